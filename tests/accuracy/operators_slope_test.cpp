// The operators' Lipschitz constants, held to difference quotients: between random points, along the steepest
// way, and across whatever borders there are between copies, cells and branches.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "accuracy/operators/operator_cases.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {

namespace operators_slope_test {

constexpr int kSegments = 5'000;

// Of a formula of some hundred operations on numbers of about this size.
double roundingAt(const glm::dvec3& p) { return 0x1p-40 * (1.0 + glm::length(p)); }

struct Steepest {
  double quotient = 0.0;
  glm::dvec3 from{0.0}, to{0.0};
};

class Slopes {
 public:
  Slopes(const Shape& s, unsigned seed) : tape_(s.distance), random_(seed) {}

  /// Halves the segment again and again, each time keeping the half with the larger quotient, which is no
  /// less than that of the whole: what is steep or torn in it is closed in upon. Returns the steepest met.
  Steepest within(glm::dvec3 a, glm::dvec3 b) {
    // A rounding over a step shorter than this would count as a slope.
    const double shortest = 0x1p14 * roundingAt(a);
    double atA = value(a), atB = value(b);
    Steepest most;
    for (double step = glm::distance(a, b); step > shortest; step *= 0.5) {
      const double quotient = std::abs(atA - atB) / step;
      if (quotient > most.quotient) most = {quotient, a, b};
      const glm::dvec3 middle = 0.5 * (a + b);
      const double atMiddle = value(middle);
      if (std::abs(atA - atMiddle) >= std::abs(atB - atMiddle))
        b = middle, atB = atMiddle;
      else
        a = middle, atA = atMiddle;
    }
    return most;
  }

  /// From p along the gradient there, both ways.
  Steepest alongGradient(const glm::dvec3& p, double length) {
    const glm::dvec3 gradient = evaluateGradient(tape_, p).gradient;
    const double slope = glm::length(gradient);
    if (!(slope > 0.0)) return {};
    const glm::dvec3 way = gradient * (0.5 * length / slope);
    return within(p - way, p + way);
  }

