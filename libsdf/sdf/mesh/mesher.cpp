#include "sdf/mesh/mesher.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sdf/mesh/certify.h"
#include "sdf/mesh/sharpen.h"
#include "sdf/mesh/stages.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/catalog.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"

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

std::string place(const glm::dvec3& p) {
  return "(" + shown(p.x) + ", " + shown(p.y) + ", " + shown(p.z) + ")";
}

// How far a point is beyond the sides of a box; negative inside.
double beyond(const Box& box, const glm::dvec3& p) {
  const glm::dvec3 d = glm::max(box.min - p, p - box.max);
  return std::max({d.x, d.y, d.z});
}

Error sceneError(const std::string& name, const std::string& what) {
  return {ErrorKind::Scene, "part '" + name + "': " + what};
}

// The shape, whose bounds are these, within a box, whose faces close it.
Shape cut(const Shape& shape, const Box& bounds, const Box& by) {
  if (by.contains(bounds)) return shape;
  return intersect(shape, translate(box(Vec3E(by.size() * 0.5)), Vec3E(by.centre())));
}

// Runs the stages of one mesh and keeps their times.
class Mesher {
 public:
  Mesher(const std::string& name, const MeshOptions& options, Progress& progress)
      : name_(name), options_(options), progress_(progress) {}

  Result<MeshedShape> run(Shape shape) {
    if (!shape.ok()) return sceneError(name_, *shape.error);
    begin("bounds");
    const Result<Box> bounds = boundsOf(shape);
    if (!bounds) return bounds.error();
    begin("sampling");
    const double h =
        options_.voxelSize > 0.0 ? options_.voxelSize : bounds->longestSide() / kDefaultResolution;
    LocalTapes whole;
    Result<NarrowBand> sampled = sample(shape, {h, *bounds, options_.maxMemory}, whole);
    if (!sampled) return sampled.error();
    const BandField field(*sampled, std::move(whole));
    begin("extraction");
    RawSurface raw = sampled->extract();
    if (raw.triangles.empty()) return noSurface(h);
    begin("projection");
    std::vector<glm::vec3> normals;
    refineVertices(raw.points, normals, field, progress_);
    begin("creases");
    const FeatureMesh features =
        sharpen(std::move(raw.points), std::move(normals), std::move(raw.triangles), field, progress_);
    begin("measuring");
    const std::vector<float> distances =
        measureDistance(features.positions, features.triangles, field, progress_, result_.stats);
    measureTopology(features.triangles, features.positions.size(), result_.stats);
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    if (Status s = checkClaims(features, *bounds, h, distances); !s) return s.error();
    if (Status s = certifyMesh(shape, features, *bounds, h); !s) return s.error();
    begin("normals");
    Mesh& mesh = result_.mesh;
    splitAtCreases(features, field, progress_, mesh);
    begin("colouring");
    colorMesh(shape, options_.values, field, progress_, mesh);
    end();
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    result_.stats.voxels = sampled->sampleCount();
    result_.stats.voxelSize = h;
    result_.stats.notNumbers = sampled->notNumbers().count;
    result_.stats.firstNotNumber = sampled->notNumbers().first;
    return std::move(result_);
  }

 private:
  // The finite box to mesh in; clips the shape where the options say so.
  Result<Box> boundsOf(Shape& shape) {
    Box bounds = findBounds(shape);
    if (options_.bounds) {
      shape = cut(shape, bounds, *options_.bounds);
      bounds = intersect(bounds, *options_.bounds);
    }
    if (bounds.empty())
      return sceneError(name_, "nothing inside the bounds; enlarge the bounds or move the shape");
    if (!bounds.finite())
      return sceneError(
          name_,
          "unbounded in " + unboundedAxes(bounds) +
              "; give bounds({x0,y0,z0}, {x1,y1,z1}) in the scene, --bounds, or intersect it with a box");
    return bounds;
  }

  // The band of samples, in which surface passed unseen has been counted; `whole` receives the model's tapes.
  Result<NarrowBand> sample(const Shape& shape, const BandOptions& band, LocalTapes& whole) {
    const ModelTapes model = Model(shape).at(options_.values);
    whole = {model.whole(), model.whole()->firstOutputOnly()};
    auto result = sampleNarrowBand(model, band, progress_);
    if (result) findUnresolved(*result, BandField(*result, whole), progress_, result_.stats);
    return result;
  }

