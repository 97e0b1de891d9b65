// Every method against rays whose first hit is known.
#include <numbers>

#include "march/scenes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/oracle.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"

namespace sdf {
namespace methods_test {

using namespace test;

constexpr double kReach = 8.0;
constexpr int kManySteps = 100000;

MarchOptions with(MarchMethod method, double epsilon = 1e-4) {
  MarchOptions options;
  options.method = method;
  options.epsilon = epsilon;
  options.maxSteps = kManySteps;
  return options;
}

class EveryMethod : public testing::TestWithParam<MarchMethod> {};
INSTANTIATE_TEST_SUITE_P(March, EveryMethod, testing::ValuesIn(kMethods), [](const auto& method) {
  std::string text = name(method.param);
  std::erase(text, '-');
  return text;
});

TEST_P(EveryMethod, HitsEveryRootAndNothingElse) {
  const unsigned seed = 1;
  const MarchOptions options = with(GetParam());
  const Rays rays = raysInward(2000, 3.0, kReach, seed);
  const double slack = floatSlack(kReach);
  for (const AnalyticScene& scene : analyticScenes(kReach)) {
    const Hits hits = trace(scene.shape, rays, options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      SCOPED_TRACE(std::string(scene.name) + ", seed " + std::to_string(seed) + ", " + describe(rays, i));
      std::optional<double> root = scene.firstRoot(rays.origin[i], rays.direction[i]);
      if (root && *root > kReach) root.reset();
      if (root) {
        ASSERT_EQ(hits.status[i], RayStatus::Hit);
        ASSERT_LE(hits.t[i], *root + slack);
      }
      if (hits.status[i] == RayStatus::Hit)
        ASSERT_LE(std::abs(scene.distance(rays.at(i, hits.t[i]))), options.epsilon + slack);
      else
        ASSERT_EQ(hits.status[i], RayStatus::Miss);
    }
  }
}

// Shapes whose distance is only a bound, or a field that is steeper than 1.
std::vector<std::pair<const char*, Shape>> boundedShapes() {
  const Vec3E p = position();
  const Expr waves = length(p) - 1.0 + 0.1 * sin(20.0 * p.x) * sin(20.0 * p.y) * sin(20.0 * p.z);
  return {
      {"smooth union",
       unite(box(Vec3E(0.6)), translate(sphere(0.6), Vec3E(0.7, 0.3, 0.0)), Blend::quadratic(0.3))},
      {"twist", twist(box(Vec3E(0.5, 0.9, 0.5)), 3.0)},
      {"bend", bend(box(Vec3E(1.0, 0.2, 0.3)), 1.0)},
      {"gyroid", gyroid(1.0, 0.1) & sphere(1.2)},
      {"carved", box(Vec3E(0.9)) - sphere(1.1)},
      {"ellipsoid bound", ellipsoidBound(Vec3E(1.0, 0.3, 0.6))},
      {"waves as a field", field(waves, Box::centred(glm::dvec3(1.2)), 1.0 + 0.1 * 20.0 * std::sqrt(3.0))}};
}

TEST(Methods, HitNoLaterThanTheDenseMarch) {
  const unsigned seed = 2;
  const double epsilon = 1e-3;
  const Rays rays = raysInward(64, 2.5, 5.0, seed);
  for (const auto& [shapeName, shape] : boundedShapes()) {
    ASSERT_TRUE(shape.ok()) << *shape.error;
    const MarchField field = marchField(shape).value();
    std::vector<std::optional<RootBracket>> roots;
    for (std::size_t i = 0; i < rays.size(); ++i) roots.push_back(marchDensely(field, rays, i, epsilon));
    for (const MarchMethod method : kMethods) {
      const Hits hits = trace(field, rays, with(method, epsilon));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        SCOPED_TRACE(std::string(shapeName) + ", " + name(method) + ", seed " + std::to_string(seed) + ", " +
                     describe(rays, i));
        ASSERT_TRUE(hits.status[i] == RayStatus::Hit || (!roots[i] && hits.status[i] == RayStatus::Miss));
        if (hits.status[i] != RayStatus::Hit) continue;
        ASSERT_LE(hits.t[i], roots[i] ? roots[i]->after + floatSlack(5.0) : kInfinity);
        const double g = evaluateAll(*field.distance, rays.at(i, hits.t[i]))[1];
        ASSERT_LE(std::abs(g), epsilon + floatSlack(5.0));
      }
    }
  }
}

// Where the ray falls at kSteep to the surface or faster, two points within epsilon of it are epsilon /
// kSteep apart.
TEST_P(EveryMethod, AgreesWithPlainTracingOnSteepHits) {
  constexpr double kSteep = 0.5;
  const Rays rays = raysInward(1000, 3.0, kReach, 3);
  const MarchOptions options = with(GetParam());
  for (const AnalyticScene& scene : analyticScenes(kReach)) {
    const Hits plain = trace(scene.shape, rays, with(MarchMethod::Plain)),
               hits = trace(scene.shape, rays, options);
    const Tape tape(scene.shape.distance);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (plain.status[i] != RayStatus::Hit) continue;
      const glm::dvec3 normal = evaluateGradient(tape, rays.at(i, plain.t[i])).gradient;
      if (glm::dot(normal, rays.direction[i]) > -kSteep) continue;
      ASSERT_NEAR(hits.t[i], plain.t[i], options.epsilon / kSteep + 2.0 * floatSlack(kReach) / kSteep)
          << scene.name << ", " << describe(rays, i);
    }
  }
}

