#include "sdf/mesh/refine/balance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/edit/indices-inl.h"

namespace sdf {
namespace {

// Of an edge: half of what normals turn by along it, in radians, where that still tells of the distance.
constexpr float kMostBend = 0.35f;
// Cosine between the ways along a crease at a vertex, below which it is a corner: 40 degrees.
constexpr float kStraight = 0.766f;
// Of the least height of a vertex's triangles, what it may move by. A linear function of no more at the
// corners rises by a third at most; where part of it goes into the height it is 1 / sqrt(8), which is 20
// degrees.
constexpr float kMostMove = 1.0f / 6.0f;

class Balancer {
 public:
  Balancer(FeatureMesh& mesh, const std::vector<glm::vec3>& normals) : mesh_(mesh), normals_(normals) {}

  void run() {
    if (!mesh_.creases.empty()) findCurvatures();
    addTriangles();
    tbb::parallel_for(std::size_t{0}, sums_.size(), [&](std::size_t v) {
      if (sums_[v].area > 0.0) mesh_.positions[v] += moveOf(v);
    });
  }

 private:
  /// Over the triangles around a vertex, those of their mass matrices' rows (lumped) and right sides.
  struct Sum {
    double moment = 0.0, area = 0.0;
    float height = HUGE_VALF;  // the square of their least
    void operator+=(const Sum& o) { moment += o.moment, area += o.area, height = std::min(height, o.height); }
  };
  struct Share {
    std::uint32_t vertex;
    Sum sum;
  };

  // At a vertex that a crease passes through the circle through its neighbours tells of the curvature. A
  // chord of length l is off by the curvature times l^2 / 12 in the mean.
  void findCurvatures() {
    curvatures_.assign(mesh_.positions.size(), {});
    std::vector<std::array<std::uint32_t, 2>> ways;
    for (const auto& [a, b] : mesh_.creases) ways.push_back({a, b}), ways.push_back({b, a});
    std::ranges::sort(ways);
    for (std::size_t i = 0, end; i < ways.size(); i = end) {
      const std::uint32_t v = ways[i][0];
      for (end = i; end < ways.size() && ways[end][0] == v;) ++end;
      if (end - i != 2) continue;
      const glm::vec3 &p = mesh_.positions[v], in = p - mesh_.positions[ways[i][1]],
                      out = mesh_.positions[ways[i + 1][1]] - p;
      const float a = glm::length(in), b = glm::length(out);
      if (!(glm::dot(in, out) > kStraight * a * b)) continue;
      curvatures_[v].vector = 2.0f / (a + b) * (out / b - in / a);
      curvatures_[v].square = (a * a * a + b * b * b) / (a + b);
    }
  }

  // Four times the height of the surface over the middle of an edge, by what is known at its ends. The
  // distance in a triangle is the sum of it over the edges, times the barycentric coordinates of both ends.
  float bend(std::uint32_t a, std::uint32_t b, const glm::vec3& third) const {
    const glm::vec3 edge = mesh_.positions[b] - mesh_.positions[a];
    const glm::vec3 &u = normals_[a], &v = normals_[b];
    const float squared = glm::dot(edge, edge);
    float bend = 0.0f;
    if (!isNone(u) && !isNone(v))
      bend = 0.5f * glm::dot(v - u, edge);
    else if (!isNone(u))
      bend = -glm::dot(u, edge);
    else if (!isNone(v))
      bend = glm::dot(v, edge);
    else if (!curvatures_.empty())
      bend = -0.25f * squared * glm::dot(third, curvatures_[a].vector + curvatures_[b].vector);
    return bend * bend < kMostBend * kMostBend * squared ? bend : 0.0f;
  }

  template <class Add>
  void addTriangle(const glm::uvec3& t, const Add& add) const {
    const glm::vec3 &a = mesh_.positions[t.x], &b = mesh_.positions[t.y], &c = mesh_.positions[t.z];
    const glm::vec3 u = b - a, v = c - a, w = c - b;
    const glm::dvec3 normal(glm::cross(u, v));
    const double square = glm::dot(normal, normal), area = std::sqrt(square);
    const auto height =
        static_cast<float>(square / std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)}));
    float bends[3];  // of the edges opposite to the corners
    for (int k = 0; k < 3; ++k) bends[k] = bend(t[(k + 1) % 3], t[(k + 2) % 3], normals_[t[k]]);
    const float all = bends[0] + bends[1] + bends[2];
    for (int k = 0; k < 3; ++k) add(t[k], Sum{area * (all / 10.0f - bends[k] / 20.0f), area, height});
  }

  glm::vec3 moveOf(std::size_t v) const {
    const Sum& sum = sums_[v];
    glm::vec3 move = normals_[v] * static_cast<float>(sum.moment / sum.area);
    if (isNone(normals_[v])) {
      if (curvatures_.empty()) return glm::vec3(0.0f);
      move = curvatures_[v].vector * (-curvatures_[v].square / 12.0f);
    }
    const float size = glm::length(move), most = kMostMove * std::sqrt(sum.height);
    return size > most ? move * (most / size) : move;
  }

  // Each task adds to a range of vertices that is its own; what it has for others is added afterwards.
  void addTriangles() {
    const std::size_t chunks = (mesh_.triangles.size() + kIndexChunk - 1) / kIndexChunk;
    sums_.assign(mesh_.positions.size(), {});
    std::vector<std::uint32_t> owned(chunks + 1, 0);
    for (std::size_t c = 1; c < chunks; ++c) {
      const glm::uvec3& first = mesh_.triangles[c * kIndexChunk];
      owned[c] = std::max(owned[c - 1], std::min({first.x, first.y, first.z}));
    }
    owned[chunks] = static_cast<std::uint32_t>(sums_.size());
    const auto others =
        collected<Share>(mesh_.triangles.size(), [&](std::uint32_t t, std::vector<Share>& out) {
          const std::size_t c = t / kIndexChunk;
          addTriangle(mesh_.triangles[t], [&](std::uint32_t v, const Sum& sum) {
            if (owned[c] <= v && v < owned[c + 1])
              sums_[v] += sum;
            else
              out.push_back({v, sum});
          });
        });
    for (const Share& s : others) sums_[s.vertex] += s.sum;
  }

  /// Of a crease, at a vertex that it passes through.
  struct Curvature {
    glm::vec3 vector{0.0f};  // to where it bends, 1 / radius
    float square = 0.0f;     // mean of its edges' lengths squared, by length
  };

  FeatureMesh& mesh_;
  const std::vector<glm::vec3>& normals_;
  std::vector<Curvature> curvatures_;  // empty where there are no creases
  std::vector<Sum> sums_;
};

}  // namespace

void balanceVertices(FeatureMesh& mesh, const std::vector<glm::vec3>& normals) {
  Balancer(mesh, normals).run();
}

}  // namespace sdf
