// A model's tapes: what is linked for a region says there what the whole says.
#include "sdf/model/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace model_test {

double uniform(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

Vec3E place(std::mt19937& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

// Balls, tubes and stretched boxes, which have claims and growths of their own, each in its own colour.
std::vector<Shape> strewn(std::mt19937& random, int count) {
  std::vector<Shape> all;
  for (int i = 0; i < count; ++i) {
    const double size = uniform(random, 0.05, 0.3);
    const Shape kinds[] = {sphere(size), torus(size, 0.3 * size),
                           scale(box(Vec3E(Expr(size))), Vec3E(1.0, 2.0, 0.5)),
                           intersect(sphere(size), box(Vec3E(Expr(0.8 * size))))};
    Material m;
    m.color = {Expr(i / double(count)), Expr(0.5), Expr(1.0 - i / double(count))};
    all.push_back(translate(rotate(kinds[i % 4], place(random, 3.0)), place(random, 2.0)).paint(m));
  }
  return all;
}

struct Seen {
  std::size_t near = 0;    // points at which the model's distance was gentle
  std::size_t linked = 0;  // operands, summed over regions
  std::size_t regions = 0;
};

// Regions of all sizes: where the whole's distance is at most `most`, what is linked says the same to the
// last bit, and elsewhere no less than `most`.
Seen expectSame(const Shape& shape, const Values& values, std::mt19937& random) {
  const ModelTapes model = Model(shape).at(values);
  Seen seen;
  for (int trial = 0; trial < 300; ++trial) {
    const double half = std::exp(uniform(random, std::log(0.02), std::log(1.0)));
    const glm::dvec3 centre(uniform(random, -2.3, 2.3), uniform(random, -2.3, 2.3),
                            uniform(random, -2.3, 2.3));
    const double most = uniform(random, 0.0, 0.1);
    const Box region{centre - half, centre + half};
    const auto near = model.relevantOperands(region, most, model.all());
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    const TapePtr tape = near.empty() ? nullptr : model.link(near);
    seen.linked += near.size();
    ++seen.regions;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 p =
          centre + half * glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      const std::vector<double> whole = evaluateAll(*model.whole(), p);
      if (whole[0] > most) {
        EXPECT_TRUE(!tape || evaluate(*tape, p) > most) << "trial " << trial;
        continue;
      }
      ++seen.near;
      EXPECT_TRUE(tape) << "trial " << trial;
      if (tape) {
        EXPECT_EQ(evaluateAll(*tape, p), whole) << "trial " << trial;
      }
    }
  }
  return seen;
}

// Seven operations on distances of at most 6.
constexpr double kRoundings = 7 * 6.0 * DBL_EPSILON;

TEST(Model, LinksOfAHardUnionSayWhatTheWholeSaysNearTheSurface) {
  std::mt19937 random(1);
  const Shape shape = unite(strewn(random, 60));
  const Seen seen = expectSame(shape, {}, random);
  EXPECT_GT(seen.near, 200u);
  EXPECT_LT(seen.linked, seen.regions * 60 / 3) << "most operands are far from most regions";
}

TEST(Model, LinksOfABlendSayWhatTheWholeSaysNearTheSurface) {
  for (const Blend& blend : {Blend::quadratic(0.05), Blend::cubic(0.05), Blend::chamfer(0.04)}) {
    std::mt19937 random(2);
    const Seen seen = expectSame(unite(strewn(random, 40), blend), {}, random);
    EXPECT_GT(seen.near, 200u);
    EXPECT_LT(seen.linked, seen.regions * 40) << "some operands are far from some regions";
  }
}

TEST(Model, ABlendsWidthMayBeAnInput) {
  std::mt19937 random(3);
  const Expr k = Expr::parameter({"k", 0.02, 0.01, 0.2});
  const Shape shape = unite(strewn(random, 30), Blend::quadratic(k));
  for (const double now : {0.01, 0.1, 0.2}) {
    const Shape fixed = [&] {
      std::mt19937 again(3);
      return unite(strewn(again, 30), Blend::quadratic(now));
    }();
    EXPECT_GT(expectSame(shape, {{"k", now}}, random).near, 100u);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 p(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
      EXPECT_NEAR(evaluate(*Model(shape).at({{"k", now}}).whole(), p), evaluate(Tape(fixed.distance), p),
                  kRoundings);
    }
  }
}

TEST(Model, TheWholeIsTheShape) {
  std::mt19937 random(4);
  for (const Shape& shape :
       {unite(strewn(random, 20)), unite(strewn(random, 9), Blend::cubic(0.2)), strewn(random, 4)[3],
        unite(strewn(random, 5), Blend::exponential(0.1)), translate(unite(strewn(random, 12)), Vec3E(0.5)),
        scale(rotate(unite(strewn(random, 12)), Vec3E(0.3)), 1.5)}) {
    const ModelTapes model = Model(shape).at();
    const Tape tape(shape.distance);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p(uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3));
      EXPECT_NEAR(evaluate(*model.whole(), p), evaluate(tape, p), kRoundings);
    }
  }
}

