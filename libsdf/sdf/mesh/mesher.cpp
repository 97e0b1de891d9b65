#include "sdf/mesh/mesher.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/band/unresolved.h"
#include "sdf/mesh/creases/borders.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/creases/tips.h"
#include "sdf/mesh/dress/color.h"
#include "sdf/mesh/dress/crease_normals.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/uncross.h"
#include "sdf/mesh/extract/placed_triangles.h"
#include "sdf/mesh/measure/against_stated.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/last_measured.h"
#include "sdf/mesh/measure/solid.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/pieces.h"
#include "sdf/mesh/refine/balance.h"
#include "sdf/mesh/refine/ladder.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/model/float_range.h"
#include "sdf/model/no_number.h"
#include "sdf/proof/certify.h"
#include "sdf/proof/obstacle.h"
#include "sdf/shape/catalog.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace {

constexpr double kDefaultResolution = 200.0;  // voxels along the longest side

// "y", "x and z", "x, y and z".
std::string unboundedAxes(const Box& b) {
  std::string text;
  for (int axis = 2, left = 0; axis >= 0; --axis)
    if (std::isinf(b.min[axis]) || std::isinf(b.max[axis]))
      text = "xyz"[axis] + std::string(left == 0 ? "" : left == 1 ? " and " : ", ") + text, ++left;
  return text;
}

Error sceneError(const std::string& name, const std::string& what) {
  return {ErrorKind::Scene, "part '" + name + "': " + what};
}

// The shape, whose bounds are these, within a box, whose faces close it.
Shape cut(const Shape& shape, const Box& bounds, const Box& by) {
  if (by.contains(bounds)) return shape;
  return intersect(shape, translate(box(Vec3E(by.size() * 0.5)), Vec3E(by.centre())));
}

// Of the longest side of the bounds: below it positions, which are floats, cannot keep a tolerance.
constexpr double kLeastTolerance = 0x1p-20;
// Of a coordinate: what lies between it and the next float at most. A voxel has to have some of them.
constexpr double kBetweenFloats = 0x1p-23, kFloatsInAVoxel = 4.0;
// Voxels: where floats are farther apart, their rounding would be seen in figures of a thousandth of a voxel,
// which is what the best meshes are off by.
constexpr double kSeen = 0x1p-10;
// Voxels: where rounding to floats moves the surface by more, distances are read in double. Figures of an
// ordinary mesh are a hundredth of a voxel and more.
constexpr double kReadWithin = 0.01;
// Voxels along the longest side of a shape with a tolerance, at least: a ball's curvature stays within a
// 4000th of its width between them.
constexpr double kAcross = 32.0;
// How often voxels are halved for a tolerance, and for what they do not resolve.
constexpr int kHalvings = 3;
// A mesh of more than these is not tried again with four times as many, nor one of more than those for what
// may not be mended by it.
constexpr std::size_t kMostTriangles = 1'000'000, kMostToTry = 150'000;

double voxelSizeOf(const MeshOptions& options, const Box& bounds) {
  return options.voxelSize > 0.0 ? options.voxelSize : bounds.longestSide() / kDefaultResolution;
}

// The largest of a box's coordinates, without their signs.
double reachOf(const Box& box) {
  const glm::dvec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({reach.x, reach.y, reach.z});
}

// Does what is seen on the surface change from place to place?
bool isPainted(const Shape& shape) {
  for (const Attribute a : {Attribute::Red, Attribute::Green, Attribute::Blue, Attribute::AmbientRed,
                            Attribute::AmbientGreen, Attribute::AmbientBlue, Attribute::MaterialId})
    if (!shape.surface[static_cast<int>(a)].isConstant()) return true;
  return false;
}

// Rounded vertices take the rest.
constexpr double kHeldToByChords = 0.95;

