// Expressions as shaders read them, held to the double reading: every operation with hostile arguments, and
// every scene of samples/.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "sdf/eval/glsl.h"
#include "sdf/expr/gradient.h"
#include "sdf/script/script.h"
#include "shape/cases.h"
#include "support/operations.h"
#include "viewer/glsl_probe.h"
#include "viewer/glsl_range.h"
#include "viewer/gpu/context.h"

namespace sdf::test {
namespace {

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

}  // namespace
}  // namespace sdf::test
