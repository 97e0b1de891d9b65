// Flat outlines of lines and Bézier curves, as fonts and drawings give them.
#pragma once
#include <algorithm>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace sdf {

/// A line, or a Bézier curve, from where the one before it ends.
struct Curve {
  int controls = 0;  ///< 0: a line; 1: quadratic; 2: cubic
  glm::dvec2 control[2]{};
  glm::dvec2 to{};
};

/// Curves one after the other. Where the last one does not end at `from`, a line closes what is filled.
struct Contour {
  glm::dvec2 from{};
  std::vector<Curve> curves{};
  bool isClosed = false;  ///< is it closed as a stroke, too?
};

/// What is inside of contours, by their winding number.
enum class FillRule {
  NonZero,  ///< where it is not 0
  EvenOdd   ///< where it is odd
};

/// A line along contours.
struct Stroke {
  enum class Join { Round, Miter, Bevel };
  enum class Cap { Round, Butt, Square };
  double width = 1.0;  ///< positive
  Join join = Join::Round;
  Cap cap = Cap::Round;
  /// Miters that would be longer, in widths, are bevels.
  double miterLimit = 4.0;
  /// Lengths of dashes, and of the gaps after them, in turn, from where a contour begins; an odd number of
  /// them is gone through twice. None is negative; where all are 0, or there are none, the line is whole.
  std::vector<double> dashes{};
  double dashOffset = 0.0;  ///< how far into these a contour begins

  bool isDashed() const {
    return std::any_of(dashes.begin(), dashes.end(), [](double length) { return length > 0.0; });
  }
};

/// Contours, which may lie in one another and cross: what is inside of them, or a line along them.
struct Outline {
  std::vector<Contour> contours{};
  FillRule rule = FillRule::NonZero;
  std::optional<Stroke> stroke{};
};

}  // namespace sdf
