#include "sdf/mesh/dress/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/mesh/creases/crease.h"
#include "sdf/mesh/dress/fit_gradients.h"
#include "sdf/mesh/dress/fit_normals.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"

namespace sdf {
namespace {

// How far into its triangles a vertex at a crease looks for the gradient of its side, as a share of the way.
constexpr float kInto = 0.1f;

using Edge = std::array<std::uint32_t, 2>;

// Edges that the surface bends around within a small part of the triangles beside them: all of a small
// rounding that a coarse mesh has left. A coarse mesh of a round shape turns as much at its edges, but
// evenly.
std::vector<Edge> tightEdges(const FeatureMesh& mesh, const LocalField& field, Progress& progress) {
  constexpr float kTurned = 0.866f;  // cosine of 30 degrees, between the facets
  constexpr float kNear = 0.25f;     // of the way from the edge to a triangle's middle
  constexpr float kShare = 0.6f;     // of the turn between these middles, at least, and of 30 degrees
  const HalfEdgeMesh topology(mesh);
  const auto corner = [&](std::uint32_t t, int k) { return mesh.positions[mesh.triangles[t][k]]; };
  const auto facet = [&](std::uint32_t t) {
    return glm::normalize(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
  };
  std::vector<Edge> edges;
  std::vector<glm::vec3> points;
  for (std::uint32_t h = 0; h < topology.halfEdges(); ++h) {
    const std::uint32_t from = topology.from(h), to = topology.to(h), twin = topology.twin(h);
    if (from > to || topology.isCrease(h) || !(glm::dot(facet(h / 3), facet(twin / 3)) < kTurned)) continue;
    edges.push_back({from, to});
    const glm::vec3 on = 0.5f * (mesh.positions[from] + mesh.positions[to]);
    for (const std::uint32_t t : {h / 3, twin / 3}) {
      const glm::vec3 middle = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0f;
      points.push_back(middle);
      points.push_back(glm::mix(on, middle, kNear));
    }
  }
  std::vector<glm::vec3> gradients;
  gradientNormals(points, field, progress, gradients);
  std::vector<Edge> tight;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const glm::vec3* g = &gradients[4 * i];
    const auto angle = [](const glm::vec3& a, const glm::vec3& b) {
      return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
    };
    const float far = std::max(angle(g[0], g[2]), std::acos(kTurned));
    if (angle(g[1], g[3]) > kShare * far) tight.push_back(edges[i]);
  }
  return tight;
}

/// Triangles around a vertex that no crease divides.
struct Fan {
  std::uint32_t vertex;
  std::vector<std::uint32_t> triangles;
};

class FanFinder {
 public:
  FanFinder(const FeatureMesh& mesh, const std::vector<Edge>& creases)
      : mesh_(mesh), creases_(creases), creased_(mesh.positions.size(), ~0u) {
    const auto add = [&](std::uint32_t v) {
      if (creased_[v] != ~0u) return;
      creased_[v] = static_cast<std::uint32_t>(around_.size());
      around_.push_back({v, {}});
    };
    for (const auto& [a, b] : creases) add(a), add(b);
    for (std::uint32_t v = 0; v < mesh.tips.size(); ++v)
      if (mesh.tips[v]) add(v);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const std::uint32_t i = creased_[mesh.triangles[t][k]]; i != ~0u)
          around_[i].triangles.push_back(t);
  }

  /// The fans of each vertex on a crease, in the order of their first triangles.
  std::vector<Fan> run() const {
    std::vector<Fan> fans;
    for (const Fan& all : around_) {
      std::vector<std::uint32_t> left = all.triangles;
      while (!left.empty()) {
        Fan& fan = fans.emplace_back(Fan{all.vertex, {left.front()}});
        left.erase(left.begin());
        for (std::size_t i = 0; i < fan.triangles.size(); ++i)
          std::erase_if(left, [&](std::uint32_t t) {
            if (!joined(all.vertex, fan.triangles[i], t)) return false;
            fan.triangles.push_back(t);
            return true;
          });
      }
    }
    return fans;
  }

