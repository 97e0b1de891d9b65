// A display for tests that open windows, and hands and eyes to use it with.
#pragma once
#include <cstdlib>
#include <string>

#include "viewer/gpu/picture.h"

namespace sdf::viewer {

/// An X server of the test's own (Xvfb), of 1024 x 768 pixels, which takes a display number that is free and
/// ends with this process. One is enough for all tests of a process. False if Xvfb is not installed.
bool ensureDisplay();

/// What is on the screen, RGB.
Picture screenPicture();

/// Runs xdotool, which moves the display's pointer and presses its keys, with these arguments: "key 1",
/// "mousemove 5 7". False if that failed.
inline bool xdotool(const std::string& arguments) {
  return std::system(("xdotool " + arguments).c_str()) == 0;
}

}  // namespace sdf::viewer
