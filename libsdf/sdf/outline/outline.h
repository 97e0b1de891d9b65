// Flat outlines of lines and Bézier curves, as fonts and drawings give them.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

namespace sdf {

/// A line, or a Bézier curve, from where the one before it ends.
struct Curve {
  int controls = 0;  ///< 0: a line; 1: quadratic; 2: cubic
  glm::dvec2 control[2]{};
  glm::dvec2 to{};
};

/// Curves one after the other. Where the last one does not end at `from`, a line closes them.
struct Contour {
  glm::dvec2 from{};
  std::vector<Curve> curves{};
};

/// What is inside of contours, by their winding number.
enum class FillRule {
  NonZero,  ///< where it is not 0
  EvenOdd   ///< where it is odd
};

/// Contours, which may lie in one another and cross.
struct Outline {
  std::vector<Contour> contours{};
  FillRule rule = FillRule::NonZero;
};

}  // namespace sdf
