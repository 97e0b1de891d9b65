#include "sdf/expr/expr.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "sdf/base/box.h"
#include "sdf/base/flat_map.h"
#include "sdf/expr/apply-inl.h"
#include "sdf/expr/depth.h"
#include "sdf/expr/origin.h"

namespace sdf {

inline constexpr int kMaxGraphArity = 3;

class Node {
 public:
  Op op = Op::Constant;
  Variable variable = Variable::X;
  double value = 0.0;
  std::unique_ptr<ParameterInfo> parameter;
  std::unique_ptr<PayloadPart> payload;
  std::array<Expr, kMaxGraphArity> args{Expr(nullptr), Expr(nullptr), Expr(nullptr)};
  std::size_t hash = 0;
  std::uint32_t depth = 0, origin = 0;
  Interval range;
  double lipschitz = 0.0;
  std::array<Interval, 3> partials{};
  mutable std::atomic<int> references{1};
};

namespace {

std::size_t combine(std::size_t h, std::size_t v) { return (h ^ v) * 0x9E3779B97F4A7C15ull + (h >> 29); }

std::size_t hashOf(const Node& n) {
  std::size_t h = combine(static_cast<std::size_t>(n.op) + 1, std::bit_cast<std::uint64_t>(n.value));
  h = combine(h, static_cast<std::size_t>(n.variable));
  if (n.parameter) h = combine(h, std::hash<std::string>()(n.parameter->name));
  if (n.payload) h = combine(h, reinterpret_cast<std::size_t>(n.payload->payload.get()) + n.payload->part);
  for (const Expr& a : n.args) h = combine(h, reinterpret_cast<std::size_t>(a.node()));
  return h;
}

struct Hash {
  std::size_t operator()(const Node* n) const { return n->hash; }
};
struct Same {
  bool operator()(const Node* a, const Node* b) const {
    return a->op == b->op && a->variable == b->variable &&
           std::bit_cast<std::uint64_t>(a->value) == std::bit_cast<std::uint64_t>(b->value) &&
           a->args == b->args && same(a->parameter, b->parameter) && same(a->payload, b->payload);
  }
  template <class T>
  static bool same(const std::unique_ptr<T>& a, const std::unique_ptr<T>& b) {
    return a ? b && *a == *b : !b;
  }
};

// Range, slope in any direction, and partial derivatives, over all of space. Neither kind of slope is the
// tighter one always: sums along different axes want partial derivatives, what has been turned a slope.
using Fact = Dual<Interval, 4>;

Fact factOf(const Node& n) {
  return {n.range, {Interval(-n.lipschitz, n.lipschitz), n.partials[0], n.partials[1], n.partials[2]}};
}

void setSlopes(Node& n, double bound, const Interval* partials) {
  const double along = std::hypot(partials[0].magnitude(), partials[1].magnitude(), partials[2].magnitude());
  n.lipschitz = std::min(bound, along);
  const auto kept = [&](double slope) { return std::clamp(slope, -n.lipschitz, n.lipschitz); };
  for (int i = 0; i < 3; ++i) n.partials[i] = {kept(partials[i].lo), kept(partials[i].hi)};
}

// Are they numbers? What depends on space and has one value may have that as 0 or -0.
bool hasKnownArguments(const Node& n) {
  for (int i = 0; i < arity(n.op); ++i)
    if (const Node& a = *n.args[i].node(); !a.range.isPoint() || a.lipschitz != 0.0) return false;
  return true;
}

void setFacts(Node& n) {
  if (n.op == Op::Constant) {
    n.range = Interval(n.value);
  } else if (n.op == Op::Parameter) {
    n.range = hull(
        Interval(std::min(n.parameter->min, n.parameter->max), std::max(n.parameter->min, n.parameter->max)),
        Interval(n.parameter->value));
  } else if (n.op == Op::Variable) {
    const bool coordinate = n.variable <= Variable::Z;
    n.range = coordinate ? Interval(-kInfinity, kInfinity) : Interval(-1.0, 1.0);
    n.lipschitz = coordinate ? 1.0 : kInfinity;
    if (coordinate)
      n.partials[static_cast<int>(n.variable)] = 1.0;
    else
      n.partials.fill(Interval::everything());
  } else if (n.op == Op::Claim) {
    n.range = n.args[0].range();
    setSlopes(n, n.value, n.args[0].partials().data());
  } else {
    const Fact fact =
        evaluateOp<Fact>(n.op, n.payload.get(), [&](int i) { return factOf(*n.args[i].node()); });
    n.range = fact.v;
    // What is made of known numbers is the number that constants would be folded to.
    if (hasKnownArguments(n))
      n.range = evaluateOp<double>(n.op, n.payload.get(), [&](int i) { return n.args[i].node()->range.lo; });
    setSlopes(n, fact.d[0].magnitude(), fact.d + 1);
  }
}

// Of the nodes that this thread makes; 0: unknown.
thread_local std::uint32_t originNow = 0;

/// Places in scenes, by number. They are few: as many as lines of scenes that make something.
class Origins {
 public:
  static Origins& instance() {
    static auto* all = new Origins;
    return *all;
  }
  std::uint32_t numberOf(const char* what, const std::string& file, int line) {
    std::lock_guard lock(mutex_);
    const auto [place, fresh] = numbers_.try_emplace({what, line, file}, 0);
    if (fresh) {
      texts_.push_back(std::string("the ") + what + " at " + file + ":" + std::to_string(line));
      place->second = static_cast<std::uint32_t>(texts_.size());
    }
    return place->second;
  }
  std::string text(std::uint32_t number) {
    std::lock_guard lock(mutex_);
    return number == 0 ? "" : texts_[number - 1];
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<std::string_view, int, std::string>, std::uint32_t> numbers_;
  std::vector<std::string> texts_;
};

// Nodes made less nodes deleted by this thread, and how many there may be (see NodeLimit).
thread_local std::int64_t nodesHeld = 0;
thread_local std::int64_t nodesAllowed = std::numeric_limits<std::int64_t>::max();

}  // namespace

NodeLimit::NodeLimit(std::int64_t count) : before_(nodesHeld) { nodesAllowed = before_ + count; }
NodeLimit::~NodeLimit() { nodesAllowed = std::numeric_limits<std::int64_t>::max(); }
std::int64_t NodeLimit::held() const { return nodesHeld - before_; }

Origin::Origin(const char* what, const std::string& file, int line)
    : before_(std::exchange(originNow, Origins::instance().numberOf(what, file, line))) {}
Origin::Origin(const Expr& like) : before_(std::exchange(originNow, like.node()->origin)) {}
Origin::~Origin() { originNow = before_; }

CountedAsNodes::CountedAsNodes(std::int64_t nodes) : nodes_(nodes) {
  if (nodesHeld + nodes > nodesAllowed) throw NodeLimitReached();
  nodesHeld += nodes;
}
CountedAsNodes::~CountedAsNodes() { nodesHeld -= nodes_; }

// Every live node, so that equal nodes are found again. References from here are not counted: a node leaves
// as its last handle goes. The last reference is dropped under the lock, so no look-up can revive a node that
// is being deleted.
class NodeTable {
 public:
  static NodeTable& instance() {
    static auto* table = new NodeTable;  // outlives every static Expr
    return *table;
  }

