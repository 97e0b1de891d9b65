// What is drawn into, when it is no window. All of it works in the current context, which must be the same
// for one target's whole life.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"
#include "viewer/gpu/picture.h"

namespace sdf::viewer {

/// Of one pixel: four channels. Rgba8 holds 0 to 1 in steps of 1/255 and clamps; the others hold what floats
/// of 16 and of 32 bits do.
enum class PixelFormat { Rgba8, Rg32f, Rgba32f };

/// A framebuffer of one or more textures, its layers, which the outputs of a fragment shader fill by their
/// locations. New ones hold anything.
class Target {
 public:
  /// With depth, of 32-bit floats, if asked. Leaves bound what is. Errors: Limits if a side is less than 1 or
  /// more than the driver can draw, or memory runs out; else Graphics.
  static Result<Target> create(int width, int height, const std::vector<PixelFormat>& layers,
                               bool depth = false);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Makes it what is drawn into, the whole of it.
  void bind() const;
  /// Only so many of its pixels, from (x, y) on.
  void bind(int x, int y, int width, int height) const;

  /// Makes it what is drawn into, one layer filled with this value.
  void clear(int layer, const glm::vec4& value) const;
  /// The same of the depth, with 1. For targets that have it.
  void clearDepth() const;

  /// Copies the first layer to the window that is current, stretched over this many pixels, and makes the
  /// window what is drawn into.
  void show(int width, int height) const;

  /// Makes a layer what samplers of this unit read, without filtering, the edge going on outside.
  void bindTexture(int unit, int layer = 0) const;

  /// One layer's pixels, rows from the top. Waits until all is drawn. Errors: as check.
  Result<std::vector<glm::vec4>> pixels(int layer = 0) const;

  /// The sum of one layer's pixels. Errors: as check.
  Result<glm::dvec4> sum(int layer) const;

  /// The same as RGBA bytes; floats are clamped to 0 to 1 and rounded. Errors: as check.
  Result<Picture> picture(int layer = 0) const;

 private:
  Target(int width, int height) : width_(width), height_(height) {}
  Status addLayer(PixelFormat format);
  Status addDepth();
  Status read(int layer, unsigned type, void* rowsFromBottom) const;

  int width_, height_;
  Handle framebuffer_, depth_;
  std::vector<Handle> textures_;
};

}  // namespace sdf::viewer