// The triangles of what is a mesh from a file alone, or an extruded outline, where a tolerance is to be kept.
std::optional<PlacedTriangles> ownTriangles(const Shape& shape, const MeshOptions& options) {
  if (!(options.tolerance > 0.0) || isPainted(shape)) return {};
  return placedTriangles(shape, options.values, kHeldToByChords * options.tolerance);
}

// Runs the stages of one mesh and keeps their times.
class Mesher : LatticeSource {
 public:
  /// One of so many pieces of a shape: others may have a surface where it has none.
  Mesher(const std::string& name, const MeshOptions& options, Progress& progress, std::size_t pieces)
      : name_(name), options_(options), progress_(progress), pieces_(pieces), clip_(options.bounds) {}

  Result<MeshedShape> run(Shape shape) {
    if (!shape.ok()) return sceneError(name_, *shape.error);
    begin("bounds");
    if (Result<Box> bounds = boundsOf(shape); bounds)
      bounds_ = *bounds;
    else
      return bounds.error();
    if (isPiece() && bounds_.empty()) return std::move(result_);
    double h = voxelSizeOf(options_, bounds_);
    if (const double least = kLeastTolerance * bounds_.longestSide();
        options_.tolerance > 0.0 && options_.tolerance < least)
      return Error{ErrorKind::Limits,
                   "part '" + name_ + "': a tolerance of " + shown(options_.tolerance) +
                       " is below the rounding of coordinates at this size; take at least " + shown(least)};
    if (Status s = checkFloats(h); !s) return s.error();
    if (isFar(h)) goNear(shape, h);
    const bool thins = options_.tolerance > 0.0;
    painted_ = isPainted(shape);
    const double finest = thins ? std::ldexp(h, -kHalvings) : h;
    model_ = Model(shape).at(options_.values, Accuracy{bounds_, kReadWithin * finest});
    distance_ = shape.distance;
    if (auto own = ownTriangles(shape, options_))
      if (options_.keepsFiles || own->offBy > 0.0) return takeTriangles(std::move(*own), shape, h);
    Ladder ladder({options_.tolerance, bounds_.longestSide(), options_.strict, painted_}, *this, surface_,
                  measured_, simplifying_);
    for (int halvings = 0;; ++halvings, h /= 2.0) {
      Result<std::unique_ptr<Lattice>> sampled = sample(h);
      if (!sampled) return sampled.error();
      Lattice& lattice = **sampled;
      findUnresolved(lattice.band, lattice.field, progress_, result_.stats);
      result_.stats.voxelSize = h;
      result_.stats.notNumbers = lattice.band.notNumbers().count;
      result_.stats.firstNotNumber = lattice.band.notNumbers().first;
      FeatureMesh& mesh = lattice.mesh;
      if (Status s = extract(lattice, !thins); !s) return s.error();
      const bool last =
          !thins || halvings == kHalvings || progress_.stopped() || mesh.triangles.size() > kMostTriangles;
      const bool cheap = mesh.triangles.size() <= kMostToTry;
      if (!last && cheap && canResolve(h / std::exp2(kHalvings - halvings))) continue;
      if (mesh.triangles.empty()) return isPiece() ? Result(std::move(result_)) : noSurface(h);
      if (thins) {
        result_.stats.tolerance = options_.tolerance;
        begin("simplifying");
        findSurfacePoints();
        const bool finer = !last && (options_.strict || cheap);
        lattice.isResolved = result_.stats.unresolved == 0;
        const Ladder::End end = ladder.climb(*sampled, halvings == 0, finer);
        witnessed_ = ladder.witnessed();
        if (end == Ladder::End::Simplified) return finish(shape, **sampled);
        if (end == Ladder::End::NeedsFiner) continue;
        if (Status s = checkLattice(mesh, h, lattice.field); !s) return s.error();
        if (finer) continue;
      }
      return finish(shape, lattice);
    }
  }

