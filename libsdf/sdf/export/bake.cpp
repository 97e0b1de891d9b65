#include "sdf/export/bake.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/gltf/emission.h"
#include "sdf/march/ambient_occlusion.h"
#include "sdf/mesh/mesher.h"
#include "sdf/scene/background_light.h"
#include "sdf/scene/fit.h"

namespace sdf {
namespace {

/// Vertices that a task takes.
constexpr std::size_t kChunk = 4096;

glm::vec3 valueOf(const Vec3E& v) { return {uniformValue(v.x), uniformValue(v.y), uniformValue(v.z)}; }

TapOptions tapsOf(const Scene& scene) {
  const std::optional<Box> inView = scene.camera.from ? std::nullopt : boundsInView(scene);
  const ViewLengths lengths = viewLengths(scene, inView ? std::optional(viewRadius(*inView)) : std::nullopt);
  const AmbientOcclusion& o = scene.ambientOcclusion;
  return {o.count, lengths.tapSpacing, uniformValue(o.strength), TapWeights::Relative};
}

/// The distance to all that the file holds.
Result<MarchField> fieldOf(const Scene& scene, const std::optional<Box>& clip) {
  const Shape whole = scene.whole();
  const Result<MarchField> field = marchField(clip ? clipped(whole, *clip) : whole);
  if (!field || field->hasSlope()) return field;
  return Error{
      ErrorKind::Scene,
      "ambient occlusion: the slope of the scene's distance is not known; give fields in it a lipschitz, or "
      "bounds near which their formulas have one, or leave the occlusion out"};
}

/// A vertex without a normal sees all there is.
bool hasNormal(const Mesh& mesh, std::size_t vertex) { return isUnit(glm::dvec3(mesh.normals[vertex])); }

/// What the background gives to each vertex; to one without a normal the mean of all around.
std::vector<glm::vec3> lightAround(const BackgroundLight& light, const Mesh& mesh) {
  std::vector<glm::vec3> around;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    around.emplace_back(hasNormal(mesh, i) ? light.at(glm::dvec3(mesh.normals[i])) : light.parts[0]);
  return around;
}

Status occlude(const MarchField& field, const TapOptions& taps, const Mesh& mesh, std::size_t first,
               std::vector<float>& occlusion) {
  const std::size_t end = std::min(first + kChunk, mesh.positions.size());
  Vectors points, facing;
  for (std::size_t i = first; i < end; ++i) {
    points.add(glm::dvec3(mesh.positions[i]));
    facing.add(hasNormal(mesh, i) ? glm::dvec3(mesh.normals[i]) : glm::dvec3(0.0, 1.0, 0.0));
  }
  const Result<std::vector<double>> open = occlusionByTaps(field, points, facing, taps);
  if (!open) return open.error();
  for (std::size_t i = first; i < end; ++i)
    occlusion[i] = hasNormal(mesh, i) ? static_cast<float>((*open)[i - first]) : 1.0f;
  return okStatus();
}

Result<std::vector<float>> occlusionOf(const MarchField& field, const TapOptions& taps, const Mesh& mesh,
                                       Progress& progress) {
  const std::size_t chunks = (mesh.positions.size() + kChunk - 1) / kChunk;
  std::vector<float> occlusion(mesh.positions.size());
  std::vector<Status> done(chunks, okStatus());
  std::atomic<std::size_t> count{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) {
    if (progress.stopped()) return;
    done[i] = occlude(field, taps, mesh, i * kChunk, occlusion);
    progress.update(static_cast<double>(++count) / static_cast<double>(chunks));
  });
  if (progress.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
  for (const Status& s : done)
    if (!s) return s.error();
  return occlusion;
}

}  // namespace

Status bakeAmbient(const Scene& scene, const std::optional<Box>& clip, std::span<ExportPart> parts,
                   Progress& progress) {
  AmbientLight light;
  light.color = glm::max(valueOf(scene.ambient), glm::vec3(0.0f));
  const BackgroundLight background = backgroundLight(scene);
  const bool isLitAround = background != BackgroundLight{};
  const bool isLit = isLitAround || light.color != glm::vec3(0.0f);
  std::optional<MarchField> field;
  if (scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Taps && isLit) {
    Result<MarchField> made = fieldOf(scene, clip);
    if (!made) return made.error();
    field = std::move(*made);
  }
  const TapOptions taps = tapsOf(scene);
  for (ExportPart& part : parts) {
    part.ambient = light;
    if (isLitAround) part.ambient->around = lightAround(background, part.mesh);
    if (field) {
      progress.beginStage("occlusion");
      if (Status s = keep(occlusionOf(*field, taps, part.mesh, progress), part.ambient->occlusion); !s)
        return s;
    }
    for (const Primitive& primitive : splitByMaterial(part.mesh)) {
      const float error = bakedEmission(part.mesh, primitive, *part.ambient).error;
      part.ambient->error = std::max(part.ambient->error, error);
    }
  }
  return okStatus();
}

}  // namespace sdf
