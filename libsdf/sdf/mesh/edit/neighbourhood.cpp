#include "sdf/mesh/edit/neighbourhood.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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
  // A surface passes about 3 n² of n³ tiles.
  constexpr double kTileTriangles = 100.0;
  constexpr int kMostTiles = 160;
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const double along = std::sqrt(static_cast<double>(mesh.triangles.size()) / (3.0 * kTileTriangles));
  return Tiles(low, high, std::clamp(static_cast<int>(along), 1, kMostTiles));
}

Neighbourhood::Neighbourhood(const FeatureMesh& mesh, const Tiles& tiles,
                             const std::vector<std::uint32_t>& some)
    : mesh_(mesh), tiles_(tiles), inside_(tiles.count(), 0) {
  constexpr std::size_t kChunk = 8192;
  for (const std::uint32_t i : some) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const auto enter = [&](std::uint32_t tile) { inside_[tile] = 1; };
    tiles_.forEach(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), enter, 1);
  }
  std::vector<char> marked(mesh.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, marked.size(), kChunk), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) marked[v] = contains(mesh.positions[v]);
  });
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
