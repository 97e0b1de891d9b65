// Hulls hold their solids, and no more than they must.
#include "sdf/march/hull.h"

#include <map>
#include <utility>

#include "march/scenes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/operators/place.h"

namespace sdf {
namespace hull_test {

using namespace test;

constexpr int kCells = 16;

Hull hullOf(const Shape& shape, int cells = kCells) {
  return *sdf::hullOf(*marchField(shape), shape.bounds, cells);
}

// Where a line enters (positive) or leaves the hull first at t >= 0 (Moller, Trumbore 1997).
struct Crossing {
  double t = HUGE_VAL;
  bool enters = false;
};
Crossing firstCrossing(const Hull& hull, const glm::dvec3& o, const glm::dvec3& d) {
  Crossing first;
  for (const glm::uvec3& triangle : hull.triangles) {
    const auto at = [&](int i) { return hull.origin + glm::dvec3(hull.corners[triangle[i]]); };
    const glm::dvec3 a = at(1) - at(0), b = at(2) - at(0), h = glm::cross(d, b), s = o - at(0);
    const double det = glm::dot(a, h), u = glm::dot(s, h) / det;
    const glm::dvec3 q = glm::cross(s, a);
    const double v = glm::dot(d, q) / det, t = glm::dot(b, q) / det;
    if (det == 0.0 || u < 0.0 || v < 0.0 || u + v > 1.0 || t < 0.0 || t >= first.t) continue;
    first = {t, det > 0.0};
  }
  return first;
}

TEST(Hull, IsEnteredByEveryRayBeforeTheSolid) {
  const unsigned seed = 1;
  const Rays rays = raysInward(500, 3.0, 8.0, seed);
  int hits = 0, missing = 0;
  for (const AnalyticScene& scene : analyticScenes(8.0)) {
    if (!scene.shape.bounds.finite()) continue;
    const Hull hull = hullOf(scene.shape);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      SCOPED_TRACE(std::string(scene.name) + ", seed " + std::to_string(seed) + ", " + describe(rays, i));
      const auto root = scene.firstRoot(rays.origin[i], rays.direction[i]);
      const Crossing crossing = firstCrossing(hull, rays.origin[i], rays.direction[i]);
      missing += crossing.t == HUGE_VAL;
      if (!root) continue;
      ++hits;
      ASSERT_LT(crossing.t, *root);
      ASSERT_TRUE(crossing.enters || scene.distance(rays.origin[i]) < 0.5);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(missing, 500);
}

TEST(Hull, IsClosedAndTurnedOutward) {
  const Shape shape = subtract(box(Vec3E(1.0)), sphere(1.2)) | translate(sphere(0.3), Vec3E(0.1, 1.5, 0.2));
  const Hull hull = hullOf(shape);
  std::map<std::pair<unsigned, unsigned>, int> edges;
  double volume = 0.0;
  for (const glm::uvec3& t : hull.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      --edges[{t[(i + 1) % 3], t[i]}];
    }
    const auto at = [&](int i) { return glm::dvec3(hull.corners[t[i]]); };
    volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  }
  for (const auto& [edge, count] : edges) ASSERT_EQ(count, 0) << edge.first << " to " << edge.second;
  EXPECT_GT(volume, 0.5);
  EXPECT_LT(volume, 8.0) << "the hollow is not held";
}

// A cube is held if its ball is not proven free: of a distance its corners are within two half diagonals.
TEST(Hull, KeepsCloseToTheSolid) {
  const Shape shape = rotate(box(Vec3E(1.0, 0.2, 0.5)), Vec3E(0.3, 0.5, 0.7));
  for (const int cells : {2, 16, 48}) {
    const Hull hull = hullOf(shape, cells);
    const double side = shape.bounds.longestSide() / cells;
    ScalarReading<double> reading;
    const auto field = marchField(shape);
    for (const glm::vec3& corner : hull.corners) {
      const glm::dvec3 p = hull.origin + glm::dvec3(corner);
      reading.run(*field->distance, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
      ASSERT_GT(reading.output(0), 0.0);
      ASSERT_LE(reading.output(0), 1.01 * std::sqrt(3.0) * side);
    }
  }
}

// A unit is a thousandth of the distance from the origin; and a film of no thickness is part of no solid, but
// as near as any.
TEST(Hull, HoldsWhatIsFarAwayThinOrSmall) {
  for (const double size : {1e-6, 1.0, 1e6})
    for (const double away : {0.0, 1000.0}) {
      const Shape plate = translate(box(Vec3E(size, 1e-5 * size, size)), Vec3E(away * size));
      const Hull hull = hullOf(plate);
      EXPECT_GT(hull.triangles.size(), 4u * kCells * kCells) << size << " at " << away;
      const glm::dvec3 above(away * size + 0.01 * size, away * size + size, away * size + 0.02 * size);
      const Crossing crossing = firstCrossing(hull, above, {0.0, -1.0, 0.0});
      EXPECT_TRUE(crossing.enters);
      EXPECT_GT(crossing.t, 0.5 * size);
      EXPECT_LT(crossing.t, size);
    }
}

TEST(Hull, OfNothingIsEmpty) {
  EXPECT_TRUE(
      hullOf(intersect({sphere(1.0), translate(sphere(1.0), Vec3E(5.0, 0.0, 0.0))})).triangles.empty());
  EXPECT_TRUE(sdf::hullOf(*marchField(sphere(1.0)), Box{}, kCells)->triangles.empty());
}

TEST(Hull, NeedsASlope) {
  const Expr x = position().x;
  const auto hull = sdf::hullOf(marchField(x * x * x, kInfinity), Box::centred(glm::dvec3(1.0)), kCells);
  ASSERT_FALSE(hull);
  EXPECT_EQ(hull.error().kind, ErrorKind::Scene);
  EXPECT_EQ(hull.error().message.substr(0, 7), "a hull:");
}

}  // namespace hull_test
}  // namespace sdf
