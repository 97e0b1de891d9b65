// The smooth booleans held to what defines them. Their operands are half-spaces with normals along x, y and
// z: a point's coordinates then are the operands' distances, and the gradient's parts are the operands'
// weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "accuracy/operators/operator_blends.h"
#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/solids/solids.h"
#include "support/thorough.h"

namespace sdf::accuracy {
namespace blends_test {

const int kPoints = static_cast<int>(100'000 / test::accuracyFraction());
constexpr unsigned kSeed = 1;
constexpr double kWidths[] = {0.01, 0.3, 2.0};
// Distances are tried up to this many widths from each other, the numbers themselves up to 10.
constexpr double kReach = 3.0, kFar = 10.0;
// Some ten operations, none of which adds more than an epsilon of the numbers involved; quotients by k add
// one of |a| / k.
constexpr double kValueRounding = 16.0 * 0x1p-52 * kFar;
double weightRounding(double k) { return 16.0 * 0x1p-52 * (1.0 + kFar / k); }

// Each in its own colour: red, green or blue.
Shape halfSpace(int axis) {
  static const std::array<MaterialPtr, 3> kMaterials = [] {
    std::array<MaterialPtr, 3> made;
    for (int i = 0; i < 3; ++i) {
      Material m;
      m.color = Vec3E(i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0);
      made[i] = makeMaterial(m);
    }
    return made;
  }();
  return plane(kMaterials[axis]->color, 0.0).paint(kMaterials[axis]);
}

// Pairs of distances: ties, the edges of the blend, and everything around.
class Pairs {
 public:
  explicit Pairs(double k) : k_(k), random_(kSeed) {}

  glm::dvec3 next() {
    const double a = uniform(-kFar / 2, kFar / 2);
    const int kind = static_cast<int>(random_() % 8);
    if (kind == 0) return {a, a, 0.0};
    if (kind == 1) return {a, a + (random_() % 2 ? k_ : -k_), 0.0};
    if (kind == 2) return {a, a + k_ * std::pow(10.0, uniform(-12.0, 0.0)), 0.0};
    if (kind == 3) return {a, -a, 0.0};
    return {a, a + k_ * uniform(-kReach, kReach), 0.0};
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }

  double k_;
  std::mt19937 random_;
};

struct Given {
  const Smooth& smooth;
  double k;
  Blend blend() const { return {smooth.kind, k}; }
};

class SmoothBooleans : public ::testing::TestWithParam<int> {
 protected:
  const Smooth& smooth() const { return kSmooths[GetParam()]; }

  template <class Test>
  void tryAll(Test test) {
    for (const double k : kWidths) {
      Pairs pairs(k);
      const Given given{smooth(), k};
      test(given, [&](auto tryPair) {
        for (int i = 0; i < kPoints && !HasFatalFailure(); ++i) {
          const glm::dvec3 p = pairs.next();
          SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", point " << i << ": k = " << k
                                          << ", a = " << p.x << ", b - a = " << p.y - p.x);
          tryPair(p);
        }
      });
    }
  }
};

// Where a chamfer's gradient jumps; there either side is right.
bool onEdge(const Given& g, const glm::dvec3& p) {
  if (g.smooth.kind != Blend::Kind::Chamfer) return false;
  return std::abs(std::abs(p.x - p.y) - g.k) <= kValueRounding ||
         std::abs(std::abs(p.x + p.y) - g.k) <= kValueRounding;
}

TEST_P(SmoothBooleans, GiveWhatTheirDefinitionsSay) {
  tryAll([](const Given& g, auto forAll) {
    const Shape a = halfSpace(0), b = halfSpace(1);
    const Tape either(unite(a, b, g.blend()).distance), both(intersect(a, b, g.blend()).distance),
        less(subtract(a, b, g.blend()).distance), oneOnly(exclude(a, b, g.blend()).distance);
    forAll([&](const glm::dvec3& p) {
      const auto lower = [&](double u, double v) { return g.smooth.lower(u, v, g.k); };
      const auto upper = [&](double u, double v) { return -lower(-u, -v); };
      ASSERT_NEAR(evaluate(either, p), lower(p.x, p.y), kValueRounding);
      ASSERT_NEAR(evaluate(both, p), upper(p.x, p.y), kValueRounding);
      ASSERT_NEAR(evaluate(less, p), upper(p.x, -p.y), kValueRounding);
      ASSERT_NEAR(evaluate(oneOnly, p), upper(lower(p.x, p.y), -upper(p.x, p.y)), kValueRounding);
    });
  });
}

TEST_P(SmoothBooleans, AreSymmetricInTheirOperands) {
  tryAll([](const Given& g, auto forAll) {
    const Shape a = halfSpace(0), b = halfSpace(1);
    using Operator = Shape (*)(const Shape&, const Shape&, const Blend&);
    for (const Operator combine : {Operator(unite), Operator(intersect), Operator(exclude)}) {
      const Tape one(combine(a, b, g.blend()).distance), other(combine(b, a, g.blend()).distance);
      forAll([&](const glm::dvec3& p) {
        ASSERT_EQ(evaluate(one, p), evaluate(other, p));
        ASSERT_EQ(evaluate(one, p), evaluate(one, {p.y, p.x, 0.0}));
      });
    }
  });
}

TEST_P(SmoothBooleans, LieWithinTheirDepthOfTheHardOnesAndReachIt) {
  tryAll([](const Given& g, auto forAll) {
    const Shape a = halfSpace(0), b = halfSpace(1);
    const Tape either(unite(a, b, g.blend()).distance), both(intersect(a, b, g.blend()).distance);
    forAll([&](const glm::dvec3& p) {
      const double below = std::min(p.x, p.y) - evaluate(either, p),
                   above = evaluate(both, p) - std::max(p.x, p.y);
      for (const double by : {below, above}) {
        ASSERT_GE(by, 0.0);
        ASSERT_LE(by, g.smooth.depth * g.k + kValueRounding);
        ASSERT_TRUE(p.x != p.y || std::abs(by - g.smooth.depth * g.k) <= kValueRounding) << by;
      }
    });
  });
}

TEST_P(SmoothBooleans, ChangeNothingBeyondTheirWidth) {
  tryAll([](const Given& g, auto forAll) {
    const Shape a = halfSpace(0), b = halfSpace(1);
    const Tape either(unite(a, b, g.blend()).distance), both(intersect(a, b, g.blend()).distance);
    forAll([&](const glm::dvec3& p) {
      const double apart = std::abs(p.x - p.y);
      // The exponential has no end, but falls off as it says: log(1 + e) <= e.
      const double most = g.smooth.kind == Blend::Kind::Exponential
                              ? g.k * std::exp(-apart / g.k) + kValueRounding
                          : apart >= g.k + kValueRounding ? 0.0
                                                          : kInfinity;
      ASSERT_LE(std::min(p.x, p.y) - evaluate(either, p), most);
      ASSERT_LE(evaluate(both, p) - std::max(p.x, p.y), most);
    });
  });
}

// The weights that a gradient shows: of a and of b, whose signs say whether the solid or what is outside it
// counts.
void expectShares(const glm::dvec3& gradient, double signOfB, double k) {
  const double ofA = gradient.x, ofB = gradient.y * signOfB, rounding = weightRounding(k);
  ASSERT_GE(ofA, -rounding);
  ASSERT_GE(ofB, -rounding);
  ASSERT_NEAR(ofA + ofB, 1.0, rounding);
}

TEST_P(SmoothBooleans, HaveGradientsThatAreMeansOfTheirOperands) {
  tryAll([](const Given& g, auto forAll) {
    const Shape a = halfSpace(0), b = halfSpace(1);
    const Tape either(unite(a, b, g.blend()).distance), both(intersect(a, b, g.blend()).distance),
        less(subtract(a, b, g.blend()).distance), oneOnly(exclude(a, b, g.blend()).distance);
    forAll([&](const glm::dvec3& p) {
      expectShares(evaluateGradient(either, p).gradient, 1.0, g.k);
      expectShares(evaluateGradient(both, p).gradient, 1.0, g.k);
      expectShares(evaluateGradient(less, p).gradient, -1.0, g.k);
      const glm::dvec3 mixed = evaluateGradient(oneOnly, p).gradient;
      ASSERT_LE(std::abs(mixed.x) + std::abs(mixed.y), 1.0 + 2.0 * weightRounding(g.k));
    });
  });
}

TEST_P(SmoothBooleans, HaveThoseGradientsInTheBatchReadingToo) {
  for (const double k : kWidths) {
    const Shape s = unite(halfSpace(0), halfSpace(1), {smooth().kind, k});
    const Tape tape(s.distance);
    Pairs pairs(k);
    std::vector<float> x, y;
    for (int i = 0; i < kPoints; ++i) {
      const glm::dvec3 p = pairs.next();
      x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y));
    }
    std::vector<float> value(kPoints), dx(kPoints), dy(kPoints), dz(kPoints);
    BatchEvaluator().evaluateGradient(tape, {x.data(), y.data(), x.data()}, kPoints, value.data(), dx.data(),
                                      dy.data(), dz.data());
    // As in double, with the epsilon of float.
    const double rounding = weightRounding(k) * 0x1p29;
    for (int i = 0; i < kPoints; ++i) {
      ASSERT_GE(dx[i], -rounding) << "k = " << k << ", a = " << x[i] << ", b = " << y[i];
      ASSERT_GE(dy[i], -rounding) << "k = " << k << ", a = " << x[i] << ", b = " << y[i];
      ASSERT_NEAR(dx[i] + dy[i], 1.0, rounding) << "k = " << k << ", a = " << x[i] << ", b = " << y[i];
    }
  }
}

