// What expressions have in common that differ only in numbers.
#include "sdf/expr/alike.h"

#include <gtest/gtest.h>

#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"

namespace sdf::test {
namespace alike_test {

using Lists = std::vector<std::vector<Expr>>;

Expr ball(double x, double z, double radius) {
  const Vec3E p = position();
  return length(p.x - x, p.y, p.z - z) - radius;
}

// What a sort's parameters and one of its rows make of what it has in common.
std::vector<Expr> filled(const Alike& alike, std::size_t row) {
  return rewrite(alike.common, [&](const Expr& e, std::span<const Expr>) -> std::optional<Expr> {
    for (std::size_t i = 0; i < alike.parameters.size(); ++i)
      if (e == alike.parameters[i]) return alike.rows[row][i];
    return std::nullopt;
  });
}

TEST(Alike, AreExpressionsThatDifferInNumbers) {
  const Lists lists{{ball(1.0, 2.0, 0.5)}, {position().x}, {ball(3.0, -4.0, 0.5)}};
  const auto sorts = groupByStructure(lists, "n");
  ASSERT_EQ(sorts.size(), 2u);
  EXPECT_EQ(sorts[0].places, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(sorts[0].parameters.size(), 2u) << "the radius is one";
  EXPECT_EQ(sorts[1].places, std::vector<std::size_t>{1});
  EXPECT_TRUE(sorts[1].parameters.empty());
  for (const std::size_t row : {0, 1})
    EXPECT_EQ(filled(sorts[0], row), withoutClaims(lists[sorts[0].places[row]]));
}

// In the first both coordinates are taken from one number, and their squares from one node.
TEST(Alike, AreExpressionsThatShareTermsByChance) {
  const Vec3E p = position();
  const auto at = [&](double a, double b) { return square(p.x - a) + square(p.x - b) * a; };
  const Lists lists{{at(2.0, 2.0)}, {at(2.0, 5.0)}, {at(-1.0, 3.0)}};
  const auto sorts = groupByStructure(lists, "n");
  ASSERT_EQ(sorts.size(), 1u);
  EXPECT_EQ(sorts[0].parameters.size(), 2u);
  for (const std::size_t row : {0, 1, 2}) EXPECT_EQ(filled(sorts[0], row), withoutClaims(lists[row]));
}

TEST(Alike, HaveFormulasOfParametersForNumbers) {
  const Expr time = Expr::parameter({"time", 0.0, 0.0, 10.0});
  const Lists lists{{position().y - sin(time + 1.0)}, {position().y - 2.0}, {position().y - time}};
  const auto sorts = groupByStructure(lists, "n");
  ASSERT_EQ(sorts.size(), 1u);
  ASSERT_EQ(sorts[0].parameters.size(), 1u);
  EXPECT_EQ(sorts[0].rows[0][0], sin(time + 1.0));
  const ParameterInfo& info = sorts[0].parameters[0].parameterInfo();
  EXPECT_LE(info.min, -1.0);
  EXPECT_GE(info.max, 10.0) << "whatever the rows can be";
}

TEST(Alike, LeaveFormulasThatAllShare) {
  const Expr sine = sin(Expr::parameter({"time", 0.0, 0.0, 10.0}));
  const auto sorts = groupByStructure(Lists{{position().x * sine - 1.0}, {position().x * sine - 2.0}}, "n");
  ASSERT_EQ(sorts.size(), 1u);
  EXPECT_EQ(sorts[0].common.front().arg(0), position().x * sine);
}

TEST(Alike, AreListsThatAreAlikeAllAlong) {
  const Lists lists{{position().x, 1.0}, {position().x, 2.0}, {position().x, position().y}};
  const auto sorts = groupByStructure(lists, "n");
  ASSERT_EQ(sorts.size(), 2u);
  EXPECT_EQ(sorts[0].places, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(sorts[0].common[0], position().x);
}

TEST(Alike, NameTheirParametersApart) {
  const auto sorts = groupByStructure(
      Lists{{position().x - 1.0}, {position().y - 1.0}, {position().x - 2.0}, {position().y - 2.0}}, "n");
  ASSERT_EQ(sorts.size(), 2u);
  EXPECT_NE(sorts[0].parameters[0].parameterInfo().name, sorts[1].parameters[0].parameterInfo().name);
}

// A parameter of a reading's own has another value at each place.
TEST(Alike, LeavesParametersThatNoSceneHas) {
  const auto list = [](double most, double number) {
    const Expr own = Expr::parameter({kOwnName + std::string("row"), 0.0, 0.0, most});
    return std::vector{(own * number + 1.0) * position().x};
  };
  const auto sorts = groupByStructure(Lists{list(1.0, 2.0), list(5.0, 3.0)}, "n");
  ASSERT_EQ(sorts.size(), 1u);
  EXPECT_EQ(sorts[0].rows, (Lists{{Expr(2.0)}, {Expr(3.0)}}));
  const Expr other = Expr::parameter({kOwnName + std::string("other"), 0.0, 0.0, 1.0});
  EXPECT_EQ(groupByStructure(Lists{list(1.0, 2.0), {(other * 2.0 + 1.0) * position().x}}, "n").size(), 2u);
}

TEST(Alike, TakesConstantsForOneThatFloatsDoNotTellApart) {
  const Lists lists{{position().x + 0.1}, {position().x + (0.1 + 1e-12)}, {position().x + 0.2}};
  const std::span<const std::vector<Expr>> all(lists);
  EXPECT_TRUE(groupByStructure(all.first(2), "n", true)[0].parameters.empty());
  EXPECT_EQ(groupByStructure(all.first(2), "n")[0].parameters.size(), 1u);
  EXPECT_EQ(groupByStructure(all, "n", true)[0].parameters.size(), 1u);
}

TEST(Alike, CountsOperationsOnce) {
  const Expr x = position().x, twice = x * 2.0;
  EXPECT_EQ(operationsOf(std::vector{twice + twice, twice}), 2u);
  EXPECT_EQ(operationsOf(std::vector{x, Expr(1.0)}), 0u);
}

}  // namespace alike_test
}  // namespace sdf::test