TEST_P(EveryMethod, FindsAPlateThinnerThanEpsilon) {
  const Shape plate = box(Vec3E(1.0, 1e-6, 1.0));
  Rays rays;
  for (int i = 0; i < 100; ++i)
    rays.add({0.0, 1.0 + 0.0137 * i, 0.0}, glm::normalize(glm::dvec3(0.2, -1.0, 0.1)), 0.0, 10.0);
  const Hits hits = trace(plate, rays, with(GetParam()));
  for (std::size_t i = 0; i < rays.size(); ++i)
    ASSERT_EQ(hits.status[i], RayStatus::Hit) << describe(rays, i);
}

// Half way along, the ray is at the height of two corners of the polygon, where its sign flips twice.
TEST_P(EveryMethod, PassesBesideAPolygonsCorners) {
  const std::vector<glm::dvec2> arrow{{0, 0}, {1, 0}, {0.4, 0.4}, {0, 1}};
  Rays rays;
  const glm::dvec3 from(-0.3, -0.7, 0.0), along = glm::normalize(glm::dvec3(-0.1, 1.0, 0.0));
  rays.add(from, along, 0.0, -2.0 * from.y / along.y);
  EXPECT_EQ(trace(extrude(polygon(arrow), 1.0), rays, with(GetParam())).status[0], RayStatus::Miss);
}

// Straight down, the balls of a step that went too deep just touch if the depth's sign is overlooked.
TEST_P(EveryMethod, DoesNotPassAPlaneHeadOn) {
  Rays rays;
  for (int height = 1; height <= 8; ++height) rays.add({0, height, 0}, {0, -1, 0}, 0.0, 20.0);
  const Hits hits = trace(plane(Vec3E(0, 1, 0), 0.0), rays, with(GetParam()));
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_LE(hits.t[i], rays.origin.y[i]) << describe(rays, i);
}

TEST_P(EveryMethod, HitsAtOnceFromWithin) {
  Rays rays;
  rays.add({0.1, 0.2, 0.3}, {0, 0, 1}, 0.25, 5.0);
  const Hits hits = trace(sphere(1.0), rays, with(GetParam()));
  EXPECT_EQ(hits.status[0], RayStatus::Hit);
  EXPECT_EQ(hits.t[0], 0.25);
}

TEST_P(EveryMethod, TakesAnEmptyBatchAndAnEmptyRange) {
  EXPECT_TRUE(trace(sphere(1.0), Rays{}, with(GetParam())).t.empty());
  Rays rays;
  rays.add({0, 0, 3}, {0, 0, -1}, 1.0, 1.0);
  EXPECT_EQ(trace(sphere(1.0), rays, with(GetParam())).status[0], RayStatus::Miss);
}

