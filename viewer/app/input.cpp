#include "viewer/app/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "viewer/app/orbit.h"

namespace sdf::viewer {
namespace {

constexpr double kFlight = 0.8;  // of the distance to what the camera looks at, a second

const std::map<int, glm::dvec3>& ways() {
  static const std::map<int, glm::dvec3> all = {{GLFW_KEY_W, {0, 0, 1}}, {GLFW_KEY_S, {0, 0, -1}},
                                                {GLFW_KEY_D, {1, 0, 0}}, {GLFW_KEY_A, {-1, 0, 0}},
                                                {GLFW_KEY_E, {0, 1, 0}}, {GLFW_KEY_Q, {0, -1, 0}}};
  return all;
}

View after(View view) {
  return static_cast<View>((static_cast<int>(view) + 1) % static_cast<int>(View::Count));
}

}  // namespace

void Input::key(int key, int action, Session& session, Requests& requests) {
  if (action == GLFW_RELEASE) held_.erase(key);
  if (action != GLFW_PRESS) return;
  if (ways().contains(key)) held_.insert(key);
  if (key == GLFW_KEY_TAB) panelsHidden_ = !panelsHidden_;
  Controls& controls = session.controls;
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_6)
    controls.eye = seenFrom(session.eye(), static_cast<Side>(key - GLFW_KEY_1));
  if (key == GLFW_KEY_0) controls.eye.reset();
  if (key == GLFW_KEY_SPACE) session.playing = session.hasClock() && !session.playing;
  if (key == GLFW_KEY_V) controls.shader.view = after(controls.shader.view);
  requests.fit |= key == GLFW_KEY_F;
  requests.savePicture |= key == GLFW_KEY_P;
  requests.copyCamera |= key == GLFW_KEY_C;
  requests.measure |= key == GLFW_KEY_M;
  requests.close |= key == GLFW_KEY_ESCAPE;
}

void Input::button(int button, int action, int modifiers) {
  if (action == GLFW_RELEASE) {
    if (button == dragButton_) drag_ = Drag::None;
    return;
  }
  const bool pans = button == GLFW_MOUSE_BUTTON_MIDDLE || (modifiers & GLFW_MOD_SHIFT) != 0;
  drag_ = button == GLFW_MOUSE_BUTTON_RIGHT ? Drag::Turn
          : pans                            ? Drag::Pan
          : onDivider_                      ? Drag::Divide
                                            : Drag::Orbit;
  dragButton_ = button;
}

void Input::cursor(glm::dvec2 place, double windowHeight, Session& session) {
  const glm::dvec2 pixels = place - last_, drag = glm::dvec2(pixels.x, -pixels.y) / windowHeight;
  last_ = place;
  constexpr double kReach = 8.0, kLeast = 0.02;  // of the divider, to either side; of the width
  const double width = session.aspect * windowHeight;
  double& split = session.controls.split;
  if (drag_ == Drag::Divide) split = std::clamp(place.x / width, kLeast, 1.0 - kLeast);
  onDivider_ = session.controls.shader.view == View::Split && std::abs(place.x - split * width) <= kReach;
  if (drag_ == Drag::Orbit) session.controls.eye = orbited(session.eye(), drag);
  if (drag_ == Drag::Pan) session.controls.eye = panned(session.eye(), drag);
  if (drag_ == Drag::Turn) session.controls.eye = turned(session.eye(), drag);
}

void Input::scroll(double steps, Session& session) { session.controls.eye = dollied(session.eye(), steps); }

void Input::release() {
  held_.clear();
  drag_ = Drag::None;
}

void Input::fly(double seconds, Session& session) const {
  glm::dvec3 way(0.0);
  for (const int key : held_) way += ways().at(key);
  if (way != glm::dvec3(0.0)) session.controls.eye = flown(session.eye(), seconds * kFlight * way);
}

}  // namespace sdf::viewer
