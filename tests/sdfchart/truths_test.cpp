// What rays, light and known failures are held to, held to geometry in its turn.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "sdfchart/measure/measurements.h"
#include "sdfchart/peers/cone_starts.h"
#include "sdfchart/peers/drawn_rays.h"
#include "sdfchart/peers/shader_reading.h"
#include "sdfchart/truth/light_truth.h"
#include "sdfchart/truth/march_truth.h"

namespace sdf::chart {
namespace truths_test {

TEST(MarchTruth, OfABallIsTheRootOfItsEquation) {
  const MarchedScene scene{"ball", sphere(1.0), {1.0, 2.0, 3.0}, 1.2};
  const Rays rays = cameraRays(scene, 24);
  const auto truth = trueHits(take(marchField(scene.shape)), rays, scene, 1e-2);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3 o = rays.origin[i], d = rays.direction[i];
    const double b = glm::dot(o, d), square = b * b - glm::dot(o, o) + 1.0;
    if (std::abs(square) < 1e-9) continue;
    ASSERT_EQ(truth[i].has_value(), square > 0.0) << i;
    if (!truth[i]) continue;
    EXPECT_NEAR(*truth[i], -b - std::sqrt(square), 1e-12);
    ++hits;
  }
  EXPECT_GT(hits, 200);
}

TEST(MarchTruth, OfABoxIsWhereItsSlabsBegin) {
  const glm::dvec3 half(0.5, 0.7, 0.9);
  const MarchedScene scene{"box", box(Vec3E(half)), {2.0, 1.6, 3.4}, 1.3};
  const Rays rays = cameraRays(scene, 24);
  const auto truth = trueHits(take(marchField(scene.shape)), rays, scene, 1e-2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3 o = rays.origin[i], d = rays.direction[i];
    double first = 0.0, last = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-half[axis] - o[axis]) / d[axis], b = (half[axis] - o[axis]) / d[axis];
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    if (std::abs(last - first) < kSliver) continue;
    ASSERT_EQ(truth[i].has_value(), first < last) << i;
    if (truth[i]) {
      EXPECT_NEAR(*truth[i], first, 1e-12);
    }
  }
}

TEST(MarchTruth, FindsSliversBetweenItsSteps) {
  // A plate of a tenth of a step, across the rays.
  const MarchedScene scene{"plate", box(Vec3E(1.0, 1.0, 5e-4)), {0.0, 0.0, 3.0}, 0.5};
  const Rays rays = cameraRays(scene, 8);
  for (const auto& hit : trueHits(take(marchField(scene.shape)), rays, scene, 1e-2)) ASSERT_TRUE(hit);
}

// Rays are marched together as long as none of them meets anything.
TEST(ConeStarts, AreBeforeTheSurfaceAndOnTheirWayToIt) {
  for (const Shape& shape : {sphere(1.0), translate(box(Vec3E(1.0, 0.02, 0.3)), {0.2, 0.1, 0.0})}) {
    const MarchedScene scene{"", shape, {1.0, 2.0, 3.0}, 1.2};
    const MarchField field = take(marchField(shape));
    const Rays rays = cameraRays(scene, 22);  // the last tiles are narrower
    const auto truth = trueHits(field, rays, scene, 1e-2);
    const StartedRays started = coneStarts(field, rays, 22);
    double most = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_LE(started.rays.tMin[i], truth[i].value_or(rays.tMax[i])) << i;
      most = std::max(most, started.rays.tMin[i]);
    }
    EXPECT_GT(most, 2.0);
    EXPECT_GT(started.readings, 0.0);
    EXPECT_LT(started.readings, 1.0);
  }
}