  Error noSurface(double voxel) const {
    const MeshStats& stats = result_.stats;
    const std::string size = " at a voxel size of " + shown(voxel);
    if (stats.unresolved > 0)
      return sceneError(name_, "too thin to be seen" + size + "; take " +
                                   (stats.resolvingVoxel > 0.0 ? "one of " + shown(stats.resolvingVoxel)
                                                               : std::string("a smaller one")));
    return sceneError(name_, "no surface inside the bounds" + size +
                                 "; check the bounds and the shape's position, or take a smaller voxel size");
  }

  // Refuses a mesh that contradicts the bounds and the slope that the shape claims. `distances` are the
  // vertices' to the surface.
  Status checkClaims(const FeatureMesh& mesh, const Box& bounds, double voxel,
                     const std::vector<float>& distances) const {
    const MeshStats& stats = result_.stats;
    // Refinement may move a vertex by a voxel, and the surface be as far from it.
    double farthest = voxel;
    const glm::vec3* outside = nullptr;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (const double d = beyond(bounds, mesh.positions[i]); d > farthest && distances[i] < voxel)
        farthest = d, outside = &mesh.positions[i];
    if (outside)
      return sceneError(name_, "the surface leaves the bounds " + place(bounds.min) + " to " +
                                   place(bounds.max) + " that are stated for it, at " + place(*outside) +
                                   "; enlarge the bounds of its field, or leave them out");
    const std::string advice =
        ": what is stated of the shape does not hold there. Enlarge the lipschitz and the bounds of its "
        "field, or leave them out; a shape without a field has to be made in another way";
    if (!stats.watertight) {
      const std::uint32_t open = openVertex(mesh.triangles, mesh.positions.size());
      return sceneError(name_, "the mesh is torn open at " + place(mesh.positions[open]) + advice);
    }
    if (stats.maxDistance > kFarthestVoxels * voxel)
      return sceneError(name_, "the mesh is off by about " + shown(stats.maxDistance) + ", " +
                                   shown(stats.maxDistance / voxel) + " voxels, at " + place(stats.farthest) +
                                   advice);
    return okStatus();
  }

  // Proves the distance, if that is asked for.
  Status certifyMesh(const Shape& shape, const FeatureMesh& mesh, const Box& bounds, double voxel) {
    if (!options_.certify) return okStatus();
    begin("certifying");
    MeshStats& stats = result_.stats;
    // Three times the measured distance is what a proof may well come to. Vertices are floats, a rounding
    // off.
    const double goal = std::max(2.5 * stats.maxDistance, 0x1p-22 * bounds.longestSide());
    const Certificate proof = certify(mesh.positions, mesh.triangles, Model(shape).at(options_.values),
                                      {bounds, goal, voxel, kFarthestVoxels * voxel}, progress_);
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    stats.provenDistance = proof.bound();
    if (proof.proven()) return okStatus();
    return Error{
        ErrorKind::Limits,
        "part '" + name_ + "': no distance below " + shown(kFarthestVoxels * voxel) +
            " is proven between mesh and surface in " + std::to_string(proof.unproven) +
            " cells, the first of side " + shown(proof.unprovenSize) + " around " +
            place(proof.firstUnproven) +
            (proof.bound() > 0.0 ? "; elsewhere it is " + shown(proof.bound()) + " at most" : "") +
            "; measured " + shown(stats.maxDistance) +
            ". The mesh may lack something there; or proofs fail: at tips, where surfaces touch, and "
            "where the slope is not known. Take a smaller voxel size, or leave --certify out"};
  }

  // Ends the present stage, if there is one, and begins another.
  void begin(const char* stage) {
    end();
    progress_.beginStage(stage);
    result_.stageSeconds.emplace_back(stage, 0.0);
    began_ = Clock::now();
  }
  void end() {
    if (result_.stageSeconds.empty()) return;
    result_.stageSeconds.back().second = std::chrono::duration<double>(Clock::now() - began_).count();
  }

  using Clock = std::chrono::steady_clock;
  const std::string& name_;
  const MeshOptions& options_;
  Progress& progress_;
  MeshedShape result_;
  Clock::time_point began_;
};

}  // namespace

Shape clipped(const Shape& shape, const Box& box) { return cut(shape, findBounds(shape), box); }

Result<MeshedShape> meshShape(const Shape& shape, const std::string& name, const MeshOptions& options,
                              Progress& progress) {
  return Mesher(name, options, progress).run(shape);
}

}  // namespace sdf
