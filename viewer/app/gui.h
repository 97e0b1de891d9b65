// The panels over the picture, in Dear ImGui.
#pragma once
#include <optional>
#include <string>

#include "viewer/app/canvas.h"
#include "viewer/app/requests.h"
#include "viewer/app/session.h"

namespace sdf::viewer {

/// Needs a Dear ImGui context with a frame begun; draws nothing itself.
class Gui {
 public:
  explicit Gui(std::string picture) : pictureName(std::move(picture)) {}

  /// All panels. What the user does in them changes the session's controls, or is requested.
  void panels(Session& session, const Canvas& canvas, Requests& requests);
  /// What is wrong, over the picture; nothing if all is well.
  void overlay(const Session& session) const;

  std::string pictureName;           ///< of the file to save
  std::string notice;                ///< what came of the last request
  std::optional<Readings> readings;  ///< of the present picture, if measured

 private:
  void picture(Requests& requests);
  void statistics(const Session& session, const Canvas& canvas, Requests& requests);
};

}  // namespace sdf::viewer
