#include "viewer/render/mesh_view.h"

#include <utility>

#include "sdf/meshfile/read_mesh.h"

namespace sdf::viewer {
namespace {

Status checkCount(const ShownMesh& mesh) {
  if (mesh.triangles.size() <= kMostShownTriangles) return okStatus();
  return Error{ErrorKind::Limits, "the mesh has " + std::to_string(mesh.triangles.size()) +
                                      " triangles, and at most " + std::to_string(kMostShownTriangles) +
                                      " can be shown; take a larger tolerance or voxel size"};
}

Result<MeshView> viewOfFile(const Scene& scene, const MeshRequest& request, Progress& progress) {
  progress.beginStage("reading");
  auto read = readMesh(*request.file);
  if (!read) return read.error();
  MeshView view{{}, shownMesh(read->mesh), {}, std::move(read->warnings)};
  if (auto s = checkCount(view.shown); !s) return s.error();
  if (!request.errors) return view;
  const double tolerance = request.settings.tolerance.value_or(0.0);
  if (auto s = keep(measureErrors(read->mesh, scene.whole(), tolerance, progress), view.errors); !s)
    return s.error();
  return view;
}

}  // namespace

Result<MeshView> makeMeshView(Scene scene, const MeshRequest& request, Progress& progress,
                              std::shared_ptr<const SceneMesh> known) {
  if (request.file) return viewOfFile(scene, request, progress);
  if (!known) {
    auto meshed = meshScene(std::move(scene), request.settings, progress);
    if (!meshed) return meshed.error();
    known = std::make_shared<const SceneMesh>(std::move(*meshed));
  }
  MeshView view{known, shownMesh(known->parts), {}, {}};
  if (auto s = checkCount(view.shown); !s) return s.error();
  if (request.errors)
    if (auto s = keep(measureErrors(*known, progress), view.errors); !s) return s.error();
  return view;
}

Status show(const MeshView& mesh, Renderer& renderer) {
  if (renderer.shaders().plan.options.view != View::Error) return renderer.showMesh(mesh.shown);
  return renderer.showMesh(mesh.errors->shown, mesh.errors->figures.limit);
}

}  // namespace sdf::viewer
