// Numbers that shaders look up. All of it works in the current context, which must be the same for one
// object's whole life.
#pragma once
#include <glm/vec4.hpp>
#include <span>

#include "sdf/base/result.h"
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

/// TexelRow is one long row of floats, four to a texel, for samplerBuffer: quicker to look up than a texture,
/// since it has no levels.
class TexelRow {
 public:
  TexelRow();

  /// Replaces all of it. Errors: Limits if the driver has no room for so many.
  Status fill(std::span<const glm::vec4> texels);
  /// Makes it what samplers of this unit read by texelFetch.
  void bind(int unit) const;

 private:
  Handle buffer_, texture_;
};

}  // namespace sdf::viewer
