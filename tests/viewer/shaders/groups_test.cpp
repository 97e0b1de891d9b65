// Unions of like operands drawn group by group: the kinds and groups themselves, and pictures against those
// of one shader that has all of them written out.
#include "sdf/model/groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <unordered_map>

#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/hoist.h"
#include "sdf/model/model.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "support/bind.h"
#include "support/payloads.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"
#include "viewer/shaders/assemble.h"

namespace sdf::test {
namespace groups_test {

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

Kinds kindsOf(const Shape& shape) { return sdf::kindsOf(operandsOf(shape)); }

std::size_t sizeOf(const Expr& least) {
  return least.op() == Op::Min ? sizeOf(least.arg(0)) + sizeOf(least.arg(1)) : 1;
}

/// A group as a formula of its own.
struct Group {
  Expr distance, nearest, gap, step;
};

std::vector<Group> groupsOf(const OperandKind& kind) {
  std::vector<Group> groups;
  for (const std::vector<Expr>& row : kind.groups.numbers) {
    std::unordered_map<Expr, Expr> numbers;
    for (std::size_t i = 0; i < row.size(); ++i) numbers.emplace(kind.groups.parameters[i], row[i]);
    const auto own = rewrite(std::array{kind.distance, kind.nearest, kind.gap, kind.step},
                             [&](const Expr& e, std::span<const Expr>) -> std::optional<Expr> {
                               const auto found = numbers.find(e);
                               return found == numbers.end() ? std::nullopt : std::optional(found->second);
                             });
    groups.push_back({own[0], own[1], own[2], own[3]});
  }
  return groups;
}

/// Those of all kinds, and the others as one.
std::vector<Group> groupsOf(const Shape& shape) {
  const Kinds kinds = kindsOf(shape);
  std::vector<Group> groups;
  for (const OperandKind& kind : kinds.many)
    for (const Group& group : groupsOf(kind)) groups.push_back(group);
  if (kinds.others.empty()) return groups;
  std::vector<Steep> others;
  for (const NumberedOperand& e : kinds.others) others.push_back({e.distance, e.slope, e.bounds});
  const Marchable rest = leastOf(others);
  groups.push_back({rest.distance, numberOfNearest(kinds.others), Expr(-kInfinity), rest.step});
  return groups;
}

TEST(Groups, HaveTheUnionsDistanceAndTellWhichOperandIsNearest) {
  const Shape whole = balls(100) | crates(70) | rarities();
  const std::vector<NumberedOperand> operands = operandsOf(whole);
  ASSERT_EQ(operands.size(), 172u);
  const std::vector<Group> groups = groupsOf(whole);
  const Tape tape(whole.distance);
  Places places(3);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p = places.next();
    double least = kInfinity, winner = -1.0;
    for (const Group& group : groups) {
      const double d = evaluate(Tape(group.distance), p);
      if (d < least) winner = evaluate(Tape(group.nearest), p);
      least = std::min(least, d);
    }
    EXPECT_EQ(least, evaluate(tape, p));
    EXPECT_EQ(evaluate(Tape(operands.at(static_cast<std::size_t>(winner)).distance), p), least) << winner;
  }
}

/// As many times as far as it is.
Shape multiplied(Shape shape, double slope) {
  shape.distance = slope * shape.distance;
  shape.claim = {.kind = ClaimKind::Field, .lipschitz = slope, .growth = 1.0 / slope};
  return shape;
}

// Distances of a bound may be less than the way to the bounds, by the growth; steps of what is steep may not.
TEST(Groups, AreNoNearerThanTheirGaps) {
  const Shape stretched = scale(sphere(0.1), Vec3E(Expr(1.0), Expr(3.0), Expr(1.0)));
  const Shape steep = multiplied(torus(0.1, 0.05), 3.0), gentle = multiplied(box(Vec3E(Expr(0.1))), 0.4);
  const Kinds kinds =
      kindsOf(unite(std::vector{balls(100), unite(scattered(stretched, 70, 8)),
                                unite(scattered(steep, 70, 12)), unite(scattered(gentle, 70, 13))}));
  ASSERT_EQ(kinds.many.size(), 4u);
  EXPECT_GT(std::ranges::max(kinds.many, {}, &OperandKind::growth).growth, 1.0);
  Places places(9);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p = 2.0 * places.next();
    for (const OperandKind& kind : kinds.many)
      for (const Group& group : groupsOf(kind)) {
        const double gap = evaluate(Tape(group.gap), p), distance = evaluate(Tape(group.distance), p);
        EXPECT_GE(distance, gap > 0.0 ? gap / kind.growth : -kInfinity);
        EXPECT_GE(evaluate(Tape(group.step), p), gap > 0.0 ? gap / kind.stepGrowth : -kInfinity);
        EXPECT_TRUE(gap > -1.0 || distance > -1.0) << "there are bounds";
      }
  }
}