TEST(ConeStarts, SpareReadings) {
  const auto batches = marchingBatches({}, Extent::Quick);
  std::map<std::string, Row> rows;
  for (Measurement& m : batches.at(0).make())
    if (m.row.method == "plain" && m.row.size == 1e-3) m.run(&m.row), rows[m.row.scene] = m.row;
  const Row &plain = rows.at("smooth: blended balls"), &cones = rows.at("smooth: blended balls, cone starts");
  EXPECT_LT(cones.evaluations, 0.9 * plain.evaluations);
  EXPECT_EQ(cones.missed, plain.missed);
  EXPECT_LT(cones.rms, 2.0 * plain.rms);
}

TEST(MarchTruth, TellsMissedFromFalseHits) {
  const std::vector<std::optional<double>> truth{1.0, 2.0, std::nullopt, std::nullopt};
  const Hits hits{{1.5, 2.0, 3.0, 9.0},
                  {4, 4, 4, 8},
                  {RayStatus::Hit, RayStatus::Budget, RayStatus::Hit, RayStatus::Miss}};
  Row row;
  judgeHits(hits, truth, row);
  EXPECT_EQ(row.max, 0.5);
  EXPECT_EQ(row.rms, 0.5);
  EXPECT_EQ(row.missed, 0.25);
  EXPECT_EQ(row.falseHits, 0.25);
  EXPECT_EQ(row.evaluations, 5.0);
}

TEST(LightTruth, OfABallOverheadIsTheShareThatItCovers) {
  // Seen from below, a ball of radius r at height h covers sin^2 = (r / h)^2 of the sky by the cosine.
  const Blocker ball{true, {0.0, 2.0, 0.0}, glm::dvec3(1.0)};
  Vectors below;
  below.add(glm::dvec3(0.0));
  EXPECT_NEAR(lightOf(ball, below, skyDirections(4096), 10.0)[0], 0.75, 1e-3);
  EXPECT_EQ(lightOf(ball, below, skyDirections(4096), 0.5)[0], 1.0);
}

TEST(LightTruth, OfABlockBesideIsHalfWhereItHalvesTheLamp) {
  // The lamp stands overhead, and the block's side is straight above the point.
  const Blocker block{false, {1.0, 1.0, 0.0}, glm::dvec3(1.0 - 1e-9)};
  Vectors beside;
  beside.add(glm::dvec3(0.0, -1.0, 0.0));
  const auto lamp = lampDirections({0, 1, 0}, 0.05, 4096);
  EXPECT_NEAR(lightOf(block, beside, lamp, 10.0)[0], 0.5, 0.01);
  beside.clear();
  beside.add(glm::dvec3(-1.0, -1.0, 0.0));
  EXPECT_EQ(lightOf(block, beside, lamp, 10.0)[0], 1.0);
}

TEST(LightTruth, OfAPlateIsThatOfItsSides) {
  const Blocker plate{false, {0.0, 1.0, 0.0}, {0.5, 0.01, 2.0}};
  const auto meets = [&](double x, double z) { return plate.meets({x, 0.0, z}, {0, 1, 0}, 10.0); };
  EXPECT_TRUE(meets(0.49, 1.99));
  EXPECT_FALSE(meets(0.51, 0.0));
  EXPECT_FALSE(meets(0.0, 2.01));
  EXPECT_FALSE(plate.meets({0.0, 0.0, 0.0}, {0, 1, 0}, 0.98));
  EXPECT_EQ(groundPoints(plate, 4).size(), 16u) << "it covers nothing of the ground that it hovers over";
}

TEST(LightTruth, PicturesHaveAPlaceForEachPointOfTheSquare) {
  // The block covers the middle four of four by four places.
  const Blocker block{false, {0.0, 0.5, 0.0}, glm::dvec3(0.9)};
  const Vectors points = groundPoints(block, 4);
  ASSERT_EQ(points.size(), 12u);
  std::vector<double> light(points.size(), 1.0);
  light[0] = 0.0, light.back() = 0.5;
  EXPECT_EQ(groundPicture(points, light, 4),
            "00fefefe"
            "fefffffe"
            "fefffffe"
            "fefefe7f");
}

