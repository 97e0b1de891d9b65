#include "sdf/gltf/animation.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <iterator>
#include <utility>

#include "sdf/base/utf8.h"
#include "sdf/gltf/gltf.h"
#include "sdf/gltf/gltf_mesh-inl.h"
#include "sdf/gltf/gltf_view-inl.h"

namespace sdf {
namespace {

using tinygltf::Value;

bool same(const std::vector<float>& values, std::size_t each) {
  for (std::size_t i = each; i < values.size(); ++i)
    if (values[i] != values[i - each]) return false;
  return true;
}

/// Adds nodes' keys to a file's only animation, which is there once there are any.
class KeyWriter {
 public:
  KeyWriter(GltfModel& model, const std::vector<double>& times) : model_(model), times_(times) {}

  /// Puts the node where it is at first, and lets it follow the motions.
  void move(int node, const std::vector<RigidMotion>& motions) {
    std::vector<float> translations, rotations;
    glm::dquat last = motions[0].rotation;
    for (const RigidMotion& m : motions) {
      // q and -q are one turn; between neighbours of one sign a reader goes the shorter way.
      last = glm::dot(last, m.rotation) < 0.0 ? -m.rotation : m.rotation;
      append(translations, numbers(m.translation));
      append(rotations, numbers(last));
    }
    if (motions[0].translation != glm::dvec3(0.0))
      model_.nodes[node].translation = numbers(motions[0].translation);
    if (motions[0].rotation != glm::dquat(1.0, 0.0, 0.0, 0.0))
      model_.nodes[node].rotation = numbers(motions[0].rotation);
    if (!same(translations, 3)) key(node, "translation", "LINEAR", translations, TINYGLTF_TYPE_VEC3);
    if (!same(rotations, 4)) key(node, "rotation", "LINEAR", rotations, TINYGLTF_TYPE_VEC4);
  }

  /// Lets the node be there, or not: the scale is 1 or 0.
  void show(int node, const std::vector<bool>& there) {
    std::vector<float> scales;
    for (const bool t : there) scales.insert(scales.end(), 3, t ? 1.0f : 0.0f);
    if (!there[0]) model_.nodes[node].scale = {0.0, 0.0, 0.0};
    if (!same(scales, 3)) key(node, "scale", "STEP", scales, TINYGLTF_TYPE_VEC3);
  }

 private:
  static void append(std::vector<float>& values, const std::vector<double>& more) {
    values.insert(values.end(), more.begin(), more.end());
  }

  /// The accessor of the keys' times, from 0.
  int timesAccessor() {
    constexpr int kNoTarget = 0;
    const auto at = [&](std::size_t i) { return static_cast<float>(times_[i] - times_[0]); };
    const int index = model_.addAccessor(model_.addView(times_.size(), kNoTarget, at), times_.size(),
                                         TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR);
    model_.accessors[index].minValues = {0.0};
    model_.accessors[index].maxValues = {at(times_.size() - 1)};
    return index;
  }

  void key(int node, const char* path, const char* interpolation, const std::vector<float>& values,
           int type) {
    if (model_.animations.empty()) {
      model_.animations.emplace_back().name = "frames";
      input_ = timesAccessor();
    }
    tinygltf::Animation& animation = model_.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = input_;
    sampler.interpolation = interpolation;
    sampler.output = addValues(values, type);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
  }

  int addValues(const std::vector<float>& values, int type) {
    constexpr int kNoTarget = 0;
    const auto added = [&](auto element) {
      constexpr std::size_t kEach = sizeof(element) / sizeof(float);
      const std::size_t count = values.size() / kEach;
      const int view = model_.addView(count, kNoTarget, [&](std::size_t i) {
        decltype(element) e;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * kEach), kEach, e.begin());
        return e;
      });
      return model_.addAccessor(view, count, TINYGLTF_COMPONENT_TYPE_FLOAT, type);
    };
    return type == TINYGLTF_TYPE_VEC3 ? added(std::array<float, 3>()) : added(std::array<float, 4>());
  }

  GltfModel& model_;
  const std::vector<double>& times_;
  int input_ = -1;
};

