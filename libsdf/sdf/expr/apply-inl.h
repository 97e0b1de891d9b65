// The one dispatch from an operation code to its function, for any number type.
//
//   dispatch(op, [&](auto tag) { ... apply<tag.value>(a, b) ... });
//
// Re-included once per SIMD target by Highway's foreach_target; the number type's functions must be visible
// before.
#if defined(SDF_EXPR_APPLY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_EXPR_APPLY_INL_H
#undef SDF_EXPR_APPLY_INL_H
#else
#define SDF_EXPR_APPLY_INL_H
#endif

#include <cstdlib>
#include <type_traits>
#include <utility>

#include "sdf/expr/op.h"
#include "sdf/expr/payload.h"
#include "sdf/number/dual-inl.h"

#ifdef HWY_NAMESPACE
HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {
#else
namespace sdf {
#endif

/// apply<op>(a, …): the operation's function, found for the arguments' type. Takes exactly arity(op)
/// arguments.
template <Op op>
struct Apply;
#define SDF_UNARY(name, call, ...)                     \
  template <>                                          \
  struct Apply<Op::name> {                             \
    template <class T, class... Others>                \
    static T of(const T& a, const Others&... others) { \
      return call(a, others...);                       \
    }                                                  \
  };
#define SDF_BINARY SDF_UNARY
#define SDF_TERNARY SDF_UNARY
#define SDF_FUSED(name, rows, constants, smoothness, body)                                    \
  template <>                                                                                 \
  struct Apply<Op::name> {                                                                    \
    template <class T>                                                                        \
    static T of(const T& a, const T& b, const T& c = T{}, const T& d = T{}, const T& e = T{}, \
                const T& f = T{}, const T& g = T{}) {                                         \
      (void)c, (void)d, (void)e, (void)f, (void)g;                                            \
      return body;                                                                            \
    }                                                                                         \
  };
#include "sdf/expr/ops.def"

template <Op op, class... Ts>
auto apply(const Ts&... args) {
  return Apply<op>::of(args...);
}

/// What f gives for `op` as a type, which must be an operation of ops.def.
template <class F>
auto dispatch(Op op, F&& f) {
  switch (op) {
#define SDF_UNARY(name, ...) \
  case Op::name:             \
    return f(std::integral_constant<Op, Op::name>{});
#define SDF_BINARY SDF_UNARY
#define SDF_TERNARY SDF_UNARY
#define SDF_FUSED SDF_UNARY
#include "sdf/expr/ops.def"
    default:
      std::abort();
  }
}

/// The value of `op` where args(i) yields its i-th argument. Every reading passes through a claim.
template <class T, class Args>
T evaluateOp(Op op, Args&& args) {
  if (op == Op::Claim) return args(0);
  return dispatch(op, [&](auto tag) {
    return [&]<int... i>(std::integer_sequence<int, i...>)->T { return apply<tag.value>(args(i)...); }
    (std::make_integer_sequence<int, arity(tag.value)>());
  });
}

/// The same where `op` may be a payload, which is given then, and null else.
template <class T, class Args>
T evaluateOp(Op op, const PayloadPart* payload, Args&& args) {
  if (payload) [[unlikely]]
    return payloadAt(*payload, args(0), args(1), args(2));
  return evaluateOp<T>(op, args);
}

template <class T, int N>
Dual<T, N> payloadAt(const PayloadPart& part, const Dual<T, N>& a, const Dual<T, N>& b, const Dual<T, N>& c) {
  const std::array<T, 4> f = payloadSlopes(part, a.v, b.v, c.v);
  return chain(a, b, c, f[0], f[1], f[2], f[3]);
}
/// By the bound of its slope, however the arguments move together.
template <AnyInterval T, int N>
Dual<T, N> payloadAt(const PayloadPart& part, const Dual<T, N>& a, const Dual<T, N>& b, const Dual<T, N>& c) {
  Dual<T, N> r{payloadAt(part, a.v, b.v, c.v), {}};
  for (int i = 0; i < N; ++i)
    r.d[i] = mul(payloadSlope(part, r.v), sqrt(squareAdd(a.d[i], squareAdd(b.d[i], square(c.d[i])))));
  return r;
}

#ifdef HWY_NAMESPACE
}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();
#else
}  // namespace sdf
#endif
#endif  // per-target guard
