// What a surface looks like at points on it.
#pragma once
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Colours are linear; the ambient one may be above 1.
struct Paint {
  glm::vec3 color{0.0f}, ambient{0.0f};
  int material = 0;  ///< its number among the shape's
};

/// As steep in the dark as the curve of sRGB.
inline constexpr float kDark = 1.0f / 512;
/// The square root of linear light (a little above black), which is close to what screens show.
inline float perceived(float linear) { return std::sqrt(linear + kDark); }

/// The largest difference of a channel, as perceived.
float colorDifference(const Paint& a, const Paint& b);

/// The largest difference (colorDifference) between the surface's colour and what a mesh shows: four steps of
/// a byte.
inline constexpr float kColorTolerance = 1.0f / 64;
/// Colours are looked at no nearer to a border than so many tolerances of the distance.
inline constexpr float kBorderTolerances = 2.5f;

/// Colours that differ by more at one place have a border between them: some ten steps of a byte.
inline constexpr float kColorJump = 0.04f;

/// Is there a border between the two, if they are of one place?
inline bool differ(const Paint& a, const Paint& b) {
  return a.material != b.material || colorDifference(a, b) > kColorJump;
}

/// The paint at `count` points for which point(i) yields the position and normal(i) the unit normal, by some
/// roundings of floats inside of there: so a face that lies in a border of the paint is of one colour, the
/// one behind it. What is no number reads as 0.
std::vector<Paint> readPaint(std::size_t count, const std::function<glm::vec3(std::size_t)>& point,
                             const std::function<glm::vec3(std::size_t)>& normal, const LocalField& field,
                             Progress& progress);

/// The same where the surface is next to each point: a step of Newton's method along the gradient, which is
/// the normal.
std::vector<Paint> readPaintBeside(const std::vector<glm::vec3>& points, const LocalField& field,
                                   Progress& progress);

}  // namespace sdf
