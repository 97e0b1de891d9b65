// From a graph to a tape, and to what computes the tape's constants from values of its inputs. Private to
// eval/.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sdf/base/flat_map.h"
#include "sdf/eval/tape.h"

namespace sdf {

inline constexpr std::uint32_t kZero = 0;  // places of 0 and 1 in every pool
inline constexpr std::uint32_t kOne = 1;

/// One value that depends on inputs alone: places in the pool. A copy is written as a claim.
struct UniformStep {
  Op op;
  std::array<std::uint32_t, kMaxArity> in;
  std::uint32_t out;
  const PayloadPart* payload = nullptr;  // in a node that the outputs hold
};

/// An input's place in the pool.
struct InputPlace {
  Expr parameter;
  std::uint32_t place;
};

/// Chooses an instruction for every node that is needed, working back from the outputs, so that what a fused
/// operation swallows is emitted only if somebody else needs it; then emits in order. A claim is no
/// instruction: where a node is used through claims alone, its value has the slope that they state.
class TapeCompiler {
 public:
  /// `fuses`: may operations be fused? Else each instruction is one node.
  explicit TapeCompiler(std::span<const Expr> outputs, bool fuses = true);

  /// The tape with inputs at their defaults.
  Tape take() { return Tape(std::move(code_), std::move(pool_)); }
  std::vector<UniformStep> takeSteps() { return std::move(steps_); }
  std::vector<InputPlace> takeInputs() { return std::move(inputs_); }
  /// The node of each instruction.
  std::vector<Expr> takeNodes() { return std::move(emitted_); }

 private:
  using Index = std::uint32_t;
  struct NodeInfo {
    Expr e;
    std::array<Index, 3> args{};
    int uses = 0;
    bool uniform = false;    // depends on inputs alone
    bool needed = false;     // by an output or an instruction
    bool unclaimed = false;  // has a user that relies on no claim
    double claimed = 0.0;    // the largest slope that claims state
    Index place = 0;         // in the pool if uniform, else among the instructions
  };
  // A number that a fused operation takes: 0, or a uniform node, perhaps negated.
  struct Number {
    static constexpr Index kNone = ~Index{0};
    Index node = kNone;
    bool negative = false;
    explicit operator bool() const { return node != kNone; }
  };
  // An instruction, with as many arguments and numbers as its operation takes. A constant stands for none.
  struct Match {
    Op op = Op::Constant;
    std::array<Index, 3> args{};
    std::array<Number, 4> numbers{};
    explicit operator bool() const { return op != Op::Constant; }
    std::span<const Index> nodes() const {
      return std::span(args).first(static_cast<std::size_t>(rowArguments(op)));
    }
  };
  /// base - offset.
  struct Shifted {
    Index base;
    Number offset;
  };

  void gather(std::span<const Expr> outputs);
  Index use(const Expr& e);  // the argument's index
  void layOutUniform();
  void chooseInstructions(std::span<const Expr> outputs);
  Match match(Index i) const;
  Match matchLength(Index root, Number offset) const;
  Shifted shifted(Index i) const;
  std::uint32_t literal(double v);
  void addToPool(const Number& number);
  Operand place(Index i) const;
  void emit(Index i);

  Op op(Index i) const { return nodes_[i].e.op(); }
  Index arg(Index i, int k) const { return nodes_[i].args[k]; }
  Index indexOf(const Expr& e) const { return indices_.at(e.unclaimed().node()); }

  bool fuses_;
  std::vector<Expr> emitted_;
  std::vector<NodeInfo> nodes_;  // without claims, arguments before their users
  FlatMap<Index> indices_;
  std::vector<Match> matches_;  // by node
  FlatMap<std::uint32_t> literals_;
  std::vector<UniformStep> steps_;
  std::vector<InputPlace> inputs_;
  std::shared_ptr<Tape::Pool> pool_ = std::make_shared<Tape::Pool>();
  std::shared_ptr<Tape::Code> code_ = std::make_shared<Tape::Code>();
};

}  // namespace sdf