TEST_P(EveryMethod, SaysWhenItsStepsRunOut) {
  Rays rays;
  const double angle = std::numbers::pi / 180.0;
  rays.add({0, 1, 0}, {std::cos(angle), -std::sin(angle), 0}, 0.0, 100.0);
  MarchOptions options = with(GetParam());
  options.maxSteps = 2;
  const Hits hits = trace(plane(Vec3E(0, 1, 0), 0.0), rays, options);
  EXPECT_EQ(hits.status[0], RayStatus::Budget);
  EXPECT_EQ(hits.steps[0], 2);
  EXPECT_LT(hits.t[0], 1.0 / std::sin(angle));
}

TEST_P(EveryMethod, EndsAsWithoutALimitOrSaysThatItWasTooLow) {
  const Rays rays = raysInward(50, 3.0, kReach, 9);
  const Shape shape = torus(1.0, 0.3);
  const Hits free = trace(shape, rays, with(GetParam()));
  MarchOptions options = with(GetParam());
  const int more = marchesBalls(GetParam()) ? 0 : 2;
  for (options.maxSteps = 1; options.maxSteps < 60; ++options.maxSteps) {
    const Hits hits = trace(shape, rays, options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      SCOPED_TRACE(describe(rays, i) + " within " + std::to_string(options.maxSteps));
      ASSERT_LE(hits.steps[i], options.maxSteps + more);
      ASSERT_LE(hits.t[i], free.t[i]);
      if (hits.status[i] == RayStatus::Budget) continue;
      ASSERT_EQ(hits.status[i], free.status[i]);
      ASSERT_EQ(hits.t[i], free.t[i]);
    }
  }
}

TEST_P(EveryMethod, SaysWhereTheDistanceIsNotANumber) {
  const MarchField field = marchField(sqrt(position().x), 1.0);
  Rays rays;
  rays.add({-1, 0, 0}, {0, 1, 0}, 0.5, 5.0);
  const Hits hits = trace(field, rays, with(GetParam()));
  EXPECT_EQ(hits.status[0], RayStatus::Undefined);
  EXPECT_EQ(hits.t[0], 0.5);
}

// At t = 1e5 a float t moves by 0.008 at a time.
TEST_P(EveryMethod, ReachesASphereFromFarAway) {
  const MarchOptions options = with(GetParam());
  Rays rays;
  for (int i = 0; i < 10; ++i) {
    const glm::dvec3 from(1e5, 2e4 * i, -3e4);
    rays.add(from, glm::normalize(glm::dvec3(0.05 * i, 0.3, 0.1) - from), 0.0, 1e6);
  }
  const Hits hits = trace(sphere(1.0), rays, options);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(hits.status[i], RayStatus::Hit) << describe(rays, i);
    EXPECT_LE(std::abs(glm::length(rays.at(i, hits.t[i])) - 1.0), options.epsilon + floatSlack(1.0));
    EXPECT_LE(hits.steps[i], 200);  // halving 1e6 down to 1e-4 takes 34, and a reading either side of each
  }
}

// The float coordinates of the sphere's points are 0.008 apart.
TEST_P(EveryMethod, ReachesASphereThatIsFarFromTheOrigin) {
  const MarchOptions options = with(GetParam());
  const glm::dvec3 centre(1e5, -1e5, 3e4);
  Rays rays = raysInward(200, 3.0, kReach, 4);
  for (std::size_t i = 0; i < rays.size(); ++i)
    rays.origin.x[i] += centre.x, rays.origin.y[i] += centre.y, rays.origin.z[i] += centre.z;
  const Hits hits = trace(translate(sphere(1.0), Vec3E(centre)), rays, options);
  const double rounding = 1e5 * 0x1p-50;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto root = smallerRoot(glm::dot(rays.origin[i] - centre, rays.direction[i]),
                                  glm::dot(rays.origin[i] - centre, rays.origin[i] - centre) - 1.0);
    ASSERT_TRUE(!root || hits.status[i] == RayStatus::Hit) << describe(rays, i);
    if (hits.status[i] != RayStatus::Hit) continue;
    ASSERT_LE(std::abs(glm::length(rays.at(i, hits.t[i]) - centre) - 1.0), options.epsilon + rounding)
        << describe(rays, i);
  }
}

