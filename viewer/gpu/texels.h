// Numbers that shaders look up. All of it works in the current context, which must be the same for one
// object's whole life.
#pragma once
#include <glm/vec4.hpp>
#include <span>

#include "viewer/gpu/handle.h"

namespace sdf::viewer {

/// Texels are a texture of floats, four to a texel, in rows of a given length; the last one is filled up.
class Texels {
 public:
  explicit Texels(int width);

  /// Replaces all of it.
  void fill(std::span<const glm::vec4> texels);
  /// Makes it what samplers of this unit read by texelFetch.
  void bind(int unit) const;

 private:
  int width_;
  Handle texture_;
};

}  // namespace sdf::viewer
