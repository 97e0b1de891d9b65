// Expressions as shaders read them, held to the double reading: every operation with hostile arguments, and
// every scene of samples/.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "sdf/eval/glsl.h"
#include "sdf/expr/gradient.h"
#include "sdf/script/script.h"
#include "shape/cases.h"
#include "support/operations.h"
#include "support/payloads.h"
#include "support/samples.h"
#include "support/thorough.h"
#include "viewer/gpu/context.h"
#include "viewer/shaders/glsl_probe.h"
#include "viewer/shaders/glsl_range.h"

namespace sdf::test {
namespace glsl_test {

/// A context for all tests.
class Gpu : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto opened = viewer::Context::headless();
    ASSERT_TRUE(opened) << opened.error().message;
    context_ = std::move(*opened);
  }
  static void TearDownTestSuite() { context_.reset(); }

 private:
  static inline std::unique_ptr<viewer::Context> context_;
};

// Bounds of at most this share of the value say something.
constexpr double kNarrow = 1e-3;

class GlslOperation : public Gpu, public testing::WithParamInterface<OperationCase> {};

std::vector<Place> placesFor(Op op) {
  const std::vector<float> none{0.0f}, all = arguments(1, 4000), some = arguments(2, 40);
  const int count = arity(op);
  const std::vector<float>& xs = count == 1 ? all : some;
  const std::vector<float>& ys = count == 1 ? none : count == 2 ? some : hostileArguments();
  const std::vector<float> zs =
      count == 3 ? std::vector<float>{0.0f, -1.5f, 1e-20f, 1e9f, HUGE_VALF, NAN} : none;
  std::vector<Place> places;
  for (const float x : xs)
    for (const float y : ys)
      for (const float z : zs) places.push_back({{x, y, z}, {}});
  return places;
}

// GLSL lets numbers below the least normal one be 0 on their way in, and says nothing of NaN; sdf/eval/glsl.h
// names the operations of which drivers take it for a number.
bool outOfScope(Op op, const glm::vec3& p) {
  const Op blind[] = {Op::Min, Op::Max, Op::Pow, Op::Atan, Op::Atan2};
  for (int i = 0; i < 3; ++i)
    if ((p[i] != 0.0f && std::abs(p[i]) < FLT_MIN) ||
        (std::isnan(p[i]) && std::find(std::begin(blind), std::end(blind), op) != std::end(blind)))
      return true;
  return false;
}

TEST_P(GlslOperation, IsWithinWhatGlslPromises) {
  const auto& [op, e] = GetParam();
  const Tape tape(e);
  GlslReading range({&e, 1});
  const std::vector<Place> places = placesFor(op);
  const auto got = readByShader({&e, 1}, places);
  int narrow = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::vec3 p = places[i].p;
    if (outOfScope(op, p)) continue;
    const double expected = evaluate(tape, p);
    const float value = got[i][0];
    const Interval r = range(p, {})[0];
    narrow += r.width() <= kNarrow * (1.0 + r.magnitude());
    ASSERT_TRUE(std::isnan(expected) ? std::isnan(value) : r.contains(value))
        << p.x << ", " << p.y << ", " << p.z << ": " << value << ", not " << expected << " in [" << r.lo
        << ", " << r.hi << "]";
  }
  EXPECT_GT(narrow, places.size() / 3) << "the bounds say too little";
}

INSTANTIATE_TEST_SUITE_P(All, GlslOperation, testing::ValuesIn(graphOperations()),
                         [](const auto& i) { return std::string(sdf::info(i.param.op).name); });

// Of a sample's bounds.
constexpr double kMost = 0.75;

std::vector<Place> placesAround(const Shape& shape, int count) {
  Sampler random(sampleRegion(shape), 7);
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 p = random.orOnAnAxis();
    places.push_back({p, glm::vec3(glm::normalize(random.anywhere() - random.anywhere()))});
  }
  return places;
}

