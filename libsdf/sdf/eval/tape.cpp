#include "sdf/eval/tape.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

constexpr std::uint32_t kZero = 0;  // places of 0 and 1 in every pool
constexpr std::uint32_t kOne = 1;

float roundedUp(double slope) {
  const float f = static_cast<float>(slope);
  return f < slope ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

bool isOp(const Expr& e, Op op) { return e.op() == op; }

// a - offset, with offset 0 where the expression is not a shift by a constant.
struct Shifted {
  Expr base;
  double offset = 0.0;
};
Shifted shifted(const Expr& e) {
  if (isOp(e, Op::Sub) && e.arg(1).isConstant()) return {e.arg(0), e.arg(1).constantValue()};
  if (isOp(e, Op::Add) && e.arg(1).isConstant()) return {e.arg(0), -e.arg(1).constantValue()};
  if (isOp(e, Op::Add) && e.arg(0).isConstant()) return {e.arg(1), -e.arg(0).constantValue()};
  return {e, 0.0};
}

// What one node becomes on the tape.
struct Match {
  Op op = Op::Constant;
  std::vector<Expr> args;
  std::vector<double> constants;
};

}  // namespace

// Chooses an instruction for every node that is needed, working back from the outputs, so that what a fused
// operation swallows is emitted only if somebody else needs it; then emits in order.
class TapeCompiler {
 public:
  explicit TapeCompiler(std::span<const Expr> outputs) : order_(topologicalOrder(outputs)) {
    pool_->doubles = {0.0, 1.0};
    constantAt_ = {{key(0.0), kZero}, {key(1.0), kOne}};
    for (const Expr& e : order_)
      for (int i = 0; i < arity(e.op()); ++i) ++uses_[e.arg(i).node()];
    foldUniform();
    std::unordered_map<const Node*, Match> matches = chooseInstructions(outputs);
    for (const Expr& e : order_) emit(e, matches);
    for (const Expr& e : outputs) tape_.outputs_.push_back(place(e));
    pool_->floats.assign(pool_->doubles.begin(), pool_->doubles.end());
    tape_.pool_ = pool_;
    tape_.finish();
  }

  Tape take() { return std::move(tape_); }

 private:
  static std::uint64_t key(double v) { return std::bit_cast<std::uint64_t>(v); }

  // Values that depend on parameters alone are numbers by now.
  void foldUniform() {
    for (const Expr& e : order_) {
      if (isOp(e, Op::Constant)) uniform_[e.node()] = e.constantValue();
      if (isOp(e, Op::Parameter)) uniform_[e.node()] = e.parameterInfo().value;
      const int count = arity(e.op());
      if (count == 0) continue;
      bool all = true;
      for (int i = 0; i < count; ++i) all = all && uniform_.contains(e.arg(i).node());
      if (all)
        uniform_[e.node()] = evaluateOp<double>(e.op(), [&](int i) { return uniform_.at(e.arg(i).node()); });
    }
  }

