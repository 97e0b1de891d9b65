#include "sdf/mesh/islands.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "sdf/mesh/indices-inl.h"
#include "sdf/mesh/surface_points.h"

namespace sdf {
namespace {

constexpr std::size_t kMostTriangles = 512;
// Vertices of which one is to be within the rest, if the centre is not.
constexpr std::size_t kSwallowed = 8;
constexpr float kTurned = -0.1736f;  // cos 100 degrees
constexpr std::uint32_t kNone = ~0u;

using Pieces = std::map<std::uint32_t, std::vector<glm::uvec3>>;  // by one of their vertices

Pieces smallPieces(const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
  std::vector<std::uint32_t> of(vertices), size(vertices, 0);
  std::iota(of.begin(), of.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (of[v] != v) v = of[v] = of[of[v]];
    return v;
  };
  for (const glm::uvec3& t : triangles) of[root(t.x)] = root(t.y), of[root(t.y)] = root(t.z);
  for (const glm::uvec3& t : triangles) ++size[root(t.x)];
  Pieces pieces;
  for (const glm::uvec3& t : triangles)
    if (const std::uint32_t r = root(t.x); size[r] <= kMostTriangles) pieces[r].push_back(t);
  return pieces;
}

// A point of an island.
struct Probe {
  glm::dvec3 at;
  std::uint32_t island;
  bool isCentre = false;
  bool inside = false;  // the rest of the mesh
};

// Does the way from p along x meet a triangle? What touches it counts to one of the triangles there.
bool isMet(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  bool met = false;
  const auto cross = [&](glm::dvec3 from, glm::dvec3 to) {
    if ((from.y > p.y) == (to.y > p.y)) return;
    if (from.y > to.y) std::swap(from, to);
    met ^= p.z < from.z + (to.z - from.z) * ((p.y - from.y) / (to.y - from.y));
  };
  cross(a, b), cross(b, c), cross(c, a);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  return met && glm::dot(normal, a - p) * normal.x > 0.0;
}

}  // namespace

bool hasSharpEdges(const std::vector<glm::vec3>& normals, const std::vector<glm::uvec3>& triangles) {
  const auto turns = [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(normals[a], normals[b]) < kTurned;
  };
  const auto isTurned = [&](std::uint32_t i) {
    const glm::uvec3& t = triangles[i];
    return turns(t.x, t.y) || turns(t.y, t.z) || turns(t.z, t.x);
  };
  return !indicesThat(triangles.size(), isTurned).empty();
}

std::vector<Island> findIslands(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles) {
  std::vector<Island> islands;
  for (const auto& [vertex, piece] : smallPieces(triangles, positions.size())) {
    Island island;
    for (const glm::uvec3& t : piece)
      for (int k = 0; k < 3; ++k) island.vertices.push_back(t[k]);
    std::ranges::sort(island.vertices);
    const auto repeated = std::ranges::unique(island.vertices);
    island.vertices.erase(repeated.begin(), repeated.end());
    for (const std::uint32_t v : island.vertices)
      island.centre += positions[v] / static_cast<float>(island.vertices.size());
    islands.push_back(std::move(island));
  }
  return islands;
}

void dropSwallowed(FeatureMesh& mesh, const std::vector<Island>& islands, const LocalField& field,
                   Progress& progress) {
  if (islands.empty()) return;
  std::vector<char> isSolid(islands.size(), 0);
  forEachRun(
      islands.size(), [&](std::size_t i) { return islands[i].centre; }, field, progress,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) isSolid[run.first + i] = g.distance(i) < 0.0f;
      });
  const auto corner = [&](std::uint32_t v) { return glm::dvec3(mesh.positions[v]); };
  std::vector<Probe> probes;
  std::vector<std::uint32_t> islandOf(mesh.positions.size(), kNone);
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    probes.push_back({glm::dvec3(islands[i].centre), i, true});
    for (const std::uint32_t v : islands[i].vertices) probes.push_back({corner(v), i}), islandOf[v] = i;
  }
  std::ranges::sort(probes, {}, [](const Probe& p) { return p.at.y; });
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = corner(t.x), b = corner(t.y), c = corner(t.z);
    const auto [low, high] = std::minmax({a.y, b.y, c.y});
    auto p = std::ranges::lower_bound(probes, low, {}, [](const Probe& probe) { return probe.at.y; });
    for (; p != probes.end() && p->at.y <= high; ++p)
      if (islandOf[t.x] != p->island && isMet(p->at, a, b, c)) p->inside ^= true;
  }
  std::vector<std::size_t> within(islands.size(), 0);
  for (const Probe& p : probes)
    if (p.inside == (isSolid[p.island] != 0))
      within[p.island] += p.isCentre ? islands[p.island].vertices.size() : 1;
  const auto isGone = [&](std::uint32_t v) {
    const std::uint32_t i = islandOf[v];
    return i != kNone && kSwallowed * within[i] >= islands[i].vertices.size();
  };
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return isGone(t.x); });
  std::erase_if(mesh.creases, [&](const auto& crease) { return isGone(crease[0]); });
}

}  // namespace sdf