/// What the shader gives for the outputs lies in their bounds, and `oracle` too, except where it is a
/// choice between two that the bounds leave open. At least this share of the bounds is narrow: not those at
/// creases, and those of mod where a quotient may round down from a whole number.
template <class Oracle>
void check(std::span<const Expr> outputs, const std::vector<Place>& places, double share, Oracle oracle) {
  GlslReading ranges(outputs);
  const auto got = readByShader(outputs, places);
  std::size_t narrow = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::vec3 &p = places[i].p, &n = places[i].n;
    const std::vector<Interval> r = ranges(p, n);
    const std::vector<double> expected = oracle(p, n);
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      narrow += r[k].width() <= kNarrow * (1.0 + r[k].magnitude());
      const auto where = [&] {
        std::ostringstream out;
        out << std::setprecision(9) << "output " << k << " at (" << p.x << ", " << p.y << ", " << p.z
            << "), n (" << n.x << ", " << n.y << ", " << n.z << "): " << got[i][k] << ", not " << expected[k]
            << " in [" << r[k].lo << ", " << r[k].hi << "]";
        return out.str();
      };
      ASSERT_TRUE(r[k].contains(got[i][k])) << where();
      ASSERT_TRUE(r[k].contains(expected[k])) << "the oracle, too: " << where();
    }
  }
  EXPECT_GE(static_cast<double>(narrow), share * static_cast<double>(outputs.size() * places.size()))
      << "the bounds say too little";
}

void checkDistance(const Shape& shape, const std::vector<Place>& places, double share) {
  const Tape tape(shape.distance);
  check({&shape.distance, 1}, places, share,
        [&](const glm::dvec3& p, const glm::dvec3&) { return std::vector<double>{evaluate(tape, p)}; });
}

void checkGradient(const Shape& shape, const std::vector<Place>& places, double share) {
  const Vec3E g = gradientOf(shape.distance);
  const Tape tape(shape.distance);
  check(std::array{g.x, g.y, g.z}, places, share, [&](const glm::dvec3& p, const glm::dvec3&) {
    const glm::dvec3 slope = evaluateGradient(tape, p).gradient;
    return std::vector<double>{slope.x, slope.y, slope.z};
  });
}

class GlslSample : public Gpu, public testing::WithParamInterface<std::filesystem::path> {
 protected:
  void SetUp() override {
    auto scene = loadScene(GetParam());
    ASSERT_TRUE(scene) << scene.error().message;
    whole = scene->whole();
    places = placesAround(whole, 4096);
  }

  Shape whole;
  std::vector<Place> places;
};

TEST_P(GlslSample, DistancesAreThose) { checkDistance(whole, places, kMost); }

// A chess set's gradient, and a sunflower's, are a shader that takes a driver long.
TEST_P(GlslSample, GradientsAreThose) {
  const std::string name = GetParam().stem();
  if ((name == "chess" || name == "sunflower") && !isThorough())
    GTEST_SKIP() << "with ./bootstrap test --long";
  checkGradient(whole, places, kMost);
}

TEST_P(GlslSample, AttributesAreThose) {
  const Tape tape(whole.surface);
  check(whole.surface, places, kMost,
        [&](const glm::dvec3& p, const glm::dvec3& n) { return evaluateAll(tape, p, n); });
}

INSTANTIATE_TEST_SUITE_P(All, GlslSample, testing::ValuesIn(samples()), stemOf);

using GlslCatalog = Gpu;

// Extreme arguments included, whose bounds may be wide.
TEST_F(GlslCatalog, DistancesAndGradientsAreThose) {
  for (const ShapeCase& c : primitiveCases()) {
    SCOPED_TRACE(c.name);
    const std::vector<Place> places = placesAround(c.shape, 1024);
    checkDistance(c.shape, places, 0.0);
    checkGradient(c.shape, places, 0.0);
  }
}

/// Places at which no coordinate lies within rounding of the border of a grid's cell.
std::vector<Place> placesOffBorders(int count) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> steps(-25, 24);
  const auto any = [&] { return (static_cast<float>(steps(random)) + 0.5f) / 16.0f; };
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) places.push_back({{any(), any(), any()}, {}});
  return places;
}

using GlslPayload = Gpu;

// Two payloads in one shader, one of them twice, at points that are not the position, with a parameter.
TEST_F(GlslPayload, IsReadAsItPromises) {
  const auto grid = sampledBall(5);
  const auto points = fourPoints();
  const auto [x, y, z] = position();
  const Expr a = Expr::parameter({"a", 0.25, 0.0, 1.0});
  const std::array outputs{payloadHere(grid), Expr::payload({points}, {x, y + a, z * 0.5}) * 2.0,
                           Expr::payload({grid}, {a, 0.5, z}) + Expr::payload({points}, {a, a, a})};
  const Tape tape(outputs);
  check(outputs, placesOffBorders(2000), kMost,
        [&](const glm::dvec3& p, const glm::dvec3&) { return evaluateAll(tape, p); });
}