TEST(Groups, AreOfAKindInEqualNumbers) {
  const Kinds kinds = kindsOf(balls(100) | crates(70) | rarities());
  std::multiset<std::size_t> sizes;
  for (const OperandKind& kind : kinds.many)
    for (std::size_t i = 0; i < kind.groups.numbers.size(); ++i) sizes.insert(sizeOf(kind.distance));
  // Balls by seven (the root of 100 / 2), crates by six.
  EXPECT_EQ(sizes.count(7), 15u);
  EXPECT_EQ(sizes.count(6), 12u);
  EXPECT_EQ(sizes.size(), 27u);
  EXPECT_EQ(kinds.others.size(), 2u);
}

TEST(Groups, AreOfNeighbours) {
  std::vector<Shape> row;
  for (int i = 0; i < 98; ++i) row.push_back(translate(sphere(0.1), Vec3E(Expr(0.37 * (1 + (i * 41) % 98)))));
  const std::vector<Group> groups = groupsOf(unite(row));
  ASSERT_EQ(groups.size(), 14u);
  for (const Group& group : groups) {
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
  for (const Shape& shape : {balls(10), sphere(1.0)}) {
    const Kinds kinds = kindsOf(shape);
    EXPECT_TRUE(kinds.many.empty());
    EXPECT_EQ(kinds.others.size(), operandsOf(shape).size());
  }
  EXPECT_TRUE(sdf::kindsOf({}).others.empty());
}

/// A solid of some hundred operations.
Shape carved() {
  Shape solid = box(Vec3E(Expr(0.3)));
  for (int i = 0; i < 10; ++i)
    solid = subtract(solid, translate(box(Vec3E(Expr(0.02 + 0.01 * i))),
                                      Vec3E(Expr(0.03 * i), Expr(0.3), Expr(0.02 * i))));
  return solid;
}

TEST(Groups, AreSingleOperandsWhereTheseAreLarge) {
  const Kinds kinds = kindsOf(unite(scattered(carved(), 2, 4)) | balls(3));
  ASSERT_EQ(kinds.many.size(), 1u) << "from two on";
  EXPECT_EQ(kinds.many.front().groups.numbers.size(), 2u);
  EXPECT_EQ(kinds.many.front().singles.size(), 2u);
  EXPECT_EQ(kinds.others.size(), 3u);
}

TEST(Groups, TakeOneRootForBallsOfOneRadiusBesideOthers) {
  const Kinds kinds = kindsOf(balls(98) | rarities());
  ASSERT_EQ(kinds.many.size(), 1u);
  const Expr read = hoisted(kinds.many.front().distance);
  const auto order = topologicalOrder({&read, 1});
  EXPECT_EQ(std::count_if(order.begin(), order.end(), [](const Expr& n) { return n.op() == Op::Sqrt; }), 1);
}

TEST(Groups, AreOfOnePayload) {
  std::vector<Shape> all;
  for (const auto& payload : {fourPoints(), fourPoints()})
    for (const Shape& one :
         scattered(field(payloadHere(payload) * 0.2, Box::centred(glm::dvec3(1.0)), 1.0), 100, 5))
      all.push_back(one);
  const Kinds kinds = kindsOf(unite(all));
  EXPECT_EQ(kinds.many.size(), 2u);
  for (const OperandKind& kind : kinds.many) {
    std::set<const Payload*> payloads;
    for (const Expr& e : topologicalOrder({&kind.distance, 1}))
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
  for (const OperandKind& kind : kindsOf(whole).many) EXPECT_EQ(sines(kind.distance), 1);
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
  const auto surface = surfaceOf(whole, kWinner, true).attributes;
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
  const auto surface = surfaceOf(whole, kWinner, true).attributes;
  const Expr red = bind(surface[static_cast<std::size_t>(Attribute::Red)], {{"winner", 2.0}});
  EXPECT_EQ(evaluate(Tape(red), {-0.8, 0.9, 0.0}), 1.0);
  EXPECT_EQ(evaluate(Tape(red), {1.8, 0.9, 0.0}), 0.0);
}

/// Pictures of a scene drawn in groups and by one shader.
struct Ways {
  std::vector<glm::vec4> listed, grouped, whole;  // the first by lists of what is near, if there are any
};

Ways drawn(const Scene& scene, GpuRenderOptions options) {
  Ways ways;
  ways.listed = renderOnGpu(scene, options);
  options.shader.culling = false;
  const auto shaders = viewer::assemble(scene, options.shader);
  EXPECT_TRUE(shaders && shaders->plan.grouped);
  ways.grouped = renderOnGpu(scene, options);
  options.shader.sharing = false;
  ways.whole = renderOnGpu(scene, options);
  return ways;
}

// Both hit at one distance from the surface; see picture_test.cpp for the bar.
void expectSamePicture(const Scene& scene, int samples = 1) {
  constexpr double kBar = 40.0;
  GpuRenderOptions options;
  options.samples = samples;
  options.threshold = 0.0;
  const Ways ways = drawn(scene, options);
  EXPECT_GE(psnr(colors(ways.grouped), colors(ways.whole)), kBar);
  EXPECT_GE(psnr(colors(ways.listed), colors(ways.whole)), kBar);
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
  EXPECT_FALSE(viewer::assemble(scene, {})->plan.grouped);
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
  const Ways both = drawn(scene, options);
  EXPECT_GT(red(both.whole), 500.0);
  // Edges may be off by half the threshold: so much around 64 squares of this area.
  const double edges = 0.5 * options.threshold * 4.0 * std::sqrt(64.0 * red(both.whole));
  EXPECT_NEAR(red(both.grouped), red(both.whole), edges);
  EXPECT_NEAR(red(both.listed), red(both.whole), edges);
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
  const auto there = drawn(lit(moved), options).whole, before = drawn(lit(moving), {}).whole;
  for (const bool culling : {false, true}) {
    options.shader.culling = culling;
    const auto picture = renderOnGpu(lit(moving), options);
    EXPECT_GE(psnr(colors(picture), colors(there)), 40.0);
    EXPECT_LE(psnr(colors(picture), colors(before)), 25.0) << "it has moved";
  }
}

// What all parts in turn would show, floor, shadows, occlusion and all, by lists of those that are near.
TEST(CulledPicture, IsThatOfAllParts) {
  for (const int bounces : {0, 1}) {
    Scene scene = lit(painted(balls(90), kRed, 0.3 * bounces) | painted(crates(40), kBlue));
    scene.add("floor", plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), -0.9));
    scene.shadow.kind = Shadow::Kind::Soft;
    scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
    scene.reflectionBounces = bounces;
    GpuRenderOptions options;
    options.threshold = 0.0;
    const auto shaders = viewer::assemble(scene, options.shader);
    ASSERT_TRUE(shaders && shaders->plan.cells && !shaders->plan.grouped);
    const auto listed = renderOnGpu(scene, options);
    options.shader.culling = false;
    ASSERT_FALSE(viewer::assemble(scene, options.shader)->plan.cells);
    // But for pixels at edges, which rays that start elsewhere may decide otherwise.
    const auto others = colors(renderOnGpu(scene, options));
    auto rest = colors(listed);
    EXPECT_LE(shareApart(rest, others, 0.03), 0.005) << bounces << " bounces";
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (shareApart({rest[i]}, {others[i]}, 0.03) > 0.0) rest[i] = others[i];
    EXPECT_GE(psnr(rest, others), 60.0) << bounces << " bounces";
  }
}

