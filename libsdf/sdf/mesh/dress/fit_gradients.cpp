#include "sdf/mesh/dress/fit_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// A triangle is looked at in the middles of so many times so many parts: one for each voxel along its longest
// side, within limits.
constexpr int kFewest = 2, kMost = 8;
// Triangles at a time, to bound the memory.
constexpr std::size_t kChunk = std::size_t{1} << 14;
// What a vertex's own gradient weighs, beside those of the triangles around it.
constexpr float kOwn = 0.02f;
// The matrix's condition is at most four for each vertex: of the error a thousandth is left.
constexpr int kIterations = 12;

using Weights = std::array<float, 3>;

// Calls take(weights of the corners) for the middle of each of the n * n parts.
template <class Take>
void forEachPart(int n, const Take& take) {
  const float step = 1.0f / static_cast<float>(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k)
      for (const float in : {1.0f / 3.0f, 2.0f / 3.0f}) {
        if (in > 0.5f && i + k == n - 1) continue;
        const float u = (static_cast<float>(i) + in) * step, v = (static_cast<float>(k) + in) * step;
        take(Weights{1.0f - u - v, u, v});
      }
}

// The normal equations of the gradients' best approximation by normals that are interpolated.
class GradientFit {
 public:
  GradientFit(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
              const std::vector<std::uint32_t>& shared, float tolerance, const LocalField& field,
              Progress& progress)
      : positions_(positions),
        triangles_(triangles),
        shared_(shared),
        tolerance_(tolerance),
        field_(field),
        progress_(progress),
        products_(triangles.size()),
        right_(positions.size(), glm::vec3(0.0f)),
        diagonal_(positions.size(), 0.0f) {}

