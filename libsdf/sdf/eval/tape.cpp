#include "sdf/eval/tape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdf/base/fnv.h"
#include "sdf/eval/tape_compiler.h"

namespace sdf {
Tape::Tape(std::span<const Expr> outputs) : Tape(TapeCompiler(outputs).take()) {}

float Tape::Code::slope(Operand operand) const {
  if (operand.isConstant()) return 0.0f;
  if (operand.isValue()) return instructions[operand.index()].lipschitz;
  // The normal varies over the surface without bound.
  return operand.index() <= static_cast<std::uint32_t>(Variable::Z) ? 1.0f
                                                                    : std::numeric_limits<float>::infinity();
}

float Tape::Code::inheritedSlope(const Instruction& n) const {
  if (isMinOrMax(n.op)) return std::max(slope(n.in[0]), slope(n.in[1]));
  return info(n.op).slope == Slope::Nonexpansive ? slope(n.in[0]) : std::numeric_limits<float>::infinity();
}

void Tape::Code::finish() {
  decisionCount = 0;
  hasSlopes = true;
  isExact = false;
  for (const Instruction& i : instructions) {
    isExact = isExact || i.exact;
    if (!isDecidable(i.op)) continue;
    ++decisionCount;
    if (choiceOf(i.op) != Choice::Selected)
      hasSlopes = hasSlopes && std::isfinite(slope(i.in[0]) + slope(i.in[1]));
  }
  allocateRegisters();
}

// Linear scan over straight code: a register is free again after the last use of its value.
void Tape::Code::allocateRegisters() {
  constexpr std::uint32_t kNone = ~0u;
  const std::size_t count = instructions.size();
  std::vector<std::size_t> lastUse(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < rowArguments(instructions[i].op); ++k)
      if (const Operand a = instructions[i].in[k]; a.isValue()) lastUse[a.index()] = i;
  for (const Operand o : outputs)
    if (o.isValue()) lastUse[o.index()] = count;

  std::vector<std::uint32_t> registerOf(count, kNone), free;
  registerCount = kVariableCount;
  auto where = [&](Operand a) { return a.isValue() ? registerOf[a.index()] : a.index(); };
  program.clear();
  program.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Instruction& source = instructions[i];
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
    if (free.empty()) free.push_back(registerCount++);
    r.out = registerOf[i] = free.back();
    free.pop_back();
    program.push_back(r);
  }
  programOutputs.clear();
  for (const Operand o : outputs)
    programOutputs.push_back(o.isValue() ? Operand::value(registerOf[o.index()] - kVariableCount) : o);
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

// The operand that an instruction stands for under decision d, its arguments resolved to `in`. A factor that
// a decision turned into 0, as a blend's width where nothing is blended, makes its product with a finite
// constant 0.
Operand resolve(const Tape& tape, const Instruction& instruction, Operand self, Decision d,
                const std::array<Operand, 3>& in) {
  const Op op = instruction.op;
  const bool isSelected = choiceOf(op) == Choice::Selected;
  if (isSelected && in[0].isConstant())
    d = tape.constant(in[0].index()) != 0.0 ? Decision::First : Decision::Second;
  if (d != Decision::Open) {
    if (isComparison(op)) return Operand::constant(d == Decision::First ? kOne : kZero);
    return in[(d == Decision::First ? 0 : 1) + (isSelected ? 1 : 0)];
  }
  if (info(op).neutral == 0.0) {
    if (info(op).symmetry == Symmetry::Symmetric && in[0] == kZeroOperand) return in[1];
    return in[1] == kZeroOperand ? in[0] : self;
  }
  const auto vanished = [&](int k) { return in[k] == kZeroOperand && instruction.in[k].isValue(); };
  const auto finite = [&](int k) {
    return in[k].isConstant() && std::isfinite(tape.constant(in[k].index()));
  };
  const auto vanishes = [&] { return (vanished(0) && finite(1)) || (vanished(1) && finite(0)); };
  if (op == Op::Square) return vanished(0) ? kZeroOperand : self;
  if (op == Op::MulAdd) return vanishes() ? in[2] : self;
  return info(op).linearity == Linearity::Bilinear && vanishes() ? kZeroOperand : self;
}

Operand knownAs(const std::vector<Operand>& known, Operand a) { return a.isValue() ? known[a.index()] : a; }

}  // namespace

std::shared_ptr<const Tape> Tape::specialised(const Decision* decisions, std::size_t stride) const {
  std::vector<Operand> known(
      instructions().size());  // what each value stands for: itself, or another operand
  std::size_t decision = 0;
  bool changed = false;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Instruction& instruction = instructions()[i];
    std::array<Operand, 3> in = instruction.in;
    for (Operand& a : in) a = knownAs(known, a);
    const Decision d = isDecidable(instruction.op) ? decisions[decision++ * stride] : Decision::Open;
    known[i] = resolve(*this, instruction, Operand::value(i), d, in);
    changed = changed || known[i] != Operand::value(i);
  }
  return changed ? reduced(known, outputs()) : nullptr;
}

std::shared_ptr<const Tape> Tape::firstOutputOnly() const {
  std::vector<Operand> known(instructions().size());
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = Operand::value(i);
  return reduced(known, {outputs().data(), 1});
}

std::shared_ptr<const Tape> Tape::readExactly(const std::vector<bool>& marked) const {
  auto code = std::make_shared<Code>(*code_);
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i]) code->instructions[i].exact = code->isExact = true;
  return std::shared_ptr<const Tape>(new Tape(std::move(code), pool_));
}

std::uint64_t Tape::hash() const {
  auto h = kFnvBegin<std::uint64_t>;
  for (const Instruction& i : instructions()) {
    h = fnv<std::uint64_t>(h, static_cast<std::uint64_t>(i.op) << 32 | i.constants);
    for (const Operand a : i.in) h = fnv<std::uint64_t>(h, a.index());
  }
  return h;
}

std::shared_ptr<const Tape> Tape::reduced(const std::vector<Operand>& known,
                                          std::span<const Operand> outputs) const {
  const std::size_t count = instructions().size();
  std::vector<bool> needed(count, false);
  auto need = [&](Operand a) {
    a = knownAs(known, a);
    if (a.isValue()) needed[a.index()] = true;
  };
  for (const Operand o : outputs) need(o);
  for (std::size_t i = count; i-- > 0;)
    if (needed[i])
      for (int k = 0; k < rowArguments(instructions()[i].op); ++k) need(instructions()[i].in[k]);

  auto code = std::make_shared<Code>();
  code->instructions.reserve(std::count(needed.begin(), needed.end(), true));
  std::vector<std::uint32_t> placeOf(count);
  auto moved = [&](Operand a) {
    a = knownAs(known, a);
    return a.isValue() ? Operand::value(placeOf[a.index()]) : a;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    Instruction instruction = instructions()[i];
    for (int k = 0; k < rowArguments(instruction.op); ++k) instruction.in[k] = moved(instruction.in[k]);
    placeOf[i] = static_cast<std::uint32_t>(code->instructions.size());
    instruction = withoutZeros(instruction);
    instruction.lipschitz = std::min(instruction.lipschitz, code->inheritedSlope(instruction));
    code->instructions.push_back(instruction);
  }
  for (const Operand o : outputs) code->outputs.push_back(moved(o));
  code->finish();
  return std::shared_ptr<const Tape>(new Tape(std::move(code), pool_));
}

}  // namespace sdf
