// Every operation through every reading, with hostile arguments. The double reading of ops.def is the
// meaning; the others must agree with it as eval/promise.h states.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "sdf/eval/batch.h"
#include "sdf/eval/promise.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"
#include "support/float_range.h"
#include "support/operations.h"

namespace sdf {
namespace agreement_test {

using test::arguments;
using test::graphOperations;
using Case = test::OperationCase;

// Fused operations, written so that the tape compiler makes them.
std::vector<Case> fusedOperations() {
  const auto [x, y, z] = position();
  return {{Op::MulAdd, x * y + z},
          {Op::AbsMinus, abs(x) - 0.75},
          {Op::Length2, length(x, y) - 0.5},
          {Op::Length3, length(x, y, z) - 0.5},
          {Op::Distance3, length(x - 0.25, y + 0.5, z - 1.0) - 0.125}};
}

constexpr double kInfinityAsFloat = 0x1p128;  // what follows on the largest float

double asFloat(double x) { return std::clamp(x, -kInfinityAsFloat, kInfinityAsFloat); }
double ulp(double x) {
  const float v = std::abs(static_cast<float>(x));
  return v < FLT_MAX ? std::nextafter(v, HUGE_VALF) - v : 0x1p104;
}

// One instruction at one point.
struct Reading {
  Op op;
  double a[3];
  double minus;  // the constant that a fused operation subtracts last
  double expected;
  float got;

  bool inScope() const {
    const Promise p = promise(op);
    for (const double x : a)
      if (std::isfinite(x) && std::abs(x) > p.largest) return false;
    return p.of != Promise::Of::Dividend || !(std::abs(a[0] / a[1]) > 0x1p126) || std::isinf(a[0] / a[1]);
  }
  double allowed() const {
    const Promise p = promise(op);
    const double own = p.ulps * std::max(ulp(expected), ulp(got));
    switch (p.of) {
      case Promise::Of::Dividend:
        return own + p.more * ulp(a[0]);
      case Promise::Of::Product:
        return own + p.more * ulp(a[0] * a[1]);
      case Promise::Of::Length:
        return own + std::max(p.more * ulp(expected + minus), 0x1p-74);
      default:
        return own;
    }
  }
  // Of mod what is left after the whole divisors that the quotient's rounding may add.
  double difference() const {
    const double d = std::abs(asFloat(got) - asFloat(expected)), divisor = std::abs(a[1]);
    if (promise(op).of != Promise::Of::Dividend || !std::isfinite(divisor)) return d;
    const double most = std::floor(1.0 + std::abs(a[0] / a[1]) * 0x1p-24);
    return std::abs(d - std::min(most, std::round(d / divisor)) * divisor);
  }
  bool agrees() const {
    if (std::isnan(expected) || std::isnan(got)) return std::isnan(expected) == std::isnan(got);
    return got == static_cast<float>(expected) || difference() <= allowed();
  }
};

// Points of any size and sign, the first three rows of variables.
struct Points {
  std::vector<float> x, y, z;