 private:
  // Positions and readings are floats: what they cannot tell apart is refused before any work.
  Status checkFloats(double voxel) const {
    const double farthest = reachOf(bounds_);
    if (const auto why = beyondFloats(bounds_)) return sceneError(name_, *why);
    const double apart = farthest * kBetweenFloats;
    if (voxel >= kFloatsInAVoxel * apart) return okStatus();
    return sceneError(name_, "positions, which are floats, are up to " + shown(apart) +
                                 " apart where it lies, " + shown(farthest) +
                                 " from the origin: too coarse for a voxel size of " + shown(voxel) +
                                 "; move it nearer to the origin, or take one of at least " +
                                 shown(kFloatsInAVoxel * apart));
  }

  // Does it lie where the rounding of positions shows in figures, and would not about its middle?
  bool isFar(double voxel) const {
    return reachOf(bounds_) * kBetweenFloats > kSeen * voxel &&
           glm::length(bounds_.centre()) > bounds_.longestSide();
  }

  // All is done about a place near the middle, which is at the origin until the mesh is. It is a multiple of
  // a power of two, a float that the positions' floats differ from by floats.
  void goNear(Shape& shape, double voxel) {
    const double step = std::exp2(std::floor(std::log2(voxel)));
    origin_ = glm::round(bounds_.centre() / step) * step;
    shape = relativeTo(shape, origin_);
    bounds_ = {bounds_.min - origin_, bounds_.max - origin_};
    if (clip_) clip_ = Box{clip_->min - origin_, clip_->max - origin_};
  }

  // Moves vertices to where floats far from the origin can be, so that what is measured is what is written.
  // The differences of these floats are floats, too.
  void round(FeatureMesh& mesh) const {
    if (origin_ == glm::dvec3(0.0)) return;
    for (glm::vec3& p : mesh.positions) {
      const glm::vec3 there(glm::dvec3(p) + origin_);
      p = there - glm::vec3(origin_);
    }
  }

  void goBack() {
    const auto move = [&](glm::vec3& p) { p = glm::dvec3(p) + origin_; };
    for (glm::vec3& p : result_.mesh.positions) move(p);
    MeshStats& stats = result_.stats;
    for (glm::vec3* p :
         {&stats.farthest, &stats.firstCrossing, &stats.firstUnresolved, &stats.firstNotNumber})
      move(*p);
  }

  std::string placeOf(const glm::dvec3& p) const { return shownPlace(p + origin_); }

  Result<std::unique_ptr<Lattice>> sample(double voxel) {
    begin("sampling");
    Result<NarrowBand> band = sampleNarrowBand(*model_, {voxel, bounds_, options_.maxMemory}, progress_);
    if (!band) return band.error();
    result_.stats.voxels += band->sampleCount();
    return std::make_unique<Lattice>(std::move(*band),
                                     LocalTapes{model_->whole(), model_->whole()->firstOutputOnly()});
  }

  // LatticeSource.
  std::unique_ptr<Lattice> lattice(double voxel) override {
    Result<std::unique_ptr<Lattice>> sampled = sample(voxel);
    if (!sampled) return {};
    MeshStats stats;
    findUnresolved((*sampled)->band, (*sampled)->field, progress_, stats);
    (*sampled)->isResolved = stats.unresolved == 0;
    return std::move(*sampled);
  }
  bool makeMesh(Lattice& lattice) override {
    const bool made = extract(lattice, false).ok();
    begin("simplifying");
    return made && isClosed(lattice.mesh);
  }