  glm::dvec3 in(const Box& b) { return b.min + (b.max - b.min) * glm::dvec3(unit(), unit(), unit()); }
  glm::dvec3 direction() {
    while (true) {
      const glm::dvec3 v(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
      if (const double length = glm::length(v); length > 0.1 && length <= 1.0) return v / length;
    }
  }
  double unit() { return std::uniform_real_distribution<>(0.0, 1.0)(random_); }

 private:
  double value(const glm::dvec3& p) {
    reading_.run(tape_, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
    return reading_.output();
  }

  Tape tape_;
  ScalarReading<double> reading_;
  std::mt19937 random_;
};

// Some way around the solid; around the middle where it has no end.
Box triedBox(const Shape& s) {
  constexpr double kEndless = 4.0;
  Box box = intersect(s.bounds, Box::centred(glm::dvec3(1e4)));
  for (int i = 0; i < 3; ++i)
    if (box.max[i] - box.min[i] > 1e3) box.min[i] = -kEndless, box.max[i] = kEndless;
  return box.grown(0.6 * box.longestSide());
}

Steepest steepestOf(const ReferenceCase& c, unsigned seed) {
  Slopes slopes(c.shape, seed);
  const Box box = triedBox(c.shape);
  const double size = box.longestSide();
  Steepest most;
  const auto take = [&](const Steepest& s) {
    if (!(s.quotient <= most.quotient)) most = s;
  };
  for (int i = 0; i < kSegments; ++i) {
    const glm::dvec3 p = slopes.in(box);
    const double length = size * std::pow(10.0, -4.0 * slopes.unit());
    take(slopes.within(p, slopes.in(box)));
    take(slopes.within(p, p + length * slopes.direction()));
    take(slopes.alongGradient(p, length));
    if (c.special.empty()) continue;
    const glm::dvec3 corner = c.special[i % c.special.size()];
    take(slopes.within(corner - 0.4 * length * slopes.direction(),
                       corner + 0.6 * length * slopes.direction()));
  }
  return most;
}

void expectNoSteeperThanClaimed(const std::vector<ReferenceCase>& cases) {
  constexpr unsigned kSeed = 1;
  std::vector<Steepest> found(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(),
                    [&](std::size_t i) { found[i] = steepestOf(cases[i], kSeed); });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Shape& s = cases[i].shape;
    ASSERT_TRUE(std::isfinite(s.claim.lipschitz)) << cases[i].name;
    const auto& [quotient, from, to] = found[i];
    // Both ends' rounding, over the shortest step.
    constexpr double kRounding = 2.0 * 0x1p-14;
    EXPECT_LE(quotient, s.claim.lipschitz * (1.0 + kRounding))
        << cases[i].name << ", seed " << kSeed << ": from " << from.x << ", " << from.y << ", " << from.z
        << " to " << to.x << ", " << to.y << ", " << to.z;
    EXPECT_GE(quotient, 0.01 * s.claim.lipschitz) << cases[i].name << " was hardly tried";
  }
}

class OperatorSlope : public testing::TestWithParam<OperatorCases> {};

TEST_P(OperatorSlope, StaysWithinTheClaimedConstant) { expectNoSteeperThanClaimed(GetParam().make()); }

INSTANTIATE_TEST_SUITE_P(Catalog, OperatorSlope, testing::ValuesIn(operatorCases()),
                         [](const auto& info) { return info.param.entry; });

ReferenceCase only(std::string name, Shape shape, std::vector<glm::dvec3> special = {}) {
  return {{{}, 0.0, std::move(special)}, std::move(name), std::move(shape)};
}

TEST(SteepestOf, FindsATearAMillionthDeep) {
  const Expr x = Expr::variable(Variable::X);
  const Shape torn = field(x + 1e-6 * floor(x * 3.0), Box::centred(glm::dvec3(1.0)), 1.0);
  EXPECT_GT(steepestOf(only("torn", torn), 1).quotient, 2.0);
}

// Bounds that fall short of the distance by several times, so that copies that are dropped would show.
Shape slow() {
  return translate(scale(box(Vec3E(0.5, 0.4, 0.6)), Vec3E(1.0, 0.2, 0.5)), Vec3E(0.2, 0.1, 0.0));
}

TEST(PatternSlope, HasNoTearsBetweenCopiesOfBoundsThatFallShort) {
  const Shape s = slow(), ball = translate(ellipsoidBound(Vec3E(0.1, 0.4, 0.3)), Vec3E(0.1, 0.0, 0.2));
  expectNoSteeperThanClaimed(
      {only("endless", repeatGrid(s, Vec3E(1.5, 0.3, 1.0))),
       only("counted", repeatGrid(s, Vec3E(1.5, 0.3, 1.0), glm::ivec3(4, 5, 3))),
       only("long", repeatGrid(s, Vec3E(0.4, 0.0, 0.0), glm::ivec3(7, 1, 1))),
       only("ellipsoids", repeatGrid(ball, Vec3E(0.35, 0.9, 0.0))),
       only("turned", repeatGrid(rotate(s, Vec3E(0.3, 0.5, 0.7)), Vec3E(1.1))),
       only("around", polarRepeat(translate(s, Vec3E(1.0, 0.0, 0.0)), 7)),
       only("around, spanning sectors",
            polarRepeat(translate(rotate(s, Vec3E(0.0, 1.2, 0.0)), Vec3E(1.3, 0.0, 0.2)), 9)),
       only("around, across the axis", polarRepeat(s, 5)),
       only("a grid of rings",
            repeatGrid(polarRepeat(translate(s, Vec3E(0.8, 0.0, 0.0)), 5), Vec3E(3.0, 1.0, 2.9)))});
}

TEST(WarpSlope, HoldsForWarpsOfWarps) {
  const Shape bar = box(Vec3E(0.8, 0.2, 0.3)), post = box(Vec3E(0.3, 0.9, 0.2));
  expectNoSteeperThanClaimed(
      {only("twisted, bent", bend(rotate(twist(post, 1.0), Vec3E(0.0, 0.0, 1.5)), 0.5)),
       only("bent, tapered", taper(bend(bar, 0.8), 0.3)),
       only("tapered, twisted", twist(taper(post, -0.5), 2.0)),
       only("displaced, twisted", twist(displace(post, 0.05, 9.0), 1.5)),
       only("repeated, bent",
            bend(repeatGrid(box(Vec3E(0.1)), Vec3E(0.3, 0.0, 0.4), glm::ivec3(5, 1, 2)), 0.9)),
       only("elongated, mirrored", mirror(elongate(slow(), Vec3E(0.2, 0.3, 0.0)), Vec3E(1.0, 1.0, 0.0)))});
}

}  // namespace operators_slope_test
}  // namespace sdf::accuracy
