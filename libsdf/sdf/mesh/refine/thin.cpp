#include "sdf/mesh/refine/thin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/edit/tiles.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/refine/close_creases.h"
#include "sdf/mesh/refine/coarsen.h"
#include "sdf/mesh/refine/remesh.h"
#include "sdf/mesh/refine/remesh_measure.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {
namespace {

// Coarsening leaves the vertices on the surface, so that the error is on one side: so much of the tolerance
// leaves remeshing to do its work.
constexpr double kRough = 0.7;
// What misses the tolerance by little is held to this share of what would have kept it, down to the least.
constexpr double kStricter = 0.95, kStrictest = 0.5;
// Where remeshing fails the mesh is held so many voxels around, each time so many times as far, so often.
constexpr double kReach = 2.0, kFarther = 2.0;
constexpr int kHolds = 3, kHoldsToBest = 1;
// Where the tolerance need not be kept more than these triangles are thinned roughly only, in a tenth of the
// time.
constexpr std::size_t kMostToBest = 60'000;
// A tip has voxels like these around it.
constexpr double kAroundTip = 5.0;
// Voxels are tried no closer than so many along the mesh.
constexpr double kMostTiles = 256.0;
// A tolerance of more than a voxel that cannot be kept is too coarse for the shape: it is divided by so much.
constexpr double kFiner = 4.0;

// The vertices within a reach of some places are held.
void holdNear(const std::vector<glm::vec3>& places, double reach, Hold hold, FeatureMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 size = high - low;
  const double along = std::max({size.x, size.y, size.z}) / reach;
  const Tiles tiles(low, high, static_cast<int>(std::clamp(along, 1.0, kMostTiles)));
  std::vector<char> marked(tiles.count(), 0);
  for (const glm::vec3& p : places)
    tiles.forEach(
        p, p, [&](std::uint32_t tile) { marked[tile] = 1; }, 1);
  mesh.held.resize(mesh.positions.size(), Hold::Free);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (marked[tiles.at(mesh.positions[v])]) mesh.held[v] = std::max(mesh.held[v], hold);
}

class Thinner {
 public:
  Thinner(FeatureMesh& mesh, const LocalField& field, const Witnesses& witnesses, const ThinOptions& options,
          Progress& progress)
      : mesh_(mesh), field_(field), witnesses_(witnesses), options_(options), progress_(progress) {
    closeCreases(mesh);
    if (options.broken) leaveBroken();
    lattice_ = mesh;
  }

  bool run() {
    if (options_.once) return keepAtOnce();
    for (double tolerance = options_.tolerance;;) {
      if (keep(tolerance)) return true;
      if (tolerance <= options_.voxel || progress_.stopped()) break;
      tolerance = std::max(tolerance / kFiner, options_.voxel);
    }
    if (options_.strict && !crossing_.mesh.triangles.empty()) {
      mesh_ = std::move(crossing_.mesh);
      return true;
    }
    if (!closest_.mesh.triangles.empty()) mesh_ = std::move(closest_.mesh);
    return false;
  }

 private:
  bool keepAtOnce() {
    mesh_ = thinned(lattice_, options_.tolerance);
    std::vector<glm::vec3> trouble;
    return remeshStrictly(options_.tolerance, true, trouble);
  }

  bool keep(double tolerance) {
    const int holds = options_.strict ? kHolds : kHoldsToBest;
    FeatureMesh rough = thinned(lattice_, tolerance);
    if (!options_.strict && rough.triangles.size() > kMostToBest) {
      closest_ = {thinnedWithoutCrossings(std::move(rough), tolerance), 0, 0.0};
      return false;
    }
    double reach = kReach * options_.voxel;
    for (int i = 0; i <= holds && !progress_.stopped(); ++i, reach *= kFarther) {
      mesh_ = rough;
      std::vector<glm::vec3> trouble;
      if (remeshStrictly(tolerance, options_.strict || i == 0, trouble)) return true;
      if (trouble.empty()) break;
      if (i == 0) rough = thinnedWithoutCrossings(std::move(rough), tolerance);
      hold(trouble, reach, rough);
    }
    if (!options_.strict && closest_.crossings > 0) closest_ = {std::move(rough), 0, 0.0};
    return false;
  }

  FeatureMesh thinned(FeatureMesh mesh, double tolerance) {
    coarsen(mesh, field_, {kRough * tolerance, options_.painted}, progress_);
    return mesh;
  }