  std::size_t size() const { return x.size(); }
  Rows rows() const { return {x.data(), y.data(), z.data()}; }
  void add(float a, float b, float c) { x.push_back(a), y.push_back(b), z.push_back(c); }
};

/// Any finite float: all sizes are as likely.
float anyFloat(std::mt19937& random) {
  for (;;)
    if (const float v = std::bit_cast<float>(static_cast<std::uint32_t>(random())); std::isfinite(v))
      return v;
}

// Arguments for operations of so many rows: the hostile ones in all pairs; of one row every `stride`th float
// there is, of more, by seed, `count` whose sizes have to do with each other or have not.
struct Effort {
  std::uint32_t stride, count;
};

Points anyPoints(int rows, unsigned seed, const Effort& effort) {
  std::mt19937 random(seed);
  const std::vector<float> hostile = test::hostileArguments(), none{0.0f};
  const std::vector<float> few{0.0f, -1.5f, 1e-20f, 1e9f, HUGE_VALF, NAN};
  Points p;
  for (const float a : hostile)
    for (const float b : rows > 1 ? hostile : none)
      for (const float c : rows > 2 ? few : none) p.add(a, b, c);
  if (rows == 1)
    for (std::uint64_t bits = random() % effort.stride; bits >> 32 == 0; bits += effort.stride)
      p.add(std::bit_cast<float>(static_cast<std::uint32_t>(bits)), 0.0f, 0.0f);
  std::uniform_real_distribution<float> plain(-4.0f, 4.0f), exponent(-30.0f, 30.0f);
  for (std::uint32_t i = 0; rows > 1 && i < effort.count; ++i) {
    const float first = anyFloat(random);
    const auto other = [&] {
      switch (random() % 4) {
        case 0:
          return hostile[random() % hostile.size()];
        case 1:
          return plain(random);
        case 2:
          return first * std::exp2(exponent(random)) * plain(random);
        default:
          return anyFloat(random);
      }
    };
    const float second = other(), third = other();
    p.add(random() % 4 ? first : plain(random), second, third);
  }
  return p;
}

// What the batch readings give, values alone and with gradients, with one instruction set.
struct Outputs {
  std::string set;
  std::vector<float> value, valueBeside, slope[3];
};

// With each instruction set that the machine has; those that the library is not compiled for share one.
std::vector<Outputs> outputs(const Tape& tape, const Points& p) {
  std::vector<Outputs> all;
  hwy::SetSupportedTargetsForTest(0);
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    Outputs o{BatchEvaluator::targetName(), {}, {}, {}};
    if (std::any_of(all.begin(), all.end(), [&](const Outputs& known) { return known.set == o.set; }))
      continue;
    for (auto* row : {&o.value, &o.valueBeside, &o.slope[0], &o.slope[1], &o.slope[2]}) row->resize(p.size());
    BatchEvaluator().evaluate(tape, p.rows(), p.size(), o.value.data());
    BatchEvaluator().evaluateGradient(tape, p.rows(), p.size(), o.valueBeside.data(), o.slope[0].data(),
                                      o.slope[1].data(), o.slope[2].data());
    all.push_back(std::move(o));
  }
  hwy::SetSupportedTargetsForTest(0);
  return all;
}

// Says the first few things that are wrong, and counts the others.
class Faults {
 public:
  explicit Faults(unsigned seed) : seed_(seed) {}
  ~Faults() { EXPECT_EQ(count_, 0u) << "seed " << seed_; }
  template <class... Parts>
  void add(const Parts&... parts) {
    if (++count_ > 5) return;
    std::ostringstream text;
    (text << ... << parts);
    ADD_FAILURE() << text.str() << ", seed " << seed_;
  }

 private:
  unsigned seed_;
  std::size_t count_ = 0;
};

class Agreement : public testing::TestWithParam<Case> {};

std::string caseName(const testing::TestParamInfo<Case>& i) { return std::string(info(i.param.op).name); }

INSTANTIATE_TEST_SUITE_P(Graph, Agreement, testing::ValuesIn(graphOperations()), caseName);
INSTANTIATE_TEST_SUITE_P(Fused, Agreement, testing::ValuesIn(fusedOperations()), caseName);

TEST_P(Agreement, BatchKeepsItsPromise) {
  constexpr unsigned kSeed = 1;
  const Op op = GetParam().op;
  const Tape tape(GetParam().expr);
  const Instruction& last = tape.instructions().back();
  ASSERT_EQ(last.op, op) << "the tape compiler chose another instruction";
  const int constants = info(op).constants;
  const double minus = constants ? tape.constant(last.constants + constants - 1) : 0.0;
  const Points points = anyPoints(rowArguments(op), kSeed, {4001, 200000});
  const std::vector<Outputs> all = outputs(tape, points);
  ScalarReading<double> exact;
  Faults faults(kSeed);
  std::size_t inScope = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    exact.run(tape, {x, y, z, 0.0, 0.0, 0.0});
    Reading r{op, {x, y, z}, minus, exact.output(), 0.0f};
    if (!r.inScope()) continue;
    ++inScope;
    for (const Outputs& o : all)
      for (const float got : {o.value[i], o.valueBeside[i]})
        if (r.got = got; !r.agrees())
          faults.add(info(op).name, "(", x, ", ", y, ", ", z, ") gives ", got, ", not ", r.expected,
                     ": off by ", r.difference(), ", not ", r.allowed(), "; ", o.set);
  }
  EXPECT_GE(inScope, points.size() / 4) << "hardly anything is promised";
}

