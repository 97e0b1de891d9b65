// Operation codes and what is known about each, expanded from ops.def.
#pragma once
#include <cmath>
#include <cstdint>
#include <string_view>

namespace sdf {

enum class Op : std::uint8_t {
  Constant,   ///< leaf: a number
  Variable,   ///< leaf: a coordinate of the position or of the normal
  Parameter,  ///< leaf: a named number that the user may change
  Claim,      ///< its argument's value, with a proven bound on the slope that the formula does not show
  Payload,    ///< a function of three arguments that is given by data (expr/payload.h)
#define SDF_UNARY(name, ...) name,
#define SDF_BINARY(name, ...) name,
#define SDF_TERNARY(name, ...) name,
#define SDF_FUSED(name, ...) name,
#include "sdf/expr/ops.def"
  Count
};

inline constexpr int kOpCount = static_cast<int>(Op::Count);
inline constexpr int kMaxArity = 7;

/// Can what is made of smooth arguments have a crease?
enum class Smoothness : std::uint8_t {
  MayKink,  ///< The value may jump, or turn along a surface.
  Smooth,   ///< The value turns along lines at most, where a length is 0.
};

enum class Linearity : std::uint8_t {
  Nonlinear,      ///< Nothing is stated.
  Linear,         ///< The value is a sum of multiples of the arguments.
  Bilinear,       ///< The value is a multiple of each argument while the other one is held.
  LinearInFirst,  ///< The value is a multiple of the first argument while the second one is held.
};

/// The arguments whose order the values keep.
enum class Increasing : std::uint8_t {
  Unstated,        ///< Nothing is stated.
  First,           ///< The value never falls as the first argument rises.
  Both,            ///< The value never falls as either argument rises.
  BothIfPositive,  ///< The value never falls as an argument rises while the other one is held at 0 or more.
};

/// Of one argument.
enum class Slope : std::uint8_t {
  Unstated,      ///< Nothing is stated.
  Nonexpansive,  ///< The value changes by no more than the argument does.
};

/// Of one argument.
enum class Parity : std::uint8_t {
  Unstated,  ///< Nothing is stated.
  Even,      ///< The value does not depend on the argument's sign, which nodes are made without.
};

/// Of two arguments.
enum class Symmetry : std::uint8_t {
  Ordered,    ///< The arguments have their places.
  Symmetric,  ///< The arguments may be swapped.
};

/// What the operation decides between.
enum class Choice : std::uint8_t {
  NoChoice,  ///< The operation decides nothing.
  Least,     ///< The value is the lesser argument.
  Greatest,  ///< The value is the greater argument.
  Selected,  ///< The value is the second or the third argument, as the first one says.
  IsLess,    ///< The value says whether the first argument is less than the second, ties aside.
  IsEqual,   ///< The value says whether the arguments are equal.
};

struct OpInfo {
  std::string_view name;
  int arity = 0;       ///< all arguments, trailing constants included
  int constants = 0;   ///< trailing arguments that are always constants (fused operations)
  bool fused = false;  ///< made by the tape compiler, never found in a graph
  Smoothness smoothness = Smoothness::MayKink;
  std::string_view glsl{};  ///< $0, $1 and $2 stand for the arguments; empty where graphs have no such node
  Choice choice = Choice::NoChoice;
  Linearity linearity = Linearity::Nonlinear;
  Increasing increasing = Increasing::Unstated;
  double neutral = NAN;  ///< leaves the first argument as it is; NAN: there is none
  Symmetry symmetry = Symmetry::Ordered;
  Slope slope = Slope::Unstated;
  Parity parity = Parity::Unstated;
};

// It gives each of many arguments a line.
// clang-format off
inline constexpr OpInfo kOps[kOpCount] = {
    {"Constant"},
    {"Variable"},
    {"Parameter"},
    {"Claim", 1, 0, false, Smoothness::Smooth, "", Choice::NoChoice, Linearity::Linear},
    {"Payload", 3},
#define SDF_UNARY(name, call, glsl, smoothness, linearity, increasing, slope, parity) \
    {#name, 1, 0, false, Smoothness::smoothness, glsl, Choice::NoChoice, Linearity::linearity, \
     Increasing::increasing, NAN, Symmetry::Ordered, Slope::slope, Parity::parity},
#define SDF_BINARY(name, call, glsl, smoothness, linearity, increasing, neutral, symmetry, choice) \
    {#name, 2, 0, false, Smoothness::smoothness, glsl, Choice::choice, Linearity::linearity, \
     Increasing::increasing, neutral, Symmetry::symmetry},
#define SDF_TERNARY(name, call, glsl, smoothness, choice) \
    {#name, 3, 0, false, Smoothness::smoothness, glsl, Choice::choice},
#define SDF_FUSED(name, rows, constants, smoothness, body) \
    {#name, rows + constants, constants, true, Smoothness::smoothness},
#include "sdf/expr/ops.def"
};
// clang-format on

constexpr const OpInfo& info(Op op) { return kOps[static_cast<int>(op)]; }
constexpr int arity(Op op) { return info(op).arity; }
/// Arguments that vary from point to point; the others are constants.
constexpr int rowArguments(Op op) { return info(op).arity - info(op).constants; }

/// Is it one of ops.def?
constexpr bool isOperation(Op op) { return op > Op::Payload; }

constexpr Choice choiceOf(Op op) { return info(op).choice; }
/// One argument may win over a whole region, and the other be dropped.
constexpr bool isMinOrMax(Op op) { return choiceOf(op) == Choice::Least || choiceOf(op) == Choice::Greatest; }
constexpr bool isComparison(Op op) {
  return choiceOf(op) == Choice::IsLess || choiceOf(op) == Choice::IsEqual;
}

}  // namespace sdf