TEST(LightTruth, LampDirectionsFillTheirDisc) {
  const double radius = 0.2;
  const glm::dvec3 middle = glm::normalize(glm::dvec3(1.0, 2.0, -0.5));
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& d : lampDirections(middle, radius, 1000)) {
    EXPECT_LE(std::acos(std::min(1.0, glm::dot(d, middle))), radius + 1e-12);
    sum += d;
  }
  EXPECT_LT(std::acos(glm::dot(glm::normalize(sum), middle)), 0.005);
}

// Every kind of measurement runs, without a failure but for marching where no slope is known.
TEST(Batches, OfEveryKindMeasureSomething) {
  for (const auto& batches :
       {normalBatches(Extent::Trial), shadowBatches(Extent::Trial), occlusionBatches(Extent::Trial),
        evaluationBatches(Extent::Trial), growthBatches(Extent::Trial)}) {
    std::vector<Measurement> all = batches.at(0).make();
    ASSERT_FALSE(all.empty());
    for (Measurement& m : all) EXPECT_GE(m.run(&m.row), 0.0) << m.row.key();
  }
}

// Pictures of the known rays are theirs: what OpenGL draws of a ball is where the ball is, and nowhere else.
TEST(DrawnRays, MeetABallWhereItIs) {
  const auto known =
      std::make_shared<KnownRays>(MarchedScene{"ball", sphere(1.0), {1.0, 2.0, 3.0}, 1.2}, 12, 1e-2);
  std::vector<Measurement> all = drawnRays(known, 3, {1024});
  ASSERT_EQ(all.size(), 16u);
  for (Measurement& m : all) {
    EXPECT_GT(m.run(&m.row), 0.0);
    // A hit is off by its share of the pixel's cone, 0.03 wide there, and more where the surface is grazed.
    EXPECT_LT(m.row.rms, 0.03 * m.row.size) << m.row.key();
    EXPECT_EQ(m.row.missed, 0.0) << m.row.key();
    EXPECT_EQ(m.row.falseHits, 0.0) << m.row.key();
    EXPECT_GT(m.row.evaluations, 0.0) << m.row.key();
    EXPECT_EQ(m.row.items, 36.0 * 36.0);
    EXPECT_TRUE(m.row.machine.starts_with("OpenGL: ")) << m.row.machine;
  }
}

// The two methods of the viewer read differently often, and a ray that may read no more misses.
TEST(DrawnRays, AreOfEachMethodAndBudget) {
  const auto known =
      std::make_shared<KnownRays>(MarchedScene{"ball", sphere(1.0), {1.0, 2.0, 3.0}, 1.2}, 12, 1e-2);
  std::map<std::string, Row> rows;
  for (Measurement& m : drawnRays(known, 3, {1024, 3})) {
    if (m.row.size != 1.0 / 64.0) continue;
    m.run(&m.row);
    rows[m.row.scene + ": " + m.row.method] = m.row;
  }
  const Row& usual = rows.at("ball, OpenGL: OpenGL, --start plain");
  const Row& plain = rows.at("ball, OpenGL: OpenGL, --method plain");
  const Row& few = rows.at("ball, OpenGL, 3 steps: OpenGL, --method plain");
  EXPECT_LT(usual.evaluations, plain.evaluations);
  EXPECT_EQ(plain.missed, 0.0);
  EXPECT_GT(few.missed, 0.1);
  EXPECT_LE(few.evaluations, 3.0);
}

TEST(DrawnRays, OfTheUsualBudgetAloneAreTheDefault) {
  const auto known =
      std::make_shared<KnownRays>(MarchedScene{"ball", sphere(1.0), {1.0, 2.0, 3.0}, 1.2}, 12, 1e-2);
  std::vector<std::string> usual;
  for (const Measurement& m : drawnRays(known, 3, {1024, 64}))
    if (m.row.isDefault == 1.0) usual.push_back(m.row.scene + ": " + m.row.method);
  EXPECT_EQ(usual, std::vector<std::string>{"ball, OpenGL: OpenGL, --start cone"});
}

