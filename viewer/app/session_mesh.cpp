// What of a session is about meshes.
#include <glm/geometric.hpp>
#include <utility>

#include "viewer/app/session.h"

namespace sdf::viewer {

Session::Built Session::wanted(const std::set<std::string>& materials) const {
  Built built{controls.shader, materials};
  const bool hasMesh = mesh_ && (built.shader.view != View::Error || mesh_->errors);
  if (showsMesh(built.shader.view) && !hasMesh) built.shader.view = View::Picture;
  built.shader.origin = originFor(eye(), renderer_.origin());
  return built;
}

MeshOrder Session::meshOrder() const {
  return {.file = file_,
          .edition = edition_,
          .values = controls.parameters,
          .time = hasClock() ? controls.time : 0.0,
          .request = {controls.mesh, controls.meshFile, controls.shader.view == View::Error}};
}

void Session::followMesh() {
  if (!showsMesh(controls.shader.view)) {
    meshMessage_.clear();
    return;
  }
  if (!job_) job_ = std::make_unique<MeshJob>();
  if (!(playing && job_->working())) job_->order(meshOrder());
  auto made = job_->take();
  if (!made) return;
  meshMessage_ = *made ? "" : made->error().message;
  if (!*made) return;
  const auto before = std::exchange(mesh_, **made);
  if (!showsMesh(built_.shader.view) || wanted() != built_) {
    ++meshes_;
    return;  // it is handed over to the renderer that is made now
  }
  const Status shown = showMesh(renderer_);
  if (!shown) {
    meshMessage_ = shown.error().message;
    mesh_ = before;
  }
  ++meshes_;
}

Status Session::showMesh(Renderer& renderer) const {
  if (!mesh_ || !showsMesh(renderer.shaders().plan.options.view)) return okStatus();
  return show(*mesh_, renderer);
}

const ErrorFigures* Session::errors() const {
  return built_.shader.view == View::Error && mesh_->errors ? &mesh_->errors->figures : nullptr;
}

void Session::cancelMesh() {
  if (job_) job_->cancel();
}

void Session::meshAgain() {
  if (job_) job_->again();
}

double Session::extent() const {
  if (mesh_ && mesh_->own) return mesh_->own->diagonal;
  if (look_.inView()) return glm::length(look_.inView()->size());
  const Eye seen = eye();
  return glm::length(seen.to - seen.from);
}

Status Session::exportMesh(const std::filesystem::path& target) const {
  if (Status s = checkExtension(target); !s) return s;
  if (mesh_ && !mesh_->own)
    return Error{ErrorKind::Limits, "what is shown is a file's mesh; show the scene's own to export it"};
  if (!mesh_ || !showsMesh(built_.shader.view))
    return Error{ErrorKind::Limits, "there is no mesh yet to export; choose a view that shows one"};
  return writeMeshes(target, mesh_->own->scene, mesh_->own->parts);
}

}  // namespace sdf::viewer
