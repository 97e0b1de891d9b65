// What the float batch readings promise: of each operation, and of a whole distance.
//
// A shader is promised only what "Range and Precision" of the GLSL 4.50 specification asks of its driver,
// where what is below 2^-126 may be 0. That says nothing of sin, cos and arcs:
// tests hold drivers to 2^-20 for angles up to pi, and to 4096 ulp.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

#include "sdf/expr/op.h"

namespace sdf {

/// How far an operation's float value may lie from its double value for the same float arguments: `ulps`
/// units in the last place of the result, and `more` of those of what `of` names. An ulp is the distance to
/// the next larger float (2^-149 or more), infinity counting as 2^128.
///
/// This holds for all finite arguments of a magnitude up to `largest`, denormal ones too. Infinite ones
/// beside these, and NaN, give what they give in double.
///
/// A payload states what its value may be off by besides, Payload::rounding; its derivatives are promised no
/// more than its slope. A tape's constants are rounded to float first. Derivatives are made of the same
/// operations, in the order in which number/dual-inl.h writes them.
struct Promise {
  enum class Of {
    Nothing,
    /// The first argument of mod(a, b), which is promised for |a / b| up to 2^126. The rounded quotient may
    /// reach another whole number: the result may be off by whole divisors too, up to 1 + 2^-24 |a / b|.
    Dividend,
    Product,  ///< a b in mulAdd(a, b, c): whether it is rounded depends on the instruction set
    Length,   ///< what the constant is subtracted from, or 2^-74 where its squares are lost
  };
  double ulps;
  double more = 0.0;
  Of of = Of::Nothing;
  double largest = 0x1p128;
};

constexpr Promise promise(Op op) {
  using enum Op;
  const auto is = [op](auto... ops) { return ((op == ops) || ...); };
  if (is(Constant, Parameter, Add, Sub, Mul, Div, Square, AbsMinus, Payload)) return {0.5};
  if (is(Sqrt, Pow)) return {2.0};
  if (is(Sin, Cos, Asin, Acos, Atan, Atan2, Exp, Log)) return {4.0};
  if (is(Tan)) return {8.0};
  if (is(Mod)) return {1.0, 1.0, Promise::Of::Dividend, 0x1p126};
  if (is(MulAdd)) return {0.5, 0.5, Promise::Of::Product, 0x1p63};
  if (is(Length2, Length3, Distance3)) return {0.5, 5.0, Promise::Of::Length, 0x1p62};
  return {0.0};
}

/// How far the float value of a distance may be off at p, whose coordinates are no more than 2^62: some tens
/// of roundings of numbers of the size of the coordinates and of the shape. A shape whose own numbers are of
/// another size than its bounds' may round worse.
inline double distanceRounding(const glm::dvec3& p, double size = 0.0) {
  return 0x1p-18 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + size);
}

}  // namespace sdf
