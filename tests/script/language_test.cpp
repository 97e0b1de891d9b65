// What scene files can say, and that it means what the C++ functions mean.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "script/run.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/catalog.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace language_test {

/// The one shape that `expression` gives. Equal graphs are the same node, so shapes compare exactly.
Expr distanceOf(const std::string& expression, const ScriptOptions& options = {}) {
  const Scene scene = sceneOf("return " + expression, options);
  return scene.parts.empty() ? Expr(NAN) : scene.parts[0].shape.distance;
}

void expectSame(const std::string& expression, const Shape& shape) {
  ASSERT_TRUE(shape.ok()) << *shape.error;
  EXPECT_TRUE(distanceOf(expression) == shape.distance) << expression;
}

TEST(Language, ArgumentsComeInOrderOrByNameOrBoth) {
  for (const char* way :
       {"torus(1, 0.2)", "torus{1, 0.2}", "torus{major = 1, minor = 0.2}", "torus{1, minor = 0.2}",
        "torus(1, {minor = 0.2})", "torus({minor = 0.2, major = 1})"})
    expectSame(way, torus(1.0, 0.2));
  expectSame("torus()", torus(1.0, 0.25));
  expectSame("torus{}", torus(1.0, 0.25));
}

TEST(Language, VectorsMayNameTheirComponents) {
  const Shape ball = sphere(1.0), moved = translate(ball, {1.0, 2.0, 3.0});
  for (const char* way :
       {"sphere(1):translate({x = 1, y = 2, z = 3})", "sphere(1):translate{x = 1, y = 2, z = 3}",
        "sphere(1):translate{offset = {x = 1, y = 2, z = 3}}", "translate(sphere(1), {z = 3, y = 2, x = 1})",
        "translate{sphere(1), {x = 1, y = 2, z = 3}}"})
    expectSame(way, moved);
  expectSame("round_box({x = 1, y = 2, z = 3}, 0.5)", roundBox({1.0, 2.0, 3.0}, 0.5));
  expectSame("round_box({x = 1, y = 2, z = 3}, {radius = 0.5})", roundBox({1.0, 2.0, 3.0}, 0.5));
  expectSame("rectangle{x = 2, y = 1}:extrude(1)", extrude(rectangle(2.0, 1.0), 1.0));
  const glm::dvec2 corners[] = {{0, 0}, {1, 0}, {0, 1}};
  for (const char* way : {"polygon{{x = 0, y = 0}, {x = 1, y = 0}, {x = 0, y = 1}}",
                          "polygon({x = 0, y = 0}, {x = 1, y = 0}, {x = 0, y = 1})"})
    expectSame(std::string(way) + ":extrude(1)", extrude(polygon(corners), 1.0));
  EXPECT_EQ(numberOf("length{x = 3, y = 4} + dot({x = 1, y = 2, z = 3}, {1, 1, 1})"), 11.0);
  const Scene scene = sceneOf(
      "camera{from = {x = 1, y = 2, z = 3}} bounds({x = -1, y = -1, z = -1}, {1, 1, 1}) return sphere(1)");
  EXPECT_EQ(uniformValue(scene.camera.eye().z), 3.0);
  EXPECT_EQ(scene.bounds->min, glm::dvec3(-1.0));
}

// z says nothing of them.
TEST(Language, VectorsOfFlatShapesMayLeaveOutZ) {
  const Shape flat = rectangle(2.0, 1.0);
  const Shape moved = extrude(translate(flat, {1.0, 0.5, 0.0}), 1.0);
  for (const char* offset :
       {"(1, 0.5)", "({1, 0.5})", "{1, 0.5}", "{x = 1, y = 0.5}", "{offset = {1, 0.5}}", "(1, 0.5, 0)"})
    expectSame("rectangle(2, 1):translate" + std::string(offset) + ":extrude(1)", moved);
  const Shape scaled = extrude(scale(flat, {2.0, -3.0, 1.0}), 1.0);
  for (const char* factor : {"(2, -3)", "({2, -3})", "{factor = {x = 2, y = -3}}", "(2, -3, 1)"})
    expectSame("rectangle(2, 1):scale" + std::string(factor) + ":extrude(1)", scaled);
  const Expr turned = distanceOf("rectangle(2, 1):rotate(0, 0, 30):extrude(1)");
  for (const char* angle : {"(30)", "{angles = 30}", "{30}"})
    EXPECT_TRUE(distanceOf("rectangle(2, 1):rotate" + std::string(angle) + ":extrude(1)") == turned) << angle;
  expectSame("rectangle(2, 1):mirror{normal = {1, 1}}:extrude(1)",
             extrude(mirror(flat, Vec3E(1.0, 1.0, 0.0)), 1.0));
  expectSame("rectangle(2, 1):elongate(1, 2):extrude(1)", extrude(elongate(flat, {1.0, 2.0, 0.0}), 1.0));
  expectSame("rectangle(2, 1):repeat_grid({5, 3}, {3, 2}):extrude(1)",
             extrude(repeatGrid(flat, Vec3E(5.0, 3.0, 1.0), glm::ivec3(3, 2, 1)), 1.0));
}

