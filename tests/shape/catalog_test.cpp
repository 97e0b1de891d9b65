#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "shape/cases.h"

namespace sdf {
namespace catalog_test {

using test::Evaluator;
using test::Sampler;
using test::ShapeCase;

constexpr unsigned kSeed = 20240611;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A distance is computed in some tens of operations on numbers of the region's size, each rounded.
double roundingAt(const glm::dvec3& p) {
  return 256.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, glm::length(p));
}

// How exact an "exact" shape is: the iterated ones as their headers say.
double exactness(const ShapeCase& c) {
  const bool iterated = c.name.rfind("ellips", 0) == 0 && c.shape.claim.kind == ClaimKind::Exact;
  return iterated ? 5e-7 * c.shape.bounds.max.y + 5e-7 * c.shape.bounds.max.x : 0.0;
}

class EveryPrimitive : public testing::TestWithParam<ShapeCase> {
 protected:
  const ShapeCase& shapeCase() { return GetParam(); }
  const Shape& shape() { return GetParam().shape; }
};

std::string testName(const testing::TestParamInfo<ShapeCase>& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

class EveryExactPrimitive : public EveryPrimitive {};
class EveryFlatPrimitive : public EveryPrimitive {};

template <class Wanted>
std::vector<ShapeCase> casesWhere(Wanted wanted) {
  std::vector<ShapeCase> cases = test::primitiveCases();
  std::erase_if(cases, [&](const ShapeCase& c) { return !wanted(c.shape); });
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Catalog, EveryPrimitive, testing::ValuesIn(test::primitiveCases()), testName);
INSTANTIATE_TEST_SUITE_P(Catalog, EveryExactPrimitive, testing::ValuesIn(casesWhere([](const Shape& s) {
                           return s.claim.kind < ClaimKind::Bound;
                         })),
                         testName);
INSTANTIATE_TEST_SUITE_P(Catalog, EveryFlatPrimitive,
                         testing::ValuesIn(casesWhere([](const Shape& s) { return s.dimension == 2; })),
                         testName);

TEST_P(EveryPrimitive, IsBuiltWithoutAnError) {
  ASSERT_TRUE(shape().ok()) << *shape().error;
  EXPECT_EQ(shape().claim.lipschitz, 1.0);
  EXPECT_LE(shape().distance.lipschitz(), shape().claim.lipschitz);
  EXPECT_FALSE(shape().bounds.empty());
}

TEST_P(EveryPrimitive, HasNoNanAtTheCentreOnAxesOrFarAway) {
  const Evaluator f(shape().distance);
  std::vector<double> coordinates{0.0, -0.0, 1.0, -1.0, 0.25, 1e-30, -1e-12, 1e5, -1e5};
  for (int i = 0; i < 3; ++i)
    for (double end : {shape().bounds.min[i], shape().bounds.max[i]})
      if (std::isfinite(end)) coordinates.push_back(end);
  for (double x : coordinates)
    for (double y : coordinates)
      for (double z : coordinates)
        ASSERT_TRUE(std::isfinite(f({x, y, z}))) << f({x, y, z}) << " at " << test::text({x, y, z});
}

TEST_P(EveryPrimitive, HasASolidWithinItsBounds) {
  const Evaluator f(shape().distance);
  Sampler sampler(test::sampleRegion(shape()), kSeed);
  Sampler within(intersect(shape().bounds, test::sampleRegion(shape())), kSeed);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = sampler.orOnAnAxis();
    const double slack = roundingAt(p) + exactness(shapeCase());
    if (!shape().bounds.grown(slack).contains({p, p})) {
      ASSERT_GT(f(p), -slack) << test::text(p) << ", seed " << kSeed;
    }
    inside += f(within.anywhere()) <= 0.0;
  }
  EXPECT_GT(inside, 0);
}

// Not only the distance: cells are skipped and tapes specialised by what each node of the graph claims.
TEST_P(EveryPrimitive, KeepsTheLipschitzBoundOfEveryNode) {
  const Expr& distance = shape().distance;
  const std::vector<Expr> nodes = topologicalOrder({&distance, 1});
  const Evaluator f(distance);
  const Box region = test::sampleRegion(shape());
  Sampler sampler(region, kSeed);
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 p = sampler.orOnAnAxis();
    const double reach = region.longestSide() * std::pow(10.0, -4.0 * sampler.uniform());
    const glm::dvec3 q = sampler.near(p, reach);
    f(p);
    const std::vector<double> before = f.values();
    f(q);
    const double apart = glm::distance(p, q);
    const double slack = roundingAt(p) + roundingAt(q);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (!std::isfinite(nodes[n].lipschitz())) continue;
      const double change = std::abs(f.values()[n] - before[n]);
      const double scale = std::max({1.0, std::abs(before[n]), nodes[n].lipschitz()});
      const double allowed = nodes[n].lipschitz() * apart + slack * scale +
                             (n + 1 == nodes.size() ? 2.0 * exactness(shapeCase()) : 0.0);
      ASSERT_LE(change, allowed) << info(nodes[n].op()).name << " node " << n << " of " << nodes.size()
                                 << " claims L = " << nodes[n].lipschitz() << " between " << test::text(p)
                                 << " and " << test::text(q) << ", seed " << kSeed;
    }
  }
}

