// glTF 2.0 through tinygltf.
#include <optional>
#include <utility>

#include "sdf/gltf/formats.h"
#include "sdf/gltf/gltf_mesh-inl.h"
#include "sdf/gltf/utf8.h"

namespace sdf {
namespace {

using tinygltf::Value;

void addPart(GltfModel& model, const ExportPart& part) {
  tinygltf::Node node;
  node.name = utf8(part.name);
  Value::Object extras = extrasOf(part.stats);
  if (part.ambient) extras["ambientError"] = Value(static_cast<double>(part.ambient->error));
  node.extras = Value(std::move(extras));
  if (!part.mesh.triangles.empty()) node.mesh = addMesh(model, part);
  model.addNode(std::move(node));
}

void addCamera(GltfModel& model, const Scene& scene) {
  const std::optional<ViewCamera> view = viewCamera(scene);
  if (!view) return;
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.name = "camera";
  camera.perspective.yfov = view->verticalFov;
  camera.perspective.znear = view->near;
  camera.perspective.zfar = view->far;
  model.cameras.push_back(std::move(camera));
  tinygltf::Node node = placed("camera", view->placement);
  node.camera = 0;
  // A mirrored picture is no rigid placement; whoever can show it finds the wish here.
  if (scene.camera.mirrored) node.extras = Value(Value::Object{{"mirrored", Value(true)}});
  model.addNode(std::move(node));
}

void addLights(GltfModel& model, const Scene& scene) {
  const Box meshes = boundsOfMeshes(model);
  const glm::dvec3 centre = meshes.empty() ? glm::dvec3(0.0) : meshes.centre();
  for (const ViewLight& view : viewLights(scene, centre)) {
    const int index = static_cast<int>(model.lights.size());
    const std::string name = "light " + std::to_string(index + 1);
    tinygltf::Light light;
    light.name = name;
    light.type = view.kind == Light::Kind::Point ? "point" : "directional";
    light.color = numbers(view.color);
    light.intensity = view.intensity;
    model.lights.push_back(std::move(light));
    tinygltf::Node node = placed(name, view.placement);
    node.extensions["KHR_lights_punctual"] = Value(Value::Object{{"light", Value(index)}});
    model.addNode(std::move(node));
  }
}

}  // namespace

Status encodeGltf(std::ostream& out, GltfContainer container, const Scene& scene,
                  const std::vector<ExportPart>& parts) {
  GltfModel model;
  for (const ExportPart& part : parts) addPart(model, part);
  addCamera(model, scene);
  addLights(model, scene);
  model.asset.extras = Value(extrasOf(combined(parts)));
  return model.write(out, container);
}

}  // namespace sdf