// a is painted red and b green: the colours of a union are the weights themselves.
TEST_P(SmoothBooleans, MixColoursByTheWeightsOfTheGradient) {
  tryAll([](const Given& g, auto forAll) {
    const Shape s = unite(halfSpace(0), halfSpace(1), g.blend());
    const Tape distance(s.distance), colours(std::array{s.surface[0], s.surface[1], s.surface[2]});
    forAll([&](const glm::dvec3& p) {
      if (onEdge(g, p)) return;
      const glm::dvec3 gradient = evaluateGradient(distance, p).gradient;
      const std::vector<double> colour = evaluateAll(colours, p);
      ASSERT_NEAR(colour[0], gradient.x, weightRounding(g.k));
      ASSERT_NEAR(colour[1], gradient.y, weightRounding(g.k));
      ASSERT_EQ(colour[2], 0.0);
    });
  });
}

TEST(SmoothUnion, OfThreeExponentialsMixesColoursByTheWeightsOfTheGradient) {
  for (const double k : kWidths) {
    const Shape s = unite({halfSpace(0), halfSpace(1), halfSpace(2)}, Blend::exponential(k));
    const Tape distance(s.distance), colours(std::array{s.surface[0], s.surface[1], s.surface[2]});
    Pairs pairs(k);
    for (int i = 0; i < kPoints; ++i) {
      glm::dvec3 p = pairs.next();
      p.z = pairs.next().y - pairs.next().y + p.x;
      const glm::dvec3 gradient = evaluateGradient(distance, p).gradient;
      const std::vector<double> colour = evaluateAll(colours, p);
      double sum = 0.0;
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(gradient[c], -weightRounding(k));
        ASSERT_NEAR(colour[c], gradient[c], weightRounding(k)) << "k = " << k << ", point " << i;
        sum += gradient[c];
      }
      ASSERT_NEAR(sum, 1.0, weightRounding(k)) << "k = " << k << ", point " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, SmoothBooleans, ::testing::Range(0, static_cast<int>(kSmooths.size())),
                         [](const auto& info) { return std::string(kSmooths[info.param].name); });

}  // namespace blends_test
}  // namespace sdf::accuracy