// Is the slope 1 at p, and p - f grad f, the point of the zero set that p would be closest to, on the
// surface?
bool hasFootOnTheSurface(const Evaluator& f, const glm::dvec3& p, double step, double exactness) {
  // Differences are off by the square of steps over the distance to the next crease, so by this at 1000
  // steps.
  constexpr double kSlope = 1e-6;
  const double value = f(p);
  const glm::dvec3 gradient = f.gradient(p, step);
  if (std::abs(glm::length(gradient) - 1.0) > kSlope + exactness / step) return false;
  const glm::dvec3 foot = p - gradient * value;
  const double error = kSlope * std::abs(value) + roundingAt(p) + exactness;
  if (std::abs(f(foot)) > error) return false;
  // Where f only touches 0 without a change of sign it comes back with slope 1 on the other side. (Beyond a
  // corner it may come back too, but less steeply: as the cosine of at least the corner's angle.)
  const double beyond = std::copysign(3e4 * error, value);
  return std::copysign(1.0, value) * f(foot - gradient * beyond) < 0.9998 * std::abs(beyond);
}

// With L = 1 the distance to the zero set is at least |f|; that the foot point lies on it makes it at most
// |f|.
TEST_P(EveryExactPrimitive, HasItsFootPointOnTheSurface) {
  const ClaimKind kind = shape().claim.kind;
  const Evaluator f(shape().distance);
  const Box region = test::sampleRegion(shape());
  Sampler sampler(region, kSeed);
  constexpr int kSamples = 4000;
  int creased = 0, tried = 0;
  glm::dvec3 last(0.0);
  while (tried < kSamples) {
    const glm::dvec3 p = sampler.anywhere();
    if (kind == ClaimKind::ExactOutside && f(p) <= 0.0) continue;
    ++tried;
    if (hasFootOnTheSurface(f, p, 1e-6 * region.longestSide(), exactness(shapeCase()))) continue;
    ++creased;
    last = p;
  }
  // Creases are sheets. Within 1000 steps of one, a thousandth of the region, lies some thousandth of the
  // samples.
  EXPECT_LE(creased, kSamples / 100) << "seed " << kSeed << ", the last at " << test::text(last);
}

TEST_P(EveryFlatPrimitive, IgnoresZ) {
  const Evaluator f(shape().distance);
  EXPECT_EQ(shape().bounds.min.z, -kInfinity);
  EXPECT_EQ(shape().bounds.max.z, kInfinity);
  Sampler sampler(test::sampleRegion(shape()), kSeed);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p = sampler.anywhere();
    ASSERT_EQ(f(p), f({p.x, p.y, p.z + 7.0}));
  }
}