TEST(ShaderReading, AgreesWithTheDoubleReading) {
  const Shape ball = sphere(0.5);
  std::vector<glm::vec4> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(0.02f * i - 1.0f, 0.3f, 0.1f * (i % 7), 0.0f);
  const ShaderReading reading(ball.distance, points, 4);
  reading.run();
  const std::vector<float> values = reading.values();
  ASSERT_EQ(values.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(values[i], evaluate(Tape(ball.distance), glm::dvec3(points[i])), 1e-6) << i;
}

std::vector<Measurement> evaluationsOf(Extent extent, std::size_t batch, const std::string& method,
                                       double compileSeconds = 20.0) {
  std::vector<Measurement> all = evaluationBatches(extent, compileSeconds).at(batch).make();
  std::erase_if(all, [&](const Measurement& m) { return m.row.method != method; });
  return all;
}

TEST(Batches, ShadersAreJudgedLikeTheOtherReadings) {
  std::vector<Measurement> all = evaluationsOf(Extent::Trial, 1, "GLSL");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_GT(all[0].run(&all[0].row), 0.0);
  EXPECT_GT(all[0].row.rms, 0.0);
  EXPECT_LT(all[0].row.max, 8.0);  // ulps
  EXPECT_TRUE(all[0].row.machine.starts_with("OpenGL: ")) << all[0].row.machine;
}

// What takes too long to compile is told by a smaller one, before anybody has waited for it.
TEST(Batches, ShadersThatTakeTooLongToCompileFail) {
  std::vector<Measurement> all = evaluationsOf(Extent::Quick, 4, "GLSL", 1e-3);
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].row.setting, "10000 balls");
  try {
    all[0].run(&all[0].row);
    FAIL() << "it compiled";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("s to compile 156 balls; four times as many"), std::string::npos)
        << error.what();
  }
}

TEST(Batches, GrowthIsTimeAndMemoryOfEachStage) {
  for (const Batch& batch : growthBatches(Extent::Trial)) {
    double most = 0.0, whole = 0.0;
    for (Measurement& m : batch.make()) {
      EXPECT_GE(m.run(&m.row), 0.0);
      EXPECT_GT(m.row.memory, 0.0) << m.row.key();
      (m.row.method == "whole" ? whole : most) = std::max(m.row.memory, most);
      if (m.row.setting == "10 balls") {
        EXPECT_EQ(m.row.size, 19.0) << "operations: each ball, and a union less";
      }
    }
    EXPECT_GE(whole, most);
  }
}

// Differences lose to the rounding of floats as the torus goes away; derivatives far less.
TEST(Batches, NormalsAreChartedOverTheDistanceToo) {
  std::map<std::string, double> near, far;
  for (Measurement& m : normalBatches(Extent::Quick).back().make()) {
    m.run(&m.row);
    if (m.row.size == 1.0) near[m.row.method] = m.row.rms;
    if (m.row.size == 1e4) far[m.row.method] = m.row.rms;
  }
  ASSERT_EQ(far.size(), 4u);
  for (const char* scheme : {"forward", "central", "tetrahedron"}) {
    EXPECT_GT(far[scheme], 10.0 * near[scheme]) << scheme;
    EXPECT_GT(far[scheme], 10.0 * far["exact derivatives"]) << scheme;
  }
}

TEST(Batches, MarchingWithoutASlopeFailsWithTheReason) {
  const auto batches = marchingBatches({}, Extent::Trial);
  std::vector<Measurement> all = batches.at(3).make();
  for (Measurement& m : all) {
    const bool byBalls = m.row.method != "segment" && m.row.method != "bisection";
    const bool needsSlope = byBalls || m.row.scene.ends_with(", cone starts");
    if (needsSlope)
      EXPECT_THROW(m.run(&m.row), std::runtime_error) << m.row.method;
    else
      EXPECT_GT(m.run(&m.row), 0.0) << m.row.method;
  }
}

}  // namespace truths_test
}  // namespace sdf::chart
