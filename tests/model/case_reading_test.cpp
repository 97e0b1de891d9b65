// Readings over boxes across jumps: the bounds hold, and are those of the places that are looked at.
#include "sdf/model/case_reading.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace case_reading_test {

using Random = std::mt19937_64;

glm::dvec3 pointIn(const Box& box, Random& random) {
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  return {between(box.min.x, box.max.x), between(box.min.y, box.max.y), between(box.min.z, box.max.z)};
}

// No copy is its own mirror image.
Shape piece() {
  const auto& [x, y, z] = position();
  return translate(
      field(x * x + y * y + z * z + 0.3 * x * y * z - 0.2 * x - 1.0, Box::centred(glm::dvec3(1.3))),
      Vec3E(0.1, 0.0, 0.05));
}

Shape repeated(int i) {
  const Shape grid = repeatGrid(piece(), Vec3E(3.0, 0.0, 3.0));
  switch (i) {
    case 0:
      return grid;
    case 1:
      return repeatGrid(grid, Vec3E(0.0, 4.0, 0.0));
    case 2:
      return polarRepeat(translate(piece(), Vec3E(3.0, 0.0, 0.0)), 6);
    default:
      return twist(intersect(grid, sphere(6.0)), 0.3);
  }
}

TEST(CaseReading, BoundsValuesAndSlopes) {
  Random random(11);
  for (int i = 0; i < 4; ++i) {
    const Shape shape = repeated(i);
    CaseReading reading(shape.distance);
    const TapePtr tape = Function(shape.distance).at();
    for (int k = 0; k < 300; ++k) {
      const glm::dvec3 low = pointIn(Box::centred(glm::dvec3(6.0)), random);
      const Box box{low, low + std::uniform_real_distribution<double>(0.05, 1.0)(random)};
      const auto [value, slope] = reading.read(box);
      for (int n = 0; n < 30; ++n) {
        const glm::dvec3 p = pointIn(box, random), q = pointIn(box, random);
        const double a = evaluate(*tape, p), b = evaluate(*tape, q);
        ASSERT_TRUE(value.contains(a)) << i;
        ASSERT_LE(std::abs(a - b), slope * glm::length(p - q) + 1e-12) << i;
      }
    }
  }
}

// Half a cell from a copy's middle the window jumps, in the middle of another copy.
TEST(CaseReading, TellsCopiesApartWhereTheWindowJumps) {
  const Shape grid = repeatGrid(piece(), Vec3E(3.0, 0.0, 3.0));
  CaseReading reading(grid.distance);
  const TapePtr tape = Function(grid.distance).at();
  int mixed = 0;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 low(-3.0 + 0.1 * i, -0.05, -0.05);
    const Box box{low, low + 0.1};
    const Interval value = reading.read(box).value;
    mixed += value.lo < 0.0 && value.hi > 0.0;
    EXPECT_LE(value.width(), 1.0) << low.x;
  }
  EXPECT_LE(mixed, 8);  // two ends of two copies, and their neighbours
}

}  // namespace case_reading_test
}  // namespace sdf