  // The lattice thinned, but for where this mesh of it crosses itself.
  FeatureMesh thinnedWithoutCrossings(FeatureMesh mesh, double tolerance) {
    FeatureMesh start = lattice_;
    double reach = kReach * options_.voxel;
    for (int i = 0; i < kHolds && !progress_.stopped(); ++i, reach *= kFarther) {
      const std::vector<glm::vec3> crossing = cornersOfCrossings(mesh);
      if (crossing.empty()) break;
      holdNear(crossing, reach, Hold::Fixed, start);
      mesh = thinned(start, tolerance);
    }
    return mesh;
  }

  // What misses the tolerance by little once more by a stricter one. Where it failed otherwise: in `trouble`.
  bool remeshStrictly(double tolerance, bool force, std::vector<glm::vec3>& trouble) {
    for (double held = tolerance; held > kStrictest * tolerance && !progress_.stopped();) {
      const RemeshResult r =
          remesh(mesh_, field_,
                 {.tolerance = held, .painted = options_.painted, .force = force, .witnesses = &witnesses_},
                 progress_);
      const std::vector<glm::vec3> crossing = cornersOfCrossings(mesh_);
      const double distance = std::max(r.maxDistance, farthest()), missed = distance / tolerance;
      if (missed <= 1.0 && crossing.empty()) return true;
      if (missed <= 1.0) crossing_.take({mesh_, crossing.size(), distance});
      closest_.take({mesh_, crossing.size(), distance});
      trouble = r.exceeding;
      trouble.insert(trouble.end(), crossing.begin(), crossing.end());
      if (!trouble.empty()) return false;
      held *= kStricter / missed;
    }
    return false;
  }

  // Of the whole mesh from the surface, by the last measure, which what is left as it is would decide.
  double farthest() const {
    if (leaves_) return 0.0;
    MeshStats stats;
    measureDistance(mesh_.positions, mesh_.triangles, field_, progress_, stats);
    return stats.maxDistance;
  }

  static std::vector<glm::vec3> cornersOfCrossings(const FeatureMesh& mesh) {
    std::vector<glm::vec3> corners;
    for (const auto& pair : crossingTriangles(mesh.positions, mesh.triangles))
      for (const std::uint32_t t : pair)
        for (int k = 0; k < 3; ++k) corners.push_back(mesh.positions[mesh.triangles[t][k]]);
    return corners;
  }

  // Around trouble: where the tolerance need not be kept nothing is asked of it any more.
  void hold(const std::vector<glm::vec3>& places, double reach, FeatureMesh& mesh) {
    holdNear(places, reach, options_.strict ? Hold::Fixed : Hold::Exempt, mesh);
    leaves_ = !options_.strict;
  }

  // What exceeds the tolerance from the start stays as it is.
  void leaveBroken() {
    const std::vector<glm::vec3> places =
        placesBeyond(options_.tolerance, mesh_, field_, options_.voxel, progress_);
    if (!places.empty()) hold(places, kReach * options_.voxel, mesh_);
  }

  // The best of what was tried: that crosses itself least, then that is closest.
  struct Best {
    FeatureMesh mesh;
    std::size_t crossings = std::numeric_limits<std::size_t>::max();
    double distance = 0.0;
    void take(Best other) {
      if (std::tie(other.crossings, other.distance) < std::tie(crossings, distance)) *this = std::move(other);
    }
  };

  FeatureMesh& mesh_;
  const LocalField& field_;
  const Witnesses& witnesses_;
  const ThinOptions& options_;
  Progress& progress_;
  FeatureMesh lattice_;
  bool leaves_ = false;  // is some of the mesh left as it is?
  Best crossing_;        // of those that keep the tolerance
  Best closest_;         // of all
};

}  // namespace

std::vector<glm::vec3> placesBeyond(double limit, const FeatureMesh& mesh, const LocalField& field,
                                    double voxel, Progress& progress) {
  std::vector<glm::vec3> points, places, tips;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    for (const glm::vec3& p : {(a + b + c) / 3.0f, (a + b) / 2.0f, (b + c) / 2.0f, (c + a) / 2.0f})
      points.push_back(p);
  }
  for (std::uint32_t v = 0; v < mesh.held.size(); ++v)
    if (mesh.held[v] == Hold::Tip) tips.push_back(mesh.positions[v]);
  const std::vector<float> distances = distancesAt(points, field, progress);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(distances[i] <= limit) && std::ranges::none_of(tips, [&](const glm::vec3& tip) {
          return glm::distance(tip, points[i]) < kAroundTip * voxel;
        }))
      places.push_back(points[i]);
  return places;
}

bool thin(FeatureMesh& mesh, const LocalField& field, const Witnesses& witnesses, const ThinOptions& options,
          Progress& progress) {
  return Thinner(mesh, field, witnesses, options, progress).run();
}

}  // namespace sdf
