// Writing meshes: .glb and .gltf with materials, camera and lights; .stl, .ply and .obj through OpenMesh.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/progress.h"
#include "sdf/base/result.h"
#include "sdf/gltf/animation.h"
#include "sdf/gltf/part.h"
#include "sdf/scene/scene.h"

namespace sdf {

/// Is the extension one that writeMeshes takes (in upper or lower case)? The error lists those it takes
/// (Usage).
Status checkExtension(const std::filesystem::path& target);

/// Is it a glTF file's name? Those alone hold parts, materials, cameras and lights. Precondition:
/// checkExtension(target).
bool isGltf(const std::filesystem::path& target);

/// The bodies that the format of `target` holds apart, to be meshed and handed to writeMeshes: the scene's
/// parts; in .stl, .ply and .obj, which know no parts, their union as one, by the name "all parts united".
/// Precondition: checkExtension(target).
std::vector<Part> exportedParts(const Scene& scene, const std::filesystem::path& target);

/// How large all that is exported is, scene units; 0 where nothing is.
struct ExportSize {
  double diagonal = 0.0;   ///< of the box around all parts
  double voxelSize = 0.0;  ///< where none is asked for: 1/200 of that box's longest side
};
/// The default tolerance, as a share of the diagonal, where neither a tolerance nor a voxel size is asked
/// for. It is a goal (MeshOptions::strict is false).
inline constexpr double kDefaultTolerance = 1.0 / 2000;
/// The size of these parts, cut to `clip` if there is one. Errors: Scene, those of meshShape for a part that
/// is unbounded; Interrupted.
Result<ExportSize> exportSize(const std::vector<Part>& parts, const std::optional<Box>& clip,
                              Progress& progress);

/// Writes all parts to `target`, whose extension picks the format. The file appears under its name only when
/// complete.
/// - .glb, .gltf: one file (the .gltf's buffer is embedded); a node for each part, a primitive for each
///   material of it, materials by toMetallicRoughness (gltf/pbr.h), camera and lights as in gltf/view.h;
///   measured errors in `extras`. Ambient light, where a part has it, is added to the emission. Meshes that
///   are closed and manifold by their stats say so (EXT_mesh_manifold).
/// - .stl, .ply (both binary), .obj: welded triangles of all parts in one list, Y up; meshes that overlap go
///   on doing so, exportedParts unites them before. PLY and OBJ carry normals, PLY also vertex colours, as
///   sRGB; STL has neither.
/// The bytes depend on nothing but the arguments.
/// Errors: Usage (unknown extension), Files (cannot be written), Limits (a .glb over 4 GiB, compressed meshes
/// over 2 GiB), Interrupted.
Status writeMeshes(const std::filesystem::path& target, const Scene& scene,
                   const std::vector<ExportPart>& parts);

/// Writes a .glb or .gltf whose one animation, "frames", has a key for each frame, beginning at 0: the nodes'
/// translation and rotation where a mesh, the camera or a light moves, interpolated linearly, and 0 or 1 for
/// the scale of each of a part's several meshes, in steps. A part of one mesh is a node; of several, a node
/// with a child for each. What turns does so about the middle of its mesh, which a child of its node holds.
/// Without animation the file shows the first frame. A camera that the scenes leave open stands where it sees
/// all frames' bounds. Errors: as writeMeshes.
Status writeAnimation(const std::filesystem::path& target, const Animation& animation);

}  // namespace sdf
