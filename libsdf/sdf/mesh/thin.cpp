#include "sdf/mesh/thin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "sdf/mesh/crossings.h"
#include "sdf/mesh/remesh.h"
#include "sdf/mesh/remesh_topology.h"
#include "sdf/mesh/stages.h"
#include "sdf/mesh/tiles.h"

namespace sdf {
namespace {

// What misses the tolerance by little is held to this share of what would have kept it, down to the least.
constexpr double kStricter = 0.95, kStrictest = 0.5;
// Where remeshing fails the mesh is held so many voxels around, each time so many times as far, so often.
constexpr double kReach = 2.0, kFarther = 2.0;
constexpr int kHolds = 3;
// Voxels are tried no closer than so many along the mesh.
constexpr double kMostTiles = 256.0;
// A tolerance of more than a voxel that cannot be kept is too coarse for the shape: it is divided by so much.
constexpr double kFiner = 4.0;

// Closes gaps in creases, which would grow as vertices go: by edges, whose place was not found exactly, where
// facets that are no slivers meet at more than 45 degrees, and that do not end loosely.
void closeCreases(FeatureMesh& mesh) {
  constexpr float kSharp = 0.7071f, kSliver = 0.05f;
  const RemeshTopology topology(mesh);
  std::vector<glm::vec3> normals;  // 0 for slivers
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::vec3 area = glm::cross(b - a, c - a);
    const float size = glm::length(area),
                longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    normals.push_back(size > kSliver * longest ? area / size : glm::vec3(0.0f));
  }
  std::vector<std::array<std::uint32_t, 2>> sharp;
  for (std::uint32_t h = 0; h < topology.halfEdges(); ++h) {
    if (topology.from(h) > topology.to(h) || topology.isCrease(h)) continue;
    const glm::vec3 &a = normals[h / 3], &b = normals[topology.twin(h) / 3];
    if (a == glm::vec3(0.0f) || b == glm::vec3(0.0f) || glm::dot(a, b) > kSharp) continue;
    sharp.push_back({topology.from(h), topology.to(h)});
  }
  std::vector<std::uint32_t> ends(mesh.positions.size(), 0);
  for (const auto* edges : {&mesh.creases, &sharp})
    for (const auto& edge : *edges)
      for (const std::uint32_t v : edge) ++ends[v];
  const auto isLoose = [&](const std::array<std::uint32_t, 2>& edge) {
    if (ends[edge[0]] > 1 && ends[edge[1]] > 1) return false;
    --ends[edge[0]], --ends[edge[1]];
    return true;
  };
  while (std::erase_if(sharp, isLoose) > 0) {
  }
  mesh.creases.insert(mesh.creases.end(), sharp.begin(), sharp.end());
  std::sort(mesh.creases.begin(), mesh.creases.end());
}

// The vertices within a reach of some places are held.
void holdNear(const std::vector<glm::vec3>& places, double reach, FeatureMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 size = high - low;
  const double along = std::max({size.x, size.y, size.z}) / reach;
  const Tiles tiles(low, high, static_cast<int>(std::clamp(along, 1.0, kMostTiles)));
  std::vector<char> marked(tiles.count(), 0);
  for (const glm::vec3& p : places)
    tiles.forEach(
        p, p, [&](std::uint32_t tile) { marked[tile] = 1; }, 1);
  mesh.held.resize(mesh.positions.size(), 0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (marked[tiles.at(mesh.positions[v])]) mesh.held[v] = 1;
}

class Thinner {
 public:
  Thinner(FeatureMesh& mesh, const LocalField& field, const ThinOptions& options, Progress& progress)
      : mesh_(mesh), field_(field), options_(options), progress_(progress) {
    closeCreases(mesh);
    lattice_ = mesh;
  }

  bool run() {
    for (double tolerance = options_.tolerance;;) {
      if (keep(tolerance)) return true;
      if (tolerance <= options_.voxel || progress_.stopped()) break;
      tolerance = std::max(tolerance / kFiner, options_.voxel);
    }
    if (crossing_.triangles.empty()) return false;
    mesh_ = std::move(crossing_);
    return true;
  }

 private:
  bool keep(double tolerance) {
    mesh_ = lattice_;
    thinRoughly(mesh_, field_, {.tolerance = tolerance, .painted = options_.painted}, progress_);
    FeatureMesh rough = mesh_;
    double reach = kReach * options_.voxel;
    for (int i = 0; i <= kHolds && !progress_.stopped(); ++i, reach *= kFarther) {
      std::vector<glm::vec3> trouble;
      if (remeshStrictly(tolerance, trouble)) return true;
      if (trouble.empty()) break;
      holdNear(trouble, reach, rough);
      mesh_ = rough;
    }
    return false;
  }

  // What misses the tolerance by little once more by a stricter one. Where it failed otherwise: in `trouble`.
  bool remeshStrictly(double tolerance, std::vector<glm::vec3>& trouble) {
    for (double held = tolerance; held > kStrictest * tolerance && !progress_.stopped();) {
      const RemeshResult r =
          remesh(mesh_, field_, {.tolerance = held, .painted = options_.painted}, progress_);
      MeshStats stats;
      measureDistance(mesh_.positions, mesh_.triangles, field_, progress_, stats);
      const TrianglePairs pairs = crossingTriangles(mesh_.positions, mesh_.triangles);
      const double missed = std::max(r.maxDistance, stats.maxDistance) / tolerance;
      if (missed <= 1.0 && pairs.empty()) return true;
      if (missed <= 1.0 && pairs.size() < fewest_) fewest_ = pairs.size(), crossing_ = mesh_;
      trouble = r.exceeding;
      for (const auto& pair : pairs)
        for (const std::uint32_t t : pair)
          for (int k = 0; k < 3; ++k) trouble.push_back(mesh_.positions[mesh_.triangles[t][k]]);
      if (!trouble.empty()) return false;
      held *= kStricter / missed;
    }
    return false;
  }

  FeatureMesh& mesh_;
  const LocalField& field_;
  const ThinOptions& options_;
  Progress& progress_;
  FeatureMesh lattice_;
  // Of those that keep the tolerance, the one that crosses itself least.
  FeatureMesh crossing_;
  std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace

bool thin(FeatureMesh& mesh, const LocalField& field, const ThinOptions& options, Progress& progress) {
  return Thinner(mesh, field, options, progress).run();
}

}  // namespace sdf
