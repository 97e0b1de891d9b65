// Wide unions drawn group by group: the groups themselves, and pictures against those of one shader.
#include "sdf/model/groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/hoist.h"
#include "sdf/script/script.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/operators.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"
#include "support/bind.h"
#include "support/payloads.h"
#include "viewer/gpu_render.h"
#include "viewer/psnr.h"
#include "viewer/shaders/assemble.h"

namespace sdf::test {
namespace {

/// Anywhere in a flat box; the same ones for each seed.
class Places {
 public:
  explicit Places(unsigned seed) : random_(seed) {}
  glm::dvec3 next() { return {across_(random_), 0.3 * across_(random_), across_(random_)}; }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> across_{-2.0, 2.0};
};

std::vector<Shape> scattered(const Shape& shape, int count, unsigned seed) {
  Places places(seed);
  std::vector<Shape> all;
  for (int i = 0; i < count; ++i) all.push_back(translate(shape, Vec3E(places.next())));
  return all;
}

Shape balls(int count, unsigned seed = 1) { return unite(scattered(sphere(0.15), count, seed)); }

Shape crates(int count) { return unite(scattered(box(Vec3E(Expr(0.1), Expr(0.12), Expr(0.14))), count, 2)); }

/// Few of their kind.
Shape rarities() { return torus(1.5, 0.1) | capsule(Vec3E(Expr(-2.0)), Vec3E(Expr(2.0)), 0.1); }

std::vector<OperandGroup> groupsOf(const Shape& shape) { return sdf::groupsOf(operandsOf(shape)); }

std::size_t sizeOf(const Expr& least) {
  return least.op() == Op::Min ? sizeOf(least.arg(0)) + sizeOf(least.arg(1)) : 1;
}

TEST(Groups, HaveTheUnionsDistanceAndTellWhichOperandIsNearest) {
  const Shape whole = balls(100) | crates(70) | rarities();
  const std::vector<NumberedOperand> operands = operandsOf(whole);
  ASSERT_EQ(operands.size(), 172u);
  const std::vector<OperandGroup> groups = groupsOf(whole);
  const Tape tape(whole.distance);
  Places places(3);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p = places.next();
    double least = kInfinity, winner = -1.0;
    for (const OperandGroup& group : groups) {
      const double d = evaluate(Tape(group.distance), p);
      if (d < least) winner = evaluate(Tape(group.nearest), p);
      least = std::min(least, d);
    }
    EXPECT_EQ(least, evaluate(tape, p));
    EXPECT_EQ(evaluate(Tape(operands.at(static_cast<std::size_t>(winner)).distance), p), least) << winner;
  }
}

TEST(Groups, AreOneOfRaritiesAndOthersOfAKindInEqualNumbers) {
  const std::vector<OperandGroup> groups = groupsOf(balls(100) | crates(70) | rarities());
  std::multiset<std::size_t> sizes;
  for (const OperandGroup& group : groups) sizes.insert(sizeOf(group.distance));
  // Balls by seven (the root of 100 / 2), crates by six.
  EXPECT_EQ(sizes.count(7), 15u);
  EXPECT_EQ(sizes.count(6), 12u);
  EXPECT_EQ(sizes.count(2), 1u);
  EXPECT_EQ(sizes.size(), 28u);
}

TEST(Groups, AreOfNeighbours) {
  std::vector<Shape> row;
  for (int i = 0; i < 98; ++i) row.push_back(translate(sphere(0.1), Vec3E(Expr(0.37 * (1 + (i * 41) % 98)))));
  const std::vector<OperandGroup> groups = groupsOf(unite(row));
  ASSERT_EQ(groups.size(), 14u);
  for (const OperandGroup& group : groups) {
    std::set<double> places;  // in the row
    for (int step = 0; step < 98; ++step) {
      const glm::dvec3 p(0.37 * (1 + step));
      if (evaluate(Tape(group.distance), p) < 0.0) places.insert(step);
    }
    ASSERT_EQ(places.size(), 7u);
    EXPECT_EQ(*places.rbegin() - *places.begin(), 6.0) << "in a row";
  }
}

TEST(Groups, AreNoneOfFewOperandsAndOfNoUnion) {
  EXPECT_EQ(groupsOf(balls(30)).size(), 1u);
  EXPECT_EQ(groupsOf(sphere(1.0)).size(), 1u);
  EXPECT_TRUE(sdf::groupsOf({}).empty());
}

TEST(Groups, TakeOneRootForBallsOfOneRadiusBesideOthers) {
  for (const OperandGroup& group : groupsOf(balls(98) | rarities())) {
    if (sizeOf(group.distance) != 7) continue;
    const Expr read = hoisted(group.distance);
    const auto order = topologicalOrder({&read, 1});
    EXPECT_EQ(std::count_if(order.begin(), order.end(), [](const Expr& n) { return n.op() == Op::Sqrt; }), 1);
  }
}

TEST(Groups, AreOfOnePayload) {
  std::vector<Shape> all;
  for (const auto& payload : {fourPoints(), fourPoints()})
    for (const Shape& one :
         scattered(field(payloadHere(payload) * 0.2, Box::centred(glm::dvec3(1.0)), 1.0), 50, 5))
      all.push_back(one);
  for (const OperandGroup& group : groupsOf(unite(all))) {
    std::set<const Payload*> payloads;
    for (const Expr& e : topologicalOrder({&group.distance, 1}))
      if (e.payloadPart()) payloads.insert(e.payloadPart()->payload.get());
    EXPECT_EQ(payloads.size(), 1u);
  }
}

TEST(Groups, KeepWhatAllOperandsShare) {
  const Expr turn = Expr::parameter({"turn", 0.3, 0.0, 1.0});
  const Shape whole = rotate(balls(60), Vec3E(Expr(0.0), turn * 90.0, Expr(0.0)));
  const auto sines = [](const Expr& e) {
    const auto order = topologicalOrder({&e, 1});
    return std::count_if(order.begin(), order.end(), [](const Expr& n) { return n.op() == Op::Sin; });
  };
  ASSERT_EQ(sines(whole.distance), 1);
  for (const OperandGroup& group : groupsOf(whole)) EXPECT_EQ(sines(group.distance), 1);
}

const Expr kWinner = Expr::parameter({"winner", 0.0, 0.0, 100.0});

Shape painted(const Shape& shape, const glm::dvec3& color, double reflectivity = 0.0) {
  Material m;
  m.color = Vec3E(color);
  m.reflectivity = reflectivity;
  return shape.paint(m);
}

constexpr glm::dvec3 kRed(1.0, 0.0, 0.0), kBlue(0.0, 0.0, 1.0);

TEST(Winner, DecidesWhatTheUnionChose) {
  const Shape whole = (painted(balls(3, 5), kRed) | painted(crates(4), kBlue)) | painted(sphere(0.2), kRed);
  const auto surface = surfaceOf(whole, kWinner);
  for (int i = 0; i < 8; ++i) {
    const bool isBlue = i >= 3 && i < 7;
    for (const auto& [attribute, value] :
         {std::pair(Attribute::Red, isBlue ? 0.0 : 1.0), std::pair(Attribute::Blue, isBlue ? 1.0 : 0.0)}) {
      const Expr e = bind(surface[static_cast<std::size_t>(attribute)], {{"winner", static_cast<double>(i)}});
      EXPECT_TRUE(e.isConstant(value)) << "operand " << i;
    }
  }
}

TEST(Winner, LeavesWhatOperandsAndMaterialsChoose) {
  const Shape a = painted(sphere(1.0), kRed), b = painted(translate(sphere(1.0), Vec3E(Expr(1.0))), kBlue);
  const Shape operand = round(a | b, 0.1);  // takes its colour from its own operands
  const Shape whole = unite(std::vector{a, b, operand});
  const auto surface = surfaceOf(whole, kWinner);
  const Expr red = bind(surface[static_cast<std::size_t>(Attribute::Red)], {{"winner", 2.0}});
  EXPECT_EQ(evaluate(Tape(red), {-0.8, 0.9, 0.0}), 1.0);
  EXPECT_EQ(evaluate(Tape(red), {1.8, 0.9, 0.0}), 0.0);
}

/// Pictures of a scene drawn in groups and by one shader.
struct Both {
  std::vector<glm::vec4> grouped, whole;
};

Both drawn(const Scene& scene, GpuRenderOptions options) {
  const auto shaders = viewer::assemble(scene, options.shader);
  EXPECT_TRUE(shaders && !shaders->plan.groups.empty());
  Both both;
  both.grouped = renderOnGpu(scene, options);
  options.shader.grouped = false;
  both.whole = renderOnGpu(scene, options);
  return both;
}

// Both hit at one distance from the surface; see picture_test.cpp for the bar.
void expectSamePicture(const Scene& scene, int samples = 1) {
  constexpr double kBar = 40.0;
  GpuRenderOptions options;
  options.samples = samples;
  options.threshold = 0.0;
  const Both both = drawn(scene, options);
  EXPECT_GE(psnr(colors(both.grouped), colors(both.whole)), kBar);
}

Scene lit(const Shape& shape) {
  Scene scene;
  scene.add("union", shape);
  scene.camera.from = Vec3E(Expr(0.5), Expr(3.0), Expr(5.0));
  scene.lights.push_back({});
  return scene;
}

TEST(GroupedPicture, IsTheOneShadersOfAUnion) {
  expectSamePicture(lit(balls(100) | crates(70) | rarities()));
}

TEST(GroupedPicture, TakesManySamples) { expectSamePicture(lit(balls(60)), 3); }

TEST(GroupedPicture, HasEachOperandsColor) {
  std::vector<Shape> all = scattered(sphere(0.2), 60, 4);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = painted(all[i], {(i % 3) / 2.0, (i % 5) / 4.0, (i % 7) / 6.0});
  expectSamePicture(lit(unite(all)));
}

TEST(GroupedPicture, HasPlanesOfTheirOwnColors) {
  Scene scene = lit(painted(balls(60), {0.8, 0.2, 0.1}));
  scene.add("floor", painted(plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), -0.4), {0.2, 0.5, 0.2}));
  scene.add("wall", painted(plane(Vec3E(Expr(0.0), Expr(0.0), Expr(1.0)), -2.5), {0.2, 0.2, 0.7}));
  expectSamePicture(scene);
  scene.shadow.kind = Shadow::Kind::Soft;
  scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
  expectSamePicture(scene);
}

