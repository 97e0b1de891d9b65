#include "sdf/eval/rounding.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/eval/promise.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/eval/tape_compiler.h"

namespace sdf {
namespace {

constexpr double kAnyNumber = 1e200;

// The distance of the floats around x.
double ulpOf(double x) {
  constexpr int kDigits = 23;
  const double a = std::abs(x);
  return a > 0.0 ? std::max(0x1p-149, std::ldexp(1.0, std::ilogb(a) - kDigits)) : 0x1p-149;
}

// What rounding to float changes.
double roundingOf(double x) {
  return x == static_cast<float>(x) || std::isnan(x)
             ? 0.0
             : std::min(std::abs(x - static_cast<float>(x)), kAnyNumber);
}

// By how much a value is another one; any number where only one is a number.
double between(double a, double b) {
  if (a == b || std::isnan(a)) return 0.0;
  const double d = std::abs(a - b);
  return d <= kAnyNumber ? d : kAnyNumber;
}

// An instruction's arguments at a point, its constants among them.
struct Arguments {
  std::array<double, kMaxArity> value{}, error{};
  int count = 0;

  bool areFloats() const {
    return std::all_of(error.begin(), error.begin() + count, [](double e) { return e == 0.0; });
  }
};

// What the batch reading adds by itself, if its arguments are right up to their errors.
double ownRounding(const Instruction& n, const PayloadPart* payload, const Arguments& a, double value) {
  if (payload)
    return payload->part == 0 ? payload->payload->rounding({a.value[0], a.value[1], a.value[2]}) +
                                    promise(Op::Payload).ulps * ulpOf(value)
                              : 0.0;
  const Promise p = promise(n.op);
  for (int k = 0; k < a.count; ++k)
    if (std::abs(a.value[k]) > p.largest) return kAnyNumber;
  if (!std::isfinite(value)) return 0.0;
  if (std::abs(value) >= 0x1p128) return kAnyNumber;
  // Rounded once from floats: the error is the one that this makes.
  if (p.ulps == 0.5 && p.of == Promise::Of::Nothing && a.areFloats()) return roundingOf(value);
  const double own = p.ulps * ulpOf(value);
  switch (p.of) {
    case Promise::Of::Dividend: {
      const double quotient = a.value[0] / a.value[1];
      const bool reaches = std::floor(quotient) != std::floor(static_cast<float>(quotient));
      if (!reaches && a.areFloats() && roundingOf(value) == 0.0) return 0.0;
      return own + p.more * ulpOf(a.value[0]) + (reaches ? std::abs(a.value[1]) : 0.0);
    }
    case Promise::Of::Product:
      if (a.areFloats() && roundingOf(a.value[0] * a.value[1]) == 0.0) return roundingOf(value);
      return own + p.more * ulpOf(a.value[0] * a.value[1]);
    case Promise::Of::Length:
      return own + std::max(p.more * ulpOf(value + a.value[a.count - 1]), 0x1p-74);
    default:
      return own;
  }
}

// The larger change of the value as argument k moves to either end of its error.
double changeBy(int k, const Instruction& n, const PayloadPart* payload, const Arguments& a, double value) {
  double change = 0.0;
  if (a.error[k] == 0.0) return change;
  std::array<double, kMaxArity> moved = a.value;
  for (const double by : {a.error[k], -a.error[k]}) {
    moved[k] = a.value[k] + by;
    change =
        std::max(change, between(value, evaluateOp<double>(n.op, payload, [&](int i) { return moved[i]; })));
  }
  return change;
}

}  // namespace

double RoundingBounds::value(Operand a) const {
  if (a.isConstant()) return tape_->constant(a.index());
  return a.isVariable() ? variables_[a.index()] : steps_[a.index()].value;
}

double RoundingBounds::error(Operand a) const {
  if (a.isConstant()) return roundingOf(tape_->constant(a.index()));
  return a.isVariable() ? 0.0 : steps_[a.index()].error;
}

void RoundingBounds::run(const Tape& tape, const std::array<double, kVariableCount>& variables) {
  tape_ = &tape;
  variables_ = variables;
  steps_.clear();
  for (const Instruction& n : tape.instructions()) {
    const PayloadPart* const payload = tape.payload(n);
    const int rows = payload ? 3 : rowArguments(n.op);
    Arguments a;
    a.count = payload ? rows : arity(n.op);
    for (int k = 0; k < a.count; ++k) {
      const Operand from =
          k < rows ? n.in[k] : Operand::constant(n.constants + static_cast<std::uint32_t>(k - rows));
      a.value[k] = value(from), a.error[k] = error(from);
    }
    Step step{evaluateOp<double>(n.op, payload, [&](int k) { return a.value[k]; }), 0.0, 0.0, {}};
    step.own = ownRounding(n, payload, a, step.value);
    for (int k = 0; k < a.count; ++k) {
      const double change = changeBy(k, n, payload, a, step.value);
      (k < rows && n.in[k].isValue() ? step.inherited[k] : step.own) += change;
    }
    step.error =
        std::min(kAnyNumber, step.own + std::accumulate(step.inherited.begin(), step.inherited.end(), 0.0));
    steps_.push_back(step);
  }
}

std::vector<double> RoundingBounds::shares(Operand of) const {
  std::vector<double> all(steps_.size(), 0.0);
  if (!of.isValue()) return all;
  all[of.index()] = steps_[of.index()].error;
  for (std::size_t i = of.index() + 1; i-- > 0;) {
    const Step& step = steps_[i];
    if (all[i] == 0.0) continue;
    const double part = all[i] / step.error;
    for (std::size_t k = 0; k < step.inherited.size(); ++k)
      if (step.inherited[k] > 0.0) all[tape_->instructions()[i].in[k].index()] += part * step.inherited[k];
    all[i] = part * step.own;
  }
  return all;
}

namespace {

constexpr int kPoints = 16, kFewPoints = 4;
constexpr double kErrorsFromZero = 4096.0;

// Point i of a sequence that fills the box evenly, its middle and what else formulas begin at left out: there
// a length, say, is at a kink (Roberts, "The unreasonable effectiveness of quasirandom
// sequences", 2018: steps by powers of 1 / g, where g^4 = g + 1).
glm::dvec3 pointIn(const Box& box, int i) {
  constexpr double kStep = 0.8191725133961645;  // 1 / g
  glm::dvec3 share(kStep, kStep * kStep, kStep * kStep * kStep);
  share *= static_cast<double>(i + 1);
  return box.min + (share - glm::floor(share)) * box.size();
}

// Marks the instructions with the largest shares of an error, until what is left keeps the tolerance.
void mark(const std::vector<double>& shares, double tolerance, std::vector<bool>& marked) {
  std::vector<std::size_t> order;
  double left = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] == 0.0 || marked[i]) continue;
    order.push_back(i);
    left += shares[i];
  }
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  for (const std::size_t i : order) {
    if (left <= tolerance) return;
    marked[i] = true;
    left -= shares[i];
  }
}

