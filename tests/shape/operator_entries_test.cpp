// The operators as scene files call them.
#include <numbers>

#include "claim_checks.h"
#include "sdf/shape/catalog/entries.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace operator_entries_test {

constexpr double kPi = std::numbers::pi;

const Argument kAbsent{};
Argument some(std::vector<Shape> shapes) { return shapes; }
Argument number(double v) { return Expr(v); }
Argument vector(double x, double y, double z) { return Vec3E(x, y, z); }

Shape call(const std::vector<CatalogEntry>& entries, const std::string& name,
           const std::vector<Argument>& arguments) {
  for (const CatalogEntry& e : entries)
    if (e.name == name) {
      EXPECT_EQ(arguments.size(), e.parameters.size()) << name;
      return e.build(arguments);
    }
  return Shape::failed("no entry " + name);
}

TEST(OperatorEntries, StartWithTheShapeSoThatTheyAreMethods) {
  for (const auto& entries : {booleanEntries(), deformEntries(), placeEntries(), patternEntries()})
    for (const CatalogEntry& e : entries) {
      const ArgumentKind first = e.parameters.at(0).kind;
      EXPECT_TRUE(first == ArgumentKind::Shape || first == ArgumentKind::Shapes) << e.name;
      EXPECT_FALSE(e.doc.empty() || e.claim.empty()) << e.name;
    }
}

TEST(OperatorEntries, BlendWhereAWidthIsGiven) {
  const Shape a = sphere(1.0), b = box(Vec3E(0.8));
  const auto entries = booleanEntries();
  EXPECT_EQ(call(entries, "union", {some({a, b}), kAbsent, 0}).distance, (a | b).distance);
  EXPECT_EQ(call(entries, "difference", {some({a, b}), number(0.2), 0}).distance,
            subtract(a, b, Blend::quadratic(0.2)).distance);
  EXPECT_EQ(call(entries, "intersection", {some({a, b}), number(0.2), 1}).distance,
            intersect(a, b, Blend::cubic(0.2)).distance);
  EXPECT_EQ(call(entries, "xor", {some({a, b}), number(0.2), 2}).distance,
            exclude(a, b, Blend::exponential(0.2)).distance);
  EXPECT_EQ(call(entries, "union", {some({a, b}), number(0.2), 3}).distance,
            unite(a, b, Blend::chamfer(0.2)).distance);
  EXPECT_EQ(*call(entries, "union", {some({a, b}), kAbsent, 3}).error,
            "union: blend needs k, the width of the blend");
}

TEST(OperatorEntries, TakeDegrees) {
  const Shape s = box(Vec3E(0.4, 0.3, 0.2));
  EXPECT_EQ(call(placeEntries(), "rotate", {s, vector(90.0, 0.0, 0.0)}).bounds.max,
            rotate(s, Vec3E(kPi / 2.0, 0.0, 0.0)).bounds.max);
  const Probe turned(call(placeEntries(), "rotate_about", {s, vector(0.0, 2.0, 0.0), number(30.0)}).distance);
  const Probe twisted(call(deformEntries(), "twist", {s, number(90.0)}).distance),
      same(twist(s, kPi / 2.0).distance);
  const Probe bent(call(deformEntries(), "bend", {s, number(45.0)}).distance),
      arc(bend(s, kPi / 4.0).distance);
  const Probe turnedToo(rotate(s, Vec3E(0.0, kPi / 6.0, 0.0)).distance);
  Points points(1);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p = points.in(cube(1.0));
    ASSERT_NEAR(turned(p), turnedToo(p), kRounding);
    ASSERT_NEAR(twisted(p), same(p), kRounding);
    ASSERT_NEAR(bent(p), arc(p), kRounding);
  }
}

TEST(OperatorEntries, MirrorTakesAnAxisOrANormal) {
  const Shape s = translate(sphere(0.3), Vec3E(1.0, 2.0, 3.0));
  const auto image = [&](int axis, Argument normal) {
    return call(placeEntries(), "mirror", {s, axis, normal}).bounds.min;
  };
  EXPECT_NEAR(image(1, kAbsent).y, -2.3, kRounding);
  EXPECT_NEAR(image(0, vector(0.0, 0.0, -2.0)).z, -3.3, kRounding);
  EXPECT_NEAR(image(0, vector(0.0, 0.0, -2.0)).x, 0.7, kRounding);
}

TEST(OperatorEntries, CountsAreWholeFixedNumbers) {
  const auto repeat = [](Argument count) {
    return call(patternEntries(), "repeat_grid", {sphere(0.3), vector(1.0, 1.0, 1.0), std::move(count)});
  };
  EXPECT_EQ(repeat(kAbsent).bounds.max.x, kInfinity);
  EXPECT_NEAR(repeat(vector(3.0, 2.0, 1.0)).bounds.max.x, 1.3, kRounding);
  EXPECT_EQ(*repeat(vector(2.5, 1.0, 1.0)).error,
            "repeat_grid: count.x must be a whole number from 1 to 1000000, got 2.5");
  EXPECT_EQ(*repeat(vector(1.0, 0.0, 1.0)).error,
            "repeat_grid: count.y must be a whole number from 1 to 1000000, got 0");
  EXPECT_EQ(*repeat(Vec3E(slider("n", 2.0, 1.0, 5.0), 1.0, 1.0)).error,
            "repeat_grid: count.x must be a plain number, not a parameter");
}

}  // namespace operator_entries_test
}  // namespace sdf
