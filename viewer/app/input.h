// Keys and mouse as changes of a session.
#pragma once
#include <glm/vec2.hpp>
#include <set>

#include "viewer/app/session.h"

namespace sdf::viewer {

/// Input turns keys, buttons and the pointer into changes of a session. Drags: left moves the divider of a
/// split view, else orbits, middle or shift and left pans, right turns the camera; the wheel goes nearer.
/// Keys: W A S D E Q fly, 1 to 6 look from the sides, 0 through the scene's camera, F moves to where all is
/// in view, space plays and pauses, V shows the next view, Tab hides the panels, P saves the picture, C
/// copies the camera, M counts readings, Escape ends. Keys, buttons, actions and modifiers are GLFW's
/// numbers.
class Input {
 public:
  void key(int key, int action, Session& session, Requests& requests);
  void button(int button, int action, int modifiers);
  /// Moves the pointer to a place in a window of this height, in the same unit, from the top left.
  void cursor(glm::dvec2 place, double windowHeight, Session& session);
  void scroll(double steps, Session& session);
  /// Lets go of all keys and buttons, as when another window gets them.
  void release();

  /// Moves the camera on for as long as keys that fly are held.
  void fly(double seconds, Session& session) const;
  bool flying() const { return !held_.empty(); }
  bool panelsHidden() const { return panelsHidden_; }

 private:
  enum class Drag { None, Orbit, Pan, Turn, Divide };

  Drag drag_ = Drag::None;
  int dragButton_ = 0;
  glm::dvec2 last_{0.0};
  std::set<int> held_;  // keys that fly
  bool panelsHidden_ = false;
  bool onDivider_ = false;  // the pointer is at that of a split view
};

}  // namespace sdf::viewer