TEST(Model, KnowsNoBoundsAndSlopesForValuesOutOfRange) {
  const Expr r = Expr::parameter({"r", 0.5, 0.1, 1.0});
  const Shape far = translate(sphere(0.1), Vec3E(9.0, 0.0, 0.0));
  const Model model(unite({sphere(r), far}));
  const std::uint32_t both[] = {0, 1};
  const Box beside{glm::dvec3(2.0), glm::dvec3(3.0)};
  EXPECT_EQ(model.at({{"r", 1.0}}).slope(), 1.0);
  EXPECT_TRUE(model.at({{"r", 1.0}}).relevantOperands(beside, 0.5, both).empty());
  const ModelTapes large = model.at({{"r", 4.0}});
  EXPECT_EQ(large.slope(), kInfinity);
  EXPECT_EQ(large.relevantOperands(beside, 0.5, both), (std::vector<std::uint32_t>{0, 1}));

  const Expr k = Expr::parameter({"k", 0.1, 0.0, 0.2});
  const Model blend(unite({sphere(1.0), far}, Blend::quadratic(k)));
  EXPECT_EQ(blend.at({{"k", 0.2}}).slope(), 1.0);
  EXPECT_EQ(blend.at({{"k", 30.0}}).slope(), kInfinity);
}

TEST(Model, ALaterOperandShowsOnATie) {
  Material red, blue;
  red.color = {Expr(1.0), Expr(0.0), Expr(0.0)};
  blue.color = {Expr(0.0), Expr(0.0), Expr(1.0)};
  const Shape far = translate(sphere(0.1), Vec3E(9.0, 0.0, 0.0));
  const Shape shape = unite({sphere(1.0).paint(red), far, sphere(1.0).paint(blue)});
  const ModelTapes model = Model(shape).at();
  const std::uint32_t both[] = {0, 2};
  for (const TapePtr& tape : {model.whole(), model.link(both)})
    EXPECT_EQ(evaluateAll(*tape, {1.0, 0.0, 0.0})[static_cast<int>(SurfaceOutput::Blue)], 1.0);
}

TEST(Model, AFieldsSlopeHoldsInItsTapesOnlyWhereItIsClaimed) {
  // One formula with two claims in one union: neither lends its slope to the other.
  const Expr formula = sin(position().x * 3.0) + position().y;
  const Shape wrong = field(formula, Box::centred(glm::dvec3(1.0)), 0.5);
  const Shape right = field(formula, Box::centred(glm::dvec3(1.0)));
  EXPECT_EQ(wrong.claim.lipschitz, 0.5);
  EXPECT_GE(right.claim.lipschitz, 3.0);
  EXPECT_GE(slopeOf(unite(wrong, right)), 3.0);
  EXPECT_GE(Tape(unite(wrong, right).distance).lipschitz(), 3.0f);
}

TEST(Marchable, DistanceAndStepAreOneNodeWhereTheSlopeIsOne) {
  const Shape many = unite({sphere(1.0), box(Vec3E(0.5)), translate(torus(1.0, 0.2), Vec3E(2.0, 0.0, 0.0))});
  for (const Shape& shape : {sphere(1.0), many}) {
    const Marchable m = marchable(shape);
    EXPECT_EQ(m.distance, shape.distance);
    EXPECT_EQ(m.step, shape.distance);
    EXPECT_EQ(m.slope, 1.0);
  }
}

TEST(Marchable, TheDistanceDoesNotDependOnTheSlope) {
  const Expr formula = 3.0 * position().y - 3.0;
  const Box bounds{{-1.0, -2.0, -1.0}, {1.0, 1.0, 1.0}};
  for (const double slope : {3.0, 4.0, 30.0}) {
    const Marchable m = marchable(field(formula, bounds, slope));
    EXPECT_EQ(m.slope, 3.0) << "the formula's own is known";
    const Tape distance(m.distance), step(m.step);
    EXPECT_EQ(evaluate(distance, {0.0, 1.25, 0.0}), 0.75);
    EXPECT_NEAR(evaluate(step, {0.0, 1.25, 0.0}), 0.25, 1e-15);
    EXPECT_EQ(evaluate(step, {5.0, 1.25, 0.0}), 4.0) << "the way to its bounds is longer";
  }
}