  // The mesh at the voxels' resolution, with its creases; empty where there is none. Its vertices lie on the
  // surface, or are balanced.
  Status extract(Lattice& lattice, bool balanced) {
    const BandField& field = lattice.field;
    begin("extraction");
    RawSurface raw = lattice.band.extract();
    if (raw.triangles.empty()) return okStatus();
    begin("projection");
    const std::vector<glm::vec3> extracted = raw.points;
    std::vector<glm::vec3> normals;
    refineVertices(raw.points, normals, field, progress_);
    leaveFilms(outwardNormals(extracted, raw.triangles), raw.points, normals, field, progress_);
    if (Status s = checkBounds(raw, field, lattice.band.voxelSize()); !s) return s;
    begin("creases");
    auto [mesh, doubtful] =
        sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, field, progress_);
    placeTips(mesh, normals, doubtful, field, progress_);
    if (balanced) {
      begin("balancing");
      const std::vector<glm::vec3> before = mesh.positions;
      balanceVertices(mesh, normals);
      if (clip_)
        for (glm::vec3& p : mesh.positions) p = glm::clamp(glm::dvec3(p), clip_->min, clip_->max);
      uncrossMoved(mesh, doubtful, before);
    }
    if (painted_) {
      begin("borders");
      lattice.borders = cutAtBorders(mesh, field, progress_);
    }
    lattice.mesh = std::move(mesh);
    return okStatus();
  }

  // A mesh from a file has its surface, but for the rounding of its vertices; that of an outline is measured.
  // The lattice is for normals.
  Result<MeshedShape> takeTriangles(PlacedTriangles own, const Shape& shape, double voxel) {
    Result<std::unique_ptr<Lattice>> sampled = sample(kCoarsest * voxel);
    if (!sampled) return sampled.error();
    Lattice& lattice = **sampled;
    result_.stats.voxelSize = lattice.band.voxelSize();
    result_.stats.tolerance = options_.tolerance;
    round(own.mesh);
    lattice.mesh = std::move(own.mesh);
    if (own.offBy > 0.0) return finish(shape, lattice);
    begin("measuring");
    measureRounding(lattice.mesh.positions, own.places, result_.stats);
    measureTopology(lattice.mesh.triangles, lattice.mesh.positions.size(), result_.stats);
    measureCrossings(lattice.mesh.positions, lattice.mesh.triangles, result_.stats);
    return dress(shape, lattice);
  }

  // Of what is not closed simplifying could make nothing.
  Status checkLattice(const FeatureMesh& mesh, double voxel, const BandField& field) {
    const std::vector<float>& distances = measured_.fromMesh(mesh, field, progress_, result_.stats);
    measureTopology(mesh.triangles, mesh.positions.size(), result_.stats);
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    return checkStated(mesh, voxel, distances);
  }

  // Would voxels as small as these see what the present ones do not? Solids that touch are thinner than any.
  bool canResolve(double least) const {
    const MeshStats& stats = result_.stats;
    return stats.unresolved > 0 && (stats.resolvingVoxel == 0.0 || stats.resolvingVoxel >= least);
  }

  // Measures and checks what was made, and dresses it.
  Result<MeshedShape> finish(const Shape& shape, Lattice& lattice) {
    round(lattice.mesh);
    const FeatureMesh& features = lattice.mesh;
    const BandField& field = lattice.field;
    const double voxel = result_.stats.voxelSize;
    begin("measuring");
    const std::vector<float>& distances = measured_.fromMesh(features, field, progress_, result_.stats);
    measureTopology(features.triangles, features.positions.size(), result_.stats);
    measureCrossings(features.positions, features.triangles, result_.stats);
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    if (Status s = checkStated(features, voxel, distances); !s) return s.error();
    measureToMesh(features, field);
    return dress(shape, lattice);
  }

  // Holds what was measured to what was asked for, and gives the mesh its normals and colours.
  Result<MeshedShape> dress(const Shape& shape, const Lattice& lattice) {
    const FeatureMesh& features = lattice.mesh;
    const BandField& field = lattice.field;
    if (Status s = checkTolerance(); !s) return s.error();
    if (Status s = certifyMesh(features, result_.stats.voxelSize); !s) return s.error();
    begin("normals");
    Mesh& mesh = result_.mesh;
    const double far =
        options_.tolerance > 0.0 ? std::max(options_.tolerance, result_.stats.maxDistance) : 0.0;
    splitAtCreases(features, field, static_cast<float>(far), progress_, mesh);
    begin("colouring");
    colorMesh(shape, features, options_.values, field, progress_, mesh);
    goBack();
    end();
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    return std::move(result_);
  }

  bool isPiece() const { return pieces_ > 1; }

  // Once. Pieces share the cells in which it is looked for, as a union's operands do.
  void findSurfacePoints() {
    if (surface_.empty())
      surface_ =
          surfacePoints(*model_, bounds_, progress_, std::max(kSurfaceCells / pieces_, kFewestSurfaceCells));
  }

  // What the mesh lacks is seen from the surface only.
  void measureToMesh(const FeatureMesh& mesh, const BandField& field) {
    findSurfacePoints();
    MeshStats& stats = result_.stats;
    // A cell's diagonal, beyond which there is no vertex in a cell; few triangles may be as far as the
    // tolerance.
    const double limit = std::max(std::numbers::sqrt3 * stats.voxelSize, stats.tolerance);
    const SurfaceDistance missed =
        farthestOf(measured_.fromSurface(surface_, mesh, field, bounds_.longestSide(), progress_), limit);
    if (stats.unresolved == 0 && missed.beyond > 0)
      stats.unresolved = missed.beyond, stats.firstUnresolved = missed.farthest;
    stats.surfacePoints = missed.points + witnessed_.points;
    for (const SurfaceDistance& from : {missed, witnessed_})
      if (from.max > stats.maxDistance) stats.maxDistance = from.max, stats.farthest = from.farthest;
  }

  Status checkTolerance() const {
    const MeshStats& stats = result_.stats;
    if (!options_.strict || stats.tolerance == 0.0 || stats.maxDistance <= stats.tolerance) return okStatus();
    return Error{ErrorKind::Limits,
                 "part '" + name_ + "': a tolerance of " + shown(stats.tolerance) +
                     " could not be kept; the best that was reached is " + shown(stats.maxDistance) +
                     ", at " + placeOf(stats.farthest) +
                     ". Take a larger tolerance or a smaller voxel size, or let it be kept where it can be "
                     "(sdf2gltf: --keep-going)"};
  }

  // The finite box to mesh in; clips the shape where the options say so.
  Result<Box> boundsOf(Shape& shape) {
    Box bounds = findBounds(shape);
    if (options_.bounds) {
      shape = cut(shape, bounds, *options_.bounds);
      bounds = intersect(bounds, *options_.bounds);
    }
    if (bounds.empty() && isPiece()) return bounds;
    if (bounds.empty())
      return sceneError(name_, "nothing inside the bounds; enlarge the bounds or move the shape");
    if (!bounds.finite())
      return sceneError(name_, "unbounded in " + unboundedAxes(bounds) +
                                   "; give bounds({x0,y0,z0}, {x1,y1,z1}) in the scene (sdf2gltf: or "
                                   "--bounds), or intersect it with a box");
    return bounds;
  }

  Error noSurface(double voxel) const {
    const MeshStats& stats = result_.stats;
    const std::string size = " at a voxel size of " + shown(voxel);
    const double seeing = stats.resolvingVoxel;
    if (stats.unresolved > 0)
      return sceneError(name_, "too thin to be seen" + size + "; " +
                                   (seeing == 0.0                     ? "take a smaller one"
                                    : seeing < kFinestAdvised * voxel ? "make it thicker than " + shown(voxel)
                                                                      : "take one of " + shown(seeing)));
    return sceneError(name_, "no surface inside the bounds" + size +
                                 "; check the bounds and the shape's position, or take a smaller voxel size");
  }

  // Refuses a mesh that leaves the bounds that are stated of the shape, or is not the shape's. `distances`
  // are the vertices' to the surface.
  Status checkStated(const FeatureMesh& mesh, double voxel, const std::vector<float>& distances) const {
    const auto fault = faultOf({mesh, distances, result_.stats, bounds_, voxel, origin_}, *model_);
    return fault ? Status(explained(*fault, voxel)) : okStatus();
  }

  // What is no number lies behind all other faults.
  Error explained(const MeshFault& fault, double voxel) const {
    const auto blamed = noNumberAround(fault.at, voxel);
    return sceneError(name_, blamed ? *blamed : fault.what);
  }

  // Names what is no number near a place.
  std::optional<std::string> noNumberAround(const glm::dvec3& p, double voxel) const {
    const auto found = findNoNumber(distance_, Box{p, p}.grown(kFarthestVoxels * voxel), options_.values);
    if (!found) return {};
    return textOf(*found, placeOf(found->at));
  }

  // What leaves its bounds by more than finer voxels would change is refused before work is done on it.
  Status checkBounds(const RawSurface& raw, const BandField& field, double voxel) {
    const double allowed = 2.0 * std::max(voxel, options_.tolerance);
    const auto outside = farthestOutside(raw.points, bounds_, allowed);
    if (!outside) return okStatus();
    if (const auto blamed = noNumberAround(*outside, voxel)) return sceneError(name_, *blamed);
    FeatureMesh mesh;
    mesh.positions = raw.points;
    mesh.triangles = raw.triangles;
    MeshStats stats;
    const std::vector<float>& distances = measured_.fromMesh(mesh, field, progress_, stats);
    const auto fault = leavesBounds({mesh, distances, stats, bounds_, voxel, origin_});
    return fault && !progress_.stopped() ? Status(sceneError(name_, fault->what)) : okStatus();
  }

  // Proves the distance, if that is asked for.
  Status certifyMesh(const FeatureMesh& mesh, double voxel) {
    if (!options_.certify) return okStatus();
    begin("certifying");
    MeshStats& stats = result_.stats;
    // Three times the measured distance is what a proof may well come to. Vertices are floats, a rounding
    // off.
    const double goal = std::max(2.5 * stats.maxDistance, 0x1p-22 * bounds_.longestSide());
    const double limit = std::max(kFarthestVoxels * voxel, 4.0 * goal);
    const Certificate proof =
        certify(mesh.positions, mesh.triangles, *model_, {bounds_, goal, voxel, limit}, progress_);
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    stats.provenDistance = proof.bound();
    if (proof.proven()) return okStatus();
    const Box cell = Box{proof.firstUnproven, proof.firstUnproven}.grown(0.5 * proof.unprovenSize);
    const std::string obstacle = obstacleIn(distance_, cell, options_.values);
    return Error{
        ErrorKind::Limits,
        "part '" + name_ + "': no distance below " + shown(limit) +
            " is proven between mesh and surface in " + std::to_string(proof.unproven) +
            " cells, the first of side " + shown(proof.unprovenSize) + " around " +
            placeOf(proof.firstUnproven) +
            (proof.bound() > 0.0 ? "; elsewhere it is " + shown(proof.bound()) + " at most" : "") +
            "; measured " + shown(stats.maxDistance) + (obstacle.empty() ? "" : ". There " + obstacle) +
            ". The mesh may lack something there; or proofs fail: at tips, where surfaces touch, and "
            "where the slope is not known. Take a smaller voxel size, or leave --certify out"};
  }

  // Ends the present stage, if there is one, and begins another, or one of before again.
  void begin(const char* stage) {
    end();
    progress_.beginStage(stage);
    auto& stages = result_.stageSeconds;
    stage_ = std::ranges::find(stages, stage, [](const auto& s) { return s.first; }) - stages.begin();
    if (stage_ == stages.size()) stages.emplace_back(stage, 0.0);
    began_ = Clock::now();
  }
  void end() {
    if (result_.stageSeconds.empty()) return;
    result_.stageSeconds[stage_].second += std::chrono::duration<double>(Clock::now() - began_).count();
  }

  using Clock = std::chrono::steady_clock;
  const std::string& name_;
  const MeshOptions& options_;
  Expr distance_;  // of the shape
  std::optional<ModelTapes> model_;
  Box bounds_;  // the finite box to mesh in
  Progress& progress_;
  Progress simplifying_{&progress_};  // nobody knows how often it is tried, and so what share is done
  std::size_t pieces_;
  std::optional<Box> clip_;  // as the options have it
  glm::dvec3 origin_{0.0};   // of the coordinates in use
  MeshedShape result_;
  bool painted_ = false;
  std::vector<glm::vec3> surface_;  // points of it
  LastMeasured measured_;
  SurfaceDistance witnessed_;  // from vertices of a finer lattice, where there was one
  std::size_t stage_ = 0;
  Clock::time_point began_;
};

