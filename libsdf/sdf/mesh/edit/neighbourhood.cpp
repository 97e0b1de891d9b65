#include "sdf/mesh/edit/neighbourhood.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "sdf/mesh/edit/indices-inl.h"

namespace sdf {
namespace {

bool isMarked(const std::vector<char>& marked, const glm::uvec3& t) {
  return (marked[t.x] | marked[t.y] | marked[t.z]) != 0 && !isGone(t);
}

}  // namespace

std::vector<std::uint32_t> trianglesWith(const std::vector<char>& marked, const FeatureMesh& mesh) {
  return indicesThat(mesh.triangles.size(),
                     [&](std::uint32_t i) { return isMarked(marked, mesh.triangles[i]); });
}

void markCorners(std::vector<char>& marked, const FeatureMesh& mesh,
                 const std::vector<std::uint32_t>& triangles) {
  for (const std::uint32_t i : triangles)
    for (int k = 0; k < 3; ++k) marked[mesh.triangles[i][k]] = 1;
}

Tiles tilesOf(const FeatureMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return Tiles::ofTriangles(low, high, mesh.triangles.size());
}

Neighbourhood::Neighbourhood(const FeatureMesh& mesh, const Tiles& tiles,
                             const std::vector<std::uint32_t>& some)
    : mesh_(mesh), tiles_(tiles), inside_(tiles.count(), 0) {
  for (const std::uint32_t i : some) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const auto enter = [&](std::uint32_t tile) { inside_[tile] = 1; };
    tiles_.forEach(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), enter, 1);
  }
  std::vector<char> marked(mesh.positions.size());
  tbb::parallel_for(std::size_t{0}, marked.size(),
                    [&](std::size_t v) { marked[v] = contains(mesh.positions[v]); });
  triangles_ = trianglesWith(marked, mesh);
}

void Neighbourhood::add(const std::vector<std::uint32_t>& triangles) {
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  std::ranges::sort(triangles_);
  triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
}

std::vector<std::uint32_t> Neighbourhood::trianglesAt(const std::vector<char>& marked) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : triangles_)
    if (isMarked(marked, mesh_.triangles[t])) found.push_back(t);
  return found;
}

}  // namespace sdf
