// glTF 2.0 through tinygltf.
#include <utility>

#include "sdf/gltf/gltf.h"
#include "sdf/gltf/gltf_mesh-inl.h"
#include "sdf/gltf/gltf_view-inl.h"

namespace sdf {

Status encodeGltf(std::ostream& out, GltfContainer container, const Scene& scene,
                  const std::vector<ExportPart>& parts) {
  GltfModel model;
  std::size_t most = 0;
  for (const ExportPart& part : parts) most += mostBytesOf(part);
  model.bytes().reserve(most);
  for (const ExportPart& part : parts) model.addNode(partNode(model, part));
  if (const auto camera = viewCamera(scene)) addCamera(model, *camera, scene.camera.mirrored);
  for (const ViewLight& light : viewLights(scene, lightCentre(model))) addLight(model, light);
  model.asset.extras = tinygltf::Value(extrasOf(combined(parts)));
  return model.write(out, container);
}

}  // namespace sdf
