#include "sdf/proof/obstacle.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "sdf/expr/apply-inl.h"
#include "sdf/expr/origin.h"
#include "sdf/proof/reading.h"

namespace sdf {
namespace {

using Slopes = Dual<Interval, 3>;
using Known = std::unordered_map<const Node*, Slopes>;

bool holdsZero(const Interval& i) { return i.nan || (i.lo <= 0.0 && i.hi >= 0.0); }

/// May the gradient be 0, or anything at all? What is the same everywhere has none.
bool mayBeFlat(const Slopes& s) {
  const auto isNone = [](const Interval& i) { return !i.nan && i.lo == 0.0 && i.hi == 0.0; };
  return !std::all_of(s.d, s.d + 3, isNone) &&
         (s.v.nan || std::all_of(s.d, s.d + 3, [](const Interval& i) { return holdsZero(i); }));
}

Known readAll(const Expr& distance, const Box& box, const Values& values) {
  Known known;
  for (const Expr& n : topologicalOrder({&distance, 1})) {
    Slopes s{Interval::everything(), {Interval(0.0), Interval(0.0), Interval(0.0)}};
    if (n.op() == Op::Constant) {
      s.v = n.constantValue();
    } else if (n.op() == Op::Parameter) {
      const auto given = values.find(n.parameterInfo().name);
      s.v = given == values.end() ? n.parameterInfo().value : given->second;
    } else if (n.op() == Op::Variable) {
      const int axis = static_cast<int>(n.variableIndex());
      if (n.variableIndex() <= Variable::Z) s.v = Interval(box.min[axis], box.max[axis]), s.d[axis] = 1.0;
    } else {
      s = evaluateOp<Slopes>(n.op(), n.payloadPart(), [&](int i) { return known.at(n.arg(i).node()); });
    }
    known.emplace(n.node(), s);
  }
  return known;
}

/// The arguments that the node's value depends on in the box.
std::vector<Expr> argumentsThatMatter(const Expr& n, const Known& known) {
  const auto valueOf = [&](int i) { return known.at(n.arg(i).node()).v; };
  if (isMinOrMax(n.op())) {
    const Interval a = valueOf(0), b = valueOf(1);
    const bool isLeast = n.op() == Op::Min, below = a.hi < b.lo, above = b.hi < a.lo;
    if (!a.nan && !b.nan && (below || above)) return {n.arg(below == isLeast ? 0 : 1)};
  }
  if (n.op() == Op::Select) {
    const Interval condition = valueOf(0);
    if (!holdsZero(condition)) return {n.arg(1)};
    if (!condition.nan && condition.lo == 0.0 && condition.hi == 0.0) return {n.arg(2)};
  }
  std::vector<Expr> all;
  for (int i = 0; i < arity(n.op()); ++i) all.push_back(n.arg(i));
  return all;
}

}  // namespace

std::string obstacleIn(const Expr& distance, const Box& box, const Values& values) {
  const Known known = readAll(distance, box, values);
  ProofReading reading;
  // As the proof reads it.
  const auto valueOf = [&](const Expr& e) {
    Interval v;
    reading.boxes(*Function(e).at(values), std::vector{box}, &v);
    return v;
  };
  const auto innermost = [&](const auto& isInTheWay) {
    Expr at = distance;
    for (;;) {
      const std::vector<Expr> arguments = argumentsThatMatter(at, known);
      const auto next = std::ranges::find_if(arguments, isInTheWay);
      if (next == arguments.end()) return originOf(at);
      at = Expr(*next);
    }
  };
  const auto mayBeNoNumber = [&](const Expr& e) { return valueOf(e).nan; };
  const auto isFlat = [&](const Expr& e) { return mayBeFlat(known.at(e.node())); };
  const Interval all = valueOf(distance);
  const auto because = [](const std::string& origin, const char* why) {
    return origin.empty() ? "" : origin + " stood in the way: intervals do not tell " + why;
  };
  if (all.nan) return because(innermost(mayBeNoNumber), "if it is a number");
  return holdsZero(all) && isFlat(distance) ? because(innermost(isFlat), "if it rises") : "";
}

}  // namespace sdf