// With a tolerance shapes have triangles, and voxels, by their own size, but for what is clipped.
bool isBySize(const Shape& shape, const MeshOptions& options) {
  return options.tolerance > 0.0 && shape.bounds.finite() && !shape.bounds.empty() &&
         (!options.bounds || options.bounds->contains(shape.bounds)) &&
         options.tolerance >= kLeastTolerance * shape.bounds.longestSide();
}

// Those of the options for a shape within such bounds, whose voxels are no larger than these. They are not
// finer than its floats and the tolerance ask for.
MeshOptions bySize(const Box& bounds, double voxel, MeshOptions options) {
  const double least = std::max(options.tolerance, kFloatsInAVoxel * kBetweenFloats * reachOf(bounds));
  options.voxelSize = std::min(voxel, std::max(bounds.longestSide() / kAcross, least));
  options.bounds = {};
  return options;
}

// What is a mesh from a file leaves by its own triangles where they are asked for, or where others that keep
// the tolerance are no fewer.
Result<MeshedShape> meshOne(const Shape& shape, const std::string& name, const MeshOptions& options,
                            Progress& progress, std::size_t pieces = 1) {
  Result<MeshedShape> made = Mesher(name, options, progress, pieces).run(shape);
  if (options.keepsFiles || progress.stopped()) return made;
  const auto own = ownTriangles(shape, options);
  if (!own || own->offBy > 0.0 || (made && made->stats.triangles < own->mesh.triangles.size())) return made;
  MeshOptions kept = options;
  kept.keepsFiles = true;
  return Mesher(name, kept, progress, pieces).run(shape);
}

