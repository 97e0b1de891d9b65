#include <cmath>

#include "sdf/shape/catalog/entries.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/operators/pattern.h"

namespace sdf {

namespace {

constexpr double kMostCopies = 1e6;  // along an axis: index * cell stays far within float

Shape repeated(const Shape& shape, const Vec3E& cell, const std::optional<Vec3E>& count) {
  if (!count) return repeatGrid(shape, cell);
  Check check("repeat_grid");
  glm::ivec3 copies{1};
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("count.") + axisName(i);
    const Expr& given = component(*count, i);
    check.that(given.isConstant(), name + " must be a plain number, not a parameter");
    if (!check.ok()) return check.failure();
    const double n = given.constantValue();
    check.that(n >= 1.0 && n <= kMostCopies && n == std::floor(n),
               name + " must be a whole number from 1 to 1000000, got " + shown(n));
    if (!check.ok()) return check.failure();
    copies[i] = static_cast<int>(n);
  }
  return repeatGrid(shape, cell, copies);
}

}  // namespace

std::vector<CatalogEntry> patternEntries() {
  using namespace parameter;
  return {
      entry(
          "repeat_grid",
          "Copies at every multiple of the cell, endlessly or a count of them centred about the shape's "
          "place. "
          "Neighbouring copies are always seen; the shape may be up to 3 cells long.",
          "as the shape, exact becoming exact outside where copies touch; L of the shape",
          {shape("shape", "the shape to repeat"),
           vector3("cell",
                   "distance between copies along x, y and z, scene units; 0 does not repeat along that axis",
                   Rule::NotNegative),
           optional(vector3("count", "copies along x, y and z; absent: endless", Rule::Count))},
          repeated),
      entry("polar_repeat",
            "Copies evenly around the y axis, the first in place. Neighbouring copies are always seen.",
            "as the shape, exact becoming exact outside where copies touch; L of the shape",
            {shape("shape", "the shape to repeat, usually some way out along x"),
             integer("count", "number of copies, at least 1", Rule::Positive)},
            polarRepeat),
  };
}

}  // namespace sdf