// Else a factor of 1 - 0.9 smoothstep(...) could be 0.
TEST(Language, SmoothstepKeepsWithinItsEnds) {
  const Scene scene =
      sceneOf("return sphere(1):paint{color = function(x, y, z) return smoothstep(0, 2, x), 0, 0 end}");
  const Expr red = scene.parts.at(0).shape.surface[static_cast<int>(Attribute::Red)];
  EXPECT_GE(red.range().lo, 0.0);
  EXPECT_LE(red.range().hi, 1.0);
  const auto value = [](double x) { return 0.25 * x * x * (3.0 - x); };
  for (const double x : {0.0, 0.1, 0.5, 1.0, 1.3, 1.9, 2.0})
    EXPECT_NEAR(at(red, x, 0.0, 0.0), value(x), 1e-15) << x;
  EXPECT_EQ(at(red, -1.0, 0.0, 0.0), 0.0);
  EXPECT_EQ(at(red, 2.0, 0.0, 0.0), 1.0);
  EXPECT_EQ(at(red, 7.0, 0.0, 0.0), 1.0);
  const Tape tape(red);
  for (const double lo : {0.2, 0.6, 1.0}) {
    const Interval range = evaluate(tape, Box{{lo, 0.0, 0.0}, {lo + 0.4, 0.0, 0.0}});
    EXPECT_NEAR(range.lo, value(lo), 1e-12);
    EXPECT_NEAR(range.hi, value(lo + 0.4), 1e-12);
  }
}

TEST(Language, VectorsComeAsTablesAsNumbersInARowAndSizesAsOneNumber) {
  const Shape expected = roundBox({1.0, 2.0, 3.0}, 0.5);
  for (const char* way : {"round_box({1, 2, 3}, 0.5)", "round_box(1, 2, 3, 0.5)", "round_box{1, 2, 3, 0.5}",
                          "round_box{{1, 2, 3}, 0.5}", "round_box{half = {1, 2, 3}, radius = 0.5}",
                          "round_box(1, 2, 3, {radius = 0.5})"})
    expectSame(way, expected);
  expectSame("round_box(2, 0.5)", roundBox(Expr(2.0), 0.5));
  expectSame("sphere(1):scale(2)", scale(sphere(1.0), Expr(2.0)));
  expectSame("sphere(0.3):repeat_grid(1, 3)", repeatGrid(sphere(0.3), Expr(1.0), glm::ivec3(3)));
  expectSame("capsule(0, 0, 0, 1, 2, 3, 0.5)", capsule(Expr(0.0), {1.0, 2.0, 3.0}, 0.5));
  expectSame("rectangle(2, 1):extrude(1)", extrude(rectangle(2.0, 1.0), 1.0));
  expectSame("segment{from = {0, 0}, to = {1, 2}, radius = 0.5}:extrude(1)",
             extrude(segment({0.0, 0.0, 0.0}, {1.0, 2.0, 0.0}, 0.5), 1.0));
}