// Pieces that lie apart each by itself, where they have triangles by their own size.
Result<MeshedShape> meshInPieces(const Shape& shape, const std::string& name, const MeshOptions& options,
                                 Progress& progress) {
  if (!isBySize(shape, options)) return meshOne(shape, name, options, progress);
  const double voxel = voxelSizeOf(options, shape.bounds);
  // A mesh leaves its bounds by no more than the larger (faultOf), so that two cannot meet.
  const std::vector<Piece> pieces = isolatedPieces(shape, 2.0 * std::max(voxel, options.tolerance));
  if (pieces.size() > 1) {
    const auto mesh = [&](const Shape& piece, Progress& own) {
      return meshOne(piece, name, bySize(piece.bounds, voxel, options), own, pieces.size());
    };
    Result<MeshedShape> meshed = meshPieces(shape, pieces, options.values, mesh, progress);
    if (!meshed || !meshed->mesh.triangles.empty()) return meshed;
  }
  if (!(options.voxelSize > 0.0)) return meshOne(shape, name, options, progress);
  return meshOne(shape, name, bySize(shape.bounds, voxel, options), progress);
}

}  // namespace

Shape clipped(const Shape& shape, const Box& box) { return cut(shape, findBounds(shape), box); }

Result<MeshedShape> meshShape(const Shape& shape, const std::string& name, const MeshOptions& options,
                              Progress& progress) {
  Result<MeshedShape> made = meshInPieces(shape, name, options, progress);
  if (made) measureSolid(made->mesh, made->stats);
  return made;
}

}  // namespace sdf