TEST(Marchable, OneSteepOperandSlowsNoOtherDown) {
  const Vec3E p = position();
  const Shape steep = field(4.0 * (p.y + 5.0)), ball = sphere(1.0), gentle = field(0.5 * (9.0 - p.x));
  const Marchable m = marchable(unite({steep, ball, gentle}));
  EXPECT_EQ(m.slope, slopeOf(steep));
  const Tape distance(m.distance), step(m.step);
  EXPECT_EQ(evaluate(distance, {0.0, 1.5, 0.0}), 0.5);
  EXPECT_EQ(evaluate(step, {0.0, 1.5, 0.0}), 0.5) << "the ball's, undivided";
  EXPECT_EQ(evaluate(distance, {8.0, 1.5, 0.0}), 0.5);
  EXPECT_NEAR(evaluate(step, {8.0, 1.5, 0.0}), 1.0, 1e-12) << "the gentle field's, made larger";
  EXPECT_EQ(evaluate(distance, {5.0, -4.75, 0.0}), 1.0);
  EXPECT_NEAR(evaluate(step, {5.0, -4.75, 0.0}), 0.25, 1e-12) << "the steep field's";
}

// A step is free of the surface, and has the sign of the distance: at random places about unions of all
// kinds.
TEST(Marchable, StepsAreFreeAndHaveTheDistancesSign) {
  const Vec3E p = position();
  const Expr waves = p.y + 0.3 * sin(4.0 * p.x) * cos(3.0 * p.z);
  const Shape bumps = field(waves, Box{{-1.0, -0.5, -1.0}, {1.0, 0.5, 1.0}}) & box(Vec3E(1.0, 0.5, 1.0));
  const Shape wild = field(max(p.x * p.x * p.x - p.y, max(max(abs(p.x), abs(p.y)), abs(p.z)) - 1.0),
                           Box::centred(glm::dvec3(1.0)));
  const Shape scene =
      unite({bumps, translate(wild, Vec3E(3.0, 0.0, 0.0)), translate(sphere(0.5), Vec3E(0.0, 2.0, 0.0)),
             translate(bumps, Vec3E(0.0, -2.0, 0.0))});
  const Marchable m = marchable(scene);
  ASSERT_LT(m.slope, kInfinity);
  ASSERT_NE(m.step, m.distance);
  const Tape distance(m.distance), step(m.step);
  std::mt19937 random(7);
  std::uniform_real_distribution<> within(-4.0, 4.0);
  std::normal_distribution<> normal;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 a{within(random), within(random), within(random)};
    const double f = evaluate(distance, a), g = evaluate(step, a);
    ASSERT_EQ(f > 0.0, g > 0.0) << f << ' ' << g << " at " << a.x << ", " << a.y << ", " << a.z;
    const glm::dvec3 way = glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
    const double there = evaluate(distance, a + 0.999 * std::abs(g) * way);
    ASSERT_EQ(f > 0.0, there > 0.0) << f << ' ' << g << " at " << a.x << ", " << a.y << ", " << a.z;
  }
}

TEST(Marchable, AUnionIsAsMarchableAsEachOfItsOperands) {
  const Vec3E p = position();
  const Shape wild = field(p.x * p.x * p.x - p.y, Box::centred(glm::dvec3(1.0)));
  const Marchable alone = marchable(wild), m = marchable(unite(wild, plane({0.0, 1.0, 0.0}, -2.0)));
  EXPECT_EQ(m.slope, alone.slope);
  const Tape tape(m.distance);
  EXPECT_EQ(evaluate(tape, {0.5, 0.25, 0.0}), 0.125 - 0.25);
  EXPECT_EQ(evaluate(tape, {0.0, 0.0, 11.0}), 2.0) << "the floor";
  EXPECT_EQ(marchable(unite(wild, field(p.x * p.x))).slope, kInfinity);
}

TEST(Marchable, AFieldIsNoNearerThanTheWayToItsBounds) {
  const Vec3E p = position();
  const Shape wild = field(p.x * p.x * p.x - p.y, Box::centred(glm::dvec3(1.0)));
  const Marchable m = marchable(wild);
  ASSERT_TRUE(std::isfinite(m.slope));
  const Tape distance(m.distance), step(m.step);
  EXPECT_EQ(evaluate(distance, {0.5, 0.25, 0.0}), 0.125 - 0.25);
  EXPECT_DOUBLE_EQ(evaluate(distance, {0.0, 0.0, 11.0}), 9.0 * m.slope)
      << "to the bounds grown by half their side, as steep as the formula";
  EXPECT_EQ(evaluate(step, {0.0, 0.0, 11.0}), 10.0);
  EXPECT_EQ(marchable(field(p.x * p.x)).slope, kInfinity) << "nothing is known of it";
  EXPECT_GT(marchable(field(Expr(1.0))).slope, 0.0);
}

}  // namespace model_test
}  // namespace sdf