TEST(Catalog, NamesAreUniqueAndEveryPrimitiveHasOtherArguments) {
  std::set<std::string> names;
  for (const CatalogEntry& e : catalog()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name << " is there twice";
    EXPECT_EQ(findEntry(e.name), &e);
    EXPECT_FALSE(e.doc.empty() || e.claim.empty()) << e.name;
    for (const Parameter& p : e.parameters) EXPECT_FALSE(p.doc.empty()) << e.name << " " << p.name;
    if (test::isPrimitive(e)) {
      const auto it = test::otherArguments().find(e.name);
      ASSERT_NE(it, test::otherArguments().end()) << e.name;
      EXPECT_GE(it->second.size(), 2u) << e.name;
    }
  }
  EXPECT_EQ(findEntry("no such shape"), nullptr);
}

// The entry's defaults, each number a parameter that may run from 0 to twice its default.
struct Ranged {
  std::vector<Argument> arguments;
  std::map<std::string, double> ends;
};

Ranged rangedDefaults(const CatalogEntry& e) {
  Ranged r;
  for (const Parameter& p : e.parameters) {
    std::vector<double> n = test::numbersIn(p.fallback);
    n.resize(std::max<std::size_t>(n.size(), 3));
    const auto asParameter = [&](int i) {
      const std::string name = e.name + "." + p.name + std::to_string(i);
      const double end = 2.0 * n[i];
      r.ends[name] = end;
      return Expr::parameter({name, n[i], std::min(0.0, end), std::max(0.0, end)});
    };
    if (p.kind == ArgumentKind::Number)
      r.arguments.push_back(asParameter(0));
    else if (p.kind == ArgumentKind::Vector2)
      r.arguments.push_back(Vec3E{asParameter(0), asParameter(1), 0.0});
    else if (p.kind == ArgumentKind::Vector3)
      r.arguments.push_back(Vec3E{asParameter(0), asParameter(1), asParameter(2)});
    else
      r.arguments.emplace_back();
  }
  return r;
}

TEST(Catalog, ClaimsAndBoundsHoldOverTheRangesOfParameters) {
  for (const CatalogEntry& e : catalog()) {
    if (!test::isPrimitive(e)) continue;
    const Ranged ranged = rangedDefaults(e);
    const Shape shape = build(e, ranged.arguments);
    ASSERT_TRUE(shape.ok()) << *shape.error;
    Sampler sampler(Box::centred(glm::dvec3(4.0)), kSeed);
    // The ellipsoids' iteration is exact only for radii in bounded ratios.
    const double slack = e.name.rfind("ellips", 0) == 0 ? 1e-5 : 1e-12;
    for (int trial = 0; trial < 60; ++trial) {
      std::map<std::string, double> values;
      for (const auto& [name, end] : ranged.ends)
        values[name] = end * (trial % 7 == 0 ? 0.0 : sampler.uniform());
      const Evaluator f(shape.distance, values);
      for (int i = 0; i < 50; ++i) {
        const glm::dvec3 p = sampler.orOnAnAxis(), q = sampler.near(p, 1.0);
        ASSERT_LE(std::abs(f(p) - f(q)), shape.claim.lipschitz * glm::distance(p, q) + slack)
            << e.name << " between " << test::text(p) << " and " << test::text(q) << ", seed " << kSeed;
        if (!shape.bounds.grown(slack).contains({p, p})) {
          ASSERT_GT(f(p), -slack) << e.name << " at " << test::text(p) << ", seed " << kSeed;
        }
      }
    }
  }
}

struct Refusal {
  std::string entry;
  std::vector<Argument> arguments;
  std::string message;
};