// Of one kind, but of four slopes, beside balls of slope 1.
TEST(GroupedPicture, OfSteepOperandsIsTheWholes) {
  std::vector<Shape> all;
  Places places(8);
  for (int i = 0; i < 60; ++i) {
    const Shape ball = translate(sphere(0.15), Vec3E(places.next()));
    all.push_back(multiplied(ball, 1.5 + 0.5 * (i % 4)));
  }
  const Shape whole = unite(all) | balls(50);
  ASSERT_EQ(slopeOf(whole), 3.0);
  int divided = 0;
  for (const OperandKind& kind : kindsOf(whole).many) {
    if (kind.step == kind.distance) continue;
    ++divided;
    const glm::dvec3 p(0.3, 0.2, 0.1);
    for (const Group& group : groupsOf(kind)) {
      const double byTheSteepest = evaluate(Tape(group.distance), p) / 3.0;
      EXPECT_NEAR(evaluate(Tape(group.step), p), std::max(byTheSteepest, evaluate(Tape(group.gap), p)),
                  1e-12);
    }
  }
  EXPECT_EQ(divided, 1) << "balls need not be";
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

// What the benchmarks' parts are read by: a few are written out, dozens and more are listed.
TEST(CulledPicture, IsDrawnOfTheBenchmarksParts) {
  const auto lists = [](int count) {
    ScriptOptions script;
    script.values = {{"count", static_cast<double>(count)}};
    const auto scene = loadScene(SDF_SOURCE_DIR "/samples/bench/v_parts.lua", script);
    EXPECT_TRUE(scene) << scene.error().message;
    const auto shaders = viewer::assemble(*scene, {});
    EXPECT_TRUE(shaders && shaders->plan.planes.size() == 1);
    return shaders->plan.cells.has_value();
  };
  EXPECT_FALSE(lists(10));
  EXPECT_TRUE(lists(100));
  EXPECT_TRUE(lists(1000));
}

// A reading of a group counts as what it costs: its share of the whole.
TEST(GroupedPicture, TakesFewReadings) {
  const auto primary = [](int count, bool grouped) {
    ScriptOptions script;
    script.values = {{"count", static_cast<double>(count)}};
    const auto scene = loadScene(SDF_SOURCE_DIR "/samples/bench/v_balls.lua", script);
    EXPECT_TRUE(scene) << scene.error().message;
    GpuRenderOptions options;
    options.shader.sharing = grouped;
    options.shader.culling = false;
    return readingsOnGpu(*scene, options).primary;
  };
  EXPECT_LT(primary(100, true), 0.25 * primary(100, false));
  EXPECT_LT(primary(100, true), primary(10, true)) << "though there are ten times as many balls";
  EXPECT_GT(primary(100, true), 0.02);
}

/// So many of two large kinds, each in a color of its own that varies along it, over a floor and a slab.
Scene furnished(int count) {
  std::vector<Shape> all;
  Places places(11);
  const auto painted = [&](const Shape& shape, double share) {
    Material m;
    m.color = Vec3E(0.5 + 0.4 * sin(9.0 * position().y), Expr(share), Expr(1.0 - share));
    return shape.paint(m);
  };
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    const Shape turned = rotate(carved(), Vec3E(Expr(0.0), Expr(50.0 * i + 20.0), Expr(0.0)));
    all.push_back(translate(painted(turned, share), Vec3E(places.next())));
    all.push_back(translate(painted(round(carved(), 0.02), 0.5 * share), Vec3E(places.next())));
  }
  all.push_back(
      translate(box(Vec3E(Expr(2.5), Expr(0.1), Expr(2.5))), Vec3E(Expr(0.0), Expr(-0.9), Expr(0.0))));
  Scene scene = lit(unite(all));
  scene.add("floor", plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), -1.2));
  return scene;
}

