#include "animation_export.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include "memory.h"
#include "sdf/scene/background_light.h"
#include "timed.h"

namespace sdf::exporter {
namespace {

constexpr std::string_view kLightRests =
    "--bake: each mesh has the light of the frame in which it is first seen; it does not follow what changes "
    "later";

std::vector<Expr> graphsOf(const Shape& shape) {
  std::vector<Expr> graphs{shape.distance};
  graphs.insert(graphs.end(), shape.surface.begin(), shape.surface.end());
  return graphs;
}

bool haveMaterialsAlike(const Shape& a, const Shape& b) {
  const auto name = [](const MaterialPtr& m) { return m->name; };
  return std::ranges::equal(a.materials, b.materials, {}, name, name);
}

bool isCut(const Shape& shape, const std::optional<Box>& clip) {
  return clip && !clip->contains(findBounds(shape));
}

bool areSame(const std::optional<Box>& a, const std::optional<Box>& b) {
  return a.has_value() == b.has_value() && (!a || (a->min == b->min && a->max == b->max));
}

bool ambientChanges(const std::vector<Scene>& scenes) {
  const auto value = [](const Scene& s) {
    const glm::dvec3 all(uniformValue(s.ambient.x), uniformValue(s.ambient.y), uniformValue(s.ambient.z));
    return std::pair(all, backgroundLight(s).parts);
  };
  return std::ranges::adjacent_find(scenes, std::ranges::not_equal_to(), value) != scenes.end();
}

/// Does what a mesh gets depend on where it is, and how it is turned?
bool hasAPlace(const Scene& scene) {
  return scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Taps ||
         backgroundLight(scene) != BackgroundLight{};
}

}  // namespace

Status AnimationExport::add(int i) {
  FrameExport frame(options_, progress_, frameSubject(options_, i));
  if (Status s = frame.load(frameTime(options_, i), voxelSize_, report_.notes); !s) return s;
  animation_.times.push_back(frameTime(options_, i));
  report_.frames.push_back({frameTime(options_, i), {}});
  for (AnimatedPart& part : animation_.parts)
    for (AnimatedMesh& mesh : part.meshes) mesh.motions.emplace_back();
  if (Status s = meshNew(frame); !s) return s;
  for (const auto& [name, seconds] : frame.report.total.stages)
    addSeconds(report_.total.stages, name, seconds);
  report_.total.seconds += frame.report.total.seconds;
  for (const std::string& warning : frame.report.warnings)
    if (std::ranges::find(report_.warnings, warning) == report_.warnings.end())
      report_.warnings.push_back(warning);
  animation_.scenes.push_back(std::move(frame.scene));
  return okStatus();
}

Status AnimationExport::meshNew(FrameExport& frame) {
  std::vector<Part> bodies;
  for (const Part& part : frame.scene.parts)
    if (!follow(trackOf(part.name), part.shape, frame.clip)) bodies.push_back(part);
  if (Status s = frame.mesh(bodies, *voxelSize_, options_.tolerance); !s) return s;
  for (std::size_t i = 0; i < bodies.size(); ++i) begin(trackOf(bodies[i].name), bodies[i].shape, frame, i);
  return okStatus();
}

AnimationExport::Track& AnimationExport::trackOf(const std::string& name) {
  const auto [it, isNew] = tracks_.try_emplace(name, Track{animation_.parts.size(), {}});
  if (isNew) animation_.parts.push_back({name, {}});
  return it->second;
}

/// Is it one of the track's meshes, as it was or moved? A body that is cut by a box is none that moves
/// through the box.
bool AnimationExport::follow(Track& track, const Shape& shape, const std::optional<Box>& clip) {
  const std::vector<Expr> graphs = graphsOf(shape);
  for (std::size_t i = track.origins.size(); i-- > 0;) {
    const Origin& origin = track.origins[i];
    if (graphsOf(origin.shape) != graphs || !areSame(origin.clip, clip) ||
        !haveMaterialsAlike(origin.shape, shape))
      continue;
    see(track, i, {});
    return true;
  }
  if (track.origins.empty()) return false;
  const Origin& latest = track.origins.back();
  if (!haveMaterialsAlike(latest.shape, shape) || isCut(latest.shape, latest.clip) || isCut(shape, clip))
    return false;
  const std::optional<RigidMotion> motion = motionBetween(graphsOf(latest.shape), graphs, latest.last);
  if (motion) see(track, track.origins.size() - 1, *motion);
  return motion.has_value();
}

void AnimationExport::begin(Track& track, const Shape& shape, FrameExport& frame, std::size_t place) {
  AnimatedMesh mesh{std::move(frame.parts[place]), {}};
  mesh.motions.resize(animation_.times.size());
  animation_.parts[track.part].meshes.push_back(std::move(mesh));
  track.origins.push_back({shape, frame.clip, {}, report_.parts.size()});
  report_.parts.push_back(std::move(frame.report.parts[place]));
  see(track, track.origins.size() - 1, {});
}

void AnimationExport::see(Track& track, std::size_t mesh, const RigidMotion& motion) {
  AnimatedPart& part = animation_.parts[track.part];
  part.meshes[mesh].motions.back() = motion;
  track.origins[mesh].last = motion;
  report_.frames.back().meshes.emplace_back(part.name, track.origins[mesh].line);
}

/// As the file's nodes are named.
void AnimationExport::nameMeshes() {
  for (const auto& [name, track] : tracks_)
    for (std::size_t i = 0; track.origins.size() > 1 && i < track.origins.size(); ++i)
      report_.parts[track.origins[i].line].name += " " + std::to_string(i + 1);
}

void AnimationExport::warn() {
  for (std::string& line : notAnimated(animation_)) report_.warnings.push_back(std::move(line));
  if (options_.bake &&
      ((moves(animation_) && hasAPlace(animation_.scenes[0])) || ambientChanges(animation_.scenes)))
    report_.warnings.emplace_back(kLightRests);
}

Status AnimationExport::write() {
  report_.file = options_.output;
  report_.time = animation_.times[0];
  report_.total.name = "total";
  nameMeshes();
  warn();
  progress_.setSubject("");
  progress_.beginStage("writing");
  if (Status s = stage(report_.total, "writing", [&] { return writeAnimation(options_.output, animation_); });
      !s)
    return s;
  std::vector<MeshStats> stats;
  for (const ReportLine& line : report_.parts) stats.push_back(line.stats);
  report_.total.stats = combined(stats);
  report_.total.peakMemory = peakMemory();
  return okStatus();
}

}  // namespace sdf::exporter