TEST(GroupedPicture, HasPlanesThatAreAlsoInTheUnion) {
  const Shape floor = plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), -0.4);
  Scene scene = lit(painted(floor | balls(60), {0.8, 0.6, 0.2}));
  scene.add("floor", painted(floor, kBlue));
  scene.add("wall", painted(plane(Vec3E(Expr(0.0), Expr(0.0), Expr(1.0)), -2.5), {0.1, 0.7, 0.2}));
  expectSamePicture(scene);
}

TEST(GroupedPicture, IsOneShadersOfManyPlanes) {
  Scene scene;
  for (int i = 0; i < 50; ++i)
    scene.add("", plane(Vec3E(Expr(0.1 * i), Expr(1.0), Expr(0.3)), -1.0 - 0.01 * i));
  EXPECT_TRUE(viewer::assemble(scene, {})->plan.groups.empty());
  EXPECT_EQ(renderOnGpu(scene, {}).size(), 160u * 90u);
}

// Boxes with their tops in one plane: the later ones show.
TEST(GroupedPicture, ShowsTheLaterOfTwoCoincidentSurfaces) {
  std::vector<Shape> slabs, stickers;
  for (int i = 0; i < 64; ++i) {
    const Vec3E at(Expr(0.5 * (i % 8) - 1.8), Expr(0.0), Expr(0.5 * (i / 8) - 1.8));
    slabs.push_back(translate(box(Vec3E(Expr(0.2), Expr(0.1), Expr(0.2))), at));
    stickers.push_back(translate(box(Vec3E(Expr(0.12), Expr(0.1), Expr(0.12))), at));
  }
  Scene scene = lit(painted(unite(slabs), kBlue));
  scene.add("stickers", painted(unite(stickers), kRed));
  GpuRenderOptions options;
  const auto red = [](const std::vector<glm::vec4>& pixels) {
    return static_cast<double>(
        std::count_if(pixels.begin(), pixels.end(), [](const glm::vec4& p) { return p.r > p.b; }));
  };
  const Both both = drawn(scene, options);
  EXPECT_GT(red(both.whole), 500.0);
  // Edges may be off by half the threshold: so much around 64 squares of this area.
  const double edges = 0.5 * options.threshold * 4.0 * std::sqrt(64.0 * red(both.whole));
  EXPECT_NEAR(red(both.grouped), red(both.whole), edges);
}

