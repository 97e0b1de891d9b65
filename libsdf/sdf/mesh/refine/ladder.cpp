#include "sdf/mesh/refine/ladder.h"

#include <algorithm>
#include <span>

#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/measure/colors.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/refine/close_creases.h"
#include "sdf/mesh/refine/simplify.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

// How many tolerances a lattice's mesh may be off for simplifying to mend it. Measured on the samples:
// beyond, it fails or leaves more triangles than half the voxels do.
constexpr double kFollowed = 2.0;
// Simplifying holds samples to this share of the tolerance, for the rounding of what is measured.
constexpr double kHeldTo = 0.999;
// Where that misses the tolerance, at bends as sharp as it, all samples are held to this share of it, and
// then of that to another one, and some more triangles are left.
constexpr double kStricter = 0.8, kStricterStill = 0.75;
// What is missed by less than this factor is tried again before finer voxels are, which take four times as
// long, held to this share of what would do (gear: 0.6 of the time, as many triangles; where a quarter is
// missed a third more triangles would be left).
constexpr double kByLittle = 1.1, kAgain = 0.95;
// Where no tolerance was asked for, a lattice of up to so many triangles is held to both however far off a
// place is, at a second each; a larger one to the first alone.
constexpr std::size_t kMostToHold = 100'000;
// Of the tolerance: what is as far from a mesh of the surface may come to be beyond it in the next.
constexpr double kNearlyMissed = 0.9;
// Voxels, times those that were asked for, whose triangles are about as large as those that a tolerance asks
// for: they tell whether colours need more.
constexpr double kAsLarge = 4.0;
// For a goal that nobody asked for a lattice of more than these, which has edges that it does not follow, is
// not tried again: simplifying four times as many did not keep it in the samples either.
constexpr std::size_t kMostToHalve = 50'000;

bool crosses(const FeatureMesh& mesh) { return !crossingTriangles(mesh.positions, mesh.triangles).empty(); }

}  // namespace

bool isClosed(const FeatureMesh& mesh) {
  return !mesh.triangles.empty() && !openVertex(mesh.triangles, mesh.positions.size());
}

Ladder::End Ladder::climb(std::unique_ptr<Lattice>& fine, bool fromCoarse, bool mayRefine) {
  witnesses_.emplace(surface_, fine->mesh, fine->borders);
  // Where this lattice does not see all that there is, coarser ones see less.
  coarsest_ = fromCoarse && fine->isResolved ? kCoarsest : 1.0;
  isBlurred_ = isBlurred_ || (options_.painted && blursColors(*fine));
  missed_ = kInfinity;
  if (simplifyCoarse(1.0, fine)) return End::Simplified;
  witnessed_ = {};
  if (progress_.stopped() || !isClosed(fine->mesh)) return End::Failed;
  const FeatureMesh mesh = fine->mesh;
  const End end = simplifyFinest(*fine, mayRefine);
  // What is missed by little is kept if all is held to somewhat less.
  const bool isSmall = mesh.triangles.size() <= kMostToHold, isLast = end == End::Simplified;
  const double first = missed_ < kByLittle ? kAgain / missed_ : kStricter;
  const double shares[] = {first, kStricterStill * first};
  for (const double share : std::span(shares).first(options_.strict || isSmall ? 2 : 1)) {
    const bool isWorthIt =
        missed_ * share <= 1.0 || (isLast && isSmall && !options_.strict && missed_ < kInfinity);
    if (!isWorthIt || progress_.stopped()) continue;
    FeatureMesh best = std::exchange(fine->mesh, mesh);
    if (simplifyCoarse(share, fine) || simplifyWithin(share, fine->mesh, *fine, fine->field))
      return End::Simplified;
    fine->mesh = std::move(best);
  }
  if (isLast) witnessed_ = witnesses_->toSurface(fine->mesh, progress_);
  return end;
}

// Only from larger voxels, with samples held to a share of the tolerance. Returns whether one keeps it.
bool Ladder::simplifyCoarse(double share, std::unique_ptr<Lattice>& fine) {
  const std::size_t seen = fine->mesh.positions.size();
  for (double times = coarsest_; times > 1.0 && !progress_.stopped(); times /= 2.0) {
    std::unique_ptr<Lattice> coarse = source_.lattice(times * fine->band.voxelSize());
    if (!coarse) break;
    if (!coarse->isResolved || !source_.makeMesh(*coarse)) continue;
    if (offBy(*coarse) > kFollowed * options_.tolerance) continue;
    FeatureMesh mesh = coarse->mesh;
    bool kept = simplifyWithin(share, mesh, *coarse, fine->field);
    if (!kept && share == 1.0 && exceeded_ > 1.0 && exceeded_ < kByLittle) {
      mesh = coarse->mesh;
      kept = simplifyWithin(kAgain / exceeded_, mesh, *coarse, fine->field);
    }
    if (!kept) continue;
    witnessed_.points = seen;  // the others are looked at again
    (options_.painted ? *fine : *coarse).mesh = std::move(mesh);
    if (!options_.painted) fine = std::move(coarse);
    return true;
  }
  return false;
}