TEST(Language, ListsComeAsTablesOrInARow) {
  const Shape a = sphere(1.0), b = box(Expr(1.0)), c = torus(2.0, 0.5);
  for (const char* way :
       {"union(sphere(1), box(1), torus(2, 0.5))", "union{sphere(1), box(1), torus(2, 0.5)}",
        "sphere(1):union(box(1), torus(2, 0.5))", "sphere(1):union{box(1), torus(2, 0.5)}"})
    expectSame(way, unite(std::vector{a, b, c}));
  for (const char* way : {"union{sphere(1), box(1), k = 0.2}", "sphere(1):union(box(1), {k = 0.2})",
                          "union(sphere(1), box(1), 0.2)", "union({sphere(1), box(1)}, 0.2)",
                          "union(sphere(1), box(1), {k = 0.2, blend = \"quadratic\"})"})
    expectSame(way, unite(a, b, Blend::quadratic(0.2)));
  const glm::dvec2 corners[] = {{0, 0}, {1, 0}, {0, 1}};
  for (const char* way : {"polygon{{0, 0}, {1, 0}, {0, 1}}", "polygon({0, 0}, {1, 0}, {0, 1})",
                          "polygon({{0, 0}, {1, 0}, {0, 1}})", "polygon{points = {{0, 0}, {1, 0}, {0, 1}}}"})
    expectSame(std::string(way) + ":extrude(1)", extrude(polygon(corners), 1.0));
}

TEST(Language, SignsCombineShapes) {
  const Shape a = sphere(1.0), b = box(Expr(0.8));
  expectSame("sphere(1) | box(0.8)", unite(a, b));
  expectSame("sphere(1) & box(0.8)", intersect(a, b));
  expectSame("sphere(1) - box(0.8)", subtract(a, b));
  expectSame("sphere(1) ~ box(0.8)", exclude(a, b));
}

TEST(Language, EveryOperatorOfTheCatalogIsAMethodToo) {
  for (const CatalogEntry& entry : catalog()) {
    if (entry.parameters.front().kind != ArgumentKind::Shape &&
        entry.parameters.front().kind != ArgumentKind::Shapes)
      continue;
    sceneOf("assert(sphere(1)." + entry.name + " == " + entry.name + ") return sphere(1)");
  }
}

TEST(Language, RoundTakesShapesAndNumbers) {
  expectSame("round(box(1), 0.1)", round(box(Expr(1.0)), 0.1));
  EXPECT_EQ(numberOf("round(2.5) + round(3.5)"), 6.0);
}

TEST(Language, AFieldOfASpheresFormulaIsTheSphere) {
  const Scene scene = sceneOf(
      "return field(function(x, y, z) return length(x, y, z) - 1 end, "
      "{bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = 1})");
  const Shape& shape = scene.parts.at(0).shape;
  const Expr both[] = {shape.distance, sphere(1.0).distance};
  const std::vector<Expr> plain = withoutClaims(both);
  EXPECT_EQ(plain[0], plain[1]);
  EXPECT_EQ(shape.bounds.min, glm::dvec3(-1.0));
  EXPECT_EQ(shape.bounds.max, glm::dvec3(1.0));
  EXPECT_EQ(shape.claim.lipschitz, 1.0);
}

TEST(Language, AShapeThatIsCalledGivesItsDistance) {
  EXPECT_EQ(numberOf("value(sphere(1)(3, 0, 0))"), 2.0);
  EXPECT_EQ(numberOf("value(sphere(1)({3, 0, 0}))"), 2.0);
  EXPECT_EQ(numberOf("value(sphere(1){x = 0, y = 0, z = 0.5})"), -0.5);
  EXPECT_EQ(numberOf("value(circle(1)(0, 3))"), 2.0);
  EXPECT_EQ(numberOf("value(circle(1){0, 3})"), 2.0);
  // A formula in every program, whatever the numbers come from.
  EXPECT_EQ(numberOf("type(sphere(1)(3, 0, 0)) == 'userdata' and 1 or 0"), 1.0);
  EXPECT_EQ(numberOf("value(sphere(r)(3, 0, 0))", "local r = param('r', 2)"), 1.0);
  const Shape ball = sphere(1.0);
  const Vec3E p = position();
  expectSame("sphere(1):displace(function(x, y, z) return 0.1 * box(2)(2 * x, y, z) end)",
             displace(ball, 0.1 * distanceAt(box({2.0, 2.0, 2.0}), {2.0 * p.x, p.y, p.z})));
  const Scene scene =
      sceneOf("local s = box(1) return sphere(1):paint(function(x, y, z) return s(x, y, z) end)");
  EXPECT_TRUE(scene.parts.at(0).shape.surface[0] == box({1.0, 1.0, 1.0}).distance);
}