TEST(GroupedPicture, KnowsItsOwnNamesFromTheScenes) {
  const Expr winner = Expr::parameter({"winner", 0.5, 0.0, 1.0}),
             first = Expr::parameter({"0", 0.3, 0.0, 1.0});
  Material m;
  m.color = Vec3E(winner, first, Expr(0.1));
  expectSamePicture(lit(unite(balls(60).paint(m), painted(rarities(), kBlue))));
}

TEST(GroupedPicture, HasMirrors) {
  Scene scene = lit(painted(balls(60), {0.8, 0.2, 0.1}, 0.5) | painted(crates(50), {0.1, 0.3, 0.8}));
  scene.reflectionBounces = 2;
  scene.shadow.kind = Shadow::Kind::Hard;
  expectSamePicture(scene);
}

TEST(GroupedPicture, FollowsParameters) {
  std::vector<Shape> all;
  Places places(6);
  const Expr time = Expr::parameter({"time", 0.0, 0.0, 10.0});
  for (int i = 0; i < 60; ++i) {
    const Vec3E sway(Expr(0.0), sin(time + 0.7 * i), Expr(0.0));
    all.push_back(translate(sphere(0.15), Vec3E(places.next()) + sway));
  }
  const Shape moving = unite(all);
  Shape moved = moving;
  moved.distance = bind(moving.distance, {{"time", 2.5}});
  GpuRenderOptions options;
  options.threshold = 0.0;
  options.parameters = {{"time", 2.5}};
  const auto picture = renderOnGpu(lit(moving), options);
  EXPECT_GE(psnr(colors(picture), colors(drawn(lit(moved), options).whole)), 40.0);
  EXPECT_LE(psnr(colors(picture), colors(drawn(lit(moving), {}).whole)), 25.0) << "it has moved";
}

