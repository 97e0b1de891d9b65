#include "sdf/shape/solids/flats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "shape/cases.h"
#include "support/polygons.h"

namespace sdf {
namespace flats_test {

using glm::dvec2;
using glm::dvec3;
using test::Evaluator;
using test::Sampler;
using Points = std::vector<dvec2>;

constexpr unsigned kSeed = 20240614;
constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
// Results of some tens of roundings on numbers below 10.
constexpr double kRounding = 1e-13;

const Points kComb{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1.5, 0.2}, {1, 1}, {1, 2}, {0, 2}};

double at(const Shape& s, const dvec2& p) { return Evaluator(s.distance)({p, 0.0}); }

TEST(Flats, HaveTheDistancesWorkedOutByHand) {
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0);
  const struct {
    const char* what;
    Shape shape;
    dvec2 point;
    double distance;
  } table[] = {
      {"circle", circle(1.0), {3, 4}, 4},
      {"rectangle, corner", rectangle(1.0, 2.0), {4, 6}, 5},
      {"rectangle, inside", rectangle(1.0, 2.0), {0.25, 0}, -0.75},
      {"rounded_rectangle, corner", roundedRectangle(1.0, 1.0, 0.5), {1, 1}, 0.5 * r2 - 0.5},
      {"rounded_rectangle, side", roundedRectangle(1.0, 2.0, 0.5), {3, 0}, 2},
      {"segment, side", segment({0.0, 0.0, 9.0}, {4.0, 0.0, 7.0}, 0.5), {2, 3}, 2.5},
      {"segment, end", segment({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 0.5), {7, 4}, 4.5},
      {"triangle, corner", regularPolygon(3, 1.0), {0, 3}, 2},
      {"triangle, side", regularPolygon(3, 1.0), {0.2, -2}, 1.5},
      {"square, side", regularPolygon(4, r2), {2, 2}, r2 * 2 - 1},
      {"hexagon, side", regularPolygon(6, 2.0), {2, 0}, 2 - r3},
      {"hexagon, centre", regularPolygon(6, 2.0), {0, 0}, -r3},
      {"polygon, notch", polygon(kComb), {1.5, 2}, std::hypot(0.5, 0.0)},
      {"polygon, tooth", polygon(kComb), {0.5, 1.5}, -0.5},
      {"star, tip", star(5, 2.0, 1.0), {0, 3}, 1},
      {"four-pointed star, notch", star(4, 3.0, r2), {1, 1}, 0},
      {"ring, hole", ring(2.0, 1.0), {0, 0}, 1.5},
      {"ring, band", ring(2.0, 1.0), {0, 2.25}, -0.25},
      {"arc, on it", arc(90 * kDegree, 2.0, 0.5), {0, 2}, -0.25},
      {"arc, opposite", arc(90 * kDegree, 2.0, 0.5), {0, -3}, std::sqrt(13.0) - 0.25},
      {"trapezoid, top", trapezoid(2.0, 1.0, 1.0), {0.5, 3}, 2},
      {"trapezoid, corner", trapezoid(2.0, 1.0, 1.0), {-5, -5}, 5},
  };
  for (const auto& row : table) {
    ASSERT_TRUE(row.shape.ok()) << row.what << ": " << *row.shape.error;
    EXPECT_NEAR(at(row.shape, row.point), row.distance, kRounding) << row.what;
  }
}

Points regularCorners(int sides, double radius) {
  Points corners;
  for (int i = 0; i < sides; ++i)
    corners.push_back(radius * dvec2(std::sin(2 * kPi * i / sides), std::cos(2 * kPi * i / sides)));
  return corners;
}

Points starCorners(int points, double outer, double inner) {
  Points corners;
  for (int i = 0; i < 2 * points; ++i)
    corners.push_back((i % 2 ? inner : outer) *
                      dvec2(std::sin(kPi * i / points), std::cos(kPi * i / points)));
  return corners;
}

TEST(Flats, WithCornersAgreeWithTheirOutline) {
  Points clockwise = kComb;
  std::reverse(clockwise.begin(), clockwise.end());
  const Points spiral{{0, 0},      {0, 1},     {2, 1},    {2, -1},    {-2, -1},    {-2, 2},
                      {3, 2},      {3, -2},    {3.5, -2}, {3.5, 2.5}, {-2.5, 2.5}, {-2.5, -1.5},
                      {2.5, -1.5}, {2.5, 1.5}, {-1, 1.5}, {-1, 0}};
  std::vector<std::tuple<std::string, Shape, Points>> table{
      {"comb", polygon(kComb), kComb},
      {"clockwise comb", polygon(clockwise), kComb},
      {"spiral", polygon(spiral), spiral},
      {"triangle", polygon(Points{{0, 0}, {2, 0}, {-1, 1}}), {{0, 0}, {2, 0}, {-1, 1}}},
      {"closed square",
       polygon(Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}),
       {{0, 0}, {2, 0}, {2, 2}, {0, 2}}},
      {"trapezoid", trapezoid(1.5, 0.5, 0.75), {{-1.5, -0.75}, {1.5, -0.75}, {0.5, 0.75}, {-0.5, 0.75}}},
      {"upside-down trapezoid", trapezoid(0.0, 2.5, 0.25), {{0, -0.25}, {2.5, 0.25}, {-2.5, 0.25}}},
  };
  for (int n : {3, 4, 5, 6, 7, 8, 9, 12, 17, 32, 100}) {
    table.emplace_back("polygon of " + std::to_string(n), regularPolygon(n, 1.5), regularCorners(n, 1.5));
    for (double inner : {0.1, 0.8, 1.45})
      table.emplace_back("star of " + std::to_string(n) + " with " + std::to_string(inner),
                         star(n, 1.5, inner), starCorners(n, 1.5, inner));
  }
  for (const auto& [name, shape, corners] : table) {
    ASSERT_TRUE(shape.ok()) << name << ": " << *shape.error;
    const Evaluator f(shape.distance);
    Sampler sampler(Box{{-4, -4, 0}, {4, 4, 0}}, kSeed);
    for (int i = 0; i < 1000; ++i) {
      // Corners' heights and widths too: there, edges are told apart by which side counts as theirs.
      dvec3 p = sampler.orOnAnAxis();
      if (i % 5 == 0) p.y = corners[i % corners.size()].y;
      if (i % 7 == 0) p.x = corners[(i / 7) % corners.size()].x;
      const double expected = test::outlineDistance(corners, p);
      ASSERT_NEAR(std::abs(f(p)), expected, kRounding)
          << name << " at " << test::text(p) << ", seed " << kSeed;
      if (expected < kRounding) continue;
      ASSERT_EQ(f(p) < 0.0, test::inPolygon(corners, p))
          << name << " at " << test::text(p) << ", seed " << kSeed;
    }
  }
}

