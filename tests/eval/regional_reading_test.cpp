#include "sdf/eval/regional_reading.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace regional_reading_test {

struct Points {
  std::vector<glm::dvec3> at, normals;
};

Points randomPoints(std::size_t count, double reach) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-reach, reach), unit(-1.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.at.emplace_back(place(random), place(random), place(random));
    points.normals.emplace_back(glm::normalize(glm::dvec3(unit(random), unit(random), 1.5)));
  }
  return points;
}

// The number of the nearest of so many balls in a cube of side 2 reach, and a colour that hangs on the
// normal.
TapePtr numberOfNearest(int balls, double reach) {
  const Points centres = randomPoints(static_cast<std::size_t>(balls), reach);
  Expr least = 1e9, number = -1.0;
  for (int i = 0; i < balls; ++i) {
    const Expr d = length(position() - Vec3E(centres.at[i])).claimLipschitz(1.0);
    number = select(less(d, least), static_cast<double>(i), number);
    least = min(least, d);
  }
  return Function({number, normal().x * number}).at();
}

TEST(EvaluateEach, GivesWhatEachPointGivesAlone) {
  const TapePtr tape = numberOfNearest(100, 1.0);
  const Points points = randomPoints(2000, 1.5);
  const std::vector<double> all = evaluateEach(tape, points.at, points.normals);
  ASSERT_EQ(all.size(), 2 * points.at.size());
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const std::vector<double> alone = evaluateAll(*tape, points.at[i], points.normals[i]);
    EXPECT_EQ(all[2 * i], alone[0]) << "point " << i;
    EXPECT_EQ(all[2 * i + 1], alone[1]) << "point " << i;
  }
}

TEST(EvaluateEach, TakesPointsThatCoincideAndNone) {
  const TapePtr tape = numberOfNearest(100, 1.0);
  const std::vector<glm::dvec3> same(200, glm::dvec3(0.25)), up(200, glm::dvec3(0.0, 0.0, 1.0));
  const std::vector<double> all = evaluateEach(tape, same, up);
  for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(all[2 * i], evaluate(*tape, same[0], up[0]));
  EXPECT_TRUE(evaluateEach(tape, {}, {}).empty());
}

TEST(EvaluateEach, TakesAPartOfTheTimeWhereOperandsLieApart) {
  const TapePtr tape = numberOfNearest(300, 1.0);
  const Points points = randomPoints(16000, 1.0);
  const auto seconds = [](auto work) {
    const auto before = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  };
  const double together = seconds([&] { evaluateEach(tape, points.at, points.normals); });
  const double alone = seconds([&] {
    for (std::size_t i = 0; i < points.at.size(); ++i) evaluateAll(*tape, points.at[i], points.normals[i]);
  });
  EXPECT_LT(together, 0.5 * alone);  // a quarter is usual
}

}  // namespace regional_reading_test
}  // namespace sdf