// The instructions that break the accuracy.
std::vector<bool> marksOf(const Tape& tape, const Accuracy& accuracy, int points) {
  const glm::dvec3 normal(0.36, 0.48, 0.8);
  std::vector<bool> marked(tape.instructions().size());
  if (accuracy.region.empty() || !accuracy.region.finite()) return marked;
  RoundingBounds bounds;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 p = pointIn(accuracy.region, i);
    bounds.run(tape, {p.x, p.y, p.z, normal.x, normal.y, normal.z});
    for (std::size_t k = 0; k < tape.outputs().size(); ++k) {
      const Operand output = tape.outputs()[k];
      const double error = bounds.error(output);
      double tolerance = accuracy.others;
      if (k == 0) {
        if (!(error * kErrorsFromZero > std::abs(bounds.value(output)))) continue;
        tolerance = accuracy.distance * glm::length(evaluateGradient(tape, p).gradient);
      }
      if (error > tolerance) mark(bounds.shares(output), tolerance, marked);
    }
  }
  return marked;
}

}  // namespace

TapePtr withAccuracy(const TapePtr& tape, const Accuracy& accuracy) {
  const std::vector<bool> marked = marksOf(*tape, accuracy, kPoints);
  return std::ranges::find(marked, true) == marked.end() ? tape : tape->readExactly(marked);
}

std::vector<Expr> exactNodes(std::span<const Expr> outputs, const Accuracy& accuracy) {
  TapeCompiler compiler(outputs, false);
  const std::vector<Expr> nodes = compiler.takeNodes();
  const std::vector<bool> marked = marksOf(compiler.take(), accuracy, kFewPoints);
  std::vector<Expr> exact;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i]) exact.push_back(nodes[i]);
  return exact;
}

}  // namespace sdf
