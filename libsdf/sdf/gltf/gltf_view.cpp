#include <utility>

#include "sdf/gltf/gltf_mesh-inl.h"
#include "sdf/gltf/gltf_view-inl.h"

namespace sdf {

using tinygltf::Value;

int addCamera(GltfModel& model, const ViewCamera& view, bool mirrored) {
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.name = "camera";
  camera.perspective.yfov = view.verticalFov;
  camera.perspective.znear = view.near;
  camera.perspective.zfar = view.far;
  tinygltf::Node node = placed("camera", view.placement);
  node.camera = static_cast<int>(model.cameras.size());
  model.cameras.push_back(std::move(camera));
  // A mirrored picture is no rigid placement; whoever can show it finds the wish here.
  if (mirrored) node.extras = Value(Value::Object{{"mirrored", Value(true)}});
  return model.addNode(std::move(node));
}

int addLight(GltfModel& model, const ViewLight& view) {
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
  return model.addNode(std::move(node));
}

glm::dvec3 lightCentre(const GltfModel& model) {
  const Box meshes = boundsOfMeshes(model);
  return meshes.empty() ? glm::dvec3(0.0) : meshes.centre();
}

}  // namespace sdf
