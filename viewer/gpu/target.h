// What is drawn into, when it is no window, and how. All of it works in the current context, which must be
// the same for one target's whole life.
#pragma once
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"
#include "viewer/gpu/picture.h"

namespace sdf::viewer {

/// A PixelFormat says what a pixel holds: four bytes, from 0 to 1 in steps of 1/255 and clamped, or two or
/// four floats of 32 bits.
enum class PixelFormat { Rgba8, Rg32f, Rgba32f };

/// A Target is a framebuffer of one or more textures, its layers, which the outputs of a fragment shader fill
/// by their locations. New ones hold anything.
class Target {
 public:
  /// Makes a target, with depth of 32-bit floats if asked, and leaves bound what is. Errors: Limits if a side
  /// is less than 1 or more than the driver can draw, or memory runs out; else Graphics.
  static Result<Target> create(int width, int height, const std::vector<PixelFormat>& layers,
                               bool depth = false);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns how far apart the values are that the first layer holds: 1/255, or 0 for floats.
  double step() const { return step_; }

  /// Makes the whole target what is drawn into.
  void bind() const;
  /// Makes so many of its pixels, from (x, y) on, what is drawn into.
  void bind(int x, int y, int width, int height) const;

  /// Makes the target what is drawn into, and fills one layer with this value.
  void clear(int layer, const glm::vec4& value) const;
  /// Makes the target, which must have depth, what is drawn into, and fills its depth with 1.
  void clearDepth() const;

  /// Copies the first layer to the window that is current, stretched over this many pixels, and makes the
  /// window what is drawn into.
  void show(int width, int height) const;

  /// Makes a layer what samplers of this unit read, without filtering, the edge going on outside.
  void bindTexture(int unit, int layer = 0) const;

  /// Reads one layer's pixels, rows from the top, and so waits until all is drawn. Errors: as check.
  Result<std::vector<glm::vec4>> pixels(int layer = 0) const;

  /// Adds up one layer's pixels. Errors: as check.
  Result<glm::dvec4> sum(int layer) const;

  /// Reads one layer as RGBA bytes; floats are clamped to 0 to 1 and rounded. Errors: as check.
  Result<Picture> picture(int layer = 0) const;

 private:
  Target(int width, int height) : width_(width), height_(height) {}
  Status addLayer(PixelFormat format);
  Status addDepth();
  Status read(int layer, unsigned type, void* rowsFromBottom) const;

  int width_, height_;
  double step_ = 0.0;
  Handle framebuffer_, depth_;
  std::vector<Handle> textures_;
};

/// Makes a target of this size and these layers, if it is not one already. Errors: as Target::create.
Status ensure(std::optional<Target>& target, int width, int height, const std::vector<PixelFormat>& layers,
              bool depth = false);

/// A DrawingMode says how fragments that fall on one pixel are put together, while it lives. What counts
/// otherwise is the last.
class [[nodiscard]] DrawingMode {
 public:
  explicit DrawingMode(void (*end)()) : end_(end) {}
  ~DrawingMode() { end_(); }
  DrawingMode(const DrawingMode&) = delete;
  DrawingMode& operator=(const DrawingMode&) = delete;

 private:
  void (*end_)();
};

/// Lets the fragment of the least depth win, in targets that have depth.
DrawingMode nearestWins();
/// Adds up the values of all fragments.
DrawingMode sumOfAll();
/// Keeps the least value of all fragments, component by component.
DrawingMode leastOfAll();
/// Lets fragments into the first layers only; the others stay as they are.
DrawingMode firstLayers(int count);
/// Lets fragments and clears into these rows and columns only, counted from the lower left corner; the others
/// stay as they are.
DrawingMode somePixels(int firstRow, int rows, int firstColumn, int columns);
/// Lets fragments into one layer only; the others stay as they are.
DrawingMode oneLayer(int layer);

}  // namespace sdf::viewer
