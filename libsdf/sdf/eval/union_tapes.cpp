#include "sdf/eval/union_tapes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "sdf/eval/tape_compiler.h"

namespace sdf {

UnionTapes::UnionTapes(std::span<const TapePtr> operands, TapePtr join) {
  auto pool = std::make_shared<Tape::Pool>();
  pool->doubles = {0.0, 1.0};
  for (const TapePtr& tape : operands) operands_.push_back(add(tape, *pool));
  if (join) join_ = add(join, *pool);
  pool->floats.assign(pool->doubles.begin(), pool->doubles.end());
  pool_ = std::move(pool);
}

UnionTapes::Source UnionTapes::add(const TapePtr& tape, Tape::Pool& pool) {
  const Source source{tape, static_cast<std::uint32_t>(pool.doubles.size()),
                      static_cast<std::uint32_t>(pool.payloads.size())};
  const std::vector<PayloadPart>& payloads = tape->pool_->payloads;
  pool.payloads.insert(pool.payloads.end(), payloads.begin(), payloads.end());
  const std::vector<double>& own = tape->pool_->doubles;
  pool.doubles.insert(pool.doubles.end(), own.begin() + 2, own.end());
  return source;
}

/// Writes one tape's code.
class UnionTapes::Linker {
 public:
  Linker(const UnionTapes& from, std::span<const std::uint32_t> operands)
      : from_(from), operands_(operands) {}

  std::shared_ptr<const Tape::Code> run() {
    std::size_t length = 0;
    for (const std::uint32_t i : operands_) length += from_.operands_[i].tape->instructions().size() + 1;
    code_->instructions.reserve(length);
    code_->outputs = from_.join_ ? blended() : joined(operands_);
    code_->finish();
    return std::move(code_);
  }

 private:
  using Outputs = std::vector<Operand>;

  // Balanced, so that a region where one half wins drops the other half at once.
  Outputs joined(std::span<const std::uint32_t> operands) {
    if (operands.size() == 1) return appended(from_.operands_[operands[0]], {});
    const std::size_t half = operands.size() / 2;
    const Outputs a = joined(operands.first(half));
    const Outputs b = joined(operands.subspan(half));
    const float steeper = std::max(code_->slope(a[0]), code_->slope(b[0]));
    Outputs least{append({.op = Op::Min, .in = {a[0], b[0]}, .lipschitz = steeper})};
    std::optional<Operand> second;
    for (std::size_t k = 1; k < a.size(); ++k) {
      if (same(a[k], b[k])) {
        least.push_back(a[k]);
        continue;
      }
      if (!second) second = append({.op = Op::LessEqual, .in = {b[0], a[0]}, .lipschitz = kUnknown});
      least.push_back(append({.op = Op::Select, .in = {*second, b[k], a[k]}, .lipschitz = kUnknown}));
    }
    return least;
  }

  Outputs blended() {
    Outputs all = appended(from_.operands_[operands_[0]], {});
    for (const std::uint32_t i : operands_.subspan(1)) {
      const Outputs next = appended(from_.operands_[i], {});
      const Outputs join = appended(*from_.join_, {&all[0], &next[0]});
      all[0] = join[0];
      for (std::size_t k = 1; k < all.size(); ++k) {
        if (same(all[k], next[k])) continue;
        if (k + 1 == all.size()) {
          all[k] = append({.op = Op::Select, .in = {join[2], next[k], all[k]}, .lipschitz = kUnknown});
          continue;
        }
        const Operand apart = append({.op = Op::Sub, .in = {next[k], all[k]}, .lipschitz = kUnknown});
        all[k] = append({.op = Op::MulAdd, .in = {apart, join[1], all[k]}, .lipschitz = kUnknown});
      }
    }
    return all;
  }

  bool same(Operand a, Operand b) const {
    const std::vector<double>& numbers = from_.pool_->doubles;
    return a == b || (a.isConstant() && b.isConstant() && numbers[a.index()] == numbers[b.index()]);
  }

  // The source's outputs here. Its variables x and y are the position's, or these two values, whose slopes
  // are then the unit of those within.
  Outputs appended(const Source& source, std::array<const Operand*, 2> values) {
    const std::size_t first = code_->instructions.size();
    const std::uint32_t constants = source.firstConstant - 2;  // 0 and 1 are at the same place in all pools
    const float slope = values[0] ? std::max(code_->slope(*values[0]), code_->slope(*values[1])) : 1.0f;
    const auto moved = [&](Operand o) {
      if (o.isValue()) return Operand::value(first + o.index());
      if (o.isConstant()) return o.index() > kOne ? Operand::constant(constants + o.index()) : o;
      return values[0] ? *values[o.index()] : o;
    };
    for (Instruction instruction : source.tape->instructions()) {
      for (int k = 0; k < rowArguments(instruction.op); ++k) instruction.in[k] = moved(instruction.in[k]);
      instruction.constants += instruction.op == Op::Payload ? source.firstPayload : constants;
      if (instruction.lipschitz > 0.0f) instruction.lipschitz *= slope;
      code_->instructions.push_back(instruction);
    }
    Outputs outputs;
    for (const Operand o : source.tape->outputs()) outputs.push_back(moved(o));
    return outputs;
  }

  Operand append(const Instruction& instruction) {
    code_->instructions.push_back(instruction);
    return Operand::value(code_->instructions.size() - 1);
  }

  static constexpr float kUnknown = std::numeric_limits<float>::infinity();
  const UnionTapes& from_;
  std::span<const std::uint32_t> operands_;
  std::shared_ptr<Tape::Code> code_ = std::make_shared<Tape::Code>();
};

TapePtr UnionTapes::link(std::span<const std::uint32_t> operands) const {
  assert(!operands.empty());
  if (operands.size() == 1) return operands_[operands[0]].tape;
  return std::shared_ptr<const Tape>(new Tape(Linker(*this, operands).run(), pool_));
}

}  // namespace sdf