// From the mesh itself. Where no tolerance was asked for, what comes of it is taken as it is.
Ladder::End Ladder::simplifyFinest(Lattice& fine, bool mayRefine) {
  const double off = offBy(fine);
  const bool followed = off <= kFollowed * options_.tolerance;
  if (!followed && (mayRefine || options_.strict)) return End::Failed;
  FeatureMesh mesh = fine.mesh;
  if (followed && (options_.strict || fine.isResolved)) {
    const bool kept = simplifyWithin(1.0, mesh, fine, fine.field);
    if (kept) missed_ = kInfinity;  // nothing is to be done again
    const bool helps = off > options_.tolerance && fine.mesh.triangles.size() <= kMostToHalve;
    if (!kept && mayRefine && (options_.strict || helps)) return End::NeedsFiner;
  } else {
    closeCreases(mesh);
    withColors(mesh, fine.field, [&](bool painted) {
      simplifyUnresolved(mesh, fine.field, kHeldTo * options_.tolerance, painted, progress_);
      return true;
    });
  }
  if (crosses(mesh)) return End::Failed;
  fine.mesh = std::move(mesh);
  return End::Simplified;
}

// Simplifies a lattice's mesh with samples held to a share of the tolerance. Returns whether shape and
// colours are kept; looks at what is painted as closely as in the finest lattice.
bool Ladder::simplifyWithin(double share, FeatureMesh& mesh, const Lattice& lattice, const BandField& fine) {
  return withColors(mesh, fine, [&](bool painted) {
    return simplifyTo(share * options_.tolerance, mesh, lattice, fine, painted) && !crosses(mesh);
  });
}

bool Ladder::simplifyTo(double tolerance, FeatureMesh& mesh, const Lattice& lattice, const BandField& fine,
                        bool painted) {
  closeCreases(mesh);
  const auto exceeding = [&](const FeatureMesh& made) {
    return placesBeyondTolerance(made, options_.painted ? fine : lattice.field);
  };
  exceeded_ = kInfinity;
  const bool kept = simplify(mesh, lattice.field, kHeldTo * tolerance, witnesses_->surface(), exceeding,
                             painted, progress_);
  if (!kept) missed_ = std::min(missed_, exceeded_);
  return kept;
}

// Changes the mesh by simplify(painted), once more with its colours where they need more triangles than the
// shape, which is found out. Returns what that returns.
template <class Simplify>
bool Ladder::withColors(FeatureMesh& mesh, const BandField& fine, const Simplify& simplify) {
  if (!isBlurred_) {
    FeatureMesh before = options_.painted ? mesh : FeatureMesh();
    const bool kept = simplify(false);
    isBlurred_ = options_.painted && !keepsColors(mesh, options_.tolerance, fine, progress_);
    if (!isBlurred_) return kept;
    mesh = std::move(before);
  }
  return simplify(true);
}

// Would triangles as large as the tolerance asks for blur the colours?
bool Ladder::blursColors(const Lattice& fine) {
  const std::unique_ptr<Lattice> coarse = source_.lattice(kAsLarge * fine.band.voxelSize());
  return coarse && source_.makeMesh(*coarse) &&
         !keepsColors(coarse->mesh, options_.tolerance, fine.field, progress_);
}

// How far a lattice's mesh is from the surface, either way, or where that is beyond what is followed, one of
// both; infinite where it lacks a border.
double Ladder::offBy(const Lattice& lattice) {
  if (witnesses_->toBorders(lattice.mesh, progress_) > options_.tolerance) return kInfinity;
  const double lacks = witnesses_->toSurface(lattice.mesh, progress_).max;
  if (lacks > kFollowed * options_.tolerance) return lacks;
  MeshStats stats;
  measured_.fromMesh(lattice.mesh, lattice.field, progress_, stats);
  return std::max(stats.maxDistance, lacks);
}

// Some places on a mesh or the surface that are farther from the other than the tolerance, if there are any.
std::vector<glm::vec3> Ladder::placesBeyondTolerance(const FeatureMesh& mesh, const BandField& field) {
  MeshStats stats;
  measured_.fromMesh(mesh, field, progress_, stats);
  exceeded_ = stats.maxDistance / options_.tolerance;
  if (exceeded_ > 1.0) return {stats.farthest};
  witnessed_ = witnesses_->toSurface(mesh, progress_);
  exceeded_ = witnessed_.max / options_.tolerance;
  if (exceeded_ > 1.0) return {witnessed_.farthest};
  return witness(mesh, field);
}

// Points of the surface between the witnesses that are farther from the mesh than the tolerance. What is so
// far that the mesh may come to miss it is one of the witnesses from now on.
std::vector<glm::vec3> Ladder::witness(const FeatureMesh& mesh, const BandField& field) {
  const std::vector<FarPoint>& far = measured_.fromSurface(surface_, mesh, field, options_.size, progress_);
  std::vector<glm::vec3> close, missed;
  for (std::size_t i = 0; i < far.size(); ++i) {
    if (i >= surface_.size() && far[i].distance > kNearlyMissed * options_.tolerance)
      close.push_back(far[i].at);
    if (far[i].distance > options_.tolerance) missed.push_back(far[i].at);
    exceeded_ = std::max(exceeded_, far[i].distance / options_.tolerance);
  }
  surface_.insert(surface_.end(), close.begin(), close.end());
  witnesses_->add(close);
  return missed;
}

}  // namespace sdf
