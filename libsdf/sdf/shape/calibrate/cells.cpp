#include "sdf/shape/calibrate/cells.h"

#include <unordered_map>

#include "sdf/expr/apply-inl.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

Interval leafOf(const Expr& e, const Box& box, const Interval* /*as*/) {
  if (e.op() != Op::Variable || e.variableIndex() > Variable::Z) return e.range();
  const int axis = static_cast<int>(e.variableIndex());
  return {box.min[axis], box.max[axis]};
}

Sloped leafOf(const Expr& e, const Box& box, const Sloped* /*as*/) {
  Sloped leaf = constant<Interval, 3>(leafOf(e, box, static_cast<const Interval*>(nullptr)));
  if (e.op() == Op::Variable && e.variableIndex() <= Variable::Z)
    leaf.d[static_cast<int>(e.variableIndex())] = 1.0;
  return leaf;
}

double leafOf(const Expr& e, const Box& box, const double* /*as*/) {
  const Interval leaf = leafOf(e, box, static_cast<const Interval*>(nullptr));
  return 0.5 * (leaf.lo + leaf.hi);
}

void heedClaim(const Expr& /*e*/, Interval& /*value*/) {}
void heedClaim(const Expr& /*e*/, double& /*value*/) {}

// A claim says more than the formula may.
void heedClaim(const Expr& e, Sloped& value) {
  const double most = e.lipschitz();
  for (Interval& d : value.d) d = {std::clamp(d.lo, -most, most), std::clamp(d.hi, -most, most)};
}

bool isKnown(const Expr& e) { return e.op() == Op::Parameter && e.range().isPoint(); }

// With numbers in the place of parameters that are known, so that these graphs take as many cells, and come
// to the same as those of scenes that are written with numbers.
std::vector<Expr> withNumbers(std::span<const Expr> roots) {
  return rewrite(roots, [](const Expr& e, std::span<const Expr> args) -> std::optional<Expr> {
    if (isKnown(e)) return Expr(e.range().lo);
    if (e.op() == Op::Claim) return args[0].claimLipschitz(e.lipschitz());
    return {};
  });
}

}  // namespace

template <class T>
BoxReading<T>::BoxReading(std::span<const Expr> given) : order_(topologicalOrder(given)) {
  std::vector<Expr> roots(given.begin(), given.end());
  if (std::ranges::any_of(order_, isKnown)) {
    roots = withNumbers(given);
    order_ = topologicalOrder(roots);
  }
  values_.resize(order_.size());
  std::unordered_map<Expr, std::size_t> places;
  for (const Expr& e : order_) {
    std::array<std::size_t, 3> args{};
    for (int i = 0; i < arity(e.op()); ++i) args[i] = places.at(e.arg(i));
    steps_.push_back({e.op(), e.payloadPart(), args});
    places.emplace(e, places.size());
  }
  for (const Expr& root : roots) outputs_.push_back(places.at(root));
}

template <class T>
void BoxReading<T>::run(const Box& box) {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Step& step = steps_[i];
    const auto arg = [&](int k) { return values_[step.args[k]]; };
    values_[i] = arity(step.op) == 0 ? leafOf(order_[i], box, static_cast<const T*>(nullptr))
                                     : evaluateOp<T>(step.op, step.payload, arg);
    if (step.op == Op::Claim) heedClaim(order_[i], values_[i]);
  }
}

template class BoxReading<double>;
template class BoxReading<Interval>;
template class BoxReading<Sloped>;

Expr heldWithin(const Expr& e, const Box& box) {
  const Vec3E p = position();
  std::array<Expr, 3> nearest;
  for (int i = 0; i < 3; ++i) nearest[i] = clamp(component(p, i), box.min[i], box.max[i]);
  return remap(e, nearest, 1.0);
}

}  // namespace sdf
