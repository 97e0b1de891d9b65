#include "sdf/eval/tape_compiler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

thread_local std::size_t compiled = 0;

float roundedUp(double slope) {
  const float f = static_cast<float>(slope);
  return f < slope ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

std::size_t tapesCompiled() { return compiled; }

TapeCompiler::TapeCompiler(std::span<const Expr> outputs, bool fuses) : fuses_(fuses) {
  ++compiled;
  literal(0.0);  // at kZero
  literal(1.0);  // at kOne
  gather(outputs);
  layOutUniform();
  chooseInstructions(outputs);
  for (Index i = 0; i < nodes_.size(); ++i)
    if (matches_[i]) emit(i);
  for (const Expr& e : outputs) code_->outputs.push_back(place(indexOf(e)));
  pool_->floats.assign(pool_->doubles.begin(), pool_->doubles.end());
  code_->finish();
}

TapeCompiler::Index TapeCompiler::use(const Expr& e) {
  const Index i = indexOf(e);
  if (e.op() == Op::Claim)
    nodes_[i].claimed = std::max(nodes_[i].claimed, e.lipschitz());
  else
    nodes_[i].unclaimed = true;
  return i;
}

void TapeCompiler::gather(std::span<const Expr> outputs) {
  std::vector<Expr> order = topologicalOrder(outputs);
  nodes_.reserve(order.size());
  for (Expr& e : order) {
    if (e.op() == Op::Claim) continue;
    NodeInfo node;
    node.uniform = e.op() != Op::Variable;
    for (int k = 0; k < arity(e.op()); ++k) {
      node.args[k] = use(e.arg(k));
      ++nodes_[node.args[k]].uses;
      node.uniform = node.uniform && nodes_[node.args[k]].uniform;
    }
    indices_.insert(e.node(), static_cast<Index>(nodes_.size()));
    node.e = std::move(e);
    nodes_.push_back(std::move(node));
  }
  for (const Expr& e : outputs) use(e);
}

std::uint32_t TapeCompiler::literal(double v) {
  const auto [place, fresh] =
      literals_.insert(std::bit_cast<std::uint64_t>(v), static_cast<std::uint32_t>(pool_->doubles.size()));
  if (fresh) pool_->doubles.push_back(v);
  return place;
}

// What depends on inputs alone is computed in double, once for all points.
void TapeCompiler::layOutUniform() {
  for (NodeInfo& node : nodes_) {
    if (!node.uniform) continue;
    if (node.e.isConstant()) {
      node.place = literal(node.e.constantValue());
      continue;
    }
    node.place = static_cast<Index>(pool_->doubles.size());
    if (node.e.op() == Op::Parameter) {
      inputs_.push_back({node.e, node.place});
      pool_->doubles.push_back(node.e.parameterInfo().value);
      continue;
    }
    UniformStep step{node.e.op(), {}, node.place, node.e.payloadPart()};
    for (int k = 0; k < arity(step.op); ++k) step.in[k] = nodes_[node.args[k]].place;
    pool_->doubles.push_back(
        evaluateOp<double>(step.op, step.payload, [&](int k) { return pool_->doubles[step.in[k]]; }));
    steps_.push_back(step);
  }
}

void TapeCompiler::chooseInstructions(std::span<const Expr> outputs) {
  matches_.resize(nodes_.size());
  for (const Expr& e : outputs) nodes_[indexOf(e)].needed = true;
  for (Index i = static_cast<Index>(nodes_.size()); i-- > 0;) {
    if (!nodes_[i].needed || nodes_[i].uniform || arity(op(i)) == 0) continue;
    matches_[i] = match(i);
    for (const Index a : matches_[i].nodes()) nodes_[a].needed = true;
  }
}

TapeCompiler::Shifted TapeCompiler::shifted(Index i) const {
  const bool difference = op(i) == Op::Sub;
  if (!difference && op(i) != Op::Add) return {i, {}};
  if (nodes_[arg(i, 1)].uniform) return {arg(i, 0), Number{arg(i, 1), !difference}};
  if (!difference && nodes_[arg(i, 0)].uniform) return {arg(i, 1), Number{arg(i, 0), true}};
  return {i, {}};
}

TapeCompiler::Match TapeCompiler::match(Index i) const {
  if (!fuses_) return {op(i), nodes_[i].args, {}};
  if (const Match m = matchLength(i, {})) return m;
  if (const Shifted s = shifted(i); s.offset && nodes_[s.base].uses == 1) {
    if (const Match m = matchLength(s.base, s.offset)) return m;
    if (op(s.base) == Op::Abs) return {Op::AbsMinus, {arg(s.base, 0)}, {s.offset}};
  }
  if (op(i) == Op::Add)
    for (const int k : {0, 1}) {
      const Index product = arg(i, k), rest = arg(i, 1 - k);
      if (nodes_[product].uses > 1) continue;
      if (op(product) ==
          Op::Mul) {  // a constant factor second, where the batch reading keeps it in a register
        const bool swap = nodes_[arg(product, 0)].uniform;
        return {Op::MulAdd, {arg(product, swap), arg(product, !swap), rest}, {}};
      }
      if (op(product) == Op::Square) return {Op::MulAdd, {arg(product, 0), arg(product, 0), rest}, {}};
    }
  return {op(i), nodes_[i].args, {}};
}

// sqrt(a² + b²) - offset, sqrt(a² + b² + c²) - offset, and the latter with shifted arguments. Squares and
// sums that others use as well are worked out again: that is cheaper than a pass through memory.
TapeCompiler::Match TapeCompiler::matchLength(Index root, Number offset) const {
  if (op(root) != Op::Sqrt || nodes_[root].uniform || op(arg(root, 0)) != Op::Add) return {};
  // The fused operations add the first square last, as a² + (b² + c²) does. (a² + b²) + c² rounds otherwise.
  Index first = arg(arg(root, 0), 0), rest = arg(arg(root, 0), 1);
  if (op(first) == Op::Add) std::swap(first, rest);
  if (op(first) != Op::Square) return {};
  if (op(rest) == Op::Square) return {Op::Length2, {arg(first, 0), arg(rest, 0)}, {offset}};
  if (op(rest) != Op::Add || op(arg(rest, 0)) != Op::Square || op(arg(rest, 1)) != Op::Square) return {};
  const std::array terms{arg(first, 0), arg(arg(rest, 0), 0), arg(arg(rest, 1), 0)};
  const Shifted a = shifted(terms[0]), b = shifted(terms[1]), c = shifted(terms[2]);
  if (bool(a.offset) + bool(b.offset) + bool(c.offset) < 2) return {Op::Length3, terms, {offset}};
  return {Op::Distance3, {a.base, b.base, c.base}, {a.offset, b.offset, c.offset, offset}};
}

// A fused operation's numbers lie in a row, so they are not shared.
void TapeCompiler::addToPool(const Number& number) {
  const auto place = static_cast<std::uint32_t>(pool_->doubles.size());
  pool_->doubles.push_back(0.0);
  if (!number) return;
  const NodeInfo& node = nodes_[number.node];
  const double value = pool_->doubles[node.place];
  pool_->doubles[place] = number.negative ? -value : value;
  if (!node.e.isConstant()) steps_.push_back({number.negative ? Op::Neg : Op::Claim, {node.place}, place});
}

Operand TapeCompiler::place(Index i) const {
  const NodeInfo& node = nodes_[i];
  if (node.uniform) return Operand::constant(node.place);
  return op(i) == Op::Variable ? Operand::variable(node.e.variableIndex()) : Operand::value(node.place);
}

void TapeCompiler::emit(Index i) {
  const Match& m = matches_[i];
  NodeInfo& node = nodes_[i];
  const double slope = node.e.lipschitz();
  Instruction instruction{
      .op = m.op, .in = {}, .lipschitz = roundedUp(node.unclaimed ? slope : std::min(slope, node.claimed))};
  for (int k = 0; k < rowArguments(m.op); ++k) instruction.in[k] = place(m.args[k]);
  const int numbers = info(m.op).constants;
  if (numbers > 0) instruction.constants = static_cast<std::uint32_t>(pool_->doubles.size());
  for (int k = 0; k < numbers; ++k) addToPool(m.numbers[k]);
  if (const PayloadPart* payload = node.e.payloadPart()) {
    instruction.constants = static_cast<std::uint32_t>(pool_->payloads.size());
    pool_->payloads.push_back(*payload);
  }
  node.place = static_cast<Index>(code_->instructions.size());
  code_->instructions.push_back(instruction);
  emitted_.push_back(node.e);
}

}  // namespace sdf
