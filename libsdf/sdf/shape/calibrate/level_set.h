// Distances of formulas that are none. Private to sdf/shape.
#pragma once
#include <memory>
#include <optional>

#include "sdf/base/box.h"
#include "sdf/expr/vec.h"

namespace sdf {

/// How far outside and inside of a surface its distance is asked for, scene units, both positive.
struct Reach {
  double out = 0.0;
  double in = 0.0;
};

/// A function with the sign and the zeros of a formula f that is near its distance.
struct LevelSet {
  Expr value;
  Vec3E normal;  ///< grad f / |grad f|
  double slope;  ///< bounds the value's slope over the region
};

/// To first order the distance is g = f / |grad f| (Taubin 1994); g falls behind it as f grows steeper along
/// its gradient. The value is g (1 + c g), on either side of the surface with the c by which the median of
/// points at that distance `at` have it as their value; points are sought along the gradients of points of
/// the surface, at the present values of parameters. Beyond `reach` it stays as it is, outside after it has
/// grown `farther` by half of g, so that points where the gradient vanishes do not matter where f is far from
/// 0. Its slope is proven by intervals over cells of
/// the region. Nothing where that is not possible: at zeros without a gradient, at creases and jumps near the
/// surface, or in a region that is not finite. The points serve all reaches.
class LevelSets {
 public:
  LevelSets(const Expr& f, const Box& region, const Reach& at);
  ~LevelSets();

  std::optional<LevelSet> within(const Reach& reach, double farther = 0.0);

 private:
  struct Readings;
  std::unique_ptr<Readings> readings_;  // none where there is no level set
};

}  // namespace sdf
