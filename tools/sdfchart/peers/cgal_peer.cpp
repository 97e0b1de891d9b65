#include <glm/geometric.hpp>

#include "peers.h"
#include "reference/implicit_mesher.h"
#include "sdf/eval/scalar_reading.h"
#include "sdfchart/measure/deadline.h"
#include "sdfchart/measure/measure.h"

namespace sdf::chart {
namespace {

// The deepest of some points of the bounds: CGAL looks for the surface from one inside.
glm::dvec3 deepest(const Subject& subject, const Tape& distance) {
  constexpr int kSteps = 24;
  glm::dvec3 best = subject.bounds.centre();
  double least = kInfinity;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const glm::dvec3 at(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
    const glm::dvec3 p = subject.bounds.min + (at + 0.5) / double{kSteps} * subject.bounds.size();
    if (const double f = evaluate(distance, p); f < least) least = f, best = p;
  }
  return best;
}

}  // namespace

accuracy::TriangleMesh meshImplicitlyByCgal(const Subject& subject, const Tape& distance, double tolerance,
                                            double seconds) {
  Deadline deadline(seconds);
  ScalarReading<double> reading;
  accuracy::ImplicitMesh asked;
  asked.value = [&](const glm::dvec3& p) {
    reading.run(distance, {p.x, p.y, p.z});
    return reading.output();
  };
  asked.inside = deepest(subject, distance);
  asked.radius = glm::length(glm::max(subject.bounds.max - asked.inside, asked.inside - subject.bounds.min));
  asked.facetDistance = tolerance;
  asked.facetSize = 0.1 * subject.bounds.longestSide();
  asked.stopped = [&] { return deadline.stopped(); };
  return accuracy::meshByCgal(asked);
}

}  // namespace sdf::chart