TEST_F(GlslPayload, OfEveryKindIsReadAsItPromises) {
  const auto [x, y, z] = position();
  for (const PayloadCase& c : payloadCases()) {
    if (!c.payload->volumes().empty()) continue;
    SCOPED_TRACE(c.name);
    const std::array outputs{payloadHere(c.payload), Expr::payload({c.payload}, {z * 8.0 + 0.3, x, y})};
    const Tape tape(outputs);
    check(outputs, placesOffBorders(2000), kMost,
          [&](const glm::dvec3& p, const glm::dvec3&) { return evaluateAll(tape, p); });
  }
}

TEST_F(GlslPayload, HasTheDoubleReadingsGradient) {
  const auto [x, y, z] = position();
  for (const PayloadCase& c : payloadCases()) {
    if (!c.payload->volumes().empty()) continue;
    SCOPED_TRACE(c.name);
    const Expr e = Expr::payload({c.payload}, {x, z, y}) + y * 0.5;
    const Tape tape(e);
    const Vec3E g = gradientOf(e);
    const auto places = placesOffBorders(2000);
    const auto got = readByShader(std::array{g.x, g.y, g.z}, places);
    std::size_t off = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const glm::dvec3 expected = evaluateGradient(tape, places[i].p).gradient;
      off += glm::length(expected - glm::dvec3(got[i][0], got[i][1], got[i][2])) > 1e-5;
    }
    EXPECT_LE(off, 5u) << "more than a few points are as far from two points";
  }
}

// However often a payload is used, its data is there once, and its derivatives at a point are read once.
TEST(GlslWriterTest, DefinesAPayloadOnce) {
  const auto points = fourPoints();
  const Expr e = payloadHere(points) + Expr::payload({points}, {position().y, 0.0, 0.0});
  const Vec3E g = gradientOf(payloadHere(points));
  GlslWriter writer;
  writer.add("distance", {&e, 1});
  writer.add("slope", std::array{g.x, g.y, g.z});
  const std::string source = writer.source();
  const auto count = [&](const std::string& text) {
    std::size_t n = 0;
    for (std::size_t at = source.find(text); at != std::string::npos; at = source.find(text, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("float sdfPayload0(vec3 p)"), 1u);
  EXPECT_EQ(count(" = sdfPayload0("), 2u);
  EXPECT_EQ(count(" = sdfPayload0Slopes("), 1u);
  EXPECT_EQ(count("sdfPayload1"), 0u);
}

// A parameter is a uniform: its value is no part of the source.
TEST(GlslWriterTest, LeavesParametersToUniforms) {
  const auto source = [](double value, GlslWriter& writer) {
    const Expr size = Expr::parameter({"size", value, 0.0, 10.0});
    const Expr e = length(position()) - sqrt(size) * 2.0;
    writer.add("distance", {&e, 1});
    return writer.source();
  };
  GlslWriter one, other;
  EXPECT_EQ(source(1.0, one), source(4.0, other));
  EXPECT_EQ(one.uniforms().uniform(), std::vector<double>{2.0});
  EXPECT_EQ(other.uniforms().uniform(), std::vector<double>{4.0});
  EXPECT_EQ(one.uniforms().uniform({{"size", 9.0}}), std::vector<double>{6.0});
}

TEST(GlslWriterTest, HasNoUniformsWithoutParameters) {
  const Expr e = length(position()) - 1.0;
  GlslWriter writer;
  writer.add("distance", {&e, 1});
  EXPECT_EQ(writer.source().find("uniform"), std::string::npos);
  EXPECT_TRUE(writer.uniforms().outputs().empty());
}

using GlslUniforms = Gpu;

// Shaders read parameters, the other numbers that they make, and time, as the double reading has them.
TEST_F(GlslUniforms, AreReadAtTheirValues) {
  const Expr a = Expr::parameter({"a", 0.5, 0.0, 1.0}), t = Expr::parameter({"time", 0.0, 0.0, 1e3});
  const Expr outputs[] = {a * position().x + sin(t), a, exp(a) - t};
  const Place places[] = {{{2.0f, 0.0f, 0.0f}, {}}};
  for (const double time : {0.0, 0.75})
    for (const double value : {0.25, 1.0}) {
      const auto got = readByShader(outputs, places, {{"a", value}, {"time", time}})[0];
      EXPECT_FLOAT_EQ(got[0], static_cast<float>(2.0 * value + std::sin(time)));
      EXPECT_EQ(got[1], static_cast<float>(value));
      EXPECT_EQ(got[2], static_cast<float>(std::exp(value) - time));
    }
}

}  // namespace glsl_test
}  // namespace sdf::test