TEST(Language, DisplaceTakesAFunctionInPlaceOfItsOwnPattern) {
  expectSame("sphere(1):displace(function(x, y, z) return 0.1 * sin(5 * x) end)",
             displace(sphere(1.0), 0.1 * sin(5.0 * position().x)));
  expectSame("sphere(1):displace(0.1, 5)", displace(sphere(1.0), 0.1, 5.0));
}

// Every function gives the same on numbers, and on formulas whose parameters have these values. Both sides
// are evaluated in double by the same functions; a sum of terms in another order may differ by a few ulps.
TEST(Language, FunctionsAgreeOnNumbersAndOnFormulas) {
  const char* calls[] = {"sin(a)",
                         "cos(a)",
                         "tan(a)",
                         "asin(a / 4)",
                         "acos(a / 4)",
                         "atan(a)",
                         "atan(a, b)",
                         "exp(a)",
                         "log(b)",
                         "log(b, 2)",
                         "sqrt(b)",
                         "square(a)",
                         "abs(a)",
                         "sign(a)",
                         "floor(a)",
                         "ceil(a)",
                         "round(a)",
                         "fract(a)",
                         "min(a, b, 1)",
                         "max(a, b, 1)",
                         "pow(b, a)",
                         "mod(a, b)",
                         "clamp(a, -b, b)",
                         "mix(a, b, 0.25)",
                         "step(a, b)",
                         "smoothstep(-3, 3, a)",
                         "less(a, b)",
                         "less_equal(a, b)",
                         "equal(a, b)",
                         "select(less(a, b), a, b)",
                         "length(a, b, 1)",
                         "dot({a, b, 1}, {b, 2, 3})",
                         "a + b",
                         "a - b",
                         "a * b",
                         "a / b",
                         "a % b",
                         "a // b",
                         "b ^ a",
                         "a ^ 2",
                         "a ^ 3",
                         "a ^ 4",
                         "-a",
                         "math.sin(a)",
                         "math.max(a, b)",
                         "math.floor(a)",
                         "noise(a, b, 1)",
                         "gradient_noise(a, b, 1, {octaves = 2, ridged = true})",
                         "cell_noise(a, b, 1)"};
  constexpr unsigned kSeed = 11;
  constexpr double kUlps = 8.0;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> any(-3.0, 3.0), positive(0.1, 3.0);
  for (const char* call : calls) {
    ScriptOptions options;
    options.values = {{"a", any(random)}, {"b", positive(random)}};
    const std::string numbers =
        "local a, b = value(param('a', 0, {min = -3})), value(param('b', 1, {max = 3}))";
    const std::string formulas = "local a, b = param('a', 0, {min = -3}), param('b', 1, {max = 3})";
    const double plain = numberOf(call, numbers, options), formula = numberOf(call, formulas, options);
    EXPECT_NEAR(plain, formula,
                kUlps * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(plain)))
        << call << " a = " << options.values["a"] << " b = " << options.values["b"] << " seed " << kSeed;
  }
}

TEST(Language, WholeNumbersStayFitForCounting) {
  sceneOf(
      "for _, v in ipairs{floor(2.5), ceil(1.5), round(2.2), abs(-2), min(2, 3), max(1, 2), mod(5, 3)} do "
      "assert(math.type(v) == 'integer' and v == 2) end return sphere(1)");
}

TEST(Language, AParameterCanBeSetFromOutside) {
  const std::string text = "return sphere(param('r', 1, {min = 0.5, max = 2}))";
  const Scene scene = sceneOf(text);
  ASSERT_EQ(scene.parameters.size(), 1u);
  EXPECT_EQ(scene.parameters[0], (ParameterInfo{"r", 1.0, 0.5, 2.0}));
  ScriptOptions options;
  options.values = {{"r", 1.5}};
  EXPECT_EQ(at(sceneOf(text, options).parts.at(0).shape.distance, 3, 0, 0), 1.5);
}

TEST(Language, ARangeThatIsNotGivenHoldsTheDefault) {
  EXPECT_EQ(sceneOf("param('a', 5) return sphere(1)").parameters.at(0), (ParameterInfo{"a", 5.0, 0.0, 5.0}));
  EXPECT_EQ(sceneOf("param('a', -2) return sphere(1)").parameters.at(0),
            (ParameterInfo{"a", -2.0, -2.0, 1.0}));
}

