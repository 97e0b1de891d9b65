// Reads an expression over boxes, case by case where it chooses by rounding.
#pragma once
#include <map>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// What intervals know of a continuous expression over a box. Where copies are looked at through a window
/// that jumps, a box across the jump would mix the places of several windows: each of them is read on its own
/// there, and the bounds hold for all. Not thread-safe.
class CaseReading {
 public:
  /// Precondition: `e` depends on no inputs. Cost: linear in the size of the graph.
  explicit CaseReading(const Expr& e);

  struct Bounds {
    Interval value;
    double slope;  ///< infinite where it is not known
  };
  /// Cost: that of the operations, for each case.
  Bounds read(const Box& box);

  std::size_t operations() const { return whole_->instructions().size(); }

 private:
  std::vector<std::vector<double>> casesOf(std::size_t roundings) const;
  const TapePtr& tapeOf(const std::vector<double>& values);

  TapePtr whole_;  // the expression, and all that is rounded in it
  Function cases_;
  std::map<std::vector<double>, TapePtr> tapes_;  // by what the roundings give
  ScalarReading<Interval> reading_;
};

}  // namespace sdf