/// Motions without gaps: where there is none, the last one holds, or at first the next.
std::vector<RigidMotion> filled(const std::vector<std::optional<RigidMotion>>& motions) {
  const auto first = std::ranges::find_if(motions, [](const auto& m) { return m.has_value(); });
  std::vector<RigidMotion> all;
  RigidMotion last = first == motions.end() ? RigidMotion() : **first;
  for (const auto& m : motions) all.push_back(last = m.value_or(last));
  return all;
}

bool turns(const std::vector<RigidMotion>& motions) {
  return std::ranges::any_of(motions,
                             [&](const RigidMotion& m) { return m.rotation != motions[0].rotation; });
}

/// Middle of the mesh's box, in float.
glm::vec3 middleOf(const Mesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return 0.5f * (low + high);
}

/// Adds a node that moves so; where it turns it does so about the middle of its mesh, which a child holds.
/// Between two keys a reader moves a node's origin along a chord: about the scene's origin all that is far
/// from it would sway.
int addMoving(GltfModel& model, tinygltf::Node node, const std::optional<int>& parent, const Mesh& mesh,
              std::vector<RigidMotion> motions, KeyWriter& keys) {
  const auto add = [&](tinygltf::Node one) {
    return parent ? model.addNode(std::move(one), *parent) : model.addNode(std::move(one));
  };
  if (node.mesh < 0 || !turns(motions)) {
    const int index = add(std::move(node));
    keys.move(index, motions);
    return index;
  }
  const glm::dvec3 middle(middleOf(mesh));
  tinygltf::Node held = placed(node.name + " about its middle", {-middle, {1.0, 0.0, 0.0, 0.0}});
  held.mesh = std::exchange(node.mesh, -1);
  const int index = add(std::move(node));
  model.addNode(std::move(held), index);
  for (RigidMotion& m : motions) m.translation = m(middle);
  keys.move(index, motions);
  return index;
}

void addPart(GltfModel& model, const AnimatedPart& part, KeyWriter& keys) {
  std::optional<int> parent;
  if (part.meshes.size() > 1) {
    tinygltf::Node node;
    node.name = utf8(part.name);
    parent = model.addNode(std::move(node));
  }
  for (std::size_t i = 0; i < part.meshes.size(); ++i) {
    const AnimatedMesh& mesh = part.meshes[i];
    tinygltf::Node node = partNode(model, mesh.part);
    if (parent) node.name += " " + std::to_string(i + 1);
    const int index = addMoving(model, std::move(node), parent, mesh.part.mesh, filled(mesh.motions), keys);
    std::vector<bool> there;
    for (const auto& m : mesh.motions) there.push_back(m.has_value());
    keys.show(index, there);
  }
}

RigidMotion motionTo(const Placement& p) { return {p.rotation, p.position}; }

/// The camera in each frame; a fitted one sees all of them. Empty where one of them has none.
std::vector<ViewCamera> camerasOf(const Animation& animation) {
  std::optional<Box> all;
  for (const Scene& scene : animation.scenes)
    if (const std::optional<Box> box = boundsInView(scene)) all = all ? unite(*all, *box) : *box;
  std::vector<ViewCamera> cameras;
  for (const Scene& scene : animation.scenes)
    if (const std::optional<ViewCamera> camera = viewCamera(scene, all)) cameras.push_back(*camera);
  if (cameras.size() < animation.scenes.size()) cameras.clear();
  return cameras;
}

/// Are the scenes' lights the same, but for where they are and how bright?
bool haveLightsAlike(const Animation& animation) {
  return std::ranges::all_of(animation.scenes, [&](const Scene& scene) {
    return std::ranges::equal(scene.lights, animation.scenes[0].lights, {}, &Light::kind, &Light::kind);
  });
}

/// The first frame's lights as they stand in each frame, by frame. Only in the first where the scenes' are
/// not alike.
std::vector<std::vector<ViewLight>> lightsOf(const Animation& animation, const glm::dvec3& centre) {
  Scene scene = animation.scenes[0];
  std::vector<std::vector<ViewLight>> lights{viewLights(scene, centre)};
  if (!haveLightsAlike(animation)) return lights;
  for (std::size_t i = 1; i < animation.scenes.size(); ++i) {
    for (std::size_t k = 0; k < scene.lights.size(); ++k)
      scene.lights[k].vector = animation.scenes[i].lights[k].vector;
    lights.push_back(viewLights(scene, centre));
    if (lights.back().size() != lights.front().size()) return {lights.front()};
  }
  return lights;
}

