#include "check.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "check_points.h"
#include "command_line/text.h"
#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"

namespace sdf::accuracy {
namespace {

constexpr double kFloatUlps = 4.0;
// Double's rounding in formulas of some hundred operations and in CGAL's projections onto slim triangles:
// 2^13 epsilons, a 2^16th of a float's ulp.
constexpr double kDoubleRounding = 0x1p-40;

double floatUlp(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - f;
}

// Everything that checking one shape shares.
struct Bench {
  Bench(const ReferenceCase& c, unsigned s)
      : of(c), reference(c.mesh), make(c), tape(c.shape.distance), seed(s) {}

  const ReferenceCase& of;
  const Reference reference;
  const PointMaker make;
  const Tape tape;
  const unsigned seed;
};

struct Workspace {
  ScalarReading<double> reading;
  BatchEvaluator batch;
};

class Chunk {
 public:
  Chunk(const Bench& bench, Workspace& work) : bench_(bench), work_(work) {}

  Checked run(std::uint64_t first, std::uint64_t count) {
    PointMaker::Random random((static_cast<std::uint64_t>(bench_.seed) << 40) + first);
    for (std::uint64_t k = first; k < first + count; ++k) {
      const glm::dvec3 p = bench_.make(k, random, [this](const glm::dvec3& q) { return value(q); });
      values_.push_back(value(p));
      for (int i = 0; i < 3; ++i) rows_[i].push_back(static_cast<float>(p[i]));
      tryClaim(p, values_.back());
      trySlope(p, values_.back(), random);
    }
    compareFloats();
    found_.points = count;
    return found_;
  }

 private:
  double value(const glm::dvec3& p) {
    work_.reading.run(bench_.tape, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
    return work_.reading.output();
  }

  double rounding(const glm::dvec3& p) const {
    return kDoubleRounding * std::max(largest(p), bench_.make.reach());
  }

  void tryClaim(const glm::dvec3& p, double f) {
    const ClaimKind kind = bench_.of.shape.claim.kind;
    const double d = bench_.reference.signedDistance(bench_.make.toMesh(p)), ulp = floatUlp(largest(p));
    const double chord = bench_.of.chord, allowed = chord + kFloatUlps * ulp + rounding(p);
    const double error = std::abs(f - d);
    const bool exactHere =
        kind == ClaimKind::Exact || (kind == ClaimKind::ExactOutside && (f > 0.0 || d > 0.0));
    bool holds = !std::isnan(f) && (std::abs(d) <= allowed || (d > 0.0 ? f > 0.0 : f < 0.0));
    if (exactHere) holds = holds && error <= allowed;
    if (kind != ClaimKind::Field) holds = holds && std::abs(f) <= std::abs(d) + allowed;
    if (!holds) refute(p, "f = %.9g, d = %.9g, allowed %.3g", f, d, allowed);

    if (exactHere) {
      found_.maxError = std::max(found_.maxError, error);
      found_.maxUlps = std::max(found_.maxUlps, (error - chord - rounding(p)) / ulp);
    }
    constexpr double kWellAbove = 20.0;
    if (std::abs(d) >= kWellAbove * allowed)
      found_.tightness = std::min(found_.tightness, (std::abs(f) + allowed) / std::abs(d));
  }

  void trySlope(const glm::dvec3& p, double f, PointMaker::Random& random) {
    const Claim& claim = bench_.of.shape.claim;
    const double step = bench_.make.size() * std::pow(10.0, uniform(random, -4.0, -0.5));
    const glm::dvec3 q = p + step * randomDirection(random);
    const double quotient = std::abs(value(q) - f) / step;
    found_.lipschitz = std::max(found_.lipschitz, quotient);
    const double most = claim.lipschitz * (1.0 + rounding(p) / step);
    if (!(quotient <= most))
      refute(p, "slope %.12g over a step of %.3g, claimed %.12g", quotient, step, most);
  }

  void compareFloats() {
    std::vector<float> floats(values_.size());
    work_.batch.evaluate(bench_.tape, {rows_[0].data(), rows_[1].data(), rows_[2].data()}, floats.size(),
                         floats.data());
    for (std::size_t k = 0; k < floats.size(); ++k) {
      const glm::dvec3 p(rows_[0][k], rows_[1][k], rows_[2][k]);
      const double ulp = floatUlp(std::max(largest(p), bench_.make.reach()));
      const double ulps = std::abs(floats[k] - values_[k]) / ulp;
      found_.floatUlps = std::isnan(ulps) ? kInfinity : std::max(found_.floatUlps, ulps);
    }
  }

  template <class... Values>
  void refute(const glm::dvec3& p, const char* format, Values... values) {
    if (++found_.refuted > 1) return;
    using command_line::formatted;
    found_.worst = bench_.of.name +
                   formatted(" at (%.9g, %.9g, %.9g), seed %u: ", p.x, p.y, p.z, bench_.seed) +
                   formatted(format, values...);
  }

  const Bench& bench_;
  Workspace& work_;
  Checked found_;
  std::vector<double> values_;
  std::array<std::vector<float>, 3> rows_;
};

}  // namespace

void Checked::add(const Checked& more) {
  points += more.points;
  maxError = std::max(maxError, more.maxError);
  maxUlps = std::max(maxUlps, more.maxUlps);
  tightness = std::min(tightness, more.tightness);
  lipschitz = std::max(lipschitz, more.lipschitz);
  floatUlps = std::max(floatUlps, more.floatUlps);
  refuted += more.refuted;
  if (worst.empty()) worst = more.worst;
}

Checked check(const ReferenceCase& c, std::uint64_t points, unsigned seed) {
  const Bench bench(c, seed);
  const std::uint64_t chunks = (points + kBatchPoints - 1) / kBatchPoints;
  std::vector<Checked> found(chunks);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, chunks, 1), [&](const auto& range) {
    for (std::uint64_t i = range.begin(); i < range.end(); ++i) {
      const std::uint64_t first = i * kBatchPoints;
      found[i] =
          Chunk(bench, workspaces.local()).run(first, std::min<std::uint64_t>(kBatchPoints, points - first));
    }
  });
  Checked sum;
  for (const Checked& part : found) sum.add(part);
  return sum;
}

}  // namespace sdf::accuracy
