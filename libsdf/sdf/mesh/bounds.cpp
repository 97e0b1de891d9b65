#include <cmath>

#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"

namespace sdf {
namespace {

constexpr double kFar = 1e6;         // scene units; what lies beyond is not looked for
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

// The part of a box beyond `at` on one side of an axis.
Box beyond(Box box, int axis, bool positive, double at) {
  sideOf(box, axis, !positive) = at;
  return box;
}

// A place on one side of an axis beyond which the box is proven empty; infinite where none is found.
double searchSide(const Tape& tape, const Box& box, int axis, bool positive) {
  const double sign = positive ? 1.0 : -1.0;
  for (double distance = 1.0; distance < kFar; distance *= 2.0)
    if (provenOutside(tape, beyond(box, axis, positive, sign * distance), kSplits)) return sign * distance;
  return sign * kInfinity;
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
  Box bounds = shape.bounds, given = bounds;
  if (bounds.finite() || bounds.empty()) return bounds;
  const Tape tape(shape.distance);
  Box searched = intersect(bounds, {glm::dvec3(-kFar), glm::dvec3(kFar)});
  for (int axis = 0; axis < 3; ++axis)
    for (const bool positive : {false, true}) {
      double& side = sideOf(bounds, axis, positive);
      if (std::isfinite(side)) continue;
      side = searchSide(tape, searched, axis, positive);
      if (std::isfinite(side)) sideOf(searched, axis, positive) = side;
    }
  if (!bounds.finite()) return bounds;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool positive : {false, true})
      if (!std::isfinite(sideOf(given, axis, positive))) tightenSide(tape, bounds, axis, positive);
  return bounds;
}

}  // namespace sdf
