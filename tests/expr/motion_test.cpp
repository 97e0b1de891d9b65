#include "sdf/expr/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace motion_test {

/// A shape's distance and attributes.
std::vector<Expr> graphs(const Shape& shape) {
  EXPECT_TRUE(shape.ok()) << shape.error.value_or("");
  std::vector<Expr> all{shape.distance};
  all.insert(all.end(), shape.surface.begin(), shape.surface.end());
  return all;
}

std::optional<RigidMotion> between(const Shape& before, const Shape& after, const RigidMotion& near = {}) {
  return motionBetween(graphs(before), graphs(after), near);
}

/// Holds the motion to its meaning at random points and normals, to within the rounding of some operations.
void expectMoves(const Shape& before, const Shape& after, const RigidMotion& m) {
  const Tape first(graphs(before)), second(graphs(after));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-2.0, 2.0);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p{coordinate(random), coordinate(random), coordinate(random)};
    const glm::dvec3 n =
        glm::normalize(glm::dvec3{coordinate(random), coordinate(random), coordinate(random)});
    const std::vector<double> here = evaluateAll(first, p, n),
                              there = evaluateAll(second, m(p), m.rotation * n);
    for (std::size_t k = 0; k < here.size(); ++k) ASSERT_NEAR(there[k], here[k], 1e-9) << "output " << k;
  }
}

/// A body without symmetry, in colours that vary over it.
Shape body() {
  const Vec3E p = position();
  return unite(translate(box({0.5, 0.3, 0.2}), {0.2, 0.1, 0.0}), translate(sphere(0.3), {0.6, 0.4, 0.3}))
      .paint({.color = {sin(p.x * 3.0), p.y * p.z, 1.0}});
}

Shape turned(double angle) {
  return translate(rotate(body(), {0.3, angle, 0.1}), {angle, 1.0, -2.0 * angle});
}

TEST(MotionBetween, FindsHowABodyWasTurnedAndMoved) {
  for (const double angle : {0.0, 0.4, 2.0, 3.0, -1.0, glm::half_pi<double>(), glm::pi<double>()}) {
    SCOPED_TRACE(angle);
    const std::optional<RigidMotion> m = between(turned(0.7), turned(angle));
    ASSERT_TRUE(m);
    expectMoves(turned(0.7), turned(angle), *m);
  }
}

