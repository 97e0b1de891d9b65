#include "sdf/mesh/creases/tips.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

#include "mesh/scenes.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/solids/flats.h"

namespace sdf::test {
namespace tips_test {

// Turned and moved at random, with the points of interest.
struct Placed {
  Shape shape;
  std::vector<glm::dvec3> points;

  Placed(const Shape& s, std::vector<glm::dvec3> at, unsigned seed) : points(std::move(at)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> angle(0.0, 2.0 * std::numbers::pi), place(-0.5, 0.5);
    const glm::dvec3 axis = glm::normalize(glm::dvec3{place(random), place(random), place(random)});
    const glm::dvec3 offset{place(random), place(random), place(random)};
    const double turn = angle(random);
    shape = translate(rotateAbout(s, axis, turn), offset);
    for (glm::dvec3& p : points) p = offset + glm::angleAxis(turn, axis) * p;
  }
};

TEST(Tips, AreVerticesAtAnyTurnOfTheShape) {
  // A lens turned about its own chord has curved sides: its tips are at 0.8, of 53 degrees.
  const Shape lemon = revolve(translate(circle(1.0), {-0.6, 0.0, 0.0}));
  const std::pair<Shape, std::vector<glm::dvec3>> shapes[] = {
      {cone(0.1, 0.8), {{0.0, 0.8, 0.0}}},
      {cone(0.3, 0.8), {{0.0, 0.8, 0.0}}},
      {cone(0.5, 0.8), {{0.0, 0.8, 0.0}}},
      {cone(1.2, 0.6), {{0.0, 0.6, 0.0}}},
      {lemon, {{0.0, 0.8, 0.0}, {0.0, -0.8, 0.0}}},
      {cone(0.5, 0.8) | translate(box({1.0, 0.3, 1.0}), {0.0, -0.8, 0.0}), {{0.0, 0.8, 0.0}}},
  };
  unsigned seed = 0;
  for (const auto& [shape, points] : shapes)
    for (const double voxel : {0.03, 0.05, 0.08}) {
      SCOPED_TRACE(testing::Message() << "seed " << ++seed << ", voxel size " << voxel);
      const Placed placed(shape, points, seed);
      const MeshedShape m = meshed(placed.shape, voxel);
      for (const glm::dvec3& p : placed.points) EXPECT_LE(nearestVertex(m.mesh.positions, p), 1e-5);
    }
}

TEST(Tips, AreNotSeenWhereThereAreNone) {
  // A small ball, and a cone that is rounded by about a voxel: all is as near as the curvature lets it be.
  for (const Shape& shape : {sphere(0.1), roundCone(0.4, 0.06, 0.5)}) {
    const double voxel = 0.05;
    const MeshedShape m = meshed(shape, voxel);
    EXPECT_LE(m.stats.maxDistance, 0.25 * voxel);
  }
}

}  // namespace tips_test
}  // namespace sdf::test
