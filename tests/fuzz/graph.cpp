#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "fuzz/formula.h"
#include "fuzz/targets.h"
#include "number/adversary.h"
#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "support/bind.h"
#include "support/float_range.h"

namespace sdf::fuzz {
namespace {

constexpr int kMostSteps = 40;
constexpr int kPoints = 6;

using Point = glm::dvec3;

std::string text(const Point& p) {
  return "(" + sdf::text(p.x) + ", " + sdf::text(p.y) + ", " + sdf::text(p.z) + ")";
}
std::string text(const Box& b) { return text(b.min) + " to " + text(b.max); }

// Equal, the two zeros alike, or both NaN.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

Point roundedToFloat(const Point& p) { return Point(glm::vec3(p)); }

// A box with ends that are finite floats, mostly a small one.
Box readBox(Bytes& bytes) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    double ends[2] = {bytes.moderate(), 0.0};
    ends[1] = ends[0];
    switch (bytes.below(4)) {
      case 0:
        break;
      case 1:
        for (double& e : ends) e = std::clamp(bytes.number(), -double{FLT_MAX}, double{FLT_MAX});
        break;
      case 2:
        ends[1] += bytes.positive() / 64.0;
        break;
      default:
        ends[1] = bytes.moderate();
    }
    for (double& e : ends) e = static_cast<float>(std::isnan(e) ? 0.0 : e);
    box.min[axis] = std::min(ends[0], ends[1]), box.max[axis] = std::max(ends[0], ends[1]);
  }
  return box;
}

// Rounding to float cannot leave the box, as its ends are floats.
Point pointIn(const Box& box, Adversary& a) {
  Point p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = a.inside(Interval(box.min[axis], box.max[axis]));
  return roundedToFloat(p);
}

// Every node of a graph, read at once.
class Nodes {
 public:
  explicit Nodes(const Expr& e) : exprs_(topologicalOrder({&e, 1})), tape_(exprs_) {}

  const std::vector<Expr>& exprs() const { return exprs_; }
  const Tape& tape() const { return tape_; }

  template <class T>
  std::vector<T> at(const Point& p) const {
    ScalarReading<T> reading;
    reading.run(tape_, {T(p.x), T(p.y), T(p.z), T(0.0), T(0.0), T(0.0)});
    std::vector<T> all;
    for (std::size_t i = 0; i < exprs_.size(); ++i) all.push_back(reading.output(i));
    return all;
  }

 private:
  std::vector<Expr> exprs_;
  Tape tape_;
};

// One input: a formula, a box, and points of the box.
class GraphCheck {
 public:
  explicit GraphCheck(Input input)
      : bytes_(input),
        formula_(bytes_, kMostSteps),
        e_(formula_.root()),
        tape_(e_),
        nodes_(e_),
        box_(readBox(bytes_)),
        adversary_(bytes_.word<std::uint32_t>()) {
    for (int i = 0; i < kPoints; ++i) points_.push_back(pointIn(box_, adversary_));
  }

  void run() {
    checkValues();
    checkIntervals(tape_, box_);
    checkSpecialisation();
    checkBalls();
    checkSlopes();
    checkFacts(e_);
    checkBatch();
    checkRemap();
    checkBind();
  }

 private:
  [[noreturn]] void fault(const std::string& what) const {
    find(what + "\nbox " + text(box_) + "\n" + fuzz::text(e_));
  }
  void expectSame(double got, double expected, const std::string& what, const Point& p) const {
    if (!same(got, expected))
      fault(what + ": " + sdf::text(got) + " instead of " + sdf::text(expected) + " at " + text(p));
  }
  void expectIn(const Interval& allowed, double got, const std::string& what, const Point& p) const {
    if (!allowed.contains(got))
      fault(what + " is " + sdf::text(got) + " at " + text(p) + ", not in " + sdf::text(allowed));
  }
  double valueAt(const Point& p) const { return evaluate(tape_, p); }

  void checkValues() const {
    for (const Point& p : points_) {
      const Formula::Value plain = formula_.evaluate({p.x, p.y, p.z});
      if (!plain.signOfZeroMatters) expectSame(valueAt(p), plain.value, "the tape's value", p);
    }
  }

  // Of the tape's own values: those of a specialised one may differ where squares overflow.
  void checkIntervals(const Tape& tape, const Box& box) const {
    const Interval range = evaluate(tape, box);
    if (!(range.lo <= range.hi)) fault("no interval: " + sdf::text(range));
    for (const Point& p : points_) {
      const double value = evaluate(tape, p);
      if (box.contains({p, p}) && !range.contains(value))
        fault(sdf::text(value) + " at " + text(p) + " is not in " + sdf::text(range) + " over " + text(box));
    }
  }