std::size_t bytesOf(const Scene& scene) {
  const auto shaders = viewer::assemble(scene, {});
  EXPECT_TRUE(shaders) << shaders.error().message;
  return shaders->bytes();
}

TEST(GroupedPicture, SharesLargeOperandsFromTwoOn) {
  const auto shaders = viewer::assemble(furnished(2), {});
  ASSERT_TRUE(shaders) << shaders.error().message;
  ASSERT_TRUE(shaders->plan.grouped);
  EXPECT_EQ(shaders->plan.kinds->many.size(), 2u);
}

// Only counts and places are longer numbers.
TEST(GroupedPicture, TakesNoMoreTextForMoreOperands) {
  for (const auto shadow : {Shadow::Kind::None, Shadow::Kind::Soft, Shadow::Kind::Improved}) {
    Scene few = furnished(20), many = furnished(60);
    EXPECT_FALSE(viewer::assemble(few, {})->plan.surfaceRows.parameters.empty()) << "surfaces, too";
    few.shadow.kind = many.shadow.kind = shadow;
    EXPECT_NEAR(static_cast<double>(bytesOf(many)), static_cast<double>(bytesOf(few)), 60.0);
  }
}

void expectLitAlike(const Scene& scene) {
  constexpr double kBar = 50.0;
  GpuRenderOptions options;
  options.threshold = 0.0;
  options.samples = 2;
  const Ways both = drawn(scene, options);
  EXPECT_GE(psnr(colors(both.grouped), colors(both.whole)), kBar) << static_cast<int>(scene.shadow.kind);
  EXPECT_GE(psnr(colors(both.listed), colors(both.whole)), kBar) << static_cast<int>(scene.shadow.kind);
}

