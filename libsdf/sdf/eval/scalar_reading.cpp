#include "sdf/eval/scalar_reading.h"

#include <cmath>

namespace sdf {

template class ScalarReading<double>;
template class ScalarReading<Interval>;

namespace {

std::array<double, kVariableCount> variables(const glm::dvec3& p, const glm::dvec3& n) {
  return {p.x, p.y, p.z, n.x, n.y, n.z};
}

std::array<Interval, kVariableCount> variables(const Box& b) {
  const Interval unit(-1.0, 1.0);
  return {
      Interval(b.min.x, b.max.x), Interval(b.min.y, b.max.y), Interval(b.min.z, b.max.z), unit, unit, unit};
}

Decision decided(Op op, const Interval& a, const Interval& b, const Interval& value) {
  if (!isMinOrMax(op)) {
    const Interval& truth = choiceOf(op) == Choice::Selected ? a : value;
    if (truth.nan) return Decision::Open;
    if (truth.lo > 0.0 || truth.hi < 0.0) return Decision::First;
    return truth.lo == 0.0 && truth.hi == 0.0 ? Decision::Second : Decision::Open;
  }
  if (a.nan || b.nan) return Decision::Open;
  const bool below = a.hi<b.lo, above = a.lo> b.hi;
  if (!below && !above) return Decision::Open;
  return below == (choiceOf(op) == Choice::Least) ? Decision::First : Decision::Second;
}

}  // namespace

double evaluate(const Tape& tape, const glm::dvec3& p, const glm::dvec3& n) {
  ScalarReading<double> reading;
  reading.run(tape, variables(p, n));
  return reading.output();
}

std::vector<double> evaluateAll(const Tape& tape, const glm::dvec3& p, const glm::dvec3& n) {
  ScalarReading<double> reading;
  reading.run(tape, variables(p, n));
  std::vector<double> all;
  for (std::size_t i = 0; i < tape.outputs().size(); ++i) all.push_back(reading.output(i));
  return all;
}

ValueAndGradient evaluateGradient(const Tape& tape, const glm::dvec3& p) {
  using D = Dual<double, 3>;
  ScalarReading<D> reading;
  reading.run(tape, {D{p.x, {1, 0, 0}}, D{p.y, {0, 1, 0}}, D{p.z, {0, 0, 1}}, D{}, D{}, D{}});
  const D r = reading.output();
  return {r.v, {r.d[0], r.d[1], r.d[2]}};
}

Interval evaluate(const Tape& tape, const Box& box) {
  ScalarReading<Interval> reading;
  return evaluate(tape, box, reading);
}

Interval evaluate(const Tape& tape, const Box& box, ScalarReading<Interval>& workspace) {
  workspace.run(tape, variables(box));
  return workspace.output();
}

Interval evaluate(const Tape& tape, const Box& box, ScalarReading<Interval>& workspace,
                  std::vector<Decision>& decisions) {
  workspace.run(tape, variables(box));
  decisions.clear();
  for (std::size_t i = 0; i < tape.instructions().size(); ++i) {
    const Instruction& n = tape.instructions()[i];
    if (isDecidable(n.op))
      decisions.push_back(decided(n.op, workspace.value(n.in[0]), workspace.value(n.in[1]),
                                  workspace.value(Operand::value(i))));
  }
  return workspace.output();
}

namespace {

template <AnyInterval T>
double steepest(const Tape& tape, const Box& box) {
  using D = Dual<T, 3>;
  const auto v = variables(box);
  ScalarReading<D> reading;
  reading.run(tape, {D{v[0], {1.0, 0.0, 0.0}}, D{v[1], {0.0, 1.0, 0.0}}, D{v[2], {0.0, 0.0, 1.0}},
                     D{v[3], {}}, D{v[4], {}}, D{v[5], {}}});
  const D r = reading.output();
  const double slope = std::hypot(std::hypot(r.d[0].magnitude(), r.d[1].magnitude()), r.d[2].magnitude());
  return std::nextafter(slope, kInfinity);
}

}  // namespace

double lipschitzOver(const Tape& tape, const Box& box) { return steepest<Interval>(tape, box); }
double lipschitzOfContinuous(const Tape& tape, const Box& box) {
  return steepest<IntervalOfContinuous>(tape, box);
}

}  // namespace sdf
