// A scene's own mesh, as sdf2gltf exports it.
#pragma once
#include <optional>
#include <vector>

#include "sdf/export/export.h"
#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// MeshSettings say how fine a mesh is to be, as sdf2gltf's options of the same names: with a voxel size
/// alone triangles are as large everywhere, with neither kDefaultTolerance is tried for.
struct MeshSettings {
  std::optional<double> tolerance{};  ///< scene units, above 0
  bool toleranceOfDiagonal = false;   ///< it is a share of the diagonal of all parts
  std::optional<double> voxelSize{};  ///< scene units, above 0
  bool operator==(const MeshSettings&) const = default;
};

/// A SceneMesh is a scene with the meshes of its parts.
struct SceneMesh {
  Scene scene;
  std::vector<ExportPart> parts;
  double tolerance = 0.0;  ///< that they keep, or were to, scene units; 0: none
  double diagonal = 0.0;   ///< of what was meshed, scene units
};

/// Meshes a scene that is fixed (ScriptOptions::fixed), cut to its bounds, part by part. Errors: those of
/// exportSize and meshShape.
Result<SceneMesh> meshScene(Scene scene, const MeshSettings& settings, Progress& progress);

}  // namespace sdf::viewer
