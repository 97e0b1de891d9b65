// Triangle meshes that scripts name. Private to script/.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "sdf/base/result.h"
#include "sdf/script/script.h"
#include "sdf/triangles/mesh_field.h"

namespace sdf {

/// The file that a scene names, if it may read it: one in the scene's folder or below it, or in a folder that
/// the options allow. Links are followed before. Errors: Scene.
Result<std::filesystem::path> permitted(const std::string& name, const std::filesystem::path& scene,
                                        const ScriptOptions& options);

/// The mesh as a field. While one lives, the same one is given for the same file, if that has not changed.
/// Errors: those of the reader; Scene where the mesh has no inside.
Result<std::shared_ptr<const MeshField>> meshField(const std::filesystem::path& file, int voxels,
                                                   const MeshReader& read);

/// What a scene's author should know of the mesh: holes that were closed, surfaces that cross; or "".
std::string noteOf(const MeshField& field);

}  // namespace sdf
