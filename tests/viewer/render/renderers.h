// What draws a scene and is held to the truth: the CPU, and the shaders in their ways of marching.
#pragma once
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "viewer/reference/cpu_render.h"

namespace sdf::test {

/// Draws with one sample a pixel, in its middle. A picture of a scene with gamma 1 holds at least its colours
/// within [0, 1].
using Render = std::function<Picture(const Scene&, int width, int height)>;

struct Renderer {
  std::string name;
  Render render;
  double rounding;  ///< how far a colour is off where the hit and its distances are true
  double offset;    ///< how far from the surface a hit may be, scene units, at a distance of up to 10
};
inline std::ostream& operator<<(std::ostream& out, const Renderer& r) { return out << r.name; }

/// Every renderer that this machine can run.
std::vector<Renderer> renderers();

}  // namespace sdf::test