TEST(Flats, WithRoundSidesAreMadeOfThePointsThatTheirNamesSay) {
  const struct {
    const char* name;
    Shape shape;
    std::function<bool(dvec2)> inside;
  } table[] = {
      {"ellipse", ellipse(1.2, 0.4), [](dvec2 p) { return glm::length(p / dvec2(1.2, 0.4)) <= 1.0; }},
      {"ring", ring(1.0, 0.3), [](dvec2 p) { return std::abs(glm::length(p) - 1.0) <= 0.15; }},
      {"arc", arc(130 * kDegree, 1.0, 0.3),
       [](dvec2 p) {
         const double a = 130 * kDegree;
         if (std::abs(std::atan2(p.x, p.y)) <= a) return std::abs(glm::length(p) - 1.0) <= 0.15;
         return glm::distance(dvec2(std::abs(p.x), p.y), dvec2(std::sin(a), std::cos(a))) <= 0.15;
       }},
  };
  for (const auto& row : table) {
    const Evaluator f(row.shape.distance);
    Sampler sampler(Box{{-1.5, -1.5, 0}, {1.5, 1.5, 0}}, kSeed);
    for (int i = 0; i < 4000; ++i) {
      const dvec3 p = sampler.orOnAnAxis();
      if (std::abs(f(p)) < 1e-6) continue;  // the ellipse's own accuracy
      ASSERT_EQ(f(p) < 0.0, row.inside(p)) << row.name << " at " << test::text(p) << ", seed " << kSeed;
    }
  }
}

// Folding costs a handful of operations for each doubling of the sides.
TEST(Flats, CostOfARegularPolygonGrowsWithTheLogarithmOfItsSides) {
  const auto cost = [](int sides) {
    return topologicalOrder(std::array{regularPolygon(sides, 1.0).distance}).size();
  };
  const std::size_t perDoubling = cost(16) - cost(8);
  EXPECT_LE(cost(1024), cost(8) + 7 * perDoubling + 4);
  EXPECT_LE(perDoubling, 16u);  // seven operations and their constants
}

TEST(Flats, AreFlatWithBoundsThatEndInXAndYOnly) {
  const Shape s = regularPolygon(3, 2.0);
  EXPECT_EQ(s.dimension, 2);
  EXPECT_NEAR(s.bounds.max.y, 2.0, kRounding);
  EXPECT_NEAR(s.bounds.min.y, -1.0, kRounding);
  EXPECT_NEAR(s.bounds.max.x, std::sqrt(3.0), kRounding);
  EXPECT_EQ(s.bounds.max.z, kInfinity);
}

TEST(Flats, TellOfABadArgumentInOneLine) {
  EXPECT_EQ(circle(0.0).error.value_or(""), "circle: radius must be positive, got 0");
  EXPECT_EQ(rectangle(1.0, -1.0).error.value_or(""), "rectangle: half.y must be positive, got -1");
  EXPECT_EQ(star(2, 1.0, 0.5).error.value_or(""), "star: points must be at least 3, got 2");
  EXPECT_EQ(arc(kPi * 1.5, 1.0, 0.5).error.value_or(""),
            "arc: angle must be above 0 and at most 180 degrees, got 270");
  EXPECT_EQ(polygon(Points{{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}).error.value_or(""),
            "polygon: edges 1 and 3 touch or cross");
  EXPECT_EQ(polygon(Points{}).error.value_or(""), "polygon: at least 3 points are needed, got 0");
}

TEST(Flats, ATriangleThatASliderClosesIsASegment) {
  const Shape triangle = trapezoid(Expr::parameter({"bottom", 1.0, 0.0, 2.0}), 0.0, 0.5);
  const TapePtr tape = Function(triangle.distance).at({{"bottom", 0.0}});
  EXPECT_DOUBLE_EQ(evaluate(*tape, {0.25, 0.0, 0.0}), 0.25);
  EXPECT_DOUBLE_EQ(evaluate(*tape, {0.3, 0.9, 0.0}), 0.5);  // 0.4 above its upper end
  EXPECT_DOUBLE_EQ(evaluate(*tape, {0.3, -0.9, 0.0}), 0.5);
}

}  // namespace flats_test
}  // namespace sdf
