// Normals by differences and by derivatives, and their errors over step and distance from the origin.
#include "sdf/march/normals.h"

#include <numbers>

#include "march/scenes.h"
#include "sdf/shape/operators/place.h"

namespace sdf {
namespace normals_test {

constexpr NormalMethod kMethods[] = {NormalMethod::Forward, NormalMethod::Central, NormalMethod::Tetrahedron,
                                     NormalMethod::Gradient};
const char* name(NormalMethod m) {
  const char* names[] = {"forward", "central", "tetrahedron", "gradient"};
  return names[static_cast<int>(m)];
}

constexpr double kFloatRounding = 0x1p-24;

struct Ball {
  Vectors points, outward, nothing;
  MarchField field;

  explicit Ball(double distance, int count = 500, unsigned seed = 1) {
    const glm::dvec3 centre(distance, 0.0, 0.0);
    field = marchField(translate(sphere(1.0), Vec3E(centre))).value();
    std::mt19937 random(seed);
    std::normal_distribution<> normal;
    for (int i = 0; i < count; ++i) {
      outward.add(glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)}));
      points.add(centre + outward[i]);
      nothing.add(glm::dvec3(0.0));
    }
  }

  // Largest angle in radians between the normals and the true ones, of those that were found.
  double worstAngle(const NormalOptions& options) const {
    const Vectors found = normals(field, points, nothing, options).value();
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i] != glm::dvec3(0.0))
        worst = std::max(worst, 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(found[i] - outward[i]))));
    return worst;
  }
};

// Error of each formula on the unit sphere, whose second derivatives are at most 1 (1/2 off the diagonal, so
// that the three of them are at most 1 / sqrt 3 long) and third ones along an axis at most 3 (1 - n^2) n
// <= 1.155.
double formulaError(NormalMethod method, double h) {
  switch (method) {
    case NormalMethod::Forward:
      return std::sqrt(3.0) * h / 2.0;
    case NormalMethod::Central:
      return std::sqrt(3.0) * 1.155 * h * h / 6.0;
    case NormalMethod::Tetrahedron:
      return h / std::sqrt(3.0);
    default:
      return 0.0;
  }
}

// Eight roundings of coordinates of this size, divided by the step; and the point itself moved by rounding.
double roundingError(NormalMethod method, double size, double h) {
  const double moved = std::sqrt(3.0) * kFloatRounding * size;
  return moved + 8.0 * kFloatRounding * (method == NormalMethod::Gradient ? 1.0 : size / h);
}

TEST(Normals, FollowTheirErrorCurves) {
  for (const double distance : {0.0, 100.0, 1e4, 1e5}) {
    const Ball ball(distance);
    for (const NormalMethod method : kMethods) {
      std::printf("at %6g %-11s degrees by log2 h:", distance, name(method));
      for (int exponent = -20; exponent <= -1; ++exponent) {
        const double h = std::ldexp(1.0, exponent);
        const double angle = ball.worstAngle({method, h});
        if (exponent % 3 == 0) std::printf(" %d: %.2g", exponent, angle * 180.0 / std::numbers::pi);
        const double error = formulaError(method, h) + roundingError(method, distance + 1.0, h);
        ASSERT_LE(angle, error < 1.0 ? std::asin(error) : std::numbers::pi)
            << name(method) << ", h " << h << ", at " << distance;
      }
      std::printf("\n");
    }
  }
}

TEST(Normals, AreBestAtTheDocumentedStep) {
  const Ball ball(0.0);
  for (const NormalMethod method :
       {NormalMethod::Forward, NormalMethod::Central, NormalMethod::Tetrahedron}) {
    double best = HUGE_VAL;
    for (int exponent = -20; exponent <= -1; ++exponent)
      best = std::min(best, ball.worstAngle({method, std::ldexp(1.0, exponent)}));
    const double atDocumented = ball.worstAngle({method, bestNormalStep(method, 1.0)});
    EXPECT_LE(atDocumented, 2.0 * best)
        << name(method);  // a factor 2 in h costs at most 2 (4) on either side
  }
}

// A step below what float resolves there gives a difference that is all rounding; ours says so.
TEST(Normals, OfDifferencesLostInRoundingAreTheGivenOnes) {
  const Ball ball(1e5);
  Vectors up;
  for (std::size_t i = 0; i < ball.points.size(); ++i) up.add({0, 1, 0});
  const Vectors found = normals(ball.field, ball.points, up, {NormalMethod::Central, 0x1p-10}).value();
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], up[i]);
}

TEST(Normals, AreUnitVectorsWhereTheGradientIsNot) {
  const std::pair<Shape, glm::dvec3> cases[] = {{sphere(1.0), {0, 0, 0}},
                                                {cone(1.0, 1.0), {0, 1, 0}},
                                                {cone(1.0, 1.0), {0, 0.5, 0}},
                                                {box(Vec3E(1.0)), {1, 1, 1}},
                                                {box(Vec3E(1.0)), {0, 0, 0}},
                                                {box(Vec3E(1.0)), {1, 1, 0}},
                                                {torus(1.0, 0.3), {0, 0, 0}},
                                                {torus(1.0, 0.3), {1, 0, 0}},
                                                {octahedron(1.0), {0, 1, 0}},
                                                {cylinder(1.0, 1.0), {0, 0, 0}},
                                                {capsule(Vec3E(0, 0, 0), Vec3E(0, 1, 0), 0.2), {0, 0.5, 0}}};
  Vectors otherwise;
  otherwise.add({0, 0, 1});
  for (const auto& [shape, point] : cases)
    for (const NormalMethod method : kMethods) {
      Vectors at;
      at.add(point);
      const glm::dvec3 n = normals(marchField(shape).value(), at, otherwise, {method, 0x1p-8}).value()[0];
      EXPECT_NEAR(glm::length(n), 1.0, 4.0 * 0x1p-53)
          << name(method) << " at " << point.x << ' ' << point.y << ' ' << point.z;
    }
}

TEST(Normals, AreTheGivenOnesWhereTheGradientVanishesOrIsNotANumber) {
  Vectors points, otherwise;
  points.add({0, 0, 0});
  points.add({std::nan(""), 0, 0});
  otherwise.add({0, 0, 1});
  otherwise.add({1, 0, 0});
  for (const NormalMethod method : {NormalMethod::Central, NormalMethod::Gradient}) {
    const Vectors found =
        normals(marchField(sphere(1.0)).value(), points, otherwise, {method, 0x1p-8}).value();
    EXPECT_EQ(found[0], otherwise[0]) << name(method);
    EXPECT_EQ(found[1], otherwise[1]) << name(method);
  }
}

TEST(Normals, RefuseWrongStepsAndRows) {
  const MarchField field = marchField(sphere(1.0)).value();
  Vectors one;
  one.add({1, 0, 0});
  for (const double step : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(normals(field, one, one, {NormalMethod::Central, step}).error().message,
              "normals: step must be positive and finite");
  EXPECT_EQ(normals(field, one, Vectors{}, {}).error().message,
            "normals: the rows of points and of otherwise differ in length");
}

}  // namespace normals_test
}  // namespace sdf
