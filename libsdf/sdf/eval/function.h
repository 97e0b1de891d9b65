// Function: expressions compiled once, to be read at any values of their inputs.
#pragma once
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sdf/eval/tape.h"

namespace sdf {

/// Values of inputs by name. An input that is not named has its default; names of no input are passed over.
using Values = std::map<std::string, double>;

/// An immutable function of position, normal and named inputs. It is made once from expressions; every
/// reading starts from its tape at some values of the inputs, which compiles nothing. Functions are cheap to
/// copy and may be read from any thread.
class Function {
 public:
  /// Compiles the outputs, sharing common parts and fusing operations (e.g. sqrt of a sum of squares). What
  /// depends on inputs alone is left to at(). Cost: linear in the size of the graph.
  explicit Function(std::vector<Expr> outputs);
  explicit Function(const Expr& output) : Function(std::vector{output}) {}

  const std::vector<Expr>& outputs() const;
  /// The parameters that the outputs depend on, each name once.
  const std::vector<ParameterInfo>& inputs() const;

  /// Do all values lie in their inputs' declared ranges, for which bounds and slopes hold?
  bool covers(const Values& values) const;
  /// The tape with inputs at these values. Slope bounds hold for inputs within their declared ranges; where a
  /// value lies outside, the tape knows none. Cost: linear in the number of the tape's constants.
  TapePtr at(const Values& values = {}) const;
  /// The outputs' values, none of which may depend on the position or the normal. Cost: that of the
  /// operations.
  std::vector<double> uniform(const Values& values = {}) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace sdf
