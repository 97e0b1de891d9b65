#include "sdf/eval/batch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>

#include "sdf/eval/exact_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sdf/eval/batch.cpp"
#include <hwy/aligned_allocator.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sdf/eval/lanes-inl.h"
#include "sdf/expr/apply-inl.h"

#ifndef SDF_BATCH_JOB
#define SDF_BATCH_JOB
namespace sdf {
/// Rows beside the tape's registers, one for each argument, for constants where a loop wants a row.
inline constexpr std::uint32_t kSpareRows = 3;
/// One pass of a tape over at most kBatchPoints points. Pointers to registers, the spare rows last; gradients
/// lie `stride` floats further on.
struct BatchJob {
  const Tape* tape;
  float* const* registers;
  std::size_t count;   // points, rounded up to whole vectors
  std::size_t stride;  // floats from a value's row to its derivative rows
};
struct BallJob {
  BatchJob batch;
  float radius;
  float slack;
  std::size_t balls;
  Decision* decisions;
};
}  // namespace sdf
#endif

HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {

using Gradient = Dual<Lanes, 3>;

// How numbers lie in the rows: values, and derivatives `stride` floats apart.
template <class T>
SDF_INLINE T load(const float* p, std::size_t stride) {
  const Lanes value = hn::Load(kD, p);
  if constexpr (std::is_same_v<T, Lanes>)
    return value;
  else
    return {value, {hn::Load(kD, p + stride), hn::Load(kD, p + 2 * stride), hn::Load(kD, p + 3 * stride)}};
}
SDF_INLINE void store(const Lanes& a, float* p, std::size_t) { hn::Store(a.v, kD, p); }
SDF_INLINE void store(const Gradient& a, float* p, std::size_t stride) {
  hn::Store(a.v.v, kD, p);
  for (int i = 0; i < 3; ++i) hn::Store(a.d[i].v, kD, p + (i + 1) * stride);
}
template <class T>
SDF_INLINE T number(float v) {
  const Lanes value(static_cast<double>(v));
  if constexpr (std::is_same_v<T, Lanes>)
    return value;
  else
    return {value, {}};
}

// An argument: a row to load from, or a constant kept in a vector. Which of them is known as the loop is
// compiled.
template <class T, bool kConstant>
struct Argument;

template <class T>
struct Argument<T, false> {
  const float* row;
  std::size_t stride;
  SDF_INLINE Argument(const BatchJob& job, const RegisterInstruction& n, int k)
      : row(HWY_UNLIKELY(n.constant[k]) ? filledRow(job, n, k) : job.registers[n.in[k]]),
        stride(job.stride) {}
  SDF_INLINE T operator()(std::size_t i) const { return load<T>(row + i, stride); }

  // Constants in unusual places (specialisation leaves some) are spread over a spare row.
  static HWY_NOINLINE const float* filledRow(const BatchJob& job, const RegisterInstruction& n, int k) {
    float* spare = job.registers[job.tape->registerCount() + k];
    const T value = number<T>(job.tape->floats()[n.in[k]]);
    for (std::size_t i = 0; i < job.count; i += hn::Lanes(kD)) store(value, spare + i, job.stride);
    return spare;
  }
};

template <class T>
struct Argument<T, true> {
  T value;
  SDF_INLINE Argument(const BatchJob& job, const RegisterInstruction& n, int k)
      : value(number<T>(job.tape->floats()[n.in[k]])) {}
  SDF_INLINE const T& operator()(std::size_t) const { return value; }
};

// Two vectors at once, which hides latencies. `constants` are the trailing arguments of a fused operation.
template <class T, Op op, std::size_t... kConstants, class... Args>
SDF_INLINE void loop(const BatchJob& job, const RegisterInstruction& n, std::index_sequence<kConstants...>,
                     const Args&... args) {
  const float* c = job.tape->floats() + n.constants;
  [[maybe_unused]] const T constants[] = {number<T>(c[0]), number<T>(c[kConstants])...};
  float* out = job.registers[n.out];
  const std::size_t step = hn::Lanes(kD);
  for (std::size_t i = 0; i < job.count; i += 2 * step) {
    const T first = apply<op>(args(i)..., constants[kConstants + 1]...);
    const T second = apply<op>(args(i + step)..., constants[kConstants + 1]...);
    store(first, out + i, job.stride);
    store(second, out + i + step, job.stride);
  }
}

// Runs one instruction: picks the loop for the kinds of its arguments.
template <class T, Op op>
void runInstruction(const BatchJob& job, const RegisterInstruction& n) {
  using Row = Argument<T, false>;
  using Number = Argument<T, true>;
  constexpr int kRows = rowArguments(op);
  const std::make_index_sequence<info(op).constants> constants;
  const Row a(job, n, 0);
  if constexpr (kRows == 1) {
    loop<T, op>(job, n, constants, a);
  } else if constexpr (kRows == 2) {
    if (n.constant[0])
      loop<T, op>(job, n, constants, Number(job, n, 0), Row(job, n, 1));
    else if (n.constant[1])
      loop<T, op>(job, n, constants, a, Number(job, n, 1));
    else
      loop<T, op>(job, n, constants, a, Row(job, n, 1));
  } else {
    const int kinds = n.constant[1] + 2 * n.constant[2];
    if (kinds == 0) loop<T, op>(job, n, constants, a, Row(job, n, 1), Row(job, n, 2));
    if (kinds == 1) loop<T, op>(job, n, constants, a, Number(job, n, 1), Row(job, n, 2));
    if (kinds == 2) loop<T, op>(job, n, constants, a, Row(job, n, 1), Number(job, n, 2));
    if (kinds == 3) loop<T, op>(job, n, constants, a, Number(job, n, 1), Number(job, n, 2));
  }
}

// A payload writes to rows of its own, for the instruction's may be those of its arguments.
template <class T>
HWY_NOINLINE void runPayload(const BatchJob& job, const RegisterInstruction& n, const PayloadPart& part) {
  const Argument<T, false> a(job, n, 0), b(job, n, 1), c(job, n, 2);
  HWY_ALIGN float f[4][kBatchPoints];
  constexpr bool kSlopes = std::is_same_v<T, Gradient>;
  payloadSlopes(part, {a.row, b.row, c.row}, job.count, kSlopes, {f[0], f[1], f[2], f[3]});
  for (std::size_t i = 0; i < job.count; i += hn::Lanes(kD)) {
    const auto row = [&](int k) HWY_ATTR { return Lanes(hn::Load(kD, f[k] + i)); };
    float* out = job.registers[n.out] + i;
    if constexpr (kSlopes)
      store(chain(a(i), b(i), c(i), row(0), row(1), row(2), row(3)), out, job.stride);
    else
      store(row(0), out, job.stride);
  }
}

template <class T>
SDF_INLINE void runInstruction(const BatchJob& job, const RegisterInstruction& n) {
  if (const PayloadPart* part = job.tape->payload(n); HWY_UNLIKELY(part)) return runPayload<T>(job, n, *part);
  dispatch(n.op, [&](auto tag) HWY_ATTR { runInstruction<T, tag.value>(job, n); });
}

void RunValues(const BatchJob& job) {
  for (const RegisterInstruction& n : job.tape->program()) runInstruction<Lanes>(job, n);
}

void RunGradients(const BatchJob& job) {
  for (const RegisterInstruction& n : job.tape->program()) runInstruction<Gradient>(job, n);
}

// Where a - b leaves [-margin, margin] the ball is decided; the instruction's meaning says which way.
void decide(const BallJob& job, const RegisterInstruction& n, float slopes, Decision* out) {
  const float* a = n.constant[0] ? nullptr : job.batch.registers[n.in[0]];
  const float* b = n.constant[1] ? nullptr : job.batch.registers[n.in[1]];
  const float ca = n.constant[0] ? job.batch.tape->floats()[n.in[0]] : 0.0f;
  const float cb = n.constant[1] ? job.batch.tape->floats()[n.in[1]] : 0.0f;
  const float margin = slopes * job.radius + job.slack;
  const Choice choice = choiceOf(n.op);
  const bool lowerFirst = choice == Choice::Least || choice == Choice::IsLess;
  const auto below = lowerFirst ? Decision::First : Decision::Second;
  const auto above = choice == Choice::Greatest ? Decision::First : Decision::Second;
  for (std::size_t i = 0; i < job.balls; ++i) {
    const float difference = (a ? a[i] : ca) - (b ? b[i] : cb);
    out[i] = difference < -margin ? below : difference > margin ? above : Decision::Open;
  }
}

void RunBalls(const BallJob& job) {
  const Tape& tape = *job.batch.tape;
  Decision* out = job.decisions;
  for (std::size_t i = 0; i < tape.program().size(); ++i) {
    const RegisterInstruction& n = tape.program()[i];
    if (isDecidable(n.op)) {
      const Instruction& source = tape.instructions()[i];
      const float slopes = tape.slope(source.in[0]) + tape.slope(source.in[1]);
      if (choiceOf(n.op) == Choice::Selected || !(slopes < HUGE_VALF))
        std::fill_n(out, job.balls, Decision::Open);
      else
        decide(job, n, slopes, out);
      out += job.balls;
    }
    runInstruction<Lanes>(job.batch, n);
  }
}

const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf {

HWY_EXPORT(RunValues);
HWY_EXPORT(RunGradients);
HWY_EXPORT(RunBalls);
HWY_EXPORT(TargetName);

namespace {

constexpr std::size_t kGranule = 32;  // two of the widest vectors: what a loop takes at once
constexpr std::size_t kL1Bytes =
    32 * 1024;  // what a pass may keep in registers, so that they stay in the first cache
constexpr std::size_t kSmallestPass = 64;

std::size_t wholeVectors(std::size_t count) { return (count + kGranule - 1) / kGranule * kGranule; }

// Points in one pass of a tape with so many rows.
std::size_t passLength(std::size_t rows) {
  std::size_t points = kBatchPoints;
  while (points > kSmallestPass && rows * points * sizeof(float) > kL1Bytes) points /= 2;
  return points;
}

}  // namespace

struct BatchEvaluator::Scratch {
  ExactBatch exact;
  hwy::AlignedFreeUniquePtr<float[]> memory;
  std::size_t capacity = 0;
  std::vector<float*> registers;

  // Lays out the registers of a tape and the spare rows, `rows` rows of `length` floats each.
  void layOut(const Tape& tape, std::size_t rows, std::size_t length) {
    const std::size_t count = tape.registerCount() + kSpareRows;
    const std::size_t needed = count * rows * length;
    if (needed > capacity) {
      memory = hwy::AllocateAligned<float>(needed);
      std::fill_n(memory.get(), needed, 0.0f);
      capacity = needed;
    }
    registers.resize(count);
    for (std::size_t i = 0; i < count; ++i) registers[i] = memory.get() + i * rows * length;
  }
};

BatchEvaluator::BatchEvaluator() : scratch_(std::make_unique<Scratch>()) {}
BatchEvaluator::~BatchEvaluator() = default;
BatchEvaluator::BatchEvaluator(BatchEvaluator&&) noexcept = default;

const char* BatchEvaluator::targetName() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

namespace {

// Copies the tape's value of one output, wherever it ended up, to a row of the caller; or its derivative, so
// many floats further on.
void copyOutput(const Tape& tape, std::size_t i, float* const* registers, std::size_t count, float* out,
                std::size_t derivative = 0) {
  const Operand o = tape.programOutputs()[i];
  if (o.isConstant())
    std::fill_n(out, count, derivative == 0 ? tape.floats()[o.index()] : 0.0f);
  else
    std::memcpy(out, registers[o.isValue() ? o.index() + kVariableCount : o.index()] + derivative,
                count * sizeof(float));
}

// The lanes beyond the last point repeat it: sin and pow take another way when any lane asks for it, so what
// an earlier call left there would show in the values.
void copyInputs(const Rows& in, std::size_t first, std::size_t count, float* const* registers) {
  const float* const rows[kVariableCount] = {in.x, in.y, in.z, in.nx, in.ny, in.nz};
  for (int v = 0; v < kVariableCount; ++v) {
    if (!rows[v] || count == 0) continue;
    std::memcpy(registers[v], rows[v] + first, count * sizeof(float));
    std::fill(registers[v] + count, registers[v] + wholeVectors(count), rows[v][first + count - 1]);
  }
}

}  // namespace

void BatchEvaluator::evaluate(const Tape& tape, const Rows& in, std::size_t count,
                              std::span<float* const> out) {
  assert(out.size() <= tape.outputs().size());
  if (tape.isExact()) return scratch_->exact.evaluate(tape, in, count, out);
  const std::size_t length = std::min(passLength(tape.registerCount()), wholeVectors(count));
  scratch_->layOut(tape, 1, length);
  float** registers = scratch_->registers.data();
  for (std::size_t first = 0; first < count; first += length) {
    const std::size_t n = std::min(length, count - first);
    copyInputs(in, first, n, registers);
    HWY_DYNAMIC_DISPATCH(RunValues)({&tape, registers, wholeVectors(n), 0});
    for (std::size_t i = 0; i < out.size(); ++i) copyOutput(tape, i, registers, n, out[i] + first);
  }
}

void BatchEvaluator::evaluateGradient(const Tape& tape, const Rows& in, std::size_t count, float* value,
                                      float* dx, float* dy, float* dz) {
  if (tape.isExact()) return scratch_->exact.evaluateGradient(tape, in, count, {value, dx, dy, dz});
  const std::size_t length = std::min(passLength(4 * tape.registerCount()), wholeVectors(count));
  scratch_->layOut(tape, 4, length);
  float** registers = scratch_->registers.data();
  for (int v = 0; v < kVariableCount; ++v)
    for (int axis = 0; axis < 3; ++axis)
      std::fill_n(registers[v] + (axis + 1) * length, length, v == axis ? 1.0f : 0.0f);
  float* const targets[4] = {value, dx, dy, dz};
  for (std::size_t first = 0; first < count; first += length) {
    const std::size_t n = std::min(length, count - first);
    copyInputs(in, first, n, registers);
    HWY_DYNAMIC_DISPATCH(RunGradients)({&tape, registers, wholeVectors(n), length});
    for (int k = 0; k < 4; ++k) copyOutput(tape, 0, registers, n, targets[k] + first, k * length);
  }
}

void BatchEvaluator::evaluateExactly(const Tape& tape, std::span<const glm::dvec3> points, float* out) {
  scratch_->exact.evaluate(tape, points, out);
}

void BatchEvaluator::evaluateGradientExactly(const Tape& tape, std::span<const glm::dvec3> points,
                                             float* value, float* dx, float* dy, float* dz) {
  scratch_->exact.evaluateGradient(tape, points, {value, dx, dy, dz});
}

void BatchEvaluator::evaluateBalls(const Tape& tape, const Rows& in, std::size_t count, float radius,
                                   float slack, float* value, std::vector<Decision>& decisions) {
  assert(count <= kBatchPoints);
  decisions.resize(tape.decisionCount() * count);
  if (tape.isExact())
    return scratch_->exact.evaluateBalls(tape, in, count, radius, slack, value, decisions.data());
  const std::size_t padded = wholeVectors(count);
  scratch_->layOut(tape, 1, padded);
  float** registers = scratch_->registers.data();
  copyInputs(in, 0, count, registers);
  HWY_DYNAMIC_DISPATCH(RunBalls)({{&tape, registers, padded, 0}, radius, slack, count, decisions.data()});
  copyOutput(tape, 0, registers, count, value);
}

}  // namespace sdf
#endif  // HWY_ONCE
