// What a marcher refuses, and in which words.
#include <cmath>
#include <functional>

#include "march/scenes.h"
#include "sdf/shape/solids/flats.h"

namespace sdf {
namespace errors_test {

using test::kMethods;

TEST(Marcher, RefusesOptionsOutOfRange) {
  const struct {
    std::function<void(MarchOptions&)> spoil;
    const char* message;
  } cases[] = {
      {[](MarchOptions& o) { o.epsilon = 0.0; }, "march: epsilon must be positive and finite"},
      {[](MarchOptions& o) { o.epsilon = NAN; }, "march: epsilon must be positive and finite"},
      {[](MarchOptions& o) { o.epsilon = HUGE_VAL; }, "march: epsilon must be positive and finite"},
      {[](MarchOptions& o) { o.footprint = -0.1; }, "march: footprint must be finite and at least 0"},
      {[](MarchOptions& o) { o.maxSteps = 0; }, "march: maxSteps must be at least 1"},
      {[](MarchOptions& o) { o.refinements = -1; }, "march: refinements must be at least 0"},
      {[](MarchOptions& o) { o.overRelaxation = 2.0; },
       "march: overRelaxation must be at least 1 and below 2"},
      {[](MarchOptions& o) { o.overRelaxation = 0.9; },
       "march: overRelaxation must be at least 1 and below 2"},
      {[](MarchOptions& o) { o.acceleration = 1.1; }, "march: acceleration must be from 0 to 1"},
      {[](MarchOptions& o) { o.smoothing = 0.0; }, "march: smoothing must be above 0 and at most 1"},
      {[](MarchOptions& o) { o.growth = 1.0; }, "march: growth must be above 1 and finite"},
  };
  for (const auto& c : cases) {
    MarchOptions options;
    c.spoil(options);
    const Result<Marcher> marcher = Marcher::make(sphere(1.0), options);
    ASSERT_FALSE(marcher) << c.message;
    EXPECT_EQ(marcher.error().kind, ErrorKind::Usage);
    EXPECT_EQ(marcher.error().message, c.message);
  }
}

std::string refusal(const Shape& shape, MarchMethod method) {
  MarchOptions options;
  options.method = method;
  const Result<Marcher> marcher = Marcher::make(shape, options);
  if (marcher) return "";
  EXPECT_EQ(marcher.error().kind, ErrorKind::Scene);
  return marcher.error().message;
}

TEST(Marcher, RefusesAFieldOfUnknownSlopeUnlessItNeedsNone) {
  const Expr y = position().y;
  for (const MarchMethod method : kMethods)
    EXPECT_EQ(
        refusal(field(y * y - 1.0), method),
        test::marchesBalls(method)
            ? "march: the shape's slope has no known bound; state one with field's lipschitz, or march by "
              "segments or bisection"
            : "")
        << test::name(method);
}

TEST(Marcher, RefusesASlopeThatIsNotPositive) {
  const Result<Marcher> marcher = Marcher::make(marchField(position().x, 0.0), MarchOptions{});
  ASSERT_FALSE(marcher);
  EXPECT_EQ(marcher.error().message, "march: the Lipschitz constant must be positive");
}

TEST(Marcher, PassesOnWhatIsWrongWithAShape) {
  EXPECT_EQ(refusal(sphere(-1.0), MarchMethod::Plain), *sphere(-1.0).error);
  EXPECT_EQ(refusal(circle(1.0), MarchMethod::Plain), "the shape is flat; extrude or revolve it");
}

TEST(Marcher, NamesTheRayThatIsWrong) {
  const struct {
    std::function<void(Rays&)> spoil;
    const char* message;
  } cases[] = {
      {[](Rays& r) { r.direction.z[1] = 2.0; },
       "march: ray 1: its direction has length 2.000000; normalise it"},
      {[](Rays& r) { r.direction.z[1] = NAN; }, "march: ray 1: its direction has length nan; normalise it"},
      {[](Rays& r) { r.origin.y[0] = HUGE_VAL; }, "march: ray 0: its origin is not finite"},
      {[](Rays& r) { r.tMax[1] = HUGE_VAL; }, "march: ray 1: tMin and tMax must be finite"},
      {[](Rays& r) { r.tMin[1] = 11.0; }, "march: ray 1: 0 <= tMin <= tMax must hold"},
      {[](Rays& r) { r.tMin[1] = -1.0; }, "march: ray 1: 0 <= tMin <= tMax must hold"},
      {[](Rays& r) { r.tMax.pop_back(); }, "march: the rows of the rays differ in length"},
      {[](Rays& r) { r.origin.x.push_back(0.0); }, "march: the rows of the rays differ in length"},
      {[](Rays& r) { r.tMax[1] = 1e12; },
       "march: ray 1: double does not resolve epsilon at t = 1000000000000.000000; start it nearer or raise "
       "epsilon"},
  };
  Result<Marcher> marcher = Marcher::make(sphere(1.0), MarchOptions{});
  for (const auto& c : cases) {
    Rays rays;
    for (int i = 0; i < 2; ++i) rays.add({0, 0, -3}, {0, 0, 1}, 0.0, 10.0);
    c.spoil(rays);
    const Result<Hits> hits = marcher->trace(rays);
    ASSERT_FALSE(hits) << c.message;
    EXPECT_EQ(hits.error().kind, ErrorKind::Usage);
    EXPECT_EQ(hits.error().message, c.message);
  }
}

}  // namespace errors_test
}  // namespace sdf
