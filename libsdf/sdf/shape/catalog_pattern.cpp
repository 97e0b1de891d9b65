#include <array>
#include <cmath>

#include "sdf/shape/check.h"
#include "sdf/shape/entries.h"
#include "sdf/shape/pattern.h"

namespace sdf {

namespace {

constexpr int kShape = 0, kCell = 1, kCount = 2;
constexpr double kMostCopies = 1e6;  // along an axis: index * cell stays far within float

Shape repeatGridOf(const Arguments& a) {
  if (!a.given(kCount)) return repeatGrid(a.shape(kShape), a.vector(kCell));
  const Vec3E& v = a.vector(kCount);
  const std::array<Expr, 3> given{v.x, v.y, v.z};
  Check check("repeat_grid");
  glm::ivec3 count{1};
  for (int i = 0; i < 3 && check.ok(); ++i) {
    const std::string name = std::string("count.") + "xyz"[i];
    check.that(given[i].isConstant(), name + " must be a plain number, not a parameter");
    if (!check.ok()) break;
    const double n = given[i].constantValue();
    check.that(n >= 1.0 && n <= kMostCopies && n == std::floor(n),
               name + " must be a whole number from 1 to 1000000, got " + shown(n));
    if (check.ok()) count[i] = static_cast<int>(n);
  }
  if (!check.ok()) return check.failure();
  return repeatGrid(a.shape(kShape), a.vector(kCell), count);
}

}  // namespace

std::vector<CatalogEntry> patternEntries() {
  using namespace parameter;
  return {
      {"repeat_grid",
       Group::Pattern,
       "Copies at every multiple of the cell, endlessly or a count of them centred about the shape's place. "
       "Neighbouring copies are always seen; the shape may be up to 3 cells long.",
       "as the shape, exact becoming exact outside where copies touch; L of the shape",
       {shape("shape", "the shape to repeat"),
        vector3("cell",
                "distance between copies along x, y and z, scene units; 0 does not repeat along that axis",
                Rule::NotNegative),
        optional(
            vector3("count", "copies along x, y and z, whole numbers from 1; absent: endless", Rule::Any))},
       repeatGridOf},
      {"polar_repeat",
       Group::Pattern,
       "Copies evenly around the y axis, the first in place. Neighbouring copies are always seen.",
       "as the shape, exact becoming exact outside where copies touch; L of the shape",
       {shape("shape", "the shape to repeat, usually some way out along x"),
        integer("count", "number of copies, at least 1", Rule::Positive)},
       [](const Arguments& a) { return polarRepeat(a.shape(0), a.integer(1)); }},
  };
}

}  // namespace sdf
