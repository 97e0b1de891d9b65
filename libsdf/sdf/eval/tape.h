// Tape: expressions laid out as straight code, for one or more outputs; and its specialisation to a region.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sdf/expr/expr.h"
#include "sdf/expr/payload.h"

namespace sdf {

/// Where an instruction finds an argument: a variable, an earlier instruction's value, or a constant.
class Operand {
 public:
  constexpr Operand() = default;
  static constexpr Operand variable(Variable v) { return Operand(static_cast<std::uint32_t>(v)); }
  static constexpr Operand value(std::size_t instruction) {
    return Operand(static_cast<std::uint32_t>(instruction) + kVariableCount);
  }
  static constexpr Operand constant(std::size_t index) {
    return Operand(static_cast<std::uint32_t>(index) | kConstantBit);
  }
  constexpr bool isConstant() const { return bits_ & kConstantBit; }
  constexpr bool isVariable() const { return bits_ < kVariableCount; }
  constexpr bool isValue() const { return !isConstant() && !isVariable(); }
  /// Index of the constant, of the variable, or of the instruction.
  constexpr std::uint32_t index() const {
    return isConstant() ? bits_ & ~kConstantBit : isVariable() ? bits_ : bits_ - kVariableCount;
  }
  friend constexpr bool operator==(Operand, Operand) = default;

 private:
  static constexpr std::uint32_t kConstantBit = 1u << 31;
  explicit constexpr Operand(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

/// One operation. The constants of a fused operation lie in a row from `constants` on; a payload is the one
/// at this place of the tape's list.
struct Instruction {
  Op op;
  bool exact = false;  ///< floats do not do for it: a tape that has it is read in double
  std::array<Operand, 3> in;
  std::uint32_t constants = 0;
  float lipschitz = 0.0f;  ///< proven global bound of the value's slope, rounded up; infinite where unknown
  friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// The same instruction with registers. Registers [0, kVariableCount) are the variables.
struct RegisterInstruction {
  Op op;
  std::array<bool, 3> constant{};  ///< in[i] is an index of a constant, else a register
  std::uint32_t out;
  std::array<std::uint32_t, 3> in;
  std::uint32_t constants;
};

/// What is known of min, max, select and the comparisons over a region.
enum class Decision : std::uint8_t {
  Open,   ///< either may win
  First,  ///< min, max: the first argument wins everywhere; select: the condition holds; comparison: true
  Second  ///< the other way round
};

/// The number of tapes that this thread has compiled so far, which stands still where inputs alone change.
std::size_t tapesCompiled();

/// Immutable, and cheap to copy: copies and specialised tapes share what they can.
class Tape {
 public:
  /// Compiles the outputs with parameters at their defaults; see Function for other values.
  explicit Tape(std::span<const Expr> outputs);
  explicit Tape(const Expr& output) : Tape(std::span(&output, 1)) {}

  const std::vector<Instruction>& instructions() const { return code_->instructions; }
  const std::vector<Operand>& outputs() const { return code_->outputs; }
  double constant(std::size_t i) const { return pool_->doubles[i]; }
  const float* floats() const { return pool_->floats.data(); }
  /// The instruction's payload (in either form); null where it is an operation.
  template <class AnyInstruction>
  const PayloadPart* payload(const AnyInstruction& n) const {
    return n.op == Op::Payload ? &pool_->payloads[n.constants] : nullptr;
  }

  /// Register form of the tape, for the batch readings.
  const std::vector<RegisterInstruction>& program() const { return code_->program; }
  /// Registers used by program(), variables included.
  std::uint32_t registerCount() const { return code_->registerCount; }
  /// Registers (or constants) that hold the outputs at the end.
  const std::vector<Operand>& programOutputs() const { return code_->programOutputs; }

  /// Instructions that can be decided (isDecidable); decisions are given in their order on the
  /// tape.
  std::size_t decisionCount() const { return code_->decisionCount; }
  /// Slope bound of output i.
  float lipschitz(std::size_t output = 0) const { return code_->slope(outputs()[output]); }
  /// Slope bound of an operand's value.
  float slope(Operand operand) const { return code_->slope(operand); }
  /// True where every decision can be taken from slopes alone (all min, max and comparisons have finite slope
  /// bounds).
  bool hasSlopes() const { return code_->hasSlopes; }
  /// True where the batch readings are in double, for one of its instructions is Instruction::exact.
  bool isExact() const { return code_->isExact; }

  /// The tape with decided branches dropped, and all that only they needed. Values are unchanged wherever the
  /// decisions hold (the batch reading's up to its rounding, as other operations may be fused). nullptr where
  /// nothing can be dropped. decisions[i * stride] belongs to the i-th decidable instruction.
  std::shared_ptr<const Tape> specialised(const Decision* decisions, std::size_t stride) const;
  /// The tape of output 0 alone.
  std::shared_ptr<const Tape> firstOutputOnly() const;

  /// The same tape with these instructions marked as Instruction::exact, by their places.
  std::shared_ptr<const Tape> readExactly(const std::vector<bool>& instructions) const;

  /// Do both come from one compilation and consist of the same instructions? Then all readings of both agree
  /// to the bit.
  friend bool operator==(const Tape& a, const Tape& b) {
    return a.pool_ == b.pool_ && a.outputs() == b.outputs() && a.instructions() == b.instructions();
  }
  /// The same of equal tapes.
  std::uint64_t hash() const;

 private:
  friend class TapeCompiler;
  friend class Function;
  friend class UnionTapes;

  struct Pool {
    std::vector<double> doubles;  // 0 and 1 come first: what a decided comparison turns into
    std::vector<float> floats;
    std::vector<PayloadPart> payloads;
  };
  struct Code {
    std::vector<Instruction> instructions;
    std::vector<Operand> outputs;
    std::vector<RegisterInstruction> program;
    std::vector<Operand> programOutputs;
    std::uint32_t registerCount = 0;
    std::size_t decisionCount = 0;
    bool hasSlopes = true;
    bool isExact = false;

    float slope(Operand operand) const;
    // Slope bound that follows from the arguments alone, for the operations that join branches: a branch
    // that jumps may have been dropped since the graph was built.
    float inheritedSlope(const Instruction& instruction) const;
    // Derives all else from instructions and outputs.
    void finish();
    void allocateRegisters();
  };

  Tape(std::shared_ptr<const Code> code, std::shared_ptr<const Pool> pool)
      : code_(std::move(code)), pool_(std::move(pool)) {}
  // The instructions that `outputs` need, each value replaced by what `known` says it is.
  std::shared_ptr<const Tape> reduced(const std::vector<Operand>& known,
                                      std::span<const Operand> outputs) const;

  std::shared_ptr<const Code> code_;
  std::shared_ptr<const Pool> pool_;
};

using TapePtr = std::shared_ptr<const Tape>;

constexpr bool isDecidable(Op op) { return choiceOf(op) != Choice::NoChoice; }

}  // namespace sdf
