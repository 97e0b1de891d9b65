// The panel of the views of meshes, and what they lay over the picture.
#pragma once
#include <memory>
#include <string>

#include "viewer/app/session.h"
#include "viewer/gpu/handle.h"

namespace sdf::viewer {

/// A MeshPanel lays its controls out in the Dear ImGui window that was begun.
class MeshPanel {
 public:
  explicit MeshPanel(std::string exported) : exportName(std::move(exported)) {}

  /// Lays out how fine the mesh is to be, how far it is, and what it is compared with.
  void controls(Session& session, Requests& requests);
  /// Draws the divider of a split view, and the legend of errors, over the picture and behind all panels.
  void overPicture(const Session& session);

  std::string exportName;  ///< of the file to write
  std::string fileName;    ///< of the mesh to compare with, as it is typed

 private:
  void legend(const Session& session);

  Handle texture_;                     // of the legend
  std::optional<ErrorFigures> drawn_;  // into it
  int width_ = 0, height_ = 0;
};

}  // namespace sdf::viewer
