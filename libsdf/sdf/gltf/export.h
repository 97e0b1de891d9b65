// Writing meshes: .glb and .gltf with materials, camera and lights; .stl, .ply and .obj through OpenMesh.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/mesh/mesh.h"
#include "sdf/scene/scene.h"

namespace sdf {

struct ExportPart {
  std::string name;
  Mesh mesh;
  MeshStats stats;
};

/// Is the extension one that writeMeshes takes? The error lists those it takes (ErrorKind::Usage).
Status checkExtension(const std::filesystem::path& target);

/// Writes all parts to `target`, whose extension picks the format. The file appears under its name only when
/// complete. Errors: Usage (unknown extension), Files (cannot be written).
Status writeMeshes(const std::filesystem::path& target, const Scene& scene,
                   const std::vector<ExportPart>& parts);

}  // namespace sdf
