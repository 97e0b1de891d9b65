#include "sdf/mesh/mesher.h"

#include <chrono>
#include <cmath>
#include <type_traits>

#include "sdf/mesh/narrow_band.h"
#include "sdf/mesh/stages.h"
#include "sdf/shape/booleans.h"
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

Error sceneError(const std::string& name, const std::string& what) {
  return {ErrorKind::Scene, "part '" + name + "': " + what};
}

// The shape within the clip, whose faces close it.
Shape clipped(const Shape& shape, const Box& clip) {
  return intersect(shape, translate(box(Vec3E(clip.size() * 0.5)), Vec3E(clip.centre())));
}

// Runs the stages of one mesh and keeps their times.
class Mesher {
 public:
  Mesher(const std::string& name, const MeshOptions& options, Progress& progress)
      : name_(name), options_(options), progress_(progress) {}

  Result<MeshedShape> run(Shape shape) {
    if (!shape.ok()) return sceneError(name_, *shape.error);
    const Result<Box> bounds = time("bounds", [&] { return boundsOf(shape); });
    if (!bounds) return bounds.error();
    const double h =
        options_.voxelSize > 0.0 ? options_.voxelSize : bounds->longestSide() / kDefaultResolution;
    const BandOptions band{h, *bounds, options_.maxMemory};
    LocalTapes whole;
    auto sampled = time("sampling", [&] {
      const ModelTapes model = Model(shape).at(options_.values);
      whole = {model.whole(), model.whole()->firstOutputOnly()};
      auto result = sampleNarrowBand(model, band, progress_);
      if (result) findUnresolved(*result, BandField(*result, whole), progress_, result_.stats);
      return result;
    });
    if (!sampled) return sampled.error();
    const BandField field(*sampled, std::move(whole));
    RawSurface raw = time("extraction", [&] { return sampled->extract(); });
    if (raw.triangles.empty())
      return sceneError(
          name_,
          "no surface inside the bounds at this voxel size; check the bounds and the shape's position, "
          "or take a smaller voxel size");
    Mesh& mesh = result_.mesh;
    mesh.positions = std::move(raw.points);
    mesh.triangles = std::move(raw.triangles);
    mesh.welded = static_cast<std::uint32_t>(mesh.positions.size());
    time("projection", [&] {
      refineVertices(mesh.positions, mesh.normals, field, progress_);
      return 0;
    });
    time("measuring", [&] {
      measureDistance(mesh.positions, mesh.triangles, field, progress_, result_.stats);
      measureTopology(mesh.triangles, mesh.positions.size(), result_.stats);
      return 0;
    });
    time("colouring", [&] {
      colorMesh(shape, options_.values, field, progress_, mesh);
      return 0;
    });
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
      const bool inside = options_.bounds->contains(bounds);
      if (!inside) {
        shape = clipped(shape, *options_.bounds);
        bounds = intersect(bounds, *options_.bounds);
      }
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

  template <class Stage>
  std::invoke_result_t<const Stage&> time(const char* stage, const Stage& work) {
    progress_.beginStage(stage);
    const auto start = std::chrono::steady_clock::now();
    auto value = work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    result_.stageSeconds.emplace_back(stage, seconds.count());
    return value;
  }

  const std::string& name_;
  const MeshOptions& options_;
  Progress& progress_;
  MeshedShape result_;
};

}  // namespace

Result<MeshedShape> meshShape(const Shape& shape, const std::string& name, const MeshOptions& options,
                              Progress& progress) {
  return Mesher(name, options, progress).run(shape);
}

}  // namespace sdf