  // A length that loses an argument which is 0 becomes an absolute value, whose square can neither overflow
  // nor vanish.
  bool squaresHold(const Point& p) const {
    const std::vector<double> values = nodes_.at<double>(p);
    return std::all_of(values.begin(), values.end(),
                       [](double v) { return v == 0.0 || (std::abs(v) > 1e-150 && std::abs(v) < 1e150); });
  }

  // Down into ever smaller boxes around a point, each tape made of the one before.
  void checkSpecialisation() const {
    TapePtr tape = std::make_shared<const Tape>(e_);
    Box box = box_;
    ScalarReading<Interval> workspace;
    std::vector<Decision> decisions;
    for (int depth = 0; depth < 4; ++depth) {
      evaluate(*tape, box, workspace, decisions);
      if (const TapePtr special = tape->specialised(decisions.data(), 1)) tape = special;
      checkIntervals(*tape, box);
      for (const Point& p : points_)
        if (box.contains({p, p}) && squaresHold(p))
          expectSame(evaluate(*tape, p), valueAt(p), "the tape specialised to " + text(box), p);
      const Point half = box.size() * 0.25;
      box = intersect(box, {points_[0] - half, points_[0] + half});
    }
  }

  // The largest difference between float and double at p over all nodes, several times over, as the readings
  // fuse differently; infinite where a node is not finite.
  double floatSlack(const Point& p) const {
    const std::vector<double> exact = nodes_.at<double>(p);
    const float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
    std::vector<float> rounded(exact.size());
    std::vector<float*> rows;
    for (float& r : rounded) rows.push_back(&r);
    BatchEvaluator().evaluate(nodes_.tape(), {.x = &x, .y = &y, .z = &z}, 1, rows);
    double slack = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (!std::isfinite(exact[i]) || !std::isfinite(rounded[i])) return kInfinity;
      slack = std::max({slack, 4.0 * std::abs(exact[i] - rounded[i]), 0x1p-20 * std::abs(exact[i])});
    }
    return slack;
  }

  void checkBalls() {
    const Point centre = points_[0];
    const double slack = floatSlack(centre);
    if (!(slack < 1e30)) return;
    const auto radius = static_cast<float>(bytes_.positive() / 8.0);
    const float x = static_cast<float>(centre.x), y = static_cast<float>(centre.y),
                z = static_cast<float>(centre.z);
    float value;
    std::vector<Decision> decisions;
    BatchEvaluator().evaluateBalls(tape_, {.x = &x, .y = &y, .z = &z}, 1, radius, static_cast<float>(slack),
                                   &value, decisions);
    const TapePtr special = tape_.specialised(decisions.data(), 1);
    if (!special) return;
    for (int i = 0; i < 2 * kPoints; ++i) {
      Point step(adversary_.uniform(-1.0, 1.0), adversary_.uniform(-1.0, 1.0), adversary_.uniform(-1.0, 1.0));
      step *= radius / std::max(1.0, glm::length(step));
      const Point q = centre + 0.999 * step;
      if (!squaresHold(q)) continue;
      expectSame(evaluate(*special, q), valueAt(q),
                 "the tape specialised to the ball of radius " + sdf::text(double{radius}) + " around " +
                     text(centre),
                 q);
    }
  }

  // What double rounding may have added to a difference of values at two points: each value and the true one
  // lie in the interval over its point.
  static double rounding(const Interval& atP, const Interval& atQ) {
    return atP.nan || atQ.nan ? kInfinity : atP.width() + atQ.width();
  }

  void checkSlopes() const {
    const double slope = lipschitzOver(tape_, box_);
    if (!(slope >= 0.0)) fault("no slope bound: " + sdf::text(slope));
    if (slope == kInfinity) return;
    constexpr double kRoundings = 1.0 + 16.0 * kEpsilon;  // of squares, their sum and its root
    for (const Point& p : points_) {
      const ValueAndGradient g = evaluateGradient(tape_, p);
      const double length = std::hypot(g.gradient.x, g.gradient.y, g.gradient.z);
      // Through an infinite value, as of log at 0, there is no derivative.
      if (length > slope * kRoundings)
        fault("a gradient of length " + sdf::text(length) + " at " + text(p) + " over the slope bound " +
              sdf::text(slope));
      for (const Point& q : points_) {
        const double allowed = slope * kRoundings * glm::distance(p, q) +
                               rounding(evaluate(tape_, Box{p, p}), evaluate(tape_, Box{q, q}));
        if (std::abs(valueAt(p) - valueAt(q)) > allowed)
          fault("from " + text(p) + " to " + text(q) + " the value goes from " + sdf::text(valueAt(p)) +
                " to " + sdf::text(valueAt(q)) + ", over the slope bound " + sdf::text(slope));
      }
    }
  }

  void checkFacts(const Expr& e) const {
    const Nodes nodes(e);
    for (const Point& p : points_) {
      const Point& q = points_[&p == points_.data() ? 1 : 0];
      const auto atP = nodes.at<double>(p), atQ = nodes.at<double>(q);
      const auto aroundP = nodes.at<Interval>(p), aroundQ = nodes.at<Interval>(q);
      for (std::size_t i = 0; i < nodes.exprs().size(); ++i) {
        const Expr& node = nodes.exprs()[i];
        const std::string name = "node " + std::to_string(i);
        if (!node.range().contains(atP[i]))
          fault(name + " is " + sdf::text(atP[i]) + " at " + text(p) + ", outside its range");
        const double allowed = node.lipschitz() * glm::distance(p, q) * (1.0 + 16.0 * kEpsilon) +
                               rounding(aroundP[i], aroundQ[i]);
        if (std::abs(atP[i] - atQ[i]) > allowed)
          fault(name + " goes from " + sdf::text(atP[i]) + " at " + text(p) + " to " + sdf::text(atQ[i]) +
                " at " + text(q) + ", over its slope bound");
      }
    }
  }

  void checkBatch() const {
    constexpr std::size_t kCount = kPoints;
    float x[kCount], y[kCount], z[kCount], fresh[kCount], used[kCount];
    for (std::size_t i = 0; i < kCount; ++i)
      x[i] = static_cast<float>(points_[i].x), y[i] = static_cast<float>(points_[i].y),
      z[i] = static_cast<float>(points_[i].z);
    const Rows in{.x = x, .y = y, .z = z};
    BatchEvaluator().evaluate(tape_, in, kCount, fresh);
    float value[kCount], slope[3][kCount];
    BatchEvaluator().evaluateGradient(tape_, in, kCount, value, slope[0], slope[1], slope[2]);
    for (std::size_t i = 0; i < kCount; ++i) {
      const glm::vec3 p(points_[i]);
      const Interval allowed = test::floatRange(tape_, p);
      expectIn(allowed, fresh[i], "the batch reading", points_[i]);
      expectIn(allowed, value[i], "the batch gradient's value", points_[i]);
      const std::array<Interval, 3> slopes = test::floatGradientRange(tape_, p);
      for (int axis = 0; axis < 3; ++axis)
        expectIn(slopes[axis], slope[axis][i], "the batch gradient along " + std::to_string(axis),
                 points_[i]);
    }
    // Threads keep their evaluators, so what one did before must not show.
    BatchEvaluator veteran;
    float junk[64], result[64];
    std::fill_n(junk, 64, -1e6f);
    veteran.evaluate(tape_, {.x = junk, .y = junk, .z = junk}, 64, result);
    veteran.evaluate(tape_, in, kCount, used);
    for (std::size_t i = 0; i < kCount; ++i)
      expectSame(used[i], fresh[i], "the batch reading after other work", points_[i]);
  }

  void checkRemap() const {
    const Vec3E p = position();
    const Expr turned = remap(e_, {p.y, neg(p.z), p.x}, 1.0);
    const Tape tape(turned);
    for (const Point& q : points_) {
      if (formula_.evaluate({q.y, -q.z, q.x}).signOfZeroMatters) continue;
      expectSame(evaluate(tape, q), valueAt({q.y, -q.z, q.x}), "the graph remapped to (y, -z, x)", q);
    }
    checkFacts(turned);
  }

  void checkBind() const {
    std::map<std::string, double> values;
    for (const Expr& n : topologicalOrder({&e_, 1}))
      if (n.op() == Op::Parameter) values[n.parameterInfo().name] = n.parameterInfo().value;
    if (values.empty()) return;
    const Expr bound = test::bind(e_, values);
    const Tape tape(bound);
    for (const Point& p : points_) {
      if (formula_.evaluate({p.x, p.y, p.z}).signOfZeroMatters) continue;
      expectSame(evaluate(tape, p), valueAt(p), "the graph with its parameters bound", p);
    }
    checkFacts(bound);
  }

  Bytes bytes_;
  const Formula formula_;
  const Expr e_;
  const Tape tape_;
  const Nodes nodes_;
  const Box box_;
  Adversary adversary_;
  std::vector<Point> points_;
};

}  // namespace

void graph(Input input) { GraphCheck(input).run(); }

}  // namespace sdf::fuzz
