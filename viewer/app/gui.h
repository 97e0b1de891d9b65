// The panels over the picture, in Dear ImGui.
#pragma once
#include <optional>
#include <string>

#include "viewer/app/canvas.h"
#include "viewer/app/session.h"

namespace sdf::viewer {

/// The Gui lays the panels out in a Dear ImGui context whose frame was begun; it draws nothing itself.
class Gui {
 public:
  explicit Gui(std::string picture) : pictureName(std::move(picture)) {}

  /// Lays out all panels. What the user does in them changes the session's controls, or is requested.
  void panels(Session& session, const Canvas& canvas, Requests& requests);
  /// Says over the picture what is wrong, if anything is.
  void overlay(const Session& session) const;

  std::string pictureName;           ///< of the file to save
  std::string notice;                ///< what came of the last request
  std::optional<Readings> readings;  ///< of the present picture, if measured

 private:
  void picture(Requests& requests);
  void statistics(const Session& session, const Canvas& canvas, Requests& requests);
};

}  // namespace sdf::viewer
