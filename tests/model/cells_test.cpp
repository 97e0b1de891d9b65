// Lists of near groups: what they leave out is nowhere in its cell the nearest, nor leaves the least step.
#include "sdf/model/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"

#include "sdf/shape/operators/operators.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "support/payloads.h"

namespace sdf {
namespace cells_test {

constexpr int kOperands = 90;

glm::dvec3 within(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> u(-reach, reach);
  const double x = u(random), y = u(random);
  return {x, y, u(random)};
}

// Balls, boxes and twisted boxes, whose steps are not their distances.
Shape strewn(unsigned seed, const Expr& moved = 0.0) {
  std::mt19937 random(seed);
  std::vector<Shape> all;
  for (int i = 0; i < kOperands; ++i) {
    const Shape block = box(Vec3E(0.2, 0.3, 0.1)), own[] = {sphere(0.2), block, twist(block, 40.0)};
    const Vec3E place(glm::dvec3(1.0, 0.3, 1.0) * within(random, 2.0));
    all.push_back(translate(rotate(own[i % 3], Vec3E(within(random, 2.0))), place + Vec3E(moved, 0.0, 0.0)));
  }
  return unite(all);
}

std::vector<OperandKind> kindsOf(const Shape& shape) {
  return kindsOf(operandsOf(shape), Grouping::Singles).many;
}

/// A kind's functions, and the numbers of its groups, where inputs have some values.
struct Readings {
  std::vector<std::vector<TapePtr>> tapes;  // by kind and group: the distance, and the step

  Readings(const std::vector<OperandKind>& kinds, const Values& values) {
    for (const OperandKind& kind : kinds) {
      std::vector<TapePtr>& own = tapes.emplace_back();
      const Function read({kind.distance, kind.step});
      for (const std::vector<Expr>& row : kind.groups.numbers) {
        Values all = values;
        for (std::size_t i = 0; i < row.size(); ++i)
          all[kind.groups.parameters[i].parameterInfo().name] = Function(row[i]).uniform(values).front();
        own.push_back(read.at(all));
      }
    }
  }
  glm::dvec2 at(std::size_t kind, std::size_t group, const glm::dvec3& p) const {
    const std::vector<double> both = evaluateAll(*tapes[kind][group], p);
    return {both[0], both[1]};
  }
};

void expectLeast(const CellSorter& sorter, const std::vector<OperandKind>& kinds, const Values& values,
                 unsigned seed) {
  const CellLists lists = sorter.lists(values);
  const Readings readings(kinds, values);
  std::mt19937 random(seed);
  constexpr int kPoints = 600;
  for (int i = 0; i < kPoints; ++i) {
    const bool isAmongThem = i % 3 != 0;
    const glm::dvec3 p = glm::dvec3(1.0, 0.3, 1.0) * within(random, isAmongThem ? 2.0 : 12.0);
    const auto cell = static_cast<std::size_t>(sorter.grid().cellAt(p));
    glm::dvec2 least(kInfinity), leastListed(kInfinity);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      for (std::size_t group = 0; group < readings.tapes[kind].size(); ++group)
        least = glm::min(least, readings.at(kind, group, p));
      const auto [begin, count] = lists.lists[cell * kinds.size() + kind];
      for (int k = begin; k < begin + count; ++k)
        leastListed = glm::min(
            leastListed,
            readings.at(kind, static_cast<std::size_t>(lists.entries[kind][static_cast<std::size_t>(k)]), p));
    }
    ASSERT_NEAR(leastListed.x, least.x, 1e-6) << "at " << p.x << ", " << p.y << ", " << p.z;
    ASSERT_NEAR(leastListed.y, least.y, 1e-6) << "at " << p.x << ", " << p.y << ", " << p.z;
  }
}

TEST(Cells, ListWhatIsNearest) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto kinds = kindsOf(strewn(seed));
    ASSERT_EQ(kinds.size(), 3u);
    ASSERT_TRUE(CellSorter::worthwhile(kinds));
    expectLeast(CellSorter(kinds), kinds, {}, seed);
  }
}

