// What the readings of a tape promise, as clauses on one shape's distance.
#pragma once
#include "claims/clauses.h"
#include "sdf/eval/batch.h"
#include "support/float_range.h"

namespace sdf::test {

/// A box about one of the subject's points, of any size.
inline Box anyBox(const Subject& s, std::mt19937& random) {
  const glm::dvec3& p = s.points()[random() % s.points().size()];
  glm::dvec3 half;
  const double size = anyScale(random, 1e-8, 0.3) * s.longest();
  for (int i = 0; i < 3; ++i) half[i] = random() % 8 ? size * uniform(random, 0.1, 1.0) : 0.0;
  return {p - half, p + half};
}
inline glm::dvec3 anyIn(const Box& b, std::mt19937& random) {
  glm::dvec3 p;
  for (int i = 0; i < 3; ++i)
    p[i] = std::clamp(b.min[i] + uniform(random, 0.0, 1.0) * (b.max[i] - b.min[i]), b.min[i], b.max[i]);
  return p;
}

inline bool sameNumber(double a, double b) { return a == b || (a != a && b != b); }

/// How wide the interval reading may be over a box: by the mean value theorem an operation over intervals of
/// widths w_i is no wider than sum m_i w_i, m_i being the magnitude of its i-th derivative over them. The sum
/// along the tape is a constant times the size of the box: intervals shrink linearly where no derivative is
/// infinite. (Where one is, nothing is said.)
inline double widthByChainRule(const Tape& tape, const Box& box) {
  using D = Dual<Interval, 3>;
  ScalarReading<Interval> values;
  evaluate(tape, box, values);
  std::vector<double> widths(tape.instructions().size());
  const glm::dvec3 size = box.size();
  const auto width = [&](Operand o) {
    if (o.isConstant()) return 0.0;
    return o.isVariable() ? (o.index() < 3 ? size[o.index()] : 0.0) : widths[o.index()];
  };
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const Instruction& n = tape.instructions()[i];
    const int rows = rowArguments(n.op);
    const D d = evaluateOp<D>(n.op, [&](int k) {
      if (k >= rows) return constant<Interval, 3>(tape.constant(n.constants + k - rows));
      D argument = constant<Interval, 3>(values.value(n.in[k]));
      if (!n.in[k].isConstant()) argument.d[k] = Interval(1.0);
      return argument;
    });
    // Every step on the way is rounded outwards by some ulps of terms that are no larger than this.
    double terms = d.v.magnitude(), sum = 0.0;
    for (int k = 0; k < rows; ++k) {
      terms += d.d[k].magnitude() * values.value(n.in[k]).magnitude();
      sum += d.d[k].magnitude() * width(n.in[k]);
    }
    constexpr double kSteps = 64.0;
    widths[i] = d.v.nan || sum != sum || terms != terms ? kInfinity : sum + kSteps * kEpsilon * terms;
  }
  return width(tape.outputs()[0]);
}

/// Intervals contain every sample, and are no wider than the chain rule over their box.
inline Verdict hasTightIntervals(const Subject& s) {
  std::mt19937 random = s.random();
  constexpr int kBoxes = 24, kSamples = 8;
  for (int b = 0; b < kBoxes; ++b) {
    const Box box = anyBox(s, random);
    const Interval range = s.over(box);
    const double most = widthByChainRule(s.tape(), box);
    if (range.width() > most * (1.0 + 64.0 * kEpsilon))
      return finding("the interval ", exactly(range), " over ", exactly(box.min), " to ", exactly(box.max),
                     " is wider than ", most);
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec3 p = anyIn(box, random);
      if (!range.contains(s.value(p)))
        return finding("f = ", s.value(p), " at ", exactly(p), " is not in ", exactly(range), ", over ",
                       exactly(box.min), " to ", exactly(box.max));
    }
  }
  return {};
}

/// The largest float error of anything that is compared on the way, from what the operations promise.
inline double comparisonRounding(const Tape& tape, const glm::vec3& p) {
  ScalarReading<FloatRange> reading;
  reading.run(tape, floatVariables(p));
  double most = 0.0;
  for (const Instruction& n : tape.instructions())
    if (isDecidable(n.op))
      most = std::max(most, reading.value(n.in[0]).range.width() + reading.value(n.in[1]).range.width());
  return most;
}

