// The expression graph: one hash-consed DAG of scalar operations that every reading of a scene starts from.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sdf/expr/op.h"
#include "sdf/number/interval.h"

namespace sdf {

/// A coordinate that an expression may depend on.
enum class Variable : std::uint8_t {
  X,   ///< the position's x
  Y,   ///< the position's y
  Z,   ///< the position's z
  NX,  ///< the unit normal's x; surface attributes alone have a normal
  NY,  ///< the unit normal's y
  NZ   ///< the unit normal's z
};
inline constexpr int kVariableCount = 6;

/// The declaration of a named number that the user may change: its default, and the range that it is meant
/// for. The graph knows no other value. A reading is told one (eval/function.h).
struct ParameterInfo {
  std::string name;
  double value = 0.0;  ///< the default
  double min = 0.0;
  double max = 1.0;
  bool operator==(const ParameterInfo&) const = default;
};

class Node;
struct PayloadPart;

/// Handle to a node. Copying is cheap, equal graphs are the same node, and handles may be made and dropped on
/// any thread. Building a node folds constants; identities that would change the meaning for NaN or infinity
/// are not applied.
class Expr {
 public:
  Expr(double value = 0.0);  // NOLINT: a number is an expression
  Expr(const Expr& other) noexcept;
  Expr(Expr&& other) noexcept;
  Expr& operator=(Expr other) noexcept;
  ~Expr();

  static Expr variable(Variable v);
  static Expr parameter(const ParameterInfo& info);
  /// A function that is given by data (expr/payload.h), or a derivative of it, at this point. Its slope
  /// follows from the function's and from the coordinates' own, so coordinates that form a basis let a
  /// tighter one be claimed. Nodes of one payload, not of equal ones, are the same.
  static Expr payload(const PayloadPart& part, const std::array<Expr, 3>& at);
  /// Node of `op`, one of ops.def (not fused), with arity(op) arguments.
  static Expr make(Op op, std::span<const Expr> args);

  Op op() const;
  const Expr& arg(int i) const;  ///< lives as long as this node
  /// The expression itself; of a claim, its argument.
  const Expr& unclaimed() const { return op() == Op::Claim ? arg(0) : *this; }
  double constantValue() const;                ///< op() == Constant
  Variable variableIndex() const;              ///< op() == Variable
  const ParameterInfo& parameterInfo() const;  ///< op() == Parameter
  const PayloadPart* payloadPart() const;      ///< null unless op() == Payload
  bool isConstant() const { return op() == Op::Constant; }
  bool isConstant(double v) const { return isConstant() && constantValue() == v; }

  /// Encloses the expression's value over all of space and over every value of its parameters. It is a point
  /// where these are known: where every parameter's range is one value.
  const Interval& range() const;
  /// Proven L with |f(p) - f(q)| <= L |p - q| for all p, q and every value of the parameters in their ranges;
  /// infinite where none is known. Derived from the arguments' as the node is built; a claim has its own.
  double lipschitz() const;
  /// Enclose the difference quotients along x, y and z, wherever and over whatever distance they are taken.
  const std::array<Interval, 3>& partials() const;
  /// The same function with a proven global Lipschitz bound: a node of its own, so that only what is built on
  /// it relies on the claim. The expression itself where that is known to be no steeper already.
  [[nodiscard]] Expr claimLipschitz(double bound) const;

  /// Same node, that is the same function written the same way.
  friend bool operator==(const Expr& a, const Expr& b) { return a.node_ == b.node_; }
  const Node* node() const { return node_; }

 private:
  explicit Expr(Node* node) : node_(node) {}  // takes over one reference
  friend class Node;
  friend class NodeTable;
  Node* node_;
};

/// Bytes that a node is taken to cost: the node, its place in the table and the allocator's overhead.
inline constexpr std::size_t kNodeBytes = 256;

/// Thrown by the making of a node that the NodeLimit in force does not allow.
struct NodeLimitReached : std::exception {
  const char* what() const noexcept override { return "the expression graph outgrew its limit"; }
};

/// While it lives, this thread may hold at most `count` nodes more than it held before (made here, less
/// deleted here): an operation can double a graph, so a bound on a graph that someone else describes cannot
/// wait until the operation is done. Limits do not nest.
class NodeLimit {
 public:
  explicit NodeLimit(std::int64_t count);
  ~NodeLimit();
  NodeLimit(const NodeLimit&) = delete;
  NodeLimit& operator=(const NodeLimit&) = delete;
  /// Nodes held since this was made.
  std::int64_t held() const;

 private:
  std::int64_t before_;
};

/// What is made of graphs and takes memory, too, counts as so many nodes held while it lives. Throws
/// NodeLimitReached where there may not be as many.
class CountedAsNodes {
 public:
  explicit CountedAsNodes(std::int64_t nodes = 0);
  ~CountedAsNodes();
  CountedAsNodes(const CountedAsNodes& other) : CountedAsNodes(other.nodes_) {}
  CountedAsNodes(CountedAsNodes&& other) noexcept : nodes_(std::exchange(other.nodes_, 0)) {}
  CountedAsNodes& operator=(CountedAsNodes&& other) noexcept {
    std::swap(nodes_, other.nodes_);
    return *this;
  }

 private:
  std::int64_t nodes_;
};

Expr operator-(const Expr& a);
Expr operator+(const Expr& a, const Expr& b);
Expr operator-(const Expr& a, const Expr& b);
Expr operator*(const Expr& a, const Expr& b);
Expr operator/(const Expr& a, const Expr& b);

#define SDF_UNARY(name, call, ...) Expr call(const Expr& a);
#define SDF_BINARY(name, call, ...) Expr call(const Expr& a, const Expr& b);
#define SDF_TERNARY(name, call, ...) Expr call(const Expr& a, const Expr& b, const Expr& c);
#include "sdf/expr/ops.def"

Expr clamp(const Expr& a, const Expr& lo, const Expr& hi);
/// a + (b - a) t.
Expr mix(const Expr& a, const Expr& b, const Expr& t);

/// Every node of the graphs, arguments before their users, each once.
std::vector<Expr> topologicalOrder(std::span<const Expr> roots);

/// Does the expression depend on the position or the normal?
bool dependsOnSpace(const Expr& e);
/// Value of an expression that does not depend on space, with parameters at their defaults.
double uniformValue(const Expr& e);

/// The replacement of a node, given the replacements of its arguments. None: the node is made anew from
/// these.
using Replacement = std::function<std::optional<Expr>(const Expr& node, std::span<const Expr> args)>;
/// The graphs with nodes replaced, arguments first and each node once. Claims about what has changed are
/// dropped unless `replacement` says otherwise: they speak of the function as it was. Cost: the size of the
/// graphs.
std::vector<Expr> rewrite(std::span<const Expr> roots, const Replacement& replacement);
Expr rewrite(const Expr& root, const Replacement& replacement);

/// The same values without claims, for readings that ask for the formula's form alone.
std::vector<Expr> withoutClaims(std::span<const Expr> roots);

/// The expression with x, y, z replaced. `stretch` bounds the operator norm of the replacement's Jacobian:
/// facts about Lipschitz constants carry over, multiplied by it; pass infinity where it is not known. Cost:
/// the size of the graph.
Expr remap(const Expr& e, const std::array<Expr, 3>& position, double stretch);
/// Several at once, sharing the work.
std::vector<Expr> remap(std::span<const Expr> es, const std::array<Expr, 3>& position, double stretch);

}  // namespace sdf

template <>
struct std::hash<sdf::Expr> {
  std::size_t operator()(const sdf::Expr& e) const noexcept { return std::hash<const void*>()(e.node()); }
};