TEST(Cells, FollowParameters) {
  const auto kinds = kindsOf(strewn(5, Expr::parameter({"off", 0.0, -3.0, 3.0})));
  const CellSorter sorter(kinds);
  const std::vector<std::string> inputs = sorter.inputs();
  EXPECT_NE(std::ranges::find(inputs, "off"), inputs.end());
  for (const double off : {-2.5, 0.0, 1.25}) expectLeast(sorter, kinds, {{"off", off}}, 6);
}

// Of balls side by side few are near anywhere among them.
TEST(Cells, ListFew) {
  std::vector<Shape> all;
  for (int i = 0; i < 144; ++i) all.push_back(translate(sphere(0.4), Vec3E(glm::dvec3(i % 12, 0.0, i / 12))));
  const CellSorter sorter(kindsOf(unite(all)));
  const CellLists lists = sorter.lists({});
  double sum = 0.0;
  const int within = CellGrid::count(sorter.grid().levels.front().side);
  for (int cell = 0; cell < within; ++cell) sum += lists.lists[static_cast<std::size_t>(cell)].count;
  EXPECT_LT(sum / within, 6.0);
}

TEST(Cells, HoldTheirPoints) {
  const CellSorter sorter(kindsOf(strewn(7)));
  const CellGrid& grid = sorter.grid();
  int next = 0;
  for (int level = 0; level < CellGrid::kLevels; ++level) {
    const glm::ivec3& side = grid.levels[static_cast<std::size_t>(level)].side;
    for (int z = 0; z < side.z; ++z)
      for (int y = 0; y < side.y; ++y)
        for (int x = 0; x < side.x; ++x) {
          ASSERT_EQ(grid.cell(level, {x, y, z}), next++);
          const glm::dvec3 p = grid.boxOf(level, {x, y, z}).centre();
          // Some are the level before's, and cubes at the rims are partly the next one's.
          const auto& [half, size, own, first] = grid.levels[static_cast<std::size_t>(level)];
          const bool isWithin = glm::all(glm::lessThan(glm::abs(p - grid.middle), half));
          ASSERT_TRUE(grid.cellAt(p) == next - 1 || grid.cellAt(p) < first || !isWithin);
        }
  }
  EXPECT_EQ(next, grid.cells() - 1);
  EXPECT_EQ(grid.cellAt(glm::dvec3(1e9)), grid.cells() - 1);
}

TEST(Cells, AreNotMadeOfTooMany) {
  std::vector<OperandKind> kinds = kindsOf(strewn(4));
  ASSERT_TRUE(CellSorter::worthwhile(kinds));
  std::size_t others = 0;
  for (std::size_t i = 1; i < kinds.size(); ++i) others += kinds[i].groups.numbers.size();
  auto& rows = kinds.front().groups.numbers;
  const std::vector<Expr> row = rows.front();
  rows.resize(CellSorter::kMost - others, row);
  EXPECT_TRUE(CellSorter::worthwhile(kinds));
  rows.push_back(row);
  EXPECT_FALSE(CellSorter::worthwhile(kinds));
}

TEST(Cells, AreNotWorthTheirMakingForFewOrForData) {
  std::vector<Shape> few, unbounded, data;
  const Expr payload = test::payloadHere(test::fourPoints());
  const Shape given = field(0.2 * payload, Box::centred(glm::dvec3(1.0)), 1.0);
  std::mt19937 random(8);
  for (int i = 0; i < kOperands; ++i) {
    const Vec3E place(within(random, 3.0));
    if (i < 12) few.push_back(translate(sphere(0.1), place));
    data.push_back(translate(given, place));
  }
  EXPECT_FALSE(CellSorter::worthwhile(kindsOf(unite(few))));
  EXPECT_FALSE(CellSorter::worthwhile(kindsOf(unite(data))));
}

}  // namespace cells_test
}  // namespace sdf
