// Failures of smooth minima, and of the colours they mix.
#include <cmath>

#include "probe.h"
#include "sdf/eval/batch.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

/// The float batch reading at the origin.
float batchAtOrigin(const Shape& s) {
  const float zero = 0.0f;
  float value;
  BatchEvaluator().evaluate(Tape(s.distance), {.x = &zero, .y = &zero, .z = &zero}, 1, &value);
  return value;
}

FailureCase exponentialCase(const char* where, double distance) {
  // Two planes x <= -distance: both distances are `distance` at the origin.
  return {std::string("exponential blend of distances of ") + where,
          "values that are not finite, of 1",
          {"-log(exp(-32 a) + exp(-32 b)) / 32 in float", 1.0},
          {"least distance taken out of the exponents first", 0.0},
          "32 * 4.1 > log(FLT_MAX) = 88.7, and exp(-32 * 4.7) is 0 in float; ours must be within 4 float "
          "ulps of min - k log 2",
          [distance] {
            const float a = static_cast<float>(distance);
            const float naive = -std::log(std::exp(-32.0f * a) + std::exp(-32.0f * a)) / 32.0f;
            const Shape one = plane({1, 0, 0}, -distance), other = plane({1, 0, 0.0}, -distance);
            const double expected = distance - std::log(2.0) / 32.0;
            const double ours = batchAtOrigin(unite(one, other, Blend::exponential(1.0 / 32.0)));
            const bool sound = std::abs(ours - expected) <= 4.0 * 0x1p-23 * std::abs(expected);
            return Figures{std::isfinite(naive) ? 0.0 : 1.0, sound ? 0.0 : 1.0};
          }};
}

// Depth of the blend's solid in the middle of the gap between two balls, 0 where the gap is open.
double closed(double gap, double k) {
  const Shape left = translate(sphere(1.0), {-1.0 - gap / 2, 0, 0}),
              right = translate(sphere(1.0), {1.0 + gap / 2, 0, 0});
  return std::max(0.0, -Distance(unite(left, right, Blend::quadratic(k)))(0, 0, 0));
}

// Height of the field over 0 in the middle of a wall that a blended cut comes near: 0 where the wall stands.
double pierced(double half, double k) {
  const Shape wall = intersect(plane({1, 0, 0}, half), plane({-1, 0, 0}, half));
  const Shape cutter = plane({1, 0, 0}, -half);  // leaves all of the wall, and ends at its face
  return std::max(0.0, Distance(subtract(wall, cutter, Blend::quadratic(k)))(0, 0, 0));
}

}  // namespace

std::vector<FailureCase> blendFailures() {
  return {
      exponentialCase("-4.1", -4.1),
      exponentialCase("4.7", 4.7),
      {"power blend inside",
       "values that are not numbers, of 1",
       {"power smooth minimum (a^k b^k / (a^k + b^k))^(1/k)", 1.0},
       {"not offered; the four blends that are, are finite inside", 0.0},
       "a negative number to a fractional power",
       [] {
         const double a = std::pow(-0.5, 2.5), b = std::pow(-0.25, 2.5);
         const double naive = std::pow(a * b / (a + b), 1.0 / 2.5);
         bool sound = true;
         for (const Blend& blend :
              {Blend::quadratic(0.3), Blend::cubic(0.3), Blend::exponential(0.3), Blend::chamfer(0.3)}) {
           const double f =
               Distance(unite(sphere(0.5), translate(sphere(0.25), {0.1, 0, 0}), blend))(0.0, 0.0, 0.0);
           sound &= std::isfinite(f) && f < 0.0;
         }
         return Figures{std::isnan(naive) ? 1.0 : 0.0, sound ? 0.0 : 1.0};
       }},
      {"a blend that closes a gap",
       "depth of solid in the middle of a gap of 0.1",
       {"quadratic blend, k = 0.4", 0.05 - kRounding},
       {"k chosen by the documented limit, twice the gap", 0.0},
       "a blend lowers equal distances by k / 4: 0.05 - 0.1; at k = 2 gap by just half the gap",
       [] {
         return Figures{closed(0.1, 0.4), closed(0.1, 0.2 - 1e-9)};
       }},
      {"a blended cut that eats a wall",
       "height of the field in the middle of a wall of 0.1",
       {"quadratic cut, k = 0.4", 0.05 - kRounding},
       {"k chosen by the documented limit, four times half the wall", 0.0},
       "a cut raises equal distances by k / 4: -0.05 + 0.1",
       [] {
         return Figures{pierced(0.05, 0.4), pierced(0.05, 0.2 - 1e-9)};
       }},
      {"colour of a blend",
       "greatest jump of a colour over a step of 1e-3",
       {"the nearer shape's colour", 1.0},
       {"colours mixed by the weight that mixes the distances", 2.0 * 1e-3 / 0.4 + kRounding},
       "black and white; the weight 1/2 + (b - a) / (2 k), k = 0.4, changes by at most 2 / (2 k) a unit",
       [] {
         const Shape black = translate(sphere(1.0), {-0.8, 0, 0}).paint({.color = Vec3E(0.0)});
         const Shape white = translate(sphere(1.0), {0.8, 0, 0}).paint({.color = Vec3E(1.0)});
         const Tape hard(unite(black, white).surface[0]),
             soft(unite(black, white, Blend::quadratic(0.4)).surface[0]);
         const auto jump = [](const Tape& t, double x) {
           return std::abs(evaluate(t, {x + 1e-3, 0, 0}) - evaluate(t, {x, 0, 0}));
         };
         return worstOf(-1.0005, 1.0, 1e-3, [&](double x) { return Figures{jump(hard, x), jump(soft, x)}; });
       }},
      {"chamfer of two faces that nearly agree",
       "steepest difference quotient, less 1",
       {"min(a, b, (a - k + b) sqrt 1/2) (Mercury 2015)", std::sqrt(2.0) - 1.0 - 1e-3},
       {"the bevel scaled so that its gradient is a mean of the operands'", 1e-9},
       "where both gradients agree, theirs has length 2 sqrt 1/2; planes 2 degrees apart lose less than "
       "a thousandth",
       [] {
         const double tilt = 2.0 * kPi / 180.0;
         const Shape a = plane({0, 1, 0}, 0.0), b = plane({std::sin(tilt), std::cos(tilt), 0}, 0.0);
         const Distance first(a), second(b), ours(unite(a, b, Blend::chamfer(0.5)));
         const auto naive = [&](const glm::dvec3& p) {
           const double u = first(p), v = second(p);
           return std::min({u, v, (u - 0.5 + v) * std::sqrt(0.5)});
         };
         return Figures{steepest(naive, 0.5, 21) - 1.0, steepest(ours, 0.5, 21) - 1.0};
       }},
      {"order of three blended balls",
       "difference between two orders",
       {"quadratic blends, two at a time", 1e-3},
       {"exponential blend, which is one sum", kRounding},
       "a quadratic blend of a blend adds what the first one did not; log-sum-exp is associative",
       [] {
         std::vector<Shape> balls;
         for (const double x : {-0.5, 0.0, 0.7}) balls.push_back(translate(sphere(0.4), {x, 0.1 * x, 0}));
         const std::vector<Shape> turned{balls[2], balls[0], balls[1]};
         const auto difference = [&](const Blend& blend) {
           const Distance one(unite(balls, blend)), other(unite(turned, blend));
           return worst(1.0, 21, [&](const glm::dvec3& p) { return std::abs(one(p) - other(p)); });
         };
         return Figures{difference(Blend::quadratic(0.4)), difference(Blend::exponential(0.4))};
       }}};
}

}  // namespace sdf::accuracy