TEST_P(Agreement, IntervalContainsEverySample) {
  const Tape tape(GetParam().expr);
  const std::vector<float> all = arguments(3, 40);
  std::mt19937 random(4);
  auto pick = [&] { return all[random() % all.size()]; };
  for (int trial = 0; trial < 20000; ++trial) {
    double ends[3][2];
    for (auto& e : ends) {
      do e[0] = pick(), e[1] = trial % 4 ? pick() : e[0];
      while (std::isnan(e[0]) || std::isnan(e[1]));
      if (e[0] > e[1]) std::swap(e[0], e[1]);
    }
    const Interval range =
        evaluate(tape, Box{{ends[0][0], ends[1][0], ends[2][0]}, {ends[0][1], ends[1][1], ends[2][1]}});
    std::uniform_real_distribution<double> inside(0.0, 1.0);
    for (int sample = 0; sample < 8; ++sample) {
      glm::dvec3 p;
      for (int k = 0; k < 3; ++k) {
        const double t = sample < 2 ? sample : inside(random);
        p[k] = t == 0.0   ? ends[k][0]
               : t == 1.0 ? ends[k][1]
                          : std::clamp((1 - t) * ends[k][0] + t * ends[k][1], ends[k][0], ends[k][1]);
        if (std::isnan(p[k])) p[k] = ends[k][0];
      }
      const double value = evaluate(tape, p);
      ASSERT_TRUE(range.contains(value))
          << "trial " << trial << ": " << value << " at (" << p.x << ", " << p.y << ", " << p.z
          << ") is not in [" << range.lo << ", " << range.hi << "]" << (range.nan ? " or NaN" : "");
    }
  }
}

// The derivatives are within what follows for them from the promises for the operations they are made of; off
// kinks and overflow that is little.
TEST_P(Agreement, BatchGradientsKeepTheirPromise) {
  constexpr unsigned kSeed = 5;
  const Tape tape(GetParam().expr);
  const Points points = anyPoints(rowArguments(GetParam().op), kSeed, {40009, 20000});
  const std::vector<Outputs> all = outputs(tape, points);
  Faults faults(kSeed);
  std::size_t tight = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 p(points.x[i], points.y[i], points.z[i]);
    const glm::dvec3 expected = evaluateGradient(tape, glm::dvec3(p)).gradient;
    const std::array<Interval, 3> allowed = test::floatGradientRange(tape, p);
    bool isTight = true;
    for (int k = 0; k < 3; ++k) {
      isTight = isTight && allowed[k].width() <= std::max(std::abs(expected[k]) * 0x1p-16, 0x1p-126);
      for (const Outputs& o : all)
        if (!allowed[k].contains(o.slope[k][i]))
          faults.add(info(GetParam().op).name, "'s derivative along ", "xyz"[k], " at (", p.x, ", ", p.y,
                     ", ", p.z, ") is ", o.slope[k][i], ", in double ", expected[k], ", not in [",
                     allowed[k].lo, ", ", allowed[k].hi, "]; ", o.set);
    }
    tight += isTight;
  }
  std::printf("%.2f of %zu ranges are tight\n", static_cast<double>(tight) / points.size(), points.size());
  EXPECT_GE(tight, points.size() / 4) << "most ranges allow anything";
}

TEST(AgreementCases, CoverTheWholeOperationList) {
  std::vector<bool> covered(kOpCount, false);
  for (const Case& c : graphOperations()) covered[static_cast<int>(c.op)] = true;
  for (const Case& c : fusedOperations()) covered[static_cast<int>(c.op)] = true;
  for (int i = 0; i < kOpCount; ++i) {
    EXPECT_TRUE(covered[i] || !isOperation(static_cast<Op>(i))) << kOps[i].name;
  }
}

}  // namespace agreement_test
}  // namespace sdf