TEST(Catalog, RefusesArgumentsWithOneLineThatSaysWhatToChange) {
  using test::number;
  using test::vector;
  using Points = std::vector<glm::dvec2>;
  const Expr moving = position().x;
  const Refusal refusals[] = {
      {"sphere", {number(-1)}, "sphere: radius must be positive, got -1"},
      {"sphere", {number(0)}, "sphere: radius must be positive, got 0"},
      {"sphere", {number(kNan)}, "sphere: radius must be a finite number, got nan"},
      {"sphere", {number(kInfinity)}, "sphere: radius must be a finite number, got inf"},
      {"sphere", {Argument(moving)}, "sphere: radius must not depend on position"},
      {"sphere", {vector(1, 2, 3)}, "sphere: radius must be a number"},
      {"sphere", {number(1), number(2)}, "sphere: takes at most 1 arguments, got 2"},
      {"box", {vector(1, -2, 1)}, "box: half.y must be positive, got -2"},
      {"box", {vector(1, 1, kNan)}, "box: half.z must be a finite number, got nan"},
      {"round_box",
       {vector(1, 0.5, 1), number(0.6)},
       "round_box: radius must be at most the smallest half size, 0.5, got 0.6"},
      {"round_box", {vector(1, 1, 1), number(-0.1)}, "round_box: radius must be 0 or more, got -0.1"},
      {"box_frame",
       {vector(1, 0.5, 1), number(0.6)},
       "box_frame: thickness must be at most the smallest half size, 0.5, got 0.6"},
      {"torus", {number(1), number(0)}, "torus: minor must be positive, got 0"},
      {"capped_torus", {number(181)}, "capped_torus: angle must be above 0 and at most 180 degrees, got 181"},
      {"solid_angle", {number(180)}, "solid_angle: angle must be above 0 and below 180 degrees, got 180"},
      {"cut_sphere",
       {number(1), number(1)},
       "cut_sphere: height must lie between -radius and radius, 1, got 1"},
      {"capped_cone", {number(0), number(0)}, "capped_cone: radius_bottom and radius_top must not both be 0"},
      {"round_cone",
       {number(2), number(0.5), number(0.5)},
       "round_cone: radius_bottom and radius_top must differ by less than 2 half_height, 1, or one ball "
       "holds "
       "the other"},
      {"plane", {vector(0, 0, 0)}, "plane: normal must not be {0, 0, 0}"},
      {"gyroid",
       {number(1), number(0.3)},
       "gyroid: thickness must be less than 0.275664 cell, 0.275664, got 0.3"},
      {"thread", {number(1), number(1)}, "thread: pitch must be less than 0.92376 diameters, 0.92376, got 1"},
      {"thread",
       {number(1), number(0.2), number(2), Argument(0)},
       "thread: starts must be a whole number from 1, got 0"},
      {"thread",
       {number(1), number(0.2), number(2), Argument(1), number(-0.2)},
       "thread: clearance must be above -0.195873, got -0.2"},
      {"regular_polygon", {Argument(2)}, "regular_polygon: sides must be at least 3, got 2"},
      {"star", {Argument(5), number(1), number(1)}, "star: inner must be less than outer, 1, got 1"},
      {"ring", {number(1), number(2)}, "ring: thickness must be less than twice the radius, 2, got 2"},
      {"arc", {number(0)}, "arc: angle must be positive, got 0"},
      {"trapezoid", {number(0), number(0)}, "trapezoid: half_bottom and half_top must not both be 0"},
      {"polygon", {Points{{0, 0}, {1, 0}}}, "polygon: at least 3 points are needed, got 2"},
      {"polygon", {Points{{0, 0}, {1, 0}, {kNan, 1}}}, "polygon: point 3 must be finite, got {nan, 1}"},
      {"polygon", {Points{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}, "polygon: points 2 and 3 are the same"},
      {"polygon", {Points{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, "polygon: edges 1 and 3 touch or cross"},
      {"polygon", {Points{{0, 0}, {1, 0}, {2, 0}}}, "polygon: the edges at point 3 lie on each other"},
  };
  for (const Refusal& r : refusals) {
    const CatalogEntry* entry = findEntry(r.entry);
    ASSERT_NE(entry, nullptr) << r.entry;
    const Shape shape = build(*entry, r.arguments);
    EXPECT_EQ(shape.error.value_or("(no error)"), r.message);
  }
}

TEST(Catalog, ReturnsAFailedShapeAmongTheArgumentsAsItIs) {
  const Shape broken = Shape::failed("sphere: radius must be positive, got -1");
  for (const CatalogEntry& e : catalog()) {
    const ArgumentKind first = e.parameters.empty() ? ArgumentKind::Number : e.parameters[0].kind;
    if (first == ArgumentKind::Shape) {
      EXPECT_EQ(build(e, {broken}).error, broken.error) << e.name;
    } else if (first == ArgumentKind::Shapes) {
      EXPECT_EQ(build(e, {std::vector<Shape>{broken, broken}}).error, broken.error) << e.name;
    }
  }
}

}  // namespace catalog_test
}  // namespace sdf
