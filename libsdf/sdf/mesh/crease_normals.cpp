#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/mesh/crease.h"
#include "sdf/mesh/stages.h"

namespace sdf {
namespace {

// How far into its triangles a vertex at a crease looks for the gradient of its side, as a share of the way.
constexpr float kInto = 0.1f;

/// Triangles around a vertex that no crease divides.
struct Fan {
  std::uint32_t vertex;
  std::vector<std::uint32_t> triangles;
};

class FanFinder {
 public:
  explicit FanFinder(const FeatureMesh& mesh) : mesh_(mesh), creased_(mesh.positions.size(), ~0u) {
    for (const auto& [a, b] : mesh.creases)
      for (const std::uint32_t v : {a, b})
        if (creased_[v] == ~0u) {
          creased_[v] = static_cast<std::uint32_t>(around_.size());
          around_.push_back({v, {}});
        }
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
  // Do two triangles share an edge at the vertex that is no crease?
  bool joined(std::uint32_t vertex, std::uint32_t a, std::uint32_t b) const {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = mesh_.triangles[a][i];
        if (other != vertex && other == mesh_.triangles[b][k])
          return !std::ranges::binary_search(
              mesh_.creases, std::array<std::uint32_t, 2>{std::min(vertex, other), std::max(vertex, other)});
      }
    return false;
  }

  const FeatureMesh& mesh_;
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

void splitAtCreases(const FeatureMesh& features, const LocalField& field, bool coarse, Progress& progress,
                    Mesh& mesh) {
  mesh.positions = features.positions;
  mesh.triangles = features.triangles;
  mesh.welded = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<glm::vec3> looked = features.positions;  // where a vertex looks for its gradient
  const std::vector<Fan> fans = FanFinder(features).run();
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const Fan& fan = fans[i];
    std::uint32_t v = fan.vertex;
    if (i > 0 && fans[i - 1].vertex == v) {
      v = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(glm::vec3(mesh.positions[fan.vertex]));
      mesh.copyOf.push_back(fan.vertex);
      looked.emplace_back();
    }
    glm::vec3 middle(0.0f);
    for (const std::uint32_t t : fan.triangles) {
      for (int k = 0; k < 3; ++k) {
        middle += features.positions[features.triangles[t][k]];
        if (features.triangles[t][k] == fan.vertex) mesh.triangles[t][k] = v;
      }
    }
    middle /= 3.0f * static_cast<float>(fan.triangles.size());
    looked[v] = glm::mix(features.positions[fan.vertex], middle, kInto);
  }
  gradientNormals(looked, field, progress, mesh.normals);
  const std::vector<std::uint32_t> shared = joinNormals(mesh);
  if (coarse)
    fitToGradients(mesh.positions, mesh.triangles, shared, field, progress, mesh.normals);
  else
    fitNormals(mesh.positions, mesh.triangles, mesh.normals);
}

}  // namespace sdf
