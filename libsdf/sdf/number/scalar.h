// The operations of expr/ops.def on double: the meaning that every other number type is tested against.
#pragma once
#include <cmath>

namespace sdf {

using std::abs;
using std::acos;
using std::asin;
using std::atan;
using std::atan2;
using std::ceil;
using std::cos;
using std::exp;
using std::floor;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;
using std::tan;

inline double neg(double a) { return -a; }
inline double square(double a) { return a * a; }
/// Nearest integer, ties to even. Assumes the default rounding mode.
inline double round(double a) { return std::nearbyint(a); }
inline double add(double a, double b) { return a + b; }
inline double sub(double a, double b) { return a - b; }
inline double mul(double a, double b) { return a * b; }
inline double div(double a, double b) { return a / b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double mod(double a, double b) { return a - b * std::floor(a / b); }
inline double less(double a, double b) { return a < b ? 1.0 : 0.0; }
inline double lessEqual(double a, double b) { return a <= b ? 1.0 : 0.0; }
inline double equal(double a, double b) { return a == b ? 1.0 : 0.0; }
inline double select(double c, double a, double b) { return c != 0.0 ? a : b; }
inline double mulAdd(double a, double b, double c) { return a * b + c; }
inline double squareAdd(double a, double c) { return a * a + c; }

// What Dual needs beyond the operations: the derivative of a step, and of a choice between branches.
inline double stepSlope(double /*step*/) { return 0.0; }
inline double choiceSlope(double c, double a, double b) { return select(c, a, b); }

}  // namespace sdf