TEST(Language, AskingTwiceForAParameterGivesTheSame) {
  const Scene scene = sceneOf("local a, b = param('r', 1), param('r', 1) return sphere(a), sphere(b)");
  EXPECT_EQ(scene.parameters.size(), 1u);
  EXPECT_TRUE(scene.parts.at(0).shape.distance == scene.parts.at(1).shape.distance);
}

// What sdfview keeps open, sdf2gltf settles before: the same script has to mean the same in both.
TEST(Language, AParameterIsAFormulaWhetherItsValueIsFixedOrNot) {
  const std::string k = "local k = param('k', 0.2, {max = 3}) ";
  for (const bool fixed : {false, true}) {
    SCOPED_TRACE(fixed);
    for (const char* formula : {"k",
                                "2 * k",
                                "k - k",
                                "-k",
                                "k // 1",
                                "k ^ 2",
                                "sin(k)",
                                "math.floor(k)",
                                "round(k)",
                                "abs(k)",
                                "min(1, k)",
                                "max(k, 1)",
                                "pow(k, 2)",
                                "mod(k, 2)",
                                "atan(k, 1)",
                                "log(k + 1)",
                                "clamp(k, 0, 1)",
                                "mix(0, 1, k)",
                                "mix({0, 0, 0}, {1, 0, k}, 0.5)[1]",
                                "mix({0, 0, 0}, {1, 1, 1}, k)[2]",
                                "smoothstep(0, 1, k)",
                                "step(k, 1)",
                                "less(k, 1)",
                                "select(k, 1, 2)",
                                "select(k, '#f00', 1)[1]",
                                "length(k, 1)",
                                "length({k, 1, 2})",
                                "dot({1, 2}, {3, k})",
                                "noise(k, 0, 0)",
                                "value_noise(k, 0, 0)",
                                "color(k, 0, 0)[2]",
                                "color(function() return k, 0, 0 end)[2]",
                                "time",
                                "time + 1"})
      sceneOf(k + "local e = " + formula +
                  " assert(type(e) == 'userdata' and tostring(e) == 'formula', type(e)) return sphere(1)",
              {.fixed = fixed});
    for (const char* number :
         {"value(k)", "value(2 * k + time)", "sin(value(k))", "mix('#f00', {0, 0, 1}, 1)[3]",
          "color('#abc')[1]", "noise(0.5, 0, 0, {octaves = 2})", "cell_noise(0.5, 0, 0)", "length({3, 4})"})
      sceneOf(k + "local e = " + number + " assert(type(e) == 'number', type(e)) return sphere(1)",
              {.fixed = fixed});
    EXPECT_EQ(
        errorOf(k + "return select(k, sphere(1), box(1))", {.fixed = fixed}),
        "scene.lua:1: select chooses between numbers and colours; to choose between shapes, use morph or "
        "plain 'if'");
    EXPECT_EQ(
        errorOf(k + "return polygon{{0, 0}, {k, 0}, {0, 1}}:extrude(1)", {.fixed = fixed}),
        "scene.lua:1: number 1 of polygon: 'points' must be a plain number, got a formula; value(e) gives "
        "its present value");
    EXPECT_EQ(
        errorOf("local n = param('n', 2) return sphere(0.3):repeat_grid(1, {1, n, 1})", {.fixed = fixed}),
        "scene.lua:1: number 2 of repeat_grid: 'count' must be a plain number, got a formula; value(e) gives "
        "its present value");
  }
}

TEST(Language, AFixedParameterFoldsAsItsValueWould) {
  ScriptOptions options{.values = {{"k", 0.75}}, .fixed = true};
  for (const char* shape : {"sphere(1 + k)", "sphere(1):translate(2 * sin(k), k ^ 2, 0)",
                            "box(k, k // 1 + 1, 2)", "sphere(select(less(k, 1), k, 2))"}) {
    const std::string text = std::string(" return ") + shape;
    EXPECT_TRUE(sceneOf("local k = param('k', 0)" + text, options).parts.at(0).shape.distance ==
                sceneOf("param('k', 0) local k = 0.75" + text, options).parts.at(0).shape.distance)
        << shape;
  }
}

