#include "sdf/proof/reading.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sdf/proof/reading.cpp"
#include <hwy/aligned_allocator.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sdf/expr/apply-inl.h"
#include "sdf/proof/patterns.h"
#include "sdf/proof/terms-inl.h"

#ifndef SDF_PROOF_JOB
#define SDF_PROOF_JOB
namespace sdf {
struct ProofReading::Memory {
  hwy::AlignedFreeUniquePtr<double[]> bytes;
  std::size_t capacity = 0;
  std::vector<Pattern> patterns;

  void* take(std::size_t size) {
    if (size > capacity) {
      bytes = hwy::AllocateAligned<double>(size / sizeof(double) + 1);
      capacity = size;
    }
    return bytes.get();
  }
};

struct PrismJob {
  const Tape& tape;
  ProofReading::Memory& memory;
  std::span<const Prism> prisms;
  PrismBounds* out;
};
struct BoxJob {
  const Tape& tape;
  ProofReading::Memory& memory;
  std::span<const Box> boxes;
  Interval* out;
};
}  // namespace sdf
#endif

HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {

SDF_INLINE M none() { return hn::FirstN(kD, 0); }

// Runs a tape over terms of one kind.
template <class T>
class TermReading {
 public:
  TermReading(const Tape& tape, ProofReading::Memory& memory)
      : tape_(tape), patterns_(memory.patterns), unsure_(none()) {
    terms_ = static_cast<T*>(memory.take(sizeof(T) * (tape.instructions().size() + 1)));
  }

  T run(const T (&variables)[kVariableCount]) {
    variables_ = variables;
    unsure_ = none();
    const auto lengthOf3 = [&](const auto& part) {
      return sqrt(addKeepingSign(square(part(variables[0])),
                                 addKeepingSign(square(part(variables[1])), square(part(variables[2])))))
          .hi;
    };
    for (int k = 0; k < 3; ++k) ways_[k] = lengthOf3([&](const T& x) { return x.d[k]; });
    if constexpr (T::kFlat)
      for (int k = 0; k < 2; ++k) sides_[k] = lengthOf3([&](const T& x) { return x.s[k]; });
    for (std::size_t at = 0; at < tape_.instructions().size(); ++at) {
      terms_[at] = term(at);
      if (const float slope = tape_.instructions()[at].lipschitz; slope < HUGE_VALF)
        narrowSlopes(slope, ways_, sides_, terms_[at]);
    }
    return operand(tape_.outputs()[0]);
  }
  // Lanes in which something may be no number.
  M unsure() const { return unsure_; }

 private:
  T operand(Operand a) const {
    if (a.isConstant()) return constantTerm<T>(tape_.constant(a.index()));
    return a.isVariable() ? variables_[a.index()] : terms_[a.index()];
  }

  T term(std::size_t at) {
    const Instruction& n = tape_.instructions()[at];
    const Pattern& pattern = patterns_[at];
    if (pattern.kind == Pattern::BoxDistance) return box(pattern);
    T r = pattern.kind == Pattern::Corner ? box(pattern) : plain(n);
    if (pattern.kind == Pattern::Corner)
      narrowCorner(pattern.k, operand(pattern.sides[0]), operand(pattern.sides[1]), r);
    if (pattern.kind == Pattern::Blend)
      narrowBlend(pattern.k, pattern.isMin, operand(pattern.parts[0]), operand(pattern.parts[1]), r);
    return r;
  }

  T box(const Pattern& pattern) {
    BoxParts<T> box;
    box.outside = operand(pattern.outside);
    box.inside = operand(pattern.inside);
    box.most = operand(pattern.most);
    for (int i = 0; i < pattern.count; ++i) {
      box.parts[i] = operand(pattern.parts[i]);
      box.clipped[i] = larger(box.parts[i], constantTerm<T>(0.0));
      box.isInside[i] = pattern.isInside[i];
    }
    box.otherCount = pattern.otherCount;
    for (int i = 0; i < pattern.otherCount; ++i) box.others[i] = operand(pattern.others[i]);
    return pattern.count == 1   ? boxDistance<1>(box)
           : pattern.count == 2 ? boxDistance<2>(box)
                                : boxDistance<3>(box);
  }

  double constantOf(const Instruction& n, int k) const { return tape_.constant(n.constants + k); }
  T in(const Instruction& n, int k) const { return operand(n.in[k]); }

  T plain(const Instruction& n) {
    if (n.op == Op::Payload) return laneByLane(n);
    return dispatch(n.op, [&](auto op) HWY_ATTR { return valueOf(op, n); });
  }

  // The operations that terms have; the others take the last of these.
  template <Op op>
  using Is = std::integral_constant<Op, op>;
  T valueOf(Is<Op::Neg>, const Instruction& n) { return negated(in(n, 0)); }
  T valueOf(Is<Op::Add>, const Instruction& n) { return sum(in(n, 0), in(n, 1)); }
  T valueOf(Is<Op::Sub>, const Instruction& n) { return sum(in(n, 0), negated(in(n, 1))); }
  T valueOf(Is<Op::Mul>, const Instruction& n) { return product(in(n, 0), in(n, 1)); }
  T valueOf(Is<Op::MulAdd>, const Instruction& n) { return sum(product(in(n, 0), in(n, 1)), in(n, 2)); }
  T valueOf(Is<Op::Square>, const Instruction& n) { return squareOf(in(n, 0)); }
  T valueOf(Is<Op::Min>, const Instruction& n) { return smaller(in(n, 0), in(n, 1)); }
  T valueOf(Is<Op::Max>, const Instruction& n) { return larger(in(n, 0), in(n, 1)); }
  T valueOf(Is<Op::Abs>, const Instruction& n) { return absolute(in(n, 0)); }
  T valueOf(Is<Op::AbsMinus>, const Instruction& n) {
    return lessConstant(absolute(in(n, 0)), constantOf(n, 0));
  }
  T valueOf(Is<Op::Sin>, const Instruction& n) { return sineOf(in(n, 0)); }
  T valueOf(Is<Op::Cos>, const Instruction& n) { return cosineOf(in(n, 0)); }
  T valueOf(Is<Op::Sqrt>, const Instruction& n) {
    const T x = in(n, 0);
    unsure_ = hn::Or(unsure_, hn::Lt(x.v.lo, hn::Zero(kD)));
    return rootOf(x);
  }
  T valueOf(Is<Op::Div>, const Instruction& n) {
    const T x = in(n, 1);
    unsure_ = hn::Or(unsure_, hasZero(x.v));
    return product(in(n, 0), inverseOf(x));
  }
  T valueOf(Is<Op::Length2>, const Instruction& n) { return length<2>(n); }
  T valueOf(Is<Op::Length3>, const Instruction& n) { return length<3>(n); }
  T valueOf(Is<Op::Distance3>, const Instruction& n) { return length<3>(n, 3); }
  template <Op op>
  T valueOf(Is<op>, const Instruction& n) {
    return laneByLane(n);
  }

  // The first `shifts` constants are subtracted from the arguments, the one after them from the length.
  template <int N>
  T length(const Instruction& n, int shifts = 0) {
    T q[3];
    for (int i = 0; i < N; ++i) q[i] = lessConstant(in(n, i), shifts > 0 ? constantOf(n, i) : 0.0);
    const T* const parts[3] = {&q[0], &q[1], &q[2]};
    return lessConstant(lengthTerm<N>(parts, parts), constantOf(n, shifts));
  }

  // Any other operation, by the scalar intervals.
  T laneByLane(const Instruction& n) {
    const PayloadPart* payload = tape_.payload(n);
    const int rows = rowArguments(n.op);
    T args[3];
    for (int k = 0; k < rows; ++k) args[k] = operand(n.in[k]);
    const auto constantAt = [&](int k) { return Interval(constantOf(n, k - rows)); };
    HWY_ALIGN double unsure[kMostLanes];
    std::fill_n(unsure, kMostLanes, 0.0);
    const auto each = [&](const auto& lane, auto&... out) {
      HWY_ALIGN double lo[sizeof...(out)][kMostLanes], hi[sizeof...(out)][kMostLanes];
      for (std::size_t l = 0; l < hn::Lanes(kD); ++l) {
        const std::array<Interval, sizeof...(out)> r = lane(l);
        for (std::size_t i = 0; i < r.size(); ++i) {
          if (i == 0 && r[i].nan) unsure[l] = 1.0;
          lo[i][l] = r[i].nan ? -HUGE_VAL : r[i].lo;
          hi[i][l] = r[i].nan ? HUGE_VAL : r[i].hi;
        }
      }
      std::size_t i = 0;
      ((out = Range(hn::Load(kD, lo[i]), hn::Load(kD, hi[i])), ++i), ...);
    };
    T r;
    for (int c = 0; c < T::kPoints; ++c)
      each(
          [&](std::size_t l) {
            return std::array{evaluateOp<Interval>(
                n.op, payload, [&](int k) { return k < rows ? laneOf(args[k].c[c], l) : constantAt(k); })};
          },
          r.c[c]);
    using D3 = Dual<Interval, 3>;
    each(
        [&](std::size_t l) {
          const D3 f = evaluateOp<D3>(n.op, payload, [&](int k) {
            if (k >= rows) return constant<Interval, 3>(constantAt(k));
            const T& t = args[k];
            return D3{laneOf(t.v, l), {laneOf(t.d[0], l), laneOf(t.d[1], l), laneOf(t.d[2], l)}};
          });
          return std::array{f.v, f.d[0], f.d[1], f.d[2]};
        },
        r.v, r.d[0], r.d[1], r.d[2]);
    if constexpr (T::kFlat) {
      using D2 = Dual<Interval, 2>;
      each(
          [&](std::size_t l) {
            const D2 f = evaluateOp<D2>(n.op, payload, [&](int k) {
              if (k >= rows) return constant<Interval, 2>(constantAt(k));
              const T& t = args[k];
              return D2{laneOf(t.m, l), {laneOf(t.s[0], l), laneOf(t.s[1], l)}};
            });
            return std::array{f.v, f.d[0], f.d[1]};
          },
          r.m, r.s[0], r.s[1]);
      for (Range& h : r.h) h = everything();
    }
    unsure_ = hn::Or(unsure_, hn::Ne(hn::Load(kD, unsure), hn::Zero(kD)));
    narrow(r);
    return r;
  }

  const Tape& tape_;
  const std::vector<Pattern>& patterns_;
  const T* variables_ = nullptr;
  T* terms_;
  M unsure_;
  V ways_[3], sides_[2];  // lengths of the directions that slopes are taken along
};

// One number of each of `count` items, from `first` on; the last one is repeated.
template <class Get>
V gather(std::size_t first, std::size_t count, const Get& get) {
  HWY_ALIGN double x[kMostLanes];
  for (std::size_t l = 0; l < hn::Lanes(kD); ++l) x[l] = get(std::min(first + l, count - 1));
  return hn::Load(kD, x);
}

// x give or take a few ulps of `size`.
SDF_INLINE Range about(V x, V size) {
  const V slack = hn::MulAdd(size, splat(0x1p-50), splat(1e-300));
  return {hn::Sub(x, slack), hn::Add(x, slack)};
}

void RunPrisms(const PrismJob& job) {
  TermReading<PrismTerm> reading(job.tape, job.memory);
  const std::size_t count = job.prisms.size();
  PrismTerm variables[kVariableCount];
  for (int i = 3; i < kVariableCount; ++i) {
    variables[i] = constantTerm<PrismTerm>(0.0);
    for (Range& c : variables[i].c) c = Range(-1.0, 1.0);
    variables[i].m = variables[i].v = Range(-1.0, 1.0);
  }
  for (std::size_t first = 0; first < count; first += hn::Lanes(kD)) {
    for (int i = 0; i < 3; ++i) {
      PrismTerm& x = variables[i];
      V p[3], o[3], size = hn::Zero(kD);
      for (int k = 0; k < 3; ++k) {
        p[k] = gather(first, count, [&](std::size_t t) { return job.prisms[t].corners[k][i]; });
        o[k] = gather(first, count, [&](std::size_t t) { return job.prisms[t].offsets[k][i]; });
        size = hn::Max(size, hn::Add(hn::Abs(p[k]), hn::Abs(o[k])));
      }
      for (int k = 0; k < 3; ++k) {
        x.c[k] = about(p[k], size);
        x.d[k] = about(o[k], size);
        x.h[k] = Range(0.0);
      }
      for (int k = 0; k < 2; ++k) x.s[k] = about(hn::Sub(p[k + 1], p[0]), size);
      x.m = hull(hull(x.c[0], x.c[1]), x.c[2]);
      x.v = add(x.m, symmetric(mostOf(x.d)));
    }
    const PrismTerm f = reading.run(variables);
    HWY_ALIGN double lo[kMostLanes], hi[kMostLanes], least[kMostLanes], most[kMostLanes], unsure[kMostLanes],
        lowest[kMostLanes], highest[kMostLanes];
    hn::Store(f.m.lo, kD, lo);
    hn::Store(f.m.hi, kD, hi);
    hn::Store(f.v.lo, kD, lowest);
    hn::Store(f.v.hi, kD, highest);
    hn::Store(hn::Min(hn::Min(f.d[0].lo, f.d[1].lo), f.d[2].lo), kD, least);
    hn::Store(mostOf(f.d), kD, most);
    hn::Store(hn::IfThenElseZero(reading.unsure(), splat(1.0)), kD, unsure);
    for (std::size_t l = 0; l < hn::Lanes(kD) && first + l < count; ++l)
      if (unsure[l] == 0.0)
        job.out[first + l] = {{lo[l], hi[l]}, {lowest[l], highest[l]}, least[l], most[l]};
      else
        job.out[first + l] = {};
  }
}

void RunBoxes(const BoxJob& job) {
  TermReading<BoxTerm> reading(job.tape, job.memory);
  const std::size_t count = job.boxes.size();
  BoxTerm variables[kVariableCount];
  for (int i = 3; i < kVariableCount; ++i) {
    variables[i] = constantTerm<BoxTerm>(0.0);
    variables[i].c[0] = variables[i].v = Range(-1.0, 1.0);
  }
  for (std::size_t first = 0; first < count; first += hn::Lanes(kD)) {
    for (int i = 0; i < 3; ++i) {
      BoxTerm& x = variables[i];
      x.v.lo = gather(first, count, [&](std::size_t b) { return job.boxes[b].min[i]; });
      x.v.hi = gather(first, count, [&](std::size_t b) { return job.boxes[b].max[i]; });
      const V middle = hn::Mul(splat(0.5), hn::Add(x.v.lo, x.v.hi));
      const V half = hn::Max(hn::Sub(x.v.hi, middle), hn::Sub(middle, x.v.lo));
      x.c[0] = {middle, middle};
      for (int k = 0; k < 3; ++k) x.d[k] = Range(0.0);
      x.d[i] = {half, hn::Add(half, step(half))};
    }
    const BoxTerm f = reading.run(variables);
    HWY_ALIGN double lo[kMostLanes], hi[kMostLanes], unsure[kMostLanes];
    hn::Store(f.v.lo, kD, lo);
    hn::Store(f.v.hi, kD, hi);
    hn::Store(hn::IfThenElseZero(reading.unsure(), splat(1.0)), kD, unsure);
    for (std::size_t l = 0; l < hn::Lanes(kD) && first + l < count; ++l)
      job.out[first + l] = {lo[l], hi[l], unsure[l] != 0.0};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf {

HWY_EXPORT(RunPrisms);
HWY_EXPORT(RunBoxes);

ProofReading::ProofReading() : memory_(std::make_unique<Memory>()) {}
ProofReading::~ProofReading() = default;
ProofReading::ProofReading(ProofReading&&) noexcept = default;

void ProofReading::prisms(const Tape& tape, std::span<const Prism> prisms, PrismBounds* out) {
  findPatterns(tape, memory_->patterns);
  HWY_DYNAMIC_DISPATCH(RunPrisms)({tape, *memory_, prisms, out});
}

void ProofReading::boxes(const Tape& tape, std::span<const Box> boxes, Interval* out) {
  findPatterns(tape, memory_->patterns);
  HWY_DYNAMIC_DISPATCH(RunBoxes)({tape, *memory_, boxes, out});
}

}  // namespace sdf
#endif  // HWY_ONCE
