// Tapes of wide unions, put together from those operands that matter in a region.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sdf/eval/tape.h"

namespace sdf {

/// A union of functions, each with its distance as output 0 and as many others, such as its colour. Linking
/// the operands of a region costs what these are long, however many others there are.
class UnionTapes {
 public:
  /// The operands' tapes, at least one, all with as many outputs. Cost: the sum of their sizes. A blended
  /// union's `join` has x and y for the distances of two operands, and outputs the joint distance, the weight
  /// of the second's outputs, and whether the second is taken where nothing can be mixed, in the last output.
  explicit UnionTapes(std::span<const TapePtr> operands, TapePtr join = nullptr);

  /// The tape of these operands' union: the least distance, and the other outputs of the operand that has it,
  /// the last one on a tie; or what the join makes of them from left to right. `operands` are places in
  /// ascending order, at least one. Cost: linear in the sum of the operands' sizes; one alone is given as it
  /// is.
  TapePtr link(std::span<const std::uint32_t> operands) const;

 private:
  struct Source {
    TapePtr tape;
    std::uint32_t firstConstant, firstPayload;  // in the pool of all
  };
  class Linker;
  Source add(const TapePtr& tape, Tape::Pool& pool);

  std::vector<Source> operands_;
  std::optional<Source> join_;
  std::shared_ptr<const Tape::Pool> pool_;
};

}  // namespace sdf
