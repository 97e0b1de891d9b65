// What the views of a mesh show: the scene's own mesh or a file's, and how far it is from the scene.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "viewer/render/mesh_errors.h"
#include "viewer/render/renderer.h"

namespace sdf::viewer {

/// A MeshRequest says which mesh is wanted, and what of it.
struct MeshRequest {
  MeshSettings settings;  ///< of the scene's own mesh; the tolerance also of what a file is compared with
  std::optional<std::filesystem::path> file;  ///< shown in the place of that
  bool errors = false;                        ///< its distances to the scene are wanted, too
  bool operator==(const MeshRequest&) const = default;
};

/// A MeshView is a mesh ready to be shown.
struct MeshView {
  std::shared_ptr<const SceneMesh> own;  ///< what can be exported; none of a file's
  ShownMesh shown;
  std::optional<MeshErrors> errors;   ///< if they were asked for
  std::vector<std::string> warnings;  ///< of reading the file, a sentence each
};

/// Makes what is asked for of a scene that is fixed (ScriptOptions::fixed); `known`, if there is one, is its
/// own mesh by these settings, made before. Errors: those of meshScene, readMesh and measureErrors; Limits
/// where there are more than kMostShownTriangles.
Result<MeshView> makeMeshView(Scene scene, const MeshRequest& request, Progress& progress,
                              std::shared_ptr<const SceneMesh> known = {});
inline constexpr std::size_t kMostShownTriangles = 10'000'000;

/// Hands a renderer what its view shows of the mesh: of View::Error the errors, which must be there. Errors:
/// as Renderer::showMesh.
Status show(const MeshView& mesh, Renderer& renderer);

}  // namespace sdf::viewer
