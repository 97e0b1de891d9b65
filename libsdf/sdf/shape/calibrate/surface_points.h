// Points of a surface, for what is estimated from a few of them. Private to sdf/shape.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/shape/calibrate/cells.h"

namespace sdf {

/// A point with the formula's value and gradient there.
struct SurfacePoint {
  glm::dvec3 at;
  double value;
  glm::dvec3 gradient;
};

/// Reads a formula at points, parameters having their defaults.
class SurfaceReading {
 public:
  explicit SurfaceReading(const Expr& f);

  /// The number of the formula's operations.
  std::size_t size() const { return point_.size(); }
  /// Does the formula hold at most 0 there? What is no number counts as 0.
  bool isInside(const glm::dvec3& p);
  /// Values that are no numbers are 0.
  SurfacePoint at(const glm::dvec3& p);
  /// At most one zero of each of `lines` seeded lines through the finite region. Cost: some 60 readings a
  /// line.
  std::vector<SurfacePoint> zeros(const Box& region, int lines);

 private:
  Expr f_;
  PointReading point_;
  IntervalReading value_, gradient_;
};

}  // namespace sdf