  std::unordered_map<const Node*, Match> chooseInstructions(std::span<const Expr> outputs) {
    std::unordered_map<const Node*, bool> needed;
    for (const Expr& e : outputs) needed[e.node()] = true;
    std::unordered_map<const Node*, Match> matches;
    for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
      if (!needed[it->node()] || arity(it->op()) == 0 || uniform_.contains(it->node())) continue;
      Match m = match(*it);
      for (const Expr& a : m.args) needed[a.node()] = true;
      matches.emplace(it->node(), std::move(m));
    }
    return matches;
  }

  Match match(const Expr& e) const {
    if (Match m = matchLength(e, 0.0); !m.args.empty()) return m;
    if (const Shifted s = shifted(e); s.offset != 0.0 && uses_.at(s.base.node()) == 1) {
      if (Match m = matchLength(s.base, s.offset); !m.args.empty()) return m;
      if (isOp(s.base, Op::Abs)) return {Op::AbsMinus, {s.base.arg(0)}, {s.offset}};
    }
    if (isOp(e, Op::Add))
      for (int i : {0, 1}) {
        const Expr product = e.arg(i), rest = e.arg(1 - i);
        if (uses_.at(product.node()) > 1) continue;
        if (isOp(product,
                 Op::Mul)) {  // a constant factor second, where the batch reading keeps it in a register
          const bool swap = uniform_.contains(product.arg(0).node());
          return {Op::MulAdd, {product.arg(swap), product.arg(!swap), rest}, {}};
        }
        if (isOp(product, Op::Square)) return {Op::MulAdd, {product.arg(0), product.arg(0), rest}, {}};
      }
    Match m{e.op(), {}, {}};
    for (int i = 0; i < arity(e.op()); ++i) m.args.push_back(e.arg(i));
    return m;
  }

  // sqrt(a² + b²) - offset, sqrt(a² + b² + c²) - offset, and the latter with shifted arguments. Squares and
  // sums that others use as well are worked out again: that is cheaper than a pass through memory.
  Match matchLength(const Expr& root, double offset) const {
    std::vector<Expr> terms;
    if (!isOp(root, Op::Sqrt) || !collectSquares(root.arg(0), terms)) return {};
    // The fused operations add the first square last, as a² + (b² + c²) does. (a² + b²) + c² rounds
    // otherwise.
    if (isOp(root.arg(0), Op::Add) && isOp(root.arg(0).arg(0), Op::Add))
      std::rotate(terms.begin(), terms.end() - 1, terms.end());
    if (terms.size() == 2) return {Op::Length2, terms, {offset}};
    if (terms.size() != 3) return {};
    Match m{Op::Distance3, {}, {}};
    int shifts = 0;
    for (const Expr& t : terms) {
      const Shifted s = shifted(t);
      shifts += s.offset != 0.0;
      m.args.push_back(s.base);
      m.constants.push_back(s.offset);
    }
    m.constants.push_back(offset);
    return shifts >= 2 ? m : Match{Op::Length3, terms, {offset}};
  }

  static bool collectSquares(const Expr& e, std::vector<Expr>& terms) {
    if (isOp(e, Op::Square)) return terms.push_back(e.arg(0)), terms.size() <= 3;
    if (isOp(e, Op::Add)) return collectSquares(e.arg(0), terms) && collectSquares(e.arg(1), terms);
    return false;
  }

  std::uint32_t constant(double v) {
    const auto [it, fresh] =
        constantAt_.try_emplace(key(v), static_cast<std::uint32_t>(pool_->doubles.size()));
    if (fresh) pool_->doubles.push_back(v);
    return it->second;
  }

  Operand place(const Expr& e) {
    if (auto it = uniform_.find(e.node()); it != uniform_.end())
      return Operand::constant(constant(it->second));
    if (isOp(e, Op::Variable)) return Operand::variable(e.variableIndex());
    return Operand::value(valueAt_.at(e.node()));
  }

  void emit(const Expr& e, const std::unordered_map<const Node*, Match>& matches) {
    const auto it = matches.find(e.node());
    if (it == matches.end()) return;
    const Match& m = it->second;
    Instruction instruction{m.op, {}, 0, roundedUp(e.lipschitz())};
    for (std::size_t i = 0; i < m.args.size(); ++i) instruction.in[i] = place(m.args[i]);
    if (!m.constants.empty()) {  // must be consecutive, so they are not shared
      instruction.constants = static_cast<std::uint32_t>(pool_->doubles.size());
      pool_->doubles.insert(pool_->doubles.end(), m.constants.begin(), m.constants.end());
    }
    valueAt_[e.node()] = tape_.instructions_.size();
    tape_.instructions_.push_back(instruction);
  }

  std::vector<Expr> order_;
  std::unordered_map<const Node*, int> uses_;
  std::unordered_map<const Node*, double> uniform_;
  std::unordered_map<const Node*, std::size_t> valueAt_;
  std::shared_ptr<Tape::Pool> pool_ = std::make_shared<Tape::Pool>();
  std::map<std::uint64_t, std::uint32_t> constantAt_;
  Tape tape_;
};

Tape::Tape(std::span<const Expr> outputs) { *this = TapeCompiler(outputs).take(); }

float Tape::slope(Operand operand) const {
  if (operand.isConstant()) return 0.0f;
  if (operand.isValue()) return instructions_[operand.index()].lipschitz;
  // The normal varies over the surface without bound.
  return operand.index() <= static_cast<std::uint32_t>(Variable::Z) ? 1.0f
                                                                    : std::numeric_limits<float>::infinity();
}

float Tape::inheritedSlope(const Instruction& n) const {
  switch (n.op) {
    case Op::Neg:
    case Op::Abs:
      return slope(n.in[0]);
    case Op::Min:
    case Op::Max:
      return std::max(slope(n.in[0]), slope(n.in[1]));
    default:
      return std::numeric_limits<float>::infinity();
  }
}

void Tape::finish() {
  decisionCount_ = 0;
  hasSlopes_ = true;
  for (const Instruction& i : instructions_) {
    if (!isDecidable(i.op)) continue;
    ++decisionCount_;
    if (i.op != Op::Select) hasSlopes_ = hasSlopes_ && std::isfinite(slope(i.in[0]) + slope(i.in[1]));
  }
  allocateRegisters();
}

// Linear scan over straight code: a register is free again after the last use of its value.
void Tape::allocateRegisters() {
  constexpr std::uint32_t kNone = ~0u;
  const std::size_t count = instructions_.size();
  std::vector<std::size_t> lastUse(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < rowArguments(instructions_[i].op); ++k)
      if (const Operand a = instructions_[i].in[k]; a.isValue()) lastUse[a.index()] = i;
  for (const Operand o : outputs_)
    if (o.isValue()) lastUse[o.index()] = count;

  std::vector<std::uint32_t> registerOf(count, kNone), free;
  registerCount_ = kVariableCount;
  auto where = [&](Operand a) { return a.isValue() ? registerOf[a.index()] : a.index(); };
  program_.clear();
  program_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Instruction& source = instructions_[i];
    RegisterInstruction r{source.op, {}, 0, {}, source.constants};
    for (int k = 0; k < rowArguments(source.op); ++k) {
      r.in[k] = where(source.in[k]);
      r.constant[k] = source.in[k].isConstant();
    }
    for (int k = 0; k < rowArguments(source.op); ++k) {
      const Operand a = source.in[k];
      if (!a.isValue() || lastUse[a.index()] != i || registerOf[a.index()] == kNone) continue;
      free.push_back(registerOf[a.index()]);
      registerOf[a.index()] = kNone;  // an argument used twice is freed once
    }
    if (free.empty()) free.push_back(registerCount_++);
    r.out = registerOf[i] = free.back();
    free.pop_back();
    program_.push_back(r);
  }
  programOutputs_.clear();
  for (const Operand o : outputs_)
    programOutputs_.push_back(o.isValue() ? Operand::value(registerOf[o.index()] - kVariableCount) : o);
}

