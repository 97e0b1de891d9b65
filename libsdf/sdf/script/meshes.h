// Files that scripts name, and the triangle meshes among them. Private to script/.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "sdf/base/result.h"
#include "sdf/script/script.h"
#include "sdf/triangles/mesh_field.h"

namespace sdf {

/// The file that a scene names in a call of `function`, if it may read it: one in the scene's folder or below
/// it, or in a folder that the options allow. Links are followed before. Errors: Scene.
Result<std::filesystem::path> permitted(const std::string& name, const std::filesystem::path& scene,
                                        const ScriptOptions& options, const std::string& function);

/// A mesh as a field, and what a scene's author should know of it: what the reader warned of, holes that were
/// closed, surfaces that cross; or "".
struct NotedField {
  std::shared_ptr<const MeshField> field;
  std::string note;
};

/// Reads a mesh. While its field lives, the same one is given for the same file, if that has not changed.
/// Errors: those of readMesh; Scene where the mesh has no inside.
Result<NotedField> meshField(const std::filesystem::path& file, int voxels,
                             const std::filesystem::path& cache);

}  // namespace sdf