TEST(Language, AConditionThatIsFixedLeavesOnlyWhatItChooses) {
  const std::string text =
      "local k = param('k', 1) return field(function(x, y, z) return select(k, x, y) end)";
  EXPECT_TRUE(sceneOf(text, {.fixed = true}).parts.at(0).shape.distance == position().x);
}

TEST(Language, ValueGivesThePresentNumber) {
  const std::string before = "local k = param('k', 0.2, {max = 3})";
  for (const bool fixed : {false, true}) {
    EXPECT_EQ(numberOf("value(k)", before, {.fixed = fixed}), 0.2);
    EXPECT_EQ(numberOf("value(2 * k)", before, {.values = {{"k", 1.25}}, .fixed = fixed}), 2.5);
    EXPECT_EQ(numberOf("value(time)", before, {.time = 4.5, .fixed = fixed}), 4.5);
    sceneOf(before + " assert(math.type(value(k)) == 'integer') return sphere(1)",
            {.values = {{"k", 2.0}}, .fixed = fixed});
  }
}

TEST(Language, ASceneKnowsWhoseValuesShapedIt) {
  const std::string text =
      "local a, b, c = param('a', 1), param('b', 1), param('c', 1) "
      "return sphere(value(a + b)), box(c, value(2), 1)";
  EXPECT_EQ(sceneOf(text).valuesRead, (std::set<std::string>{"a", "b"}));
  EXPECT_EQ(sceneOf("return sphere(1 + value(time))").valuesRead, std::set<std::string>{"time"});
}

TEST(Language, ValuesFromAnEarlierStateOfTheFileAreBroughtIntoItsRanges) {
  const std::string text = "return sphere(param('r', 1, {min = 0.5, max = 2}))";
  const Scene scene = sceneOf(text, {.values = {{"r", 9.0}, {"gone", 1.0}}, .tolerant = true});
  EXPECT_EQ(scene.parameters.at(0), (ParameterInfo{"r", 2.0, 0.5, 2.0}));
}

TEST(Language, TimeIsAParameterOnlyWhereItIsNamed) {
  EXPECT_TRUE(sceneOf("return sphere(1)").parameters.empty());
  ScriptOptions options;
  options.time = 2.5;
  const Scene scene = sceneOf("local a = time return sphere(1 + time)", options);
  ASSERT_EQ(scene.parameters.size(), 1u);
  EXPECT_EQ(scene.parameters[0].name, "time");
  EXPECT_EQ(at(scene.parts.at(0).shape.distance, 0, 0, 0), -3.5);
}

TEST(Language, ReturnedShapesArePartsWithoutNames) {
  const Scene scene = sceneOf("part('ball', sphere(1)) return box(1), torus()");
  ASSERT_EQ(scene.parts.size(), 3u);
  EXPECT_EQ(scene.parts[0].name, "ball");
  EXPECT_EQ(scene.parts[1].name, "part 2");
  EXPECT_EQ(scene.parts[2].name, "part 3");
}

TEST(Language, PairsGoesThroughKeysInOrder) {
  sceneOf(R"(
    local t, seen = {zeta = 1, alpha = 2, [3] = 3, [1.5] = 4, [-1] = 5, mid = 6}, {}
    for k, v in pairs(t) do seen[#seen + 1] = tostring(k) end
    assert(table.concat(seen, ' ') == '-1 1.5 3 alpha mid zeta', table.concat(seen, ' '))
    for k in pairs(t) do t[k] = nil end
    for k in pairs(t) do error('left ' .. k) end
    return sphere(1))");
}

TEST(Language, RandomNumbersAreTheSameEveryTime) {
  const std::string text = "return sphere(1 + math.random())";
  EXPECT_TRUE(sceneOf(text).parts.at(0).shape.distance == sceneOf(text).parts.at(0).shape.distance);
}

TEST(Language, XpcallHandsTheErrorToItsHandler) {
  sceneOf(R"(
    local ok, text = xpcall(function(a) error('no ' .. a, 0) end, function(m) return m .. '!' end, 'way')
    assert(ok == false and text == 'no way!')
    local fine, a, b = xpcall(function(...) return ... end, print, 1, 2)
    assert(fine == true and a == 1 and b == 2)
    return sphere(1))");
}

TEST(Language, AByteOrderMarkIsNoPartOfTheScene) { sceneOf("\xEF\xBB\xBFreturn sphere(1)"); }

}  // namespace language_test
}  // namespace sdf
