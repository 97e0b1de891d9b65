// Expressions decoded from bytes, kept both as a graph and as the plain list of operations that it was
// written as.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "fuzz/bytes.h"
#include "sdf/expr/apply-inl.h"
#include "sdf/expr/vec.h"

namespace sdf::fuzz {

class Formula {
 public:
  /// x, y and z, then up to `most` steps, each on earlier ones.
  Formula(Bytes& bytes, int most);

  const Expr& root() const { return nodes_.back(); }
  const std::vector<Expr>& nodes() const { return nodes_; }

  /// The last step's value in double, no step being folded or shared.
  struct Value {
    double value;
    /// A step told the two zeros apart. The graph may have the other one: it takes x + 0 for x.
    bool signOfZeroMatters;
  };
  Value evaluate(const std::array<double, 3>& p) const;

 private:
  struct Step {
    Op op = Op::Constant;
    std::array<int, 3> in{};
    double value = 0.0;  // of a constant or parameter
  };

  void decodeStep(Bytes& bytes);
  int pick(Bytes& bytes) const;
  int add(const Step& step, Expr node);
  int constant(double value);
  int parameter(Bytes& bytes);
  int apply(Op op, std::array<int, 3> in);
  int length(const std::array<int, 3>& in, int count);

  std::vector<Step> steps_;
  std::vector<Expr> nodes_;
};

/// The graph as one assignment a node, numbers in full.
std::string text(const Expr& e);

}  // namespace sdf::fuzz