 private:
  // Do two triangles share an edge at the vertex that is no crease? Around a tip each has its own normal.
  bool joined(std::uint32_t vertex, std::uint32_t a, std::uint32_t b) const {
    if (mesh_.isTip(vertex)) return false;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = mesh_.triangles[a][i];
        if (other != vertex && other == mesh_.triangles[b][k])
          return !std::ranges::binary_search(creases_,
                                             Edge{std::min(vertex, other), std::max(vertex, other)});
      }
    return false;
  }

  const FeatureMesh& mesh_;
  const std::vector<Edge>& creases_;    // sorted
  std::vector<std::uint32_t> creased_;  // place in around_
  std::vector<Fan> around_;
};

// One normal for a vertex and its copies where they are those of one smooth piece: at borders of the paint.
// Returns whose normal each vertex has.
std::vector<std::uint32_t> joinNormals(Mesh& mesh) {
  std::vector<glm::vec3> sums(mesh.normals.begin(), mesh.normals.begin() + mesh.welded);
  std::vector<char> smooth(mesh.welded, 0);
  const auto root = [&](std::size_t copy) { return mesh.copyOf[copy]; };
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i) smooth[root(i)] = 1;
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i) {
    const glm::vec3& n = mesh.normals[mesh.welded + i];
    sums[root(i)] += n;
    if (glm::dot(n, mesh.normals[root(i)]) < std::cos(kCreaseAngle)) smooth[root(i)] = 0;
  }
  std::vector<std::uint32_t> shared(mesh.normals.size());
  std::iota(shared.begin(), shared.end(), 0u);
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i)
    if (smooth[root(i)]) shared[mesh.welded + i] = mesh.copyOf[i];
  for (std::size_t v = 0; v < shared.size(); ++v)
    if (const std::uint32_t u = shared[v]; u < mesh.welded && smooth[u])
      mesh.normals[v] = glm::normalize(sums[u]);
  return shared;
}

}  // namespace

void splitAtCreases(const FeatureMesh& features, const LocalField& field, float tolerance, Progress& progress,
                    Mesh& mesh) {
  mesh.positions = features.positions;
  mesh.triangles = features.triangles;
  mesh.welded = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<glm::vec3> looked = features.positions;             // where a vertex looks for its gradient
  std::vector<glm::vec3> facets(looked.size(), glm::vec3(0.0f));  // the mean ones of its fan, if it has one
  std::vector<Edge> creases = features.creases;
  if (tolerance > 0.0f) {
    const std::vector<Edge> tight = tightEdges(features, field, progress);
    creases.insert(creases.end(), tight.begin(), tight.end());
    std::ranges::sort(creases);
  }
  const std::vector<Fan> fans = FanFinder(features, creases).run();
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const Fan& fan = fans[i];
    std::uint32_t v = fan.vertex;
    if (i > 0 && fans[i - 1].vertex == v) {
      v = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(glm::vec3(mesh.positions[fan.vertex]));
      mesh.copyOf.push_back(fan.vertex);
      looked.emplace_back(), facets.emplace_back();
    }
    glm::vec3 middle(0.0f), area(0.0f);
    for (const std::uint32_t t : fan.triangles) {
      const glm::uvec3& c = features.triangles[t];
      const glm::vec3& a = features.positions[c.x];
      area += glm::cross(features.positions[c.y] - a, features.positions[c.z] - a);
      for (int k = 0; k < 3; ++k) {
        middle += features.positions[features.triangles[t][k]];
        if (features.triangles[t][k] == fan.vertex) mesh.triangles[t][k] = v;
      }
    }
    middle /= 3.0f * static_cast<float>(fan.triangles.size());
    looked[v] = glm::mix(features.positions[fan.vertex], middle, kInto);
    facets[v] = glm::normalize(area);
  }
  gradientNormals(looked, field, progress, mesh.normals);
  if (tolerance > 0.0f) faceGradients(looked, facets, tolerance, field, progress, mesh.normals);
  const std::vector<std::uint32_t> shared = joinNormals(mesh);
  if (tolerance > 0.0f)
    fitToGradients(mesh.positions, mesh.triangles, shared, tolerance, field, progress, mesh.normals);
  else
    fitNormals(mesh.positions, mesh.triangles, mesh.normals);
}

}  // namespace sdf