// What is read of the whole: shadows of every kind, occlusion and mirrors.
TEST(GroupedPicture, LightsSharedOperandsAsThoseWrittenOut) {
  for (const auto shadow : {Shadow::Kind::None, Shadow::Kind::Hard, Shadow::Kind::Soft,
                            Shadow::Kind::Improved, Shadow::Kind::Signed}) {
    Scene scene = furnished(3);
    scene.shadow.kind = shadow;
    scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
    expectLitAlike(scene);
  }
}

// The same of operands with a step of their own, beside some without and half spaces that are steep.
TEST(GroupedPicture, LightsSteepSharedOperandsAsThoseWrittenOut) {
  std::vector<Shape> all = scattered(carved(), 3, 14);
  for (int i = 0; i < 6; ++i) {
    const Shape column = twist(box(Vec3E(Expr(0.15), Expr(0.5), Expr(0.15))), Expr(0.5 + 0.4 * i));
    all.push_back(translate(column, Vec3E(Expr(0.8 * i - 2.0), Expr(0.0), Expr(-0.5))));
  }
  all.push_back(multiplied(translate(sphere(0.3), Vec3E(Expr(0.0), Expr(0.6), Expr(1.0))), 2.5));
  Scene scene = lit(unite(all));
  scene.add("floor", multiplied(plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), -0.8), 2.0));
  for (const auto shadow :
       {Shadow::Kind::Hard, Shadow::Kind::Soft, Shadow::Kind::Improved, Shadow::Kind::Signed}) {
    scene.shadow.kind = shadow;
    scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
    const auto shaders = viewer::assemble(scene, {});
    ASSERT_TRUE(shaders) << shaders.error().message;
    ASSERT_EQ(shaders->plan.kinds->many.size(), 2u);
    const auto isSteep = [](const OperandKind& kind) { return kind.step != kind.distance; };
    EXPECT_EQ(std::ranges::count_if(shaders->plan.kinds->many, isSteep), 1);
    expectLitAlike(scene);
  }
}

TEST(GroupedPicture, MirrorsSharedOperandsAsThoseWrittenOut) {
  Scene scene = furnished(20);
  Material mirror;
  mirror.reflectivity = 0.6;
  scene.add("wall", plane(Vec3E(Expr(0.0), Expr(0.0), Expr(1.0)), -2.2).paint(mirror));
  scene.reflectionBounces = 2;
  expectSamePicture(scene);
}

TEST(GroupedPicture, IsShownByAllViews) {
  const Scene scene = furnished(3);
  for (int view = 1; view < static_cast<int>(viewer::View::Count); ++view) {
    GpuRenderOptions options;
    options.threshold = 0.0;
    options.shader.view = static_cast<viewer::View>(view);
    const auto shared = renderOnGpu(scene, options);
    options.shader.sharing = false;
    EXPECT_GE(psnr(colors(shared), colors(renderOnGpu(scene, options))), 35.0) << view;
  }
}

}  // namespace groups_test
}  // namespace sdf::test