void addCameraAndLights(GltfModel& model, const Animation& animation, KeyWriter& keys) {
  if (const std::vector<ViewCamera> cameras = camerasOf(animation); !cameras.empty()) {
    std::vector<RigidMotion> motions;
    for (const ViewCamera& camera : cameras) motions.push_back(motionTo(camera.placement));
    keys.move(addCamera(model, cameras[0], animation.scenes[0].camera.mirrored), motions);
  }
  const std::vector<std::vector<ViewLight>> lights = lightsOf(animation, lightCentre(model));
  for (std::size_t i = 0; i < lights[0].size(); ++i) {
    const int node = addLight(model, lights[0][i]);
    std::vector<RigidMotion> motions;
    for (const std::vector<ViewLight>& frame : lights) motions.push_back(motionTo(frame[i].placement));
    if (motions.size() == animation.times.size()) keys.move(node, motions);
  }
}

}  // namespace

Status encodeAnimation(std::ostream& out, GltfContainer container, const Animation& animation) {
  GltfModel model;
  KeyWriter keys(model, animation.times);
  std::vector<MeshStats> stats;
  std::size_t most = 0;
  for (const AnimatedPart& part : animation.parts)
    for (const AnimatedMesh& mesh : part.meshes) {
      most += mostBytesOf(mesh.part);
      stats.push_back(mesh.part.stats);
    }
  model.bytes().reserve(most);
  for (const AnimatedPart& part : animation.parts) addPart(model, part, keys);
  addCameraAndLights(model, animation, keys);
  model.asset.extras = Value(extrasOf(combined(stats)));
  return model.write(out, container);
}

std::vector<std::string> notAnimated(const Animation& animation) {
  std::vector<std::string> lines;
  const auto changes = [](const auto& all, const auto& value) {
    return std::ranges::adjacent_find(all, std::ranges::not_equal_to(), value) != all.end();
  };
  const std::vector<ViewCamera> cameras = camerasOf(animation);
  if (cameras.empty() && viewCamera(animation.scenes[0]))
    lines.emplace_back("the camera is not one at all times; the file has none");
  if (changes(cameras, &ViewCamera::verticalFov))
    lines.emplace_back("the camera's field of view changes; the file has that of the first frame");
  if (!haveLightsAlike(animation)) {
    lines.emplace_back(
        "lights come, go or change their kind; the file has those of the first frame, at rest");
    return lines;
  }
  const auto valueOf = [](const Vec3E& v) {
    return glm::dvec3(uniformValue(v.x), uniformValue(v.y), uniformValue(v.z));
  };
  for (std::size_t i = 0; i < animation.scenes[0].lights.size(); ++i) {
    const std::string light = "light " + std::to_string(i + 1);
    const auto brightness = [&](const Scene& scene) {
      return valueOf(scene.lights[i].color) * uniformValue(scene.lights[i].intensity);
    };
    if (changes(animation.scenes, brightness))
      lines.push_back(light + " changes its colour or intensity; the file has those of the first frame");
    const auto place = [&](const Scene& scene) { return valueOf(scene.lights[i].vector); };
    if (animation.scenes[0].lights[i].kind == Light::Kind::Point && changes(animation.scenes, place))
      lines.push_back(
          light + " moves; its candela agree with the scene's intensity where it stands in the first frame");
  }
  return lines;
}

bool moves(const Animation& animation) {
  return std::ranges::any_of(animation.parts, [](const AnimatedPart& part) {
    if (part.meshes.size() > 1) return true;
    const std::vector<std::optional<RigidMotion>>& motions = part.meshes[0].motions;
    return std::ranges::any_of(motions, [&](const auto& m) {
      return m.has_value() != motions[0].has_value() ||
             (m && (m->translation != motions[0]->translation || m->rotation != motions[0]->rotation));
    });
  });
}

}  // namespace sdf