  Expr intern(std::unique_ptr<Node> n) {
    n->hash = hashOf(*n);
    std::lock_guard lock(mutex_);
    if (auto it = nodes_.find(n.get()); it != nodes_.end()) {
      retain(*it);
      return Expr(*it);
    }
    if (nodesHeld >= nodesAllowed) throw NodeLimitReached();
    if (!n->payload) setFacts(*n);  // a payload's own code does not run under the lock
    for (const Expr& a : n->args)
      if (a.node()) n->depth = std::max(n->depth, a.node()->depth + 1);
    Node* node = n.release();
    node->origin = originNow;
    nodes_.insert(node);
    ++nodesHeld;
    return Expr(node);
  }

  static void retain(const Node* n) { n->references.fetch_add(1, std::memory_order_relaxed); }

  static void release(Node* n) {
    int count = n->references.load(std::memory_order_relaxed);
    while (count > 1)
      if (n->references.compare_exchange_weak(count, count - 1, std::memory_order_acq_rel)) return;
    instance().releaseLast(n);
  }

 private:
  // Deep graphs are taken down with an explicit stack.
  void releaseLast(Node* first) {
    std::vector<PayloadPart> payloads;  // outlive the lock, for they may be large, or hold expressions
    std::lock_guard lock(mutex_);
    std::vector<Node*> pending{first};
    while (!pending.empty()) {
      Node* n = pending.back();
      pending.pop_back();
      if (n->references.fetch_sub(1, std::memory_order_acq_rel) > 1) continue;
      nodes_.erase(n);
      for (Expr& a : n->args)
        if (a.node_) pending.push_back(std::exchange(a.node_, nullptr));
      if (n->payload) payloads.push_back(*n->payload);
      delete n;
      --nodesHeld;
    }
  }

