#include <cmath>

#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"

namespace sdf {
namespace {

constexpr double kFar = 0x1p40;      // scene units; what lies beyond is not looked for
constexpr double kNear = 0x1p-40;    // scene units; from here on a side moves to 0
constexpr int kSplits = 12;          // halvings of a region before its emptiness counts as unproven
constexpr int kTighteningSteps = 8;  // bisections of each side

bool provenOutside(const Tape& tape, const Box& box, int splits) {
  const Interval range = evaluate(tape, box);
  if (!range.nan && range.lo > 0.0) return true;
  if (splits == 0) return false;
  const glm::dvec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Box low = box, high = box;
  low.max[axis] = high.min[axis] = box.centre()[axis];
  return provenOutside(tape, low, splits - 1) && provenOutside(tape, high, splits - 1);
}

double& sideOf(Box& box, int axis, bool positive) { return (positive ? box.max : box.min)[axis]; }
double sideOf(const Box& box, int axis, bool positive) { return (positive ? box.max : box.min)[axis]; }

// The part of a box beyond `at` on one side of an axis.
Box beyond(Box box, int axis, bool positive, double at) {
  sideOf(box, axis, !positive) = at;
  return box;
}

// Halves the sides that are not given, in turn, while what that cuts off is proven empty. Each cut lies
// within a factor of two of the side, so that intervals are as tight at any scale.
void halveSides(const Tape& tape, const Box& given, Box& box) {
  for (bool moved = true; moved;) {
    moved = false;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool positive : {false, true}) {
        double& side = sideOf(box, axis, positive);
        if (std::isfinite(sideOf(given, axis, positive)) || side == 0.0) continue;
        const double inward = std::abs(side) > kNear ? side / 2.0 : 0.0;
        if (!provenOutside(tape, beyond(box, axis, positive, inward), kSplits)) continue;
        side = inward;
        moved = true;
      }
  }
}

// Moves one side inward as far as the slab that it leaves is proven empty.
void tightenSide(const Tape& tape, Box& box, int axis, bool positive) {
  double& side = sideOf(box, axis, positive);
  double inside = sideOf(box, axis, !positive);
  for (int i = 0; i < kTighteningSteps; ++i) {
    const double middle = (inside + side) / 2.0;
    if (provenOutside(tape, beyond(box, axis, positive, middle), kSplits))
      side = middle;
    else
      inside = middle;
  }
}

}  // namespace

Box findBounds(const Shape& shape) {
  const Box given = shape.bounds;
  if (given.finite() || given.empty()) return given;
  const Tape tape(shape.distance);
  Box bounds = {glm::max(given.min, glm::dvec3(-kFar)), glm::min(given.max, glm::dvec3(kFar))};
  if (bounds.empty()) return given;
  halveSides(tape, given, bounds);
  for (int axis = 0; axis < 3; ++axis)
    for (const bool positive : {false, true})
      if (double& side = sideOf(bounds, axis, positive); std::abs(side) == kFar)
        side = sideOf(given, axis, positive);
  if (!bounds.finite()) return bounds;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool positive : {false, true})
      if (std::isinf(sideOf(given, axis, positive))) tightenSide(tape, bounds, axis, positive);
  return bounds;
}

}  // namespace sdf
