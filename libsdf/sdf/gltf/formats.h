// The encoders behind writeMeshes, one for each library.
#pragma once
#include <ostream>
#include <vector>

#include "sdf/gltf/animation.h"

namespace sdf {

enum class GltfContainer { Binary, Text };
/// glTF 2.0 with everything in one file: .glb, or .gltf with its buffer as base64. Errors: Limits (over 4 GiB
/// of .glb).
Status encodeGltf(std::ostream& out, GltfContainer container, const Scene& scene,
                  const std::vector<ExportPart>& parts);

/// The same with the scene's motion, as writeAnimation says.
Status encodeAnimation(std::ostream& out, GltfContainer container, const Animation& animation);

enum class PlainFormat { Stl, Ply, Obj };
/// Welded triangles of all parts in one list: binary STL; binary PLY with normals and sRGB colours; OBJ with
/// normals.
Status encodePlain(std::ostream& out, PlainFormat format, const std::vector<ExportPart>& parts);

}  // namespace sdf