// Of one kind, but of four slopes, beside balls of slope 1.
TEST(GroupedPicture, OfSteepOperandsIsTheWholes) {
  std::vector<Shape> all;
  Places places(8);
  for (int i = 0; i < 60; ++i) {
    Shape steep = translate(sphere(0.15), Vec3E(places.next()));
    const double slope = 1.5 + 0.5 * (i % 4);
    steep.distance = slope * steep.distance;
    steep.claim = {.kind = ClaimKind::Field, .lipschitz = slope};
    all.push_back(steep);
  }
  const Shape whole = unite(all) | balls(50);
  ASSERT_EQ(slopeOf(whole), 3.0);
  int divided = 0;
  for (const OperandGroup& group : groupsOf(whole)) {
    if (group.step == group.distance) continue;
    ++divided;
    const glm::dvec3 p(0.3, 0.2, 0.1);
    EXPECT_NEAR(3.0 * evaluate(Tape(group.step), p), evaluate(Tape(group.distance), p), 1e-12)
        << "by the steepest";
  }
  EXPECT_GT(divided, 0);
  EXPECT_LT(divided, static_cast<int>(groupsOf(whole).size())) << "balls need not be";
  expectSamePicture(lit(whole));
}

TEST(GroupedPicture, IsSeenFromWithin) {
  Scene scene = lit(balls(200));
  scene.camera.from = Vec3E(Expr(0.01), Expr(0.02), Expr(0.3));
  scene.camera.to = Vec3E(Expr(0.5), Expr(0.0), Expr(-1.0));
  expectSamePicture(scene);
}

TEST(GroupedPicture, MarksPixelsOutOfSteps) {
  const auto spent = [](int maxSteps) {
    GpuRenderOptions options;
    options.maxSteps = maxSteps;
    const auto pixels = drawn(lit(balls(100)), options).grouped;
    return std::count_if(pixels.begin(), pixels.end(), [](const glm::vec4& p) { return p.a == 0.0f; });
  };
  EXPECT_GT(spent(2), 0);
  EXPECT_EQ(spent(viewer::Frame{}.maxSteps), 0);
}

// A reading of a group counts as what it costs: its share of the whole.
TEST(GroupedPicture, TakesFewReadings) {
  const auto primary = [](int count, bool grouped) {
    ScriptOptions script;
    script.values = {{"count", static_cast<double>(count)}};
    const auto scene = loadScene(SDF_SOURCE_DIR "/samples/bench/v_balls.lua", script);
    EXPECT_TRUE(scene) << scene.error().message;
    GpuRenderOptions options;
    options.shader.grouped = grouped;
    return readingsOnGpu(*scene, options).primary;
  };
  EXPECT_LT(primary(100, true), 0.25 * primary(100, false));
  EXPECT_LT(primary(100, true), primary(10, true)) << "though there are ten times as many balls";
  EXPECT_GT(primary(100, true), 0.02);
}

}  // namespace
}  // namespace sdf::test
