#include "sdf/eval/exact_batch.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

using Gradient3 = Dual<double, 3>;

constexpr std::size_t kPass = 128;  // points that a pass takes: 1 KiB a register

template <class T>
T constantOf(double v) {
  if constexpr (std::is_same_v<T, double>)
    return v;
  else
    return constant<double, 3>(v);
}

template <class T>
T variableOf(int v, double value) {
  T result = constantOf<T>(value);
  if constexpr (std::is_same_v<T, Gradient3>)
    if (v < 3) result.d[v] = 1.0;
  return result;
}

// An argument at the points of a pass.
template <class T>
struct ExactArgument {
  const T* row = nullptr;  // none for a constant
  T constant{};
  const T& operator()(std::size_t i) const { return row ? row[i] : constant; }
};

// The operation over the rows. `constants` are the trailing arguments of a fused one.
template <Op op, class T, std::size_t... kRows, std::size_t... kConstants>
void overRows(const ExactArgument<T> (&a)[3], const double* constants, std::size_t count, T* out,
              std::index_sequence<kRows...>, std::index_sequence<kConstants...>) {
  [[maybe_unused]] const T numbers[] = {T{}, constantOf<T>(constants[kConstants])...};
  if ((... && (a[kRows].row != nullptr)))
    for (std::size_t i = 0; i < count; ++i)
      out[i] = apply<op>(a[kRows].row[i]..., numbers[kConstants + 1]...);
  else
    for (std::size_t i = 0; i < count; ++i) out[i] = apply<op>(a[kRows](i)..., numbers[kConstants + 1]...);
}

// A tape's program in number type T, over rows of points.
template <class T>
class ExactPass {
 public:
  void layOut(const Tape& tape) { registers_.resize(tape.registerCount() * kPass); }

  void fill(const Rows& in, std::size_t first, std::size_t count) {
    const float* const rows[kVariableCount] = {in.x, in.y, in.z, in.nx, in.ny, in.nz};
    for (int v = 0; v < kVariableCount; ++v)
      for (std::size_t i = 0; rows[v] && i < count; ++i)
        row(static_cast<std::uint32_t>(v))[i] = variableOf<T>(v, rows[v][first + i]);
  }
  void fill(std::span<const glm::dvec3> points, std::size_t first, std::size_t count) {
    for (int v = 0; v < 3; ++v)
      for (std::size_t i = 0; i < count; ++i)
        row(static_cast<std::uint32_t>(v))[i] = variableOf<T>(v, points[first + i][v]);
  }

  ExactArgument<T> argument(const Tape& tape, const RegisterInstruction& n, int k) {
    if (n.constant[k]) return {nullptr, constantOf<T>(tape.constant(n.in[k]))};
    return {row(n.in[k]), T{}};
  }

  void run(const Tape& tape, const RegisterInstruction& n, std::size_t count) {
    T* const out = row(n.out);
    const PayloadPart* const part = tape.payload(n);
    ExactArgument<T> a[3];
    for (int k = 0; k < (part ? 3 : rowArguments(n.op)); ++k) a[k] = argument(tape, n, k);
    if (part) {
      for (std::size_t i = 0; i < count; ++i) out[i] = payloadAt(*part, a[0](i), a[1](i), a[2](i));
      return;
    }
    double constants[4]{};
    for (int k = 0; k < info(n.op).constants; ++k)
      constants[k] = tape.constant(n.constants + static_cast<std::uint32_t>(k));
    dispatch(n.op, [&](auto tag) {
      overRows<tag.value, T>(a, constants, count, out, std::make_index_sequence<rowArguments(tag.value)>(),
                             std::make_index_sequence<info(tag.value).constants>());
    });
  }

  /// Runs the tape at the points and calls take(i) for the number of each, which output(i, k) is at place k
  /// of.
  template <class Points, class Take>
  void overPoints(const Tape& tape, const Points& points, std::size_t count, const Take& take) {
    layOut(tape);
    for (std::size_t first = 0; first < count; first += kPass) {
      const std::size_t n = std::min(kPass, count - first);
      fill(points, first, n);
      for (const RegisterInstruction& instruction : tape.program()) run(tape, instruction, n);
      for (std::size_t k = 0; k < n; ++k) take(first + k, k);
    }
  }

