#include "sdf/model/case_reading.h"

#include <algorithm>
#include <optional>
#include <string>

namespace sdf {
namespace {

// Of one box, and of all. Chosen: a box across jumps along each axis has eight, and near an axis all sectors
// meet; beyond, the box is read as a whole.
constexpr double kMostCases = 16;
constexpr std::size_t kMostTapes = 1024;

bool chooses(const Expr& node) { return node.op() == Op::Round && dependsOnSpace(node); }

std::vector<Expr> withRoundings(const Expr& e) {
  std::vector<Expr> outputs{e};
  std::ranges::copy_if(topologicalOrder({&e, 1}), std::back_inserter(outputs), chooses);
  return outputs;
}

std::string nameOf(std::size_t rounding) { return "rounded " + std::to_string(rounding); }

// The expression with numbers in place of what is rounded.
Expr withChoices(const Expr& e) {
  std::size_t next = 0;
  return rewrite(e, [&](const Expr& node, std::span<const Expr>) -> std::optional<Expr> {
    if (!chooses(node)) return {};
    return Expr::parameter({nameOf(next++), 0.0, -kInfinity, kInfinity});
  });
}

}  // namespace

CaseReading::CaseReading(const Expr& e) : whole_(Function(withRoundings(e)).at()), cases_(withChoices(e)) {}

// What the roundings may be in the box that was read last; nothing where that is one case, or too many.
std::vector<std::vector<double>> CaseReading::casesOf(std::size_t roundings) const {
  std::vector<std::vector<double>> cases{{}};
  for (std::size_t k = 0; k < roundings; ++k) {
    const Interval values = reading_.output(k + 1);
    if (values.nan || !((values.width() + 1.0) * static_cast<double>(cases.size()) <= kMostCases)) return {};
    std::vector<std::vector<double>> next;
    for (const std::vector<double>& before : cases)
      for (double v = values.lo; v <= values.hi; v += 1.0) {
        next.push_back(before);
        next.back().push_back(v);
      }
    cases = std::move(next);
  }
  return cases;
}

const TapePtr& CaseReading::tapeOf(const std::vector<double>& values) {
  TapePtr& tape = tapes_[values];
  if (tape) return tape;
  Values named;
  for (std::size_t k = 0; k < values.size(); ++k) named[nameOf(k)] = values[k];
  return tape = cases_.at(named);
}

CaseReading::Bounds CaseReading::read(const Box& box) {
  const Interval value = evaluate(*whole_, box, reading_);
  const auto cases = casesOf(whole_->outputs().size() - 1);
  if (cases.size() < 2 || tapes_.size() + cases.size() > kMostTapes)
    return {value, lipschitzOfContinuous(*whole_, box)};
  std::optional<Bounds> all;
  for (const std::vector<double>& values : cases) {
    const Tape& tape = *tapeOf(values);
    const Bounds one{evaluate(tape, box, reading_), lipschitzOfContinuous(tape, box)};
    all = all ? Bounds{hull(all->value, one.value), std::max(all->slope, one.slope)} : one;
  }
  return *all;
}

}  // namespace sdf