TEST(MotionBetween, IsExactlyNothingWhereNothingMoved) {
  const std::optional<RigidMotion> m = between(turned(0.7), turned(0.7));
  ASSERT_TRUE(m);
  EXPECT_EQ(m->rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(m->translation, glm::dvec3(0.0));
}

TEST(MotionBetween, DoesNotTurnWhatOnlyMoves) {
  const Shape askew = rotate(body(), {0.3, 0.5, 0.7});
  const std::optional<RigidMotion> m =
      between(translate(askew, {0.1, 0.2, 0.3}), translate(askew, {1.7, -0.3, 0.9}));
  ASSERT_TRUE(m);
  EXPECT_EQ(m->rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
  EXPECT_LT(glm::distance(m->translation, {1.6, -0.5, 0.6}), 1e-14);
}

TEST(MotionBetween, SeesThroughWhatElseWasDoneToABody) {
  // Turned about a point of its own, twisted before, painted after, in a union that moves as a whole.
  const auto at = [](double t) {
    const Shape wheel = translate(
        rotate(translate(twist(box({0.2, 0.6, 0.3}), 1.0), {-1.0, 0.0, 0.0}), {0.0, 0.0, t}), {1.0, t, 0.0});
    const Shape hub =
        translate(rotate(translate(sphere(0.3), {-1.0, 0.0, 0.0}), {0.0, 0.0, t}), {1.0, t, 0.0});
    return unite(wheel, hub, Blend::quadratic(0.1)).paint({.color = {1.0, 0.0, 0.0}});
  };
  const std::optional<RigidMotion> m = between(at(0.2), at(1.5));
  ASSERT_TRUE(m);
  expectMoves(at(0.2), at(1.5), *m);
}

TEST(MotionBetween, OfSeveralTakesTheOneThatTurnsLeast) {
  // Half a turn of a box is none, to look at; but one that turned nearly half before goes on.
  const Shape still = box({0.5, 0.3, 0.2});
  const auto at = [&](double angle) { return rotate(still, {0.0, angle, 0.0}); };
  const double pi = glm::pi<double>();
  EXPECT_NEAR(glm::angle(between(still, at(pi))->rotation), 0.0, 1e-7);
  RigidMotion last;
  for (int i = 0; i <= 24; ++i) {
    const std::optional<RigidMotion> m = between(still, at(i * pi / 12.0), last);
    ASSERT_TRUE(m) << i;
    expectMoves(still, at(i * pi / 12.0), *m);
    const glm::dquat meant = glm::angleAxis(i * pi / 12.0, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_NEAR(std::abs(glm::dot(m->rotation, meant)), 1.0, 1e-12) << i;
    last = *m;
  }
}

TEST(MotionBetween, IsNoneWhereABodyChanges) {
  const Shape still = body();
  EXPECT_FALSE(between(still, scale(still, 1.5)));
  EXPECT_FALSE(between(still, scale(still, -1.0))) << "mirrored";
  EXPECT_FALSE(between(sphere(1.0), sphere(1.0 + 1e-6)));
  EXPECT_FALSE(between(sphere(1.0), box({1.0, 1.0, 1.0})));
  EXPECT_FALSE(
      between(sphere(1.0).paint({.color = {1.0, 0.0, 0.0}}), sphere(1.0).paint({.color = {0.9, 0.0, 0.0}})));
  // One operand moves by itself.
  const auto pair = [](double x) {
    return unite(sphere(1.0), translate(box({0.1, 0.1, 0.1}), {x, 0.0, 0.0}));
  };
  EXPECT_FALSE(between(pair(1.0), pair(1.2)));
  // The body moves and its pattern stays.
  const auto passing = [](double x) {
    return translate(sphere(1.0), {x, 0.0, 0.0}).paint({.color = {sin(position().x)}});
  };
  EXPECT_FALSE(between(passing(0.0), passing(0.5)));
}

TEST(MotionBetween, TellsTurnsOfABodyThatIsPaintedByItsNormal) {
  // The normal is the scene's: as the body turns its colours change.
  const Shape painted = body().paint({.color = {normal().x * 0.5 + 0.5, 0.0, 0.0}});
  EXPECT_TRUE(between(painted, translate(painted, {1.0, 2.0, 3.0})));
  EXPECT_FALSE(between(painted, rotate(painted, {0.0, 0.5, 0.0})));
}

TEST(MotionBetween, IsOpenForWhatEndsNowhereUnlessItRests) {
  EXPECT_TRUE(between(plane({0.0, 1.0, 0.0}, 0.0), plane({0.0, 1.0, 0.0}, 0.0)));
  EXPECT_FALSE(between(plane({0.0, 1.0, 0.0}, 0.0), plane({0.0, 1.0, 0.0}, 0.5)));
}

TEST(HashWithoutMotion, IsThatOfABodyWhereverItIs) {
  const auto hash = [](const Shape& shape) { return hashWithoutMotion(graphs(shape)); };
  const Shape body = round(box({0.3, 0.5, 0.2}) | translate(sphere(0.2), {0.4, 0.1, 0.0}), 0.05);
  for (const glm::dvec3& turn : {glm::dvec3(0.0), glm::dvec3(90.0, 0.0, 0.0), glm::dvec3(10.0, -50.0, 33.0)})
    EXPECT_EQ(hash(translate(rotate(body, Vec3E(turn)), {turn.x, -3.0, 0.25})), hash(body)) << turn.y;
  EXPECT_NE(hash(body), hash(box({0.3, 0.5, 0.2})));
  EXPECT_NE(hash(body), hash(shell(body, 0.01)));
}

TEST(MotionBetween, HoldsForSceneFilesAtTwoTimes) {
  const std::string text =
      "return (box(0.4, 0.3, 0.2):round(0.05) | sphere(0.3):translate(0.5, 0.2, "
      "0)):paint(checkerboard({1, 0, 0}, {0, 0, 1}))"
      ":rotate(20, 90 * time, 10 * sin(time)):translate(time, 0.5 * time * time, 0)";
  const auto at = [&](double time) {
    return runScene(text, "test.lua", {.time = time, .fixed = true}).value().parts[0].shape;
  };
  for (const double time : {0.25, 1.0, 2.0, 17.3}) {
    const std::optional<RigidMotion> m = between(at(0.0), at(time));
    ASSERT_TRUE(m) << time;
    expectMoves(at(0.0), at(time), *m);
    EXPECT_NEAR(m->translation.x, time, 1e-12 * 17.3);
  }
}

}  // namespace motion_test
}  // namespace sdf