  void run(std::vector<glm::vec3>& normals) {
    for (std::size_t first = 0; first < triangles_.size() && !progress_.stopped(); first += kChunk)
      read(first, std::min(first + kChunk, triangles_.size()));
    if (progress_.stopped()) return;
    for (std::size_t v = 0; v < normals.size(); ++v) right_[v] += kOwn * diagonal_[v] * normals[v];
    std::vector<glm::vec3> fitted = normals;
    solve(fitted);
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const glm::vec3& n = fitted[shared_[v]];
      if (glm::dot(n, right_[shared_[v]]) > 0.0f) normals[v] = glm::normalize(n);
    }
  }

 private:
  // Products of the corners' weights, summed over a triangle: 00, 11, 22, 01, 12, 20.
  using Products = std::array<float, 6>;

  void read(std::size_t first, std::size_t last) {
    std::vector<glm::vec3> points, facets;
    std::vector<int> parts;
    const auto finder = field_.finder();
    for (std::size_t t = first; t < last; ++t) {
      const std::array<glm::vec3, 3> p = corners(t);
      const float longest =
          std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
      const double along = std::ceil(longest / finder->at(p[0]).voxel);
      parts.push_back(static_cast<int>(std::clamp(along, 1.0 * kFewest, 1.0 * kMost)));
      forEachPart(parts.back(),
                  [&](const Weights& w) { points.push_back(w[0] * p[0] + w[1] * p[1] + w[2] * p[2]); });
      facets.resize(points.size(), glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])));
    }
    std::vector<glm::vec3> gradients(points.size());
    forEachGradient(points, field_, progress_,
                    [&](std::size_t i, const RunGradients& g, std::size_t k) { gradients[i] = g.normal(k); });
    faceGradients(points, facets, tolerance_, field_, progress_, gradients);
    if (progress_.stopped()) return;
    const glm::vec3* g = gradients.data();
    for (std::size_t t = first; t < last; ++t) {
      const int n = parts[t - first];
      add(t, n, g);
      g += n * n;
    }
  }

  std::array<glm::vec3, 3> corners(std::size_t t) const {
    const glm::uvec3& v = triangles_[t];
    return {positions_[v.x], positions_[v.y], positions_[v.z]};
  }

  void add(std::size_t t, int n, const glm::vec3* gradients) {
    const auto [a, b, c] = corners(t);
    const glm::vec3 area = glm::cross(b - a, c - a);
    const float size = glm::length(area), weight = size / static_cast<float>(n * n);
    Products& p = products_[t];
    p.fill(0.0f);
    forEachPart(n, [&](const Weights& w) {
      const glm::vec3& g = *gradients++;
      if (!(glm::dot(g, area) > kFacing * size)) return;
      for (int k = 0; k < 3; ++k) {
        p[k] += weight * w[k] * w[k];
        p[3 + k] += weight * w[k] * w[(k + 1) % 3];
        right_[shared_[triangles_[t][k]]] += weight * w[k] * g;
      }
    });
    for (int k = 0; k < 3; ++k) diagonal_[shared_[triangles_[t][k]]] += p[k];
  }

  void multiply(const std::vector<glm::vec3>& x, std::vector<glm::vec3>& result) const {
    for (std::size_t v = 0; v < x.size(); ++v) result[v] = kOwn * diagonal_[v] * x[v];
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const glm::uvec3 v(shared_[triangles_[t].x], shared_[triangles_[t].y], shared_[triangles_[t].z]);
      const Products& p = products_[t];
      for (int k = 0; k < 3; ++k)
        result[v[k]] +=
            p[k] * x[v[k]] + p[3 + k] * x[v[(k + 1) % 3]] + p[3 + (k + 2) % 3] * x[v[(k + 2) % 3]];
    }
  }

  // Conjugate gradients (Hestenes, Stiefel 1952), each vertex scaled by its own share.
  void solve(std::vector<glm::vec3>& x) const {
    const auto scaled = [&](std::size_t v, const glm::vec3& r) {
      return diagonal_[v] > 0.0f ? r / diagonal_[v] : glm::vec3(0.0f);
    };
    std::vector<glm::vec3> r(x.size()), p(x.size()), q(x.size());
    multiply(x, q);
    glm::dvec3 rho(0.0);
    for (std::size_t v = 0; v < x.size(); ++v) {
      r[v] = right_[v] - q[v];
      p[v] = scaled(v, r[v]);
      rho += glm::dvec3(r[v]) * glm::dvec3(p[v]);
    }
    for (int i = 0; i < kIterations; ++i) {
      multiply(p, q);
      glm::dvec3 curvature(0.0), next(0.0);
      for (std::size_t v = 0; v < x.size(); ++v) curvature += glm::dvec3(p[v]) * glm::dvec3(q[v]);
      const glm::vec3 alpha = ratio(rho, curvature);
      for (std::size_t v = 0; v < x.size(); ++v) {
        x[v] += alpha * p[v];
        r[v] -= alpha * q[v];
        next += glm::dvec3(r[v]) * glm::dvec3(scaled(v, r[v]));
      }
      const glm::vec3 beta = ratio(next, rho);
      for (std::size_t v = 0; v < x.size(); ++v) p[v] = scaled(v, r[v]) + beta * p[v];
      rho = next;
    }
  }
  static glm::vec3 ratio(const glm::dvec3& a, const glm::dvec3& b) {
    glm::vec3 result(0.0f);
    for (int k = 0; k < 3; ++k)
      if (b[k] > 0.0) result[k] = static_cast<float>(a[k] / b[k]);
    return result;
  }

  const std::vector<glm::vec3>& positions_;
  const std::vector<glm::uvec3>& triangles_;
  const std::vector<std::uint32_t>& shared_;
  float tolerance_;
  const LocalField& field_;
  Progress& progress_;
  std::vector<Products> products_;
  std::vector<glm::vec3> right_;
  std::vector<float> diagonal_;
};

}  // namespace

void faceGradients(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& facets,
                   float tolerance, const LocalField& field, Progress& progress,
                   std::vector<glm::vec3>& gradients) {
  std::vector<std::size_t> turned;
  std::vector<glm::vec3> beside;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (facets[i] != glm::vec3(0.0f) && !(glm::dot(gradients[i], facets[i]) > kFacing)) turned.push_back(i);
  for (const float way : {2.0f * tolerance, -2.0f * tolerance}) {
    beside.clear();
    for (const std::size_t i : turned) beside.push_back(points[i] + way * facets[i]);
    forEachGradient(beside, field, progress, [&](std::size_t i, const RunGradients& g, std::size_t k) {
      if (glm::dot(g.normal(k), facets[turned[i]]) > kFacing) gradients[turned[i]] = g.normal(k);
    });
    std::erase_if(turned, [&](std::size_t i) { return glm::dot(gradients[i], facets[i]) > kFacing; });
  }
}

void fitToGradients(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const std::vector<std::uint32_t>& shared, float tolerance, const LocalField& field,
                    Progress& progress, std::vector<glm::vec3>& normals) {
  GradientFit(positions, triangles, shared, tolerance, field, progress).run(normals);
}

}  // namespace sdf
