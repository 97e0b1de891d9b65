// The camera follows the hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "viewer/app/orbit.h"

namespace sdf::viewer {
namespace orbit_test {

// What a few dozen operations on numbers of a few units can lose, in double.
constexpr double kRounding = 256 * std::numeric_limits<double>::epsilon();

const Eye kEye{{2.0, 1.5, 6.0}, {0.5, 0.2, -0.3}, {0.0, 1.0, 0.0}, 40.0, false};

Eye mirrored(Eye eye) {
  eye.mirrored = true;
  return eye;
}

/// Where the eye sees a point: right and up of the picture's middle, in picture heights.
glm::dvec2 seen(const Eye& eye, const glm::dvec3& p) {
  const glm::dvec3 forward = glm::normalize(eye.to - eye.from), way = p - eye.from;
  const glm::dvec3 right = glm::normalize(glm::cross(forward, eye.up)), up = glm::cross(right, forward);
  const double height = 2.0 * std::tan(0.5 * glm::radians(eye.fov)) * glm::dot(way, forward);
  return {(eye.mirrored ? -1.0 : 1.0) * glm::dot(way, right) / height, glm::dot(way, up) / height};
}

double distance(const Eye& eye) { return glm::length(eye.to - eye.from); }

/// A point a little before what the eye looks at: on the near side of what turns.
glm::dvec3 nearSide(const Eye& eye) { return eye.to + 0.1 * (eye.from - eye.to); }

TEST(OrbitTest, TheNearSideFollowsTheDrag) {
  for (const Eye& eye : {kEye, mirrored(kEye)}) {
    const glm::dvec3 p = nearSide(eye);
    EXPECT_GT(seen(orbited(eye, {0.05, 0.0}), p).x, 0.0) << "mirrored: " << eye.mirrored;
    EXPECT_LT(seen(orbited(eye, {-0.05, 0.0}), p).x, 0.0) << "mirrored: " << eye.mirrored;
    EXPECT_GT(seen(orbited(eye, {0.0, 0.05}), p).y, 0.0) << "mirrored: " << eye.mirrored;
    EXPECT_LT(seen(orbited(eye, {0.0, -0.05}), p).y, 0.0) << "mirrored: " << eye.mirrored;
  }
}

TEST(OrbitTest, KeepsTheDistanceAndWhatItLooksAt) {
  const Eye eye = orbited(kEye, {0.3, -0.2});
  EXPECT_EQ(eye.to, kEye.to);
  EXPECT_NEAR(distance(eye), distance(kEye), kRounding * distance(kEye));
}

TEST(OrbitTest, TwoPictureHeightsAreAWholeTurn) {
  const Eye eye = orbited(kEye, {2.0, 0.0});
  EXPECT_LT(glm::length(eye.from - kEye.from), kRounding * distance(kEye));
}

TEST(OrbitTest, NeverPassesTheZenithOrTheNadir) {
  for (const double drag : {5.0, -5.0}) {
    const Eye eye = orbited(kEye, {0.0, drag});
    const glm::dvec3 sideways = eye.from - eye.to;
    EXPECT_GT(glm::length(glm::dvec2(sideways.x, sideways.z)), 0.0);
    // Seen from there, the horizontal direction of the eye is where it was.
    const glm::dvec3 before = kEye.from - kEye.to;
    EXPECT_GT(sideways.x * before.x + sideways.z * before.z, 0.0);
    const Eye back = orbited(eye, {0.0, -drag / 50.0});
    EXPECT_LT(std::abs(glm::normalize(back.from - back.to).y), std::abs(glm::normalize(sideways).y));
  }
}

TEST(OrbitTest, TurningPointsWhereTheDragGoesAndStaysInPlace) {
  for (const Eye& eye : {kEye, mirrored(kEye)}) {
    const Eye after = turned(eye, {0.1, 0.1});
    EXPECT_EQ(after.from, eye.from);
    EXPECT_LT(seen(after, eye.to).x, 0.0) << "mirrored: " << eye.mirrored;
    EXPECT_LT(seen(after, eye.to).y, 0.0);
  }
}

TEST(OrbitTest, PanningKeepsWhatItLooksAtUnderThePointer) {
  for (const Eye& eye : {kEye, mirrored(kEye)}) {
    const glm::dvec2 drag(0.3, -0.15), place = seen(panned(eye, drag), eye.to);
    EXPECT_NEAR(place.x, drag.x, kRounding) << "mirrored: " << eye.mirrored;
    EXPECT_NEAR(place.y, drag.y, kRounding);
  }
}

TEST(OrbitTest, ADollyGoesATenthOfTheWayAndNeverArrives) {
  EXPECT_NEAR(distance(dollied(kEye, 1.0)), 0.9 * distance(kEye), kRounding * distance(kEye));
  EXPECT_NEAR(distance(dollied(dollied(kEye, 3.0), -3.0)), distance(kEye), kRounding * distance(kEye));
  EXPECT_GT(distance(dollied(kEye, 1e4)), 0.0);
  EXPECT_TRUE(std::isfinite(distance(dollied(kEye, -1e4))));
}

TEST(OrbitTest, FlyingGoesAlongThePicturesAxes) {
  for (const Eye& eye : {kEye, mirrored(kEye)}) {
    const Eye ahead = flown(eye, {0.0, 0.0, 0.5});
    EXPECT_LT(glm::length(ahead.from - 0.5 * (eye.from + eye.to)), kRounding * distance(eye));
    EXPECT_NEAR(distance(ahead), distance(eye), kRounding * distance(eye));
    EXPECT_LT(seen(flown(eye, {0.1, 0.0, 0.0}), eye.to).x, 0.0) << "mirrored: " << eye.mirrored;
    EXPECT_LT(seen(flown(eye, {0.0, 0.1, 0.0}), eye.to).y, 0.0);
  }
}

TEST(OrbitTest, ViewKeysLookAlongTheAxes) {
  const auto from = [](const glm::dvec3& up, Side side) {
    Eye eye = kEye;
    eye.up = up;
    const Eye after = seenFrom(eye, side);
    EXPECT_NEAR(distance(after), distance(eye), kRounding * distance(eye));
    return glm::normalize(after.from - after.to);
  };
  const glm::dvec3 y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  const auto along = [](const glm::dvec3& direction, const glm::dvec3& axis) {
    // Top and bottom are 1e-4 off the axis, so that the horizon is known.
    return glm::length(direction - axis) <= 1.0001e-4;
  };
  EXPECT_TRUE(along(from(y, Side::Front), {0, 0, 1}));
  EXPECT_TRUE(along(from(y, Side::Back), {0, 0, -1}));
  EXPECT_TRUE(along(from(y, Side::Left), {-1, 0, 0}));
  EXPECT_TRUE(along(from(y, Side::Right), {1, 0, 0}));
  EXPECT_TRUE(along(from(y, Side::Top), y));
  EXPECT_TRUE(along(from(y, Side::Bottom), -y));
  EXPECT_TRUE(along(from(z, Side::Front), {0, -1, 0}));
  EXPECT_TRUE(along(from(z, Side::Right), {1, 0, 0}));
  EXPECT_TRUE(along(from(z, Side::Top), z));
  EXPECT_TRUE(along(from({1, 0, 0}, Side::Top), {1, 0, 0}));
}

TEST(OrbitTest, FromTheTopTheFrontIsBelow) {
  const Eye eye = seenFrom(kEye, Side::Top);
  EXPECT_LT(seen(eye, eye.to + glm::dvec3(0.0, 0.0, 1.0)).y, 0.0);
  EXPECT_GT(seen(eye, eye.to + glm::dvec3(1.0, 0.0, 0.0)).x, 0.0);
}

}  // namespace orbit_test
}  // namespace sdf::viewer