namespace {

constexpr Operand kZeroOperand = Operand::constant(kZero);

// Lengths with arguments that became 0 (a box's nearest face, say) turn into shorter ones. The arguments are
// resolved.
Instruction withoutZeros(Instruction n) {
  if (n.op != Op::Length2 && n.op != Op::Length3) return n;
  std::array<Operand, 3> rest{};
  int count = 0;
  for (int k = 0; k < rowArguments(n.op); ++k)
    if (n.in[k] != kZeroOperand) rest[count++] = n.in[k];
  n.in = rest;
  n.op = count == 3 ? Op::Length3 : count == 2 ? Op::Length2 : Op::AbsMinus;
  if (count == 0) n.in[0] = kZeroOperand;
  return n;
}

// The operand that instruction i stands for under decision d, its arguments resolved already.
Operand resolve(const Tape& tape, const Instruction& instruction, Operand self, Decision d,
                const std::array<Operand, 3>& in) {
  if (isComparison(instruction.op) && d != Decision::Open)
    return Operand::constant(d == Decision::First ? kOne : kZero);
  if (instruction.op == Op::Select) {
    if (in[0].isConstant()) d = tape.constant(in[0].index()) != 0.0 ? Decision::First : Decision::Second;
    return d == Decision::Open ? self : in[d == Decision::First ? 1 : 2];
  }
  if (isChoice(instruction.op) && d != Decision::Open) return in[d == Decision::First ? 0 : 1];
  if (instruction.op == Op::Add && in[0] == kZeroOperand) return in[1];
  if (instruction.op == Op::Add && in[1] == kZeroOperand) return in[0];
  return self;
}

Operand knownAs(const std::vector<Operand>& known, Operand a) { return a.isValue() ? known[a.index()] : a; }

}  // namespace

std::shared_ptr<const Tape> Tape::specialised(const Decision* decisions, std::size_t stride) const {
  std::vector<Operand> known(instructions_.size());  // what each value stands for: itself, or another operand
  std::size_t decision = 0;
  bool changed = false;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Instruction& instruction = instructions_[i];
    std::array<Operand, 3> in = instruction.in;
    for (Operand& a : in) a = knownAs(known, a);
    const Decision d = isDecidable(instruction.op) ? decisions[decision++ * stride] : Decision::Open;
    known[i] = resolve(*this, instruction, Operand::value(i), d, in);
    changed = changed || known[i] != Operand::value(i);
  }
  return changed ? reduced(known, outputs_) : nullptr;
}

std::shared_ptr<const Tape> Tape::firstOutputOnly() const {
  std::vector<Operand> known(instructions_.size());
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = Operand::value(i);
  return reduced(known, {outputs_.data(), 1});
}

std::shared_ptr<const Tape> Tape::reduced(const std::vector<Operand>& known,
                                          std::span<const Operand> outputs) const {
  const std::size_t count = instructions_.size();
  std::vector<bool> needed(count, false);
  auto need = [&](Operand a) {
    a = knownAs(known, a);
    if (a.isValue()) needed[a.index()] = true;
  };
  for (const Operand o : outputs) need(o);
  for (std::size_t i = count; i-- > 0;)
    if (needed[i])
      for (int k = 0; k < rowArguments(instructions_[i].op); ++k) need(instructions_[i].in[k]);

  auto result = std::shared_ptr<Tape>(new Tape);
  result->instructions_.reserve(std::count(needed.begin(), needed.end(), true));
  std::vector<std::uint32_t> placeOf(count);
  auto moved = [&](Operand a) {
    a = knownAs(known, a);
    return a.isValue() ? Operand::value(placeOf[a.index()]) : a;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    Instruction instruction = instructions_[i];
    for (int k = 0; k < rowArguments(instruction.op); ++k) instruction.in[k] = moved(instruction.in[k]);
    placeOf[i] = static_cast<std::uint32_t>(result->instructions_.size());
    instruction = withoutZeros(instruction);
    instruction.lipschitz = std::min(instruction.lipschitz, result->inheritedSlope(instruction));
    result->instructions_.push_back(instruction);
  }
  for (const Operand o : outputs) result->outputs_.push_back(moved(o));
  result->pool_ = pool_;
  result->finish();
  return result;
}

}  // namespace sdf