  std::mutex mutex_;
  std::unordered_set<Node*, Hash, Same> nodes_;
};

Expr::Expr(double value) : node_(nullptr) {
  // Expressions that are yet to be given a value are many, and 0.
  if (std::bit_cast<std::uint64_t>(value) == 0) {
    static const Expr* const zero = new Expr(NodeTable::instance().intern(std::make_unique<Node>()));
    node_ = zero->node_;
    NodeTable::retain(node_);
    return;
  }
  auto n = std::make_unique<Node>();
  n->value = value;
  *this = NodeTable::instance().intern(std::move(n));
}
Expr::Expr(const Expr& other) noexcept : node_(other.node_) {
  if (node_) NodeTable::retain(node_);
}
Expr::Expr(Expr&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
Expr& Expr::operator=(Expr other) noexcept {
  std::swap(node_, other.node_);
  return *this;
}
Expr::~Expr() {
  if (node_) NodeTable::release(node_);
}

Expr Expr::variable(Variable v) {
  auto n = std::make_unique<Node>();
  n->op = Op::Variable;
  n->variable = v;
  return NodeTable::instance().intern(std::move(n));
}

Expr Expr::parameter(const ParameterInfo& info) {
  auto n = std::make_unique<Node>();
  n->op = Op::Parameter;
  n->parameter = std::make_unique<ParameterInfo>(info);
  return NodeTable::instance().intern(std::move(n));
}

Expr Expr::payload(const PayloadPart& part, const std::array<Expr, 3>& at) {
  if (at[0].isConstant() && at[1].isConstant() && at[2].isConstant())
    return payloadAt(part, at[0].constantValue(), at[1].constantValue(), at[2].constantValue());
  auto n = std::make_unique<Node>();
  n->op = Op::Payload;
  n->payload = std::make_unique<PayloadPart>(part);
  n->args = at;
  setFacts(*n);
  return NodeTable::instance().intern(std::move(n));
}

namespace {

// A simpler expression of the same meaning, NaN and infinity included; nothing where none is known.
std::optional<Expr> simplified(Op op, std::span<const Expr> args) {
  const Expr &a = args[0], &b = args.back();
  const OpInfo& about = info(op);
  if (b.isConstant(about.neutral)) return a;
  if (about.symmetry == Symmetry::Symmetric && a.isConstant(about.neutral)) return b;
  if (isMinOrMax(op) && a == b) return a;
  if (op == Op::Select && a.isConstant()) return a.constantValue() != 0.0 ? args[1] : b;
  if (op == Op::Select && args[1] == b) return b;
  if (op == Op::Neg && a.op() == Op::Neg) return a.arg(0);
  if (about.parity == Parity::Even && (a.op() == Op::Neg || a.op() == Op::Abs))
    return Expr::make(op, {&a.arg(0), 1});
  return std::nullopt;
}

}  // namespace

Expr Expr::make(Op op, std::span<const Expr> args) {
  assert(static_cast<int>(args.size()) == arity(op) && isOperation(op) && !info(op).fused);
  if (std::all_of(args.begin(), args.end(), [](const Expr& e) { return e.isConstant(); }))
    return evaluateOp<double>(op, [&](int i) { return args[i].constantValue(); });
  if (std::optional<Expr> simpler = simplified(op, args)) return *std::move(simpler);
  auto n = std::make_unique<Node>();
  n->op = op;
  std::copy(args.begin(), args.end(), n->args.begin());
  return NodeTable::instance().intern(std::move(n));
}

Op Expr::op() const { return node_->op; }
const Expr& Expr::arg(int i) const { return node_->args[i]; }
double Expr::constantValue() const { return node_->value; }
Variable Expr::variableIndex() const { return node_->variable; }
const ParameterInfo& Expr::parameterInfo() const { return *node_->parameter; }
const PayloadPart* Expr::payloadPart() const { return node_->payload.get(); }
const Interval& Expr::range() const { return node_->range; }
double Expr::lipschitz() const { return node_->lipschitz; }
std::string originOf(const Expr& e) { return Origins::instance().text(e.node()->origin); }
std::uint32_t depthOf(const Expr& e) { return e.node()->depth; }
const std::array<Interval, 3>& Expr::partials() const { return node_->partials; }
Expr Expr::claimLipschitz(double bound) const {
  if (!(bound < lipschitz())) return *this;
  auto n = std::make_unique<Node>();
  n->op = Op::Claim;
  n->value = bound;
  n->args[0] = unclaimed();
  return NodeTable::instance().intern(std::move(n));
}

#define SDF_UNARY(name, call, ...) \
  Expr call(const Expr& a) { return Expr::make(Op::name, {&a, 1}); }
#define SDF_BINARY(name, call, ...) \
  Expr call(const Expr& a, const Expr& b) { return Expr::make(Op::name, std::array{a, b}); }
#define SDF_TERNARY(name, call, ...) \
  Expr call(const Expr& a, const Expr& b, const Expr& c) { return Expr::make(Op::name, std::array{a, b, c}); }
#include "sdf/expr/ops.def"

Expr operator-(const Expr& a) { return neg(a); }
Expr operator+(const Expr& a, const Expr& b) { return add(a, b); }
Expr operator-(const Expr& a, const Expr& b) { return sub(a, b); }
Expr operator*(const Expr& a, const Expr& b) { return a == b ? square(a) : mul(a, b); }
Expr operator/(const Expr& a, const Expr& b) { return div(a, b); }

Expr clamp(const Expr& a, const Expr& lo, const Expr& hi) { return min(max(a, lo), hi); }
Expr mix(const Expr& a, const Expr& b, const Expr& t) { return a == b ? a : a + (b - a) * t; }

std::vector<Expr> topologicalOrder(std::span<const Expr> roots) {
  std::vector<Expr> order;
  FlatMap<bool> seen;
  std::vector<std::pair<const Expr*, int>> stack;
  const auto visit = [&](const Expr& e) {
    if (seen.insert(e.node(), true).second) stack.emplace_back(&e, 0);
  };
  for (const Expr& root : roots) {
    visit(root);
    while (!stack.empty()) {
      auto& [e, next] = stack.back();
      if (next < arity(e->op())) {
        visit(e->arg(next++));
      } else {
        order.push_back(*e);
        stack.pop_back();
      }
    }
  }
  return order;
}

bool dependsOnSpace(const Expr& e) {
  return std::ranges::any_of(topologicalOrder({&e, 1}), [](const Expr& n) { return n.op() == Op::Variable; });
}

double uniformValue(const Expr& e) {
  std::unordered_map<const Node*, double> values;
  for (const Expr& n : topologicalOrder({&e, 1})) {
    assert(n.op() != Op::Variable);
    double& v = values[n.node()];
    if (n.op() == Op::Constant)
      v = n.constantValue();
    else if (n.op() == Op::Parameter)
      v = n.parameterInfo().value;
    else
      v = evaluateOp<double>(n.op(), n.payloadPart(), [&](int i) { return values.at(n.arg(i).node()); });
  }
  return values.at(e.node());
}

namespace {

// The node's operation, or payload, over other arguments, as many as it has; a leaf is itself.
Expr remade(const Expr& node, std::span<const Expr> args) {
  if (args.empty()) return node;
  const Origin origin(node);
  if (node.op() == Op::Payload) return Expr::payload(*node.payloadPart(), {args[0], args[1], args[2]});
  return Expr::make(node.op(), args);
}

}  // namespace

std::vector<Expr> rewrite(std::span<const Expr> roots, const Replacement& replacement) {
  std::unordered_map<const Node*, Expr> made;
  std::vector<Expr> args;
  for (const Expr& n : topologicalOrder(roots)) {
    args.clear();
    bool same = true;
    for (int i = 0; i < arity(n.op()); ++i) {
      const Expr& argument = n.arg(i);
      args.push_back(made.at(argument.node()));
      same = same && args.back() == argument;
    }
    std::optional<Expr> e = replacement(n, args);
    if (!e) e = same ? n : n.op() == Op::Claim ? args[0] : remade(n, args);
    made.emplace(n.node(), *std::move(e));
  }
  std::vector<Expr> result;
  for (const Expr& r : roots) result.push_back(made.at(r.node()));
  return result;
}

Expr rewrite(const Expr& root, const Replacement& replacement) {
  return rewrite({&root, 1}, replacement).front();
}

std::vector<Expr> withoutClaims(std::span<const Expr> roots) {
  return rewrite(roots, [](const Expr& n, std::span<const Expr> args) {
    return n.op() == Op::Claim ? std::optional(args[0]) : std::nullopt;
  });
}

std::vector<Expr> remap(std::span<const Expr> es, const std::array<Expr, 3>& position, double stretch) {
  constexpr double kRounding = 1e-12;  // a claim that gains no more than rounding loses is not worth a node
  return rewrite(es, [&](const Expr& n, std::span<const Expr> args) -> std::optional<Expr> {
    const double bound = n.lipschitz() * stretch;
    if (n.op() == Op::Claim) return args[0].claimLipschitz(bound);
    const bool coordinate = n.op() == Op::Variable && n.variableIndex() <= Variable::Z;
    const Expr e = coordinate ? position[static_cast<int>(n.variableIndex())] : remade(n, args);
    return bound < e.lipschitz() * (1.0 - kRounding) ? e.claimLipschitz(bound) : e;
  });
}

Expr remap(const Expr& e, const std::array<Expr, 3>& position, double stretch) {
  return remap({&e, 1}, position, stretch).front();
}

}  // namespace sdf
