// Scenes as glTF 2.0.
#pragma once
#include <ostream>
#include <vector>

#include "sdf/gltf/animation.h"

namespace sdf {

/// The form of a glTF file.
enum class GltfContainer {
  Binary,  ///< .glb
  Text     ///< .gltf, its buffer as base64
};
/// glTF 2.0 with everything in one file: .glb, or .gltf with its buffer as base64. Errors: Limits (over 4 GiB
/// of .glb).
Status encodeGltf(std::ostream& out, GltfContainer container, const Scene& scene,
                  const std::vector<ExportPart>& parts);

/// The same with the scene's motion, as writeAnimation (export/export.h) says.
Status encodeAnimation(std::ostream& out, GltfContainer container, const Animation& animation);

}  // namespace sdf
