// The panels over the picture, in Dear ImGui.
#pragma once
#include <optional>
#include <string>

#include "viewer/app/canvas.h"
#include "viewer/app/mesh_panel.h"
#include "viewer/app/session.h"

namespace sdf::viewer {

/// The Gui lays the panels out in a Dear ImGui context whose frame was begun; it draws nothing itself.
class Gui {
 public:
  /// Names the files that are offered for the picture and for the mesh.
  explicit Gui(std::string picture, std::string exported = "mesh.glb")
      : pictureName(std::move(picture)), mesh(std::move(exported)) {}

  /// Lays out all panels. What the user does in them changes the session's controls, or is requested.
  void panels(Session& session, const Canvas& canvas, Requests& requests);
  /// Says over the picture what is wrong, if anything is.
  void overlay(const Session& session) const;

  std::string pictureName;  ///< of the file to save
  MeshPanel mesh;
  std::string notice;                ///< what came of the last request
  std::optional<Readings> readings;  ///< of the present picture, if measured

 private:
  void picture(Requests& requests);
  void statistics(const Session& session, const Canvas& canvas, Requests& requests);
};

}  // namespace sdf::viewer