// The error of each secant step is about the product of the two before it, here at most 2 epsilon and epsilon
// / 0.5.
TEST_P(EveryMethod, ComesOntoTheSurfaceBySecants) {
  MarchOptions options = with(GetParam());
  options.refinements = 4;
  const double error = 8.0 * std::pow(options.epsilon, 3);
  const Rays rays = raysInward(500, 3.0, kReach, 5);
  const Hits hits = trace(sphere(1.0), rays, options);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto root = smallerRoot(glm::dot(rays.origin[i], rays.direction[i]), 8.0);
    if (!root || glm::dot(rays.at(i, *root), rays.direction[i]) > -0.5) continue;
    ASSERT_NEAR(hits.t[i], *root, error) << describe(rays, i);
  }
}

TEST_P(EveryMethod, StopsWhereAPixelCoversTheDistance) {
  MarchOptions options = with(GetParam());
  options.footprint = 0.01;
  const Rays rays = raysInward(500, 3.0, kReach, 6);
  const Hits fine = trace(sphere(1.0), rays, with(GetParam())), coarse = trace(sphere(1.0), rays, options);
  long fineSteps = 0, coarseSteps = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    fineSteps += fine.steps[i], coarseSteps += coarse.steps[i];
    ASSERT_TRUE(fine.status[i] != RayStatus::Hit || coarse.status[i] == RayStatus::Hit) << describe(rays, i);
    if (coarse.status[i] != RayStatus::Hit) continue;
    ASSERT_LE(glm::length(rays.at(i, coarse.t[i])) - 1.0,
              options.epsilon + options.footprint * coarse.t[i] + floatSlack(kReach));
  }
  EXPECT_LT(coarseSteps, fineSteps);
}

TEST_P(EveryMethod, GivesARayTheSameHitInAnyCompany) {
  const Rays rays = raysInward(1300, 3.0, kReach, 7);
  const Shape shape = torus(1.0, 0.3);
  const Hits together = trace(shape, rays, with(GetParam()));
  for (const std::size_t i : {std::size_t{0}, std::size_t{511}, std::size_t{512}, std::size_t{1299}}) {
    Rays one;
    one.add(rays.origin[i], rays.direction[i], rays.tMin[i], rays.tMax[i]);
    const Hits alone = trace(shape, one, with(GetParam()));
    EXPECT_EQ(alone.t[0], together.t[i]);
    EXPECT_EQ(alone.steps[0], together.steps[i]);
    EXPECT_EQ(alone.status[0], together.status[i]);
  }
}

// y^2 - 1e-12 has no bounded slope, and |y| <= 1e-6 is thinner than any step.
TEST(SegmentsAndBisection, NeedNoLipschitzConstant) {
  const Expr y = position().y;
  const Shape sheet = field(y * y - 1e-12);
  Rays rays;
  for (int i = 0; i < 50; ++i)
    rays.add({0.0, 1.0 + 0.1 * i, 0.0}, glm::normalize(glm::dvec3(0.1 * i, -1.0, 0.3)), 0.0, 40.0);
  for (const MarchMethod method : {MarchMethod::Segment, MarchMethod::Bisection}) {
    const Hits hits = trace(sheet, rays, with(method));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(hits.status[i], RayStatus::Hit) << name(method) << ", " << describe(rays, i);
      const double height = rays.at(i, hits.t[i]).y;
      ASSERT_LE(height * height - 1e-12, 1e-4) << name(method);
      ASSERT_GE(height, -1e-6) << name(method);
    }
  }
}