  T output(const Tape& tape, std::size_t i, std::size_t k) const {
    const Operand o = tape.programOutputs()[i];
    if (o.isConstant()) return constantOf<T>(tape.constant(o.index()));
    return registers_[(o.isValue() ? o.index() + kVariableCount : o.index()) * kPass + k];
  }

 private:
  T* row(std::uint32_t r) { return &registers_[r * kPass]; }

  std::vector<T> registers_;
};

template <class Points>
void gradientOver(ExactPass<Gradient3>& pass, const Tape& tape, const Points& points, std::size_t count,
                  float* const (&out)[4]) {
  pass.overPoints(tape, points, count, [&](std::size_t i, std::size_t k) {
    const Gradient3 r = pass.output(tape, 0, k);
    out[0][i] = static_cast<float>(r.v);
    for (int axis = 0; axis < 3; ++axis) out[axis + 1][i] = static_cast<float>(r.d[axis]);
  });
}

// Where a - b leaves [-margin, margin] the ball is decided, as in the float reading.
void decideExactly(const Tape& tape, const Instruction& n, const ExactArgument<double>& a,
                   const ExactArgument<double>& b, std::size_t count, double radius, double slack,
                   Decision* out) {
  const double slopes = static_cast<double>(tape.slope(n.in[0])) + tape.slope(n.in[1]);
  const Choice choice = choiceOf(n.op);
  if (choice == Choice::Selected || !(slopes < HUGE_VAL)) {
    std::fill_n(out, count, Decision::Open);
    return;
  }
  const double margin = slopes * radius + slack;
  const bool lowerFirst = choice == Choice::Least || choice == Choice::IsLess;
  const Decision below = lowerFirst ? Decision::First : Decision::Second;
  const Decision above = choice == Choice::Greatest ? Decision::First : Decision::Second;
  for (std::size_t k = 0; k < count; ++k) {
    const double apart = a(k) - b(k);
    out[k] = apart < -margin ? below : apart > margin ? above : Decision::Open;
  }
}

}  // namespace

struct ExactBatch::Scratch {
  ExactPass<double> values;
  ExactPass<Gradient3> gradients;
};

ExactBatch::ExactBatch() : scratch_(std::make_unique<Scratch>()) {}
ExactBatch::~ExactBatch() = default;

void ExactBatch::evaluate(const Tape& tape, const Rows& in, std::size_t count, std::span<float* const> out) {
  ExactPass<double>& pass = scratch_->values;
  pass.overPoints(tape, in, count, [&](std::size_t i, std::size_t k) {
    for (std::size_t o = 0; o < out.size(); ++o) out[o][i] = static_cast<float>(pass.output(tape, o, k));
  });
}

void ExactBatch::evaluate(const Tape& tape, std::span<const glm::dvec3> points, float* out) {
  ExactPass<double>& pass = scratch_->values;
  pass.overPoints(tape, points, points.size(), [&](std::size_t i, std::size_t k) {
    out[i] = static_cast<float>(pass.output(tape, 0, k));
  });
}

void ExactBatch::evaluateGradient(const Tape& tape, const Rows& in, std::size_t count,
                                  float* const (&out)[4]) {
  gradientOver(scratch_->gradients, tape, in, count, out);
}

void ExactBatch::evaluateGradient(const Tape& tape, std::span<const glm::dvec3> points,
                                  float* const (&out)[4]) {
  gradientOver(scratch_->gradients, tape, points, points.size(), out);
}

void ExactBatch::evaluateBalls(const Tape& tape, const Rows& in, std::size_t count, double radius,
                               double slack, float* value, Decision* decisions) {
  ExactPass<double>& pass = scratch_->values;
  pass.layOut(tape);
  for (std::size_t first = 0; first < count; first += kPass) {
    const std::size_t n = std::min(kPass, count - first);
    pass.fill(in, first, n);
    Decision* out = decisions + first;
    for (std::size_t i = 0; i < tape.program().size(); ++i) {
      const RegisterInstruction& r = tape.program()[i];
      if (isDecidable(r.op)) {
        decideExactly(tape, tape.instructions()[i], pass.argument(tape, r, 0), pass.argument(tape, r, 1), n,
                      radius, slack, out);
        out += count;
      }
      pass.run(tape, r, n);
    }
    for (std::size_t k = 0; k < n; ++k) value[first + k] = static_cast<float>(pass.output(tape, 0, k));
  }
}

}  // namespace sdf
