// Operation codes and what is known about each, expanded from ops.def.
#pragma once
#include <cstdint>
#include <string_view>

namespace sdf {

enum class Op : std::uint8_t {
  Constant,   ///< leaf: a number
  Variable,   ///< leaf: a coordinate of the position or of the normal
  Parameter,  ///< leaf: a named number that the user may change
  Claim,      ///< its argument's value, with a proven bound on the slope that the formula does not show
  Payload,    ///< a function of three arguments that is given by data (expr/payload.h)
#define SDF_UNARY(name, call) name,
#define SDF_BINARY(name, call) name,
#define SDF_TERNARY(name, call) name,
#define SDF_FUSED(name, rows, constants, body) name,
#include "sdf/expr/ops.def"
  Count
};

inline constexpr int kOpCount = static_cast<int>(Op::Count);
inline constexpr int kMaxArity = 7;

struct OpInfo {
  std::string_view name;
  int arity;      ///< all arguments, trailing constants included
  int constants;  ///< trailing arguments that are always constants (fused operations)
  bool fused;     ///< made by the tape compiler, never found in a graph
};

inline constexpr OpInfo kOps[kOpCount] = {
    {"Constant", 0, 0, false}, {"Variable", 0, 0, false}, {"Parameter", 0, 0, false},
    {"Claim", 1, 0, false},    {"Payload", 3, 0, false},
#define SDF_UNARY(name, call) {#name, 1, 0, false},
#define SDF_BINARY(name, call) {#name, 2, 0, false},
#define SDF_TERNARY(name, call) {#name, 3, 0, false},
#define SDF_FUSED(name, rows, constants, body) {#name, rows + constants, constants, true},
#include "sdf/expr/ops.def"
};

constexpr const OpInfo& info(Op op) { return kOps[static_cast<int>(op)]; }
constexpr int arity(Op op) { return info(op).arity; }
/// Arguments that vary from point to point; the others are constants.
constexpr int rowArguments(Op op) { return info(op).arity - info(op).constants; }

/// Is it one of ops.def?
constexpr bool isOperation(Op op) { return op > Op::Payload; }
/// Operations where one argument may win over a whole region, and the other be dropped.
constexpr bool isChoice(Op op) { return op == Op::Min || op == Op::Max || op == Op::Select; }
constexpr bool isComparison(Op op) { return op == Op::Less || op == Op::LessEqual || op == Op::Equal; }

}  // namespace sdf