/// Specialised to a ball by slopes, or to its box by intervals; nullptr where nothing can be dropped.
inline TapePtr specialisedTo(const Tape& tape, const glm::vec3& centre, float radius, bool byBalls) {
  std::vector<Decision> decisions;
  if (byBalls) {
    const double slack = comparisonRounding(tape, centre);
    if (!std::isfinite(slack)) return nullptr;
    float value;
    BatchEvaluator().evaluateBalls(tape, {.x = &centre.x, .y = &centre.y, .z = &centre.z}, 1, radius,
                                   std::nextafter(static_cast<float>(slack), HUGE_VALF), &value, decisions);
  } else {
    ScalarReading<Interval> workspace;
    evaluate(tape, around(glm::dvec3(centre), radius), workspace, decisions);
  }
  return tape.specialised(decisions.data(), 1);
}

/// Specialised by intervals or by balls, once and again, the tape gives the same values in its region.
inline Verdict specialises(const Subject& s) {
  std::mt19937 random = s.random();
  constexpr int kRegions = 24, kSamples = 8;
  for (int r = 0; r < kRegions; ++r) {
    glm::vec3 centre = s.points()[random() % s.points().size()];
    const double size = anyScale(random, 1e-3, 0.5) * s.longest();
    TapePtr special;
    for (double radius = size; radius > size / 8.0; radius /= 2.0) {
      const TapePtr next =
          specialisedTo(special ? *special : s.tape(), centre, static_cast<float>(radius), r % 2);
      if (next) special = next;
      if (!special) continue;
      for (int i = 0; i < kSamples; ++i) {
        const glm::dvec3 p =
            glm::dvec3(centre) + randomDirection(random) * (radius * uniform(random, 0.0, 0.999));
        if (!sameNumber(evaluate(*special, p), s.value(p)))
          return finding("specialised by ", r % 2 ? "a ball" : "a box", " about ",
                         exactly(glm::dvec3(centre)), " of radius ", radius, ", f = ", evaluate(*special, p),
                         " at ", exactly(p), ", and by the whole tape ", s.value(p));
      }
    }
  }
  return {};
}

/// The batch reading, values and gradients, lies within the rounding that it promises; so does the double
/// one.
inline Verdict keepsFloatPromise(const Subject& s) {
  const std::size_t count = s.points().size();
  std::array<std::vector<float>, 3> in;
  std::array<std::vector<float>, 5> out;
  for (auto& row : in) row.resize(count);
  for (auto& row : out) row.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) in[axis][i] = static_cast<float>(s.points()[i][axis]);
  const Rows rows{.x = in[0].data(), .y = in[1].data(), .z = in[2].data()};
  BatchEvaluator batch;
  batch.evaluate(s.tape(), rows, count, out[0].data());
  batch.evaluateGradient(s.tape(), rows, count, out[1].data(), out[2].data(), out[3].data(), out[4].data());
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 p(in[0][i], in[1][i], in[2][i]);
    const Interval range = floatRange(s.tape(), p);
    for (const double value : {s.value(p), static_cast<double>(out[0][i]), static_cast<double>(out[1][i])})
      if (!range.contains(value))
        return finding("a reading gives ", value, " at ", exactly(glm::dvec3(p)), ", in double ", s.value(p),
                       ", not in ", exactly(range));
    const std::array<Interval, 3> slopes = floatGradientRange(s.tape(), p);
    const glm::dvec3 reference = evaluateGradient(s.tape(), p).gradient;
    for (int axis = 0; axis < 3; ++axis)
      for (const double slope : {reference[axis], static_cast<double>(out[2 + axis][i])})
        if (!slopes[axis].contains(slope))
          return finding("a reading's derivative along axis ", axis, " is ", slope, " at ",
                         exactly(glm::dvec3(p)), ", in double ", reference[axis], ", not in ",
                         exactly(slopes[axis]));
  }
  return {};
}

/// The float value of the whole is no farther off than distanceRounding says.
inline Verdict roundsAsADistance(const Subject& s) {
  BatchEvaluator batch;
  for (const glm::dvec3& point : s.points()) {
    const glm::vec3 p(point);
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > promise(Op::Length3).largest) continue;
    float value;
    batch.evaluate(s.tape(), {.x = &p.x, .y = &p.y, .z = &p.z}, 1, &value);
    const double off = std::abs(value - s.value(p)), most = distanceRounding(p, s.longest());
    if (!(off <= most))
      return finding("the float reading is off by ", off, " at ", exactly(glm::dvec3(p)), ", more than ",
                     most);
  }
  return {};
}

inline constexpr Clause kReadingClauses[] = {{"intervals", hasTightIntervals},
                                             {"specialised", specialises},
                                             {"floats", keepsFloatPromise},
                                             {"rounding", roundsAsADistance}};

}  // namespace sdf::test
