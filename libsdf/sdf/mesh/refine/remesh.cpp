#include "sdf/mesh/refine/remesh.h"

#include <algorithm>

#include "sdf/mesh/refine/remesh_changes.h"
#include "sdf/mesh/refine/remesh_measure.h"
#include "sdf/mesh/refine/remesh_paint.h"

namespace sdf {
namespace {

// Edges are collapsed until the error is this many tolerances, as relocation lessens the largest errors to
// three quarters: measured on balls, tori and blends. With more, more has to be split in the end.
constexpr double kOvershoot = 1.3;
// Cycles of adjusting and collapsing, of collapsing after splits, and sweeps over all vertices that adjusting
// takes at most. Measured on eight scenes: two cycles of six sweeps take a third longer and leave as many
// triangles within 2 %; with fewer sweeps or cycles a ball has too many.
constexpr int kCycles = 3, kCleanings = 2, kSweeps = 4;
// A sweep that changes less than this share of the vertices is the last.
constexpr double kSettled = 0.01;
// First sweeps let a change raise the energy by so much: it may open the way to a better shape.
constexpr float kLoose = 0.3f;
// What exceeds the tolerance between the samples is halved so often at most.
constexpr int kHalvings = 16;
// Shares of the tolerance that hold for changes, and where all is measured closely: what changes let pass
// between their samples, and the close ones between theirs.
constexpr double kHeld = 0.98, kMeasured = 0.998;
// Where halving makes more triangles exceed it, so many times the fewest and some, it is given up.
constexpr std::size_t kRunaway = 2, kFewRounds = 20;

// Passes on the wish to stop, and reports nothing: each batch would begin at 0 again.
class Quiet : public Progress {
 public:
  explicit Quiet(const Progress& outer) : outer_(outer) {}
  void update(double) override {
    if (outer_.stopped()) stop();
  }

 private:
  const Progress& outer_;
};

class Remesher {
 public:
  Remesher(const FeatureMesh& mesh, const LocalField& field, const RemeshOptions& options, Progress& progress)
      : field_(field),
        options_(options),
        outer_(progress),
        quiet_(progress),
        mesh_(mesh),
        changes_(mesh_, field, kOvershoot * options.tolerance, options.painted, quiet_) {}

  RemeshResult run() {
    changes_.split();
    report(0.1);
    changes_.collapse();
    report(0.4);
    for (int i = 0; i < kCycles; ++i) {
      adjust(kLoose);
      adjust(0.0f);
      changes_.collapse();
    }
    adjust(0.0f);
    report(0.7);
    keepTolerance();
    halveExceeding();
    if (options_.painted) keepColors();
    report(1.0);
    RemeshResult result{measured_.largest, measured_.largest <= options_.tolerance && !quiet_.stopped(), {}};
    for (const std::uint32_t t : measured_.exceeding)
      for (std::uint32_t k = 0; k < 3; ++k) result.exceeding.push_back(mesh_.positions[mesh_.from(t + k)]);
    return result;
  }
  FeatureMesh take() const { return mesh_.compacted(); }

 private:
  void adjust(float loose) {
    for (int i = 0; i < kSweeps && !quiet_.stopped(); ++i) {
      const std::size_t changed = changes_.flip(loose) + changes_.relocate(loose);
      if (static_cast<double>(changed) < kSettled * static_cast<double>(mesh_.liveTriangles())) return;
    }
  }

  void measure() {
    measured_ = measureDensely(mesh_, field_, kMeasured * options_.tolerance, distances_, quiet_);
  }

  void keepTolerance() {
    changes_.setTolerance(kHeld * options_.tolerance);
    adjust(0.0f);
    changes_.split();
    for (int i = 0; i < kCleanings; ++i) {
      // What splitting and adjusting have made superfluous.
      changes_.collapse(RemeshChanges::Care::Strict);
      adjust(0.0f);
      changes_.split();
    }
  }

  // Splits what exceeds the tolerance anywhere.
  void halveExceeding() {
    std::size_t fewest = mesh_.liveTriangles();
    for (int i = 0; i < kHalvings && !quiet_.stopped(); ++i) {
      changes_.collapseShortest();
      measure();
      if (measured_.exceeding.empty()) measureWitnesses();
      if (measured_.exceeding.empty() || measured_.exceeding.size() > kRunaway * fewest) return;
      fewest = std::min(fewest, measured_.exceeding.size() + kFewRounds);
      changes_.project(measured_.vertices);
      changes_.splitTriangles(measured_.exceeding, options_.force);
    }
    changes_.collapseShortest();
    measure();
    measureWitnesses();
  }

  // Adds the triangles next to which points of the surface are too far off.
  void measureWitnesses() {
    if (!options_.witnesses || quiet_.stopped()) return;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> from;
    for (std::uint32_t h = 0; h < mesh_.halfEdges(); h += 3) {
      if (!mesh_.alive(h)) continue;
      triangles.emplace_back(mesh_.from(h), mesh_.from(h + 1), mesh_.from(h + 2));
      from.push_back(h);
    }
    const Witnesses::Missed missed =
        options_.witnesses->missedBy(mesh_.positions, triangles, kMeasured * options_.tolerance, quiet_);
    for (const std::uint32_t t : missed.triangles)
      if (!mesh_.isExemptTriangle(from[t])) measured_.exceeding.push_back(from[t]);
    if (measured_.exceeding.empty()) return;
    measured_.largest = std::max(measured_.largest, missed.max);
    std::ranges::sort(measured_.exceeding);
    measured_.exceeding.erase(std::unique(measured_.exceeding.begin(), measured_.exceeding.end()),
                              measured_.exceeding.end());
  }

  // Splits what blurs the colours, down to a voxel.
  void keepColors() {
    for (int i = 0; i < kHalvings && !quiet_.stopped(); ++i) {
      const ColorErrors colors =
          measureColors(mesh_, static_cast<float>(options_.tolerance), field_, paint_, quiet_);
      if (colors.exceeding.empty()) break;
      changes_.splitTriangles(colors.exceeding, options_.force);
    }
    halveExceeding();
  }

  void report(double done) {
    quiet_.update(done);
    outer_.update(done);
  }

  const LocalField& field_;
  const RemeshOptions& options_;
  Progress& outer_;
  Quiet quiet_;
  HalfEdgeMesh mesh_;
  RemeshChanges changes_;
  DenseDistances measured_;
  std::vector<TriangleDistances> distances_;
  std::vector<TriangleColors> paint_;
};

}  // namespace

RemeshResult remesh(FeatureMesh& mesh, const LocalField& field, const RemeshOptions& options,
                    Progress& progress) {
  Remesher remesher(mesh, field, options, progress);
  const RemeshResult result = remesher.run();
  mesh = remesher.take();
  return result;
}

}  // namespace sdf
