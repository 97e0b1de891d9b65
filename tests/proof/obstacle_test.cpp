// What is said to stand in the way of a proof does.
#include "sdf/proof/obstacle.h"

#include <gtest/gtest.h>

#include "sdf/expr/origin.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace obstacle_test {

const Box kAroundZero{glm::dvec3(-0.01), glm::dvec3(0.01)};

template <class Make>
auto madeBy(const char* what, int line, Make make) {
  const Origin origin(what, "a.lua", line);
  return make();
}

std::string inTheWay(const Expr& distance) { return obstacleIn(distance, kAroundZero, {}); }

// Numbers that no other test has, for a node of the same formula would be that one's.
TEST(Obstacle, IsTheInnermostOperationThatMayBeFlat) {
  const Expr x = position().x + 1e-7, y = position().y - 1e-7;
  const Expr pit = madeBy("pit", 2, [&] { return square(x); });
  const Expr moved = madeBy("shift", 3, [&] { return pit - 1e-9; });
  EXPECT_EQ(inTheWay(moved), "the pit at a.lua:2 stood in the way: intervals do not tell if it rises");
  const Expr ridge = madeBy("union", 4, [&] { return min(y, -y); });
  EXPECT_EQ(inTheWay(ridge), "the union at a.lua:4 stood in the way: intervals do not tell if it rises");
}

TEST(Obstacle, IsWhatMayBeNoNumber) {
  const Expr x = position().x + 2e-7;
  const Expr root = madeBy("formula", 5, [&] { return sqrt(x); });
  EXPECT_EQ(inTheWay(madeBy("shift", 6, [&] { return root - 0.05; })),
            "the formula at a.lua:5 stood in the way: intervals do not tell if it is a number");
}

TEST(Obstacle, IsNoneWhereIntervalsTellAll) {
  const Expr x = position().x + 3e-7;
  const Expr pit = madeBy("pit", 7, [&] { return square(x) + 0.001; });
  const Expr slope = madeBy("plane", 8, [&] { return x * 3.0; });
  EXPECT_EQ(inTheWay(pit), "");
  EXPECT_EQ(inTheWay(slope), "");
  EXPECT_EQ(inTheWay(madeBy("union", 9, [&] { return min(slope, square(x) + 5.0); })), "");
}

// Nor is a place named that is not known.
TEST(Obstacle, IsNoneWhereItsPlaceIsNotKnown) { EXPECT_EQ(inTheWay(square(position().x + 4e-7)), ""); }

TEST(Origin, StaysWithWhatIsMovedLater) {
  const Expr pit = madeBy("pit", 10, [&] { return square(position().x + 5e-7); });
  const Expr moved = madeBy("translate", 11, [&] {
    return remap(pit, {position().x - 3.0, position().y, position().z}, 1.0);
  });
  EXPECT_EQ(originOf(moved.unclaimed()), "the pit at a.lua:10");
  EXPECT_EQ(originOf(moved.unclaimed().arg(0).unclaimed().arg(0)), "the translate at a.lua:11");
}

}  // namespace obstacle_test
}  // namespace sdf
