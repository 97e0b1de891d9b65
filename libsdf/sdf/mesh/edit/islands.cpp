#include "sdf/mesh/edit/islands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/edit/tiles.h"
#include "sdf/triangles/incidence.h"
#include "sdf/triangles/tree.h"

namespace sdf {
namespace {

constexpr std::size_t kMostTriangles = 512;
// So many vertices of an island are looked at, and so many of these are to be within the rest, or the centre.
constexpr int kProbes = 16, kSwallowed = 2;
constexpr float kTurned = -0.1736f;  // cos 100 degrees
constexpr std::uint32_t kNone = ~0u;
constexpr double kMostTiles = 1024.0;  // to a side

// A point of an island.
struct Probe {
  glm::vec3 at;
  std::uint32_t island;
  int weight;
  int turns = 0;  // of the rest of the mesh around it: 1 in what is solid
};

// Where the way from p along x meets a triangle: 1 out of what is solid, -1 into it, 0 nowhere. What touches
// it counts to one of the triangles there.
int passes(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  bool met = false;
  const auto cross = [&](glm::dvec3 from, glm::dvec3 to) {
    if ((from.y > p.y) == (to.y > p.y)) return;
    if (from.y > to.y) std::swap(from, to);
    met ^= p.z < from.z + (to.z - from.z) * ((p.y - from.y) / (to.y - from.y));
  };
  cross(a, b), cross(b, c), cross(c, a);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  if (!met || !(glm::dot(normal, a - p) * normal.x > 0.0)) return 0;
  return normal.x > 0.0 ? 1 : -1;
}

// How often the rest of the mesh goes around the probes.
void findTurns(const FeatureMesh& mesh, const std::vector<std::uint32_t>& islandOf,
               std::vector<Probe>& probes) {
  const auto flat = [](const glm::vec3& p) { return glm::vec3(0.0f, p.y, p.z); };
  glm::vec3 low = flat(probes[0].at), high = low;
  for (const Probe& p : probes) low = glm::min(low, flat(p.at)), high = glm::max(high, flat(p.at));
  const double along = std::sqrt(static_cast<double>(probes.size()));
  const Tiles tiles(low, high, static_cast<int>(std::clamp(along, 1.0, kMostTiles)));
  std::ranges::sort(probes, {}, [&](const Probe& p) { return tiles.at(flat(p.at)); });
  std::vector<std::uint32_t> first(tiles.count() + 1, 0);
  for (const Probe& p : probes) ++first[tiles.at(flat(p.at)) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  const auto forEachMet = [&](const glm::uvec3& t, const auto& take) {
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::vec3 least = glm::min(glm::min(a, b), c), most = glm::max(glm::max(a, b), c);
    if (most.y < low.y || least.y > high.y || most.z < low.z || least.z > high.z) return;
    tiles.forEach(flat(least), flat(most), [&](std::uint32_t tile) {
      for (std::uint32_t i = first[tile]; i < first[tile + 1]; ++i) {
        const glm::vec3& p = probes[i].at;
        if (p.x <= most.x && p.y >= least.y && p.y <= most.y && p.z >= least.z && p.z <= most.z &&
            islandOf[t.x] != probes[i].island)
          if (const int way = passes(p, a, b, c)) take(i, way);
      }
    });
  };
  using Met = std::pair<std::uint32_t, int>;
  for (const auto& [i, way] :
       collected<Met>(mesh.triangles.size(), [&](std::uint32_t t, std::vector<Met>&out) {
         forEachMet(mesh.triangles[t], [&](std::uint32_t probe, int turn) { out.emplace_back(probe, turn); });
       }))
    probes[i].turns += way;
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
  const std::vector<std::uint32_t> of = piecesOf(triangles, positions.size());
  std::vector<std::uint32_t> size(of.size(), 0);
  for (const glm::uvec3& t : triangles) ++size[of[t.x]];
  std::vector<std::array<std::uint32_t, 2>> small;  // vertices, after their pieces
  for (std::uint32_t v = 0; v < of.size(); ++v)
    if (size[of[v]] > 0 && size[of[v]] <= kMostTriangles) small.push_back({of[v], v});
  std::ranges::sort(small);
  std::vector<Island> islands;
  for (std::size_t i = 0; i < small.size(); ++i) {
    if (i == 0 || small[i][0] != small[i - 1][0]) islands.emplace_back();
    islands.back().vertices.push_back(small[i][1]);
  }
  for (Island& island : islands)
    for (const std::uint32_t v : island.vertices)
      island.centre += positions[v] / static_cast<float>(island.vertices.size());
  std::vector<std::uint32_t> islandAt(of.size(), kNone);
  for (std::uint32_t i = 0; i < islands.size(); ++i) islandAt[of[islands[i].vertices[0]]] = i;
  std::vector<double> volume(islands.size(), 0.0), turns(islands.size(), 0.0);
  for (const glm::uvec3& t : triangles)
    if (const std::uint32_t i = islandAt[of[t.x]]; i != kNone) {
      const auto corner = [&](std::uint32_t v) {
        return glm::dvec3(positions[v]) - glm::dvec3(islands[i].centre);
      };
      const glm::dvec3 a = corner(t.x), b = corner(t.y), c = corner(t.z);
      volume[i] += glm::dot(a, glm::cross(b, c));
      turns[i] += windingOf(a, b, c);
    }
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    islands[i].solid = volume[i] > 0.0;
    islands[i].holdsCentre = islands[i].solid ? turns[i] > 0.5 : turns[i] < -0.5;
  }
  return islands;
}

void dropSwallowed(FeatureMesh& mesh, const std::vector<Island>& islands) {
  if (islands.empty()) return;
  std::vector<std::uint32_t> islandOf(mesh.positions.size(), kNone);
  std::vector<Probe> probes;
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    const std::vector<std::uint32_t>& vertices = islands[i].vertices;
    for (const std::uint32_t v : vertices) islandOf[v] = i;
    if (islands[i].holdsCentre) probes.push_back({islands[i].centre, i, kProbes});
    for (int k = 0; k < kProbes; ++k)
      probes.push_back({mesh.positions[vertices[vertices.size() * k / kProbes]], i, 1});
  }
  findTurns(mesh, islandOf, probes);
  std::vector<int> within(islands.size(), 0);
  for (const Probe& p : probes)
    if (islands[p.island].solid ? p.turns > 0 : p.turns <= 0) within[p.island] += p.weight;
  const auto isGone = [&](std::uint32_t v) {
    const std::uint32_t i = islandOf[v];
    return i != kNone && within[i] >= kSwallowed;
  };
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return isGone(t.x); });
  std::erase_if(mesh.creases, [&](const auto& crease) { return isGone(crease[0]); });
}

}  // namespace sdf