TEST(SegmentsAndBisection, StopAtAJump) {
  const Expr step = 1.0 - 2.0 * less(position().x, Expr(0.0));  // 1, then -1 for x < 0
  Rays rays;
  rays.add({0.5, 0, 0}, {-1, 0, 0}, 0.0, 1.0);
  for (const MarchMethod method : {MarchMethod::Segment, MarchMethod::Bisection}) {
    const MarchOptions options = with(method);
    const Hits hits = trace(field(step), rays, options);
    EXPECT_EQ(hits.status[0], RayStatus::Hit) << name(method);
    EXPECT_NEAR(hits.t[0], 0.5, options.epsilon) << name(method);
  }
}

struct GrazingSteps {
  MarchMethod method;
  int least, most;
};

// One degree above a plane, from height 1 down to 1e-4. Each plain step leaves 1 - sin 1° of the height: ln
// 1e4 / -ln(1 - sin 1°) = 523.1, so 524 steps and the first reading. Balls that must overlap cannot do better
// than half as many. The plane's slope along the ray is a number that intervals know at once.
TEST(StepCounts, OfTheMethodsAtOneDegree) {
  const double angle = std::numbers::pi / 180.0;
  const int plain = static_cast<int>(std::ceil(std::log(1e-4) / std::log(1.0 - std::sin(angle)))) + 1;
  Rays rays;
  rays.add({0, 1, 0}, {std::cos(angle), -std::sin(angle), 0}, 0.0, 100.0);
  const GrazingSteps expected[] = {{MarchMethod::Plain, plain - 1, plain + 1},
                                   {MarchMethod::OverRelaxed, plain / 2, static_cast<int>(plain / 1.6) + 1},
                                   {MarchMethod::Accelerated, plain / 2, static_cast<int>(plain / 1.8)},
                                   {MarchMethod::AutoRelaxed, plain / 2, static_cast<int>(plain / 1.8)},
                                   {MarchMethod::Segment, 1, 8},
                                   {MarchMethod::Bisection, 1, 2 * 20 + 8}};  // halving 100 down to 1e-4
  for (const GrazingSteps& e : expected) {
    const Hits hits = trace(plane(Vec3E(0, 1, 0), 0.0), rays, with(e.method));
    std::printf("1 degree: %-13s %4d steps\n", name(e.method), hits.steps[0]);
    EXPECT_EQ(hits.status[0], RayStatus::Hit);
    EXPECT_GE(hits.steps[0], e.least) << name(e.method);
    EXPECT_LE(hits.steps[0], e.most) << name(e.method);
  }
}

TEST(StepCounts, AreRecordedForEverySceneAndMethod) {
  const Rays rays = raysInward(2000, 3.0, kReach, 8);
  std::printf("%-13s", "mean steps");
  for (const MarchMethod method : kMethods) std::printf("%14s", name(method));
  for (const AnalyticScene& scene : analyticScenes(kReach)) {
    std::printf("\n%-13s", scene.name);
    std::vector<double> mean;
    for (const MarchMethod method : kMethods) {
      const Hits hits = trace(scene.shape, rays, with(method));
      double sum = 0.0;
      for (const int steps : hits.steps) sum += steps;
      mean.push_back(sum / static_cast<double>(rays.size()));
      std::printf("%14.2f", mean.back());
    }
    EXPECT_LT(mean[static_cast<int>(MarchMethod::Accelerated)], mean[0]) << scene.name;
    EXPECT_LT(mean[static_cast<int>(MarchMethod::AutoRelaxed)], mean[0]) << scene.name;
  }
  std::printf("\n");
}

// 1e-3 above a plane for a length of 10: 1e4 plain steps, while a segment's slopes show at once that nothing
// comes.
TEST(StepCounts, OfSegmentsAlongAPlaneDoNotGrow) {
  Rays rays;
  rays.add({0, 1e-3, 0}, {1, 0, 0}, 0.0, 10.0);
  const Shape ground = plane(Vec3E(0, 1, 0), 0.0);
  EXPECT_GE(trace(ground, rays, with(MarchMethod::Plain)).steps[0], 9990);  // 1e4 but for float's rounding
  EXPECT_LE(trace(ground, rays, with(MarchMethod::Segment)).steps[0], 4);
}

}  // namespace methods_test
}  // namespace sdf
