#include "sdf/shape/calibrate/cells.h"

#include <unordered_map>

#include "sdf/expr/apply-inl.h"

namespace sdf {

IntervalReading::IntervalReading(std::span<const Expr> roots)
    : order_(topologicalOrder(roots)), values_(order_.size()) {
  std::unordered_map<Expr, std::size_t> places;
  for (const Expr& e : order_) {
    std::array<std::size_t, 3> args{};
    for (int i = 0; i < arity(e.op()); ++i) args[i] = places.at(e.arg(i));
    args_.push_back(args);
    places.emplace(e, places.size());
  }
  for (const Expr& root : roots) outputs_.push_back(places.at(root));
}

void IntervalReading::run(const Box& box) {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Expr& e = order_[i];
    const auto arg = [&](int k) { return values_[args_[i][k]]; };
    if (e.op() == Op::Variable && e.variableIndex() <= Variable::Z) {
      const int axis = static_cast<int>(e.variableIndex());
      values_[i] = Interval(box.min[axis], box.max[axis]);
    } else {
      values_[i] = arity(e.op()) == 0 ? e.range() : evaluateOp<Interval>(e.op(), e.payloadPart(), arg);
    }
  }
}

}  // namespace sdf
