// Every operation of the graph, and arguments that it might break on.
#pragma once
#include <array>
#include <cfloat>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "sdf/expr/vec.h"

namespace sdf::test {

/// Zeros, the ends of the floats, and where functions turn, of both signs; infinities and NaN.
inline const std::vector<float>& hostileArguments() {
  static const std::vector<float> all = [] {
    std::vector<float> v{0.0f,        FLT_TRUE_MIN, 1e-40f, FLT_MIN, 1e-20f,  1e-5f,    0.25f,
                         0.5f,        1.0f,         1.5f,   2.0f,    2.5f,    3.0f,     1.57079637f,
                         3.14159274f, 10.0f,        88.7f,  88.8f,   103.9f,  1e4f,     38999.0f,
                         39001.0f,    8388609.0f,   1e9f,   1e20f,   FLT_MAX, HUGE_VALF};
    for (const float near : {1.0f, 1.57079637f, 0.5f})
      for (const float to : {0.0f, HUGE_VALF}) v.push_back(std::nextafter(near, to));
    const std::size_t positive = v.size();
    for (std::size_t i = 0; i < positive; ++i) v.push_back(-v[i]);
    v.push_back(NAN);
    return v;
  }();
  return all;
}

/// Those, and as many others as `extra` of up to 4 and of all sizes up to 2^20, by seed.
inline std::vector<float> arguments(int seed, int extra) {
  std::vector<float> v = hostileArguments();
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> plain(-4.0f, 4.0f), exponent(-20.0f, 20.0f);
  for (int i = 0; i < extra; ++i)
    v.push_back(i % 2 ? plain(random) : std::copysign(std::exp2(exponent(random)), plain(random)));
  return v;
}

struct OperationCase {
  Op op;
  Expr expr;  // of x, y, z
};
inline void PrintTo(const OperationCase& c, std::ostream* out) { *out << info(c.op).name; }

/// Every operation of which graphs are made, of x, y and z.
inline std::vector<OperationCase> graphOperations() {
  const Vec3E p = position();
  const std::array<Expr, 3> xyz{p.x, p.y, p.z};
  std::vector<OperationCase> cases;
  for (int i = 0; i < kOpCount; ++i) {
    const Op op = static_cast<Op>(i);
    if (!isOperation(op) || info(op).fused) continue;
    cases.push_back({op, Expr::make(op, {xyz.data(), static_cast<std::size_t>(arity(op))})});
  }
  return cases;
}

}  // namespace sdf::test
