#include "sdf/mesh/band/unresolved.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "sdf/eval/promise.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// Where a suspect's sign is looked at. Of an edge, around the expected crossing: along it, and to its sides,
// where solids that touch part. Else beyond the expected surface. In shares of a voxel.
struct Probe {
  float along, aside[2];
  float beyond;
};
constexpr Probe kAcross[] = {{0.0f, {0.0f, 0.0f}, 0.002f}, {-0.1f, {0.0f, 0.0f}, 0.01f},
                             {0.1f, {0.0f, 0.0f}, 0.02f},  {0.0f, {0.4f, 0.0f}, 0.05f},
                             {0.0f, {-0.4f, 0.0f}, 0.1f},  {0.0f, {0.0f, 0.4f}, 0.2f},
                             {0.0f, {0.0f, -0.4f}, 0.4f}};
// Where the sign must be the suspect's again: at the edge's start, or beyond what is thinner than a voxel,
// but not beyond the tip of something larger that is seen elsewhere.
constexpr Probe kThrough = {-1.0f, {0.0f, 0.0f}, 1.0f};
// Half a cell's diagonal, and the least of what is looked beyond.
constexpr float kReach = 0.8660254f + 0.02f;
// Thickness is measured between the changes of sign along the gradient, as far as the suspect's tapes hold.
// Where all samples miss it, it is looked for about the least of them.
constexpr float kMeasured = 2.0f;  // voxels
constexpr int kSamples = 32, kPasses = 3;
constexpr std::size_t kMostMeasured = 128;  // suspects, evenly spread
constexpr float kNowhere = -1.0f;
// Of a distance's rounding: what it may make of a zero where solids touch, which few operations lead to.
constexpr double kOfRounding = 0.25;

/// The point this much further than the first-order distance; the suspect itself where that is out of reach:
/// a flat field is low far from its surface, which then lies beside another sample.
glm::vec3 beyond(const NarrowBand::Suspect& s, float further, const glm::vec3& gradient, float voxel) {
  const float length = glm::length(gradient), distance = std::abs(s.value) / length;
  if (!(distance <= kReach * voxel)) return s.at;
  return s.at - gradient * std::copysign((distance + further) / length, s.value);
}

/// Where a suspect's probe is to look; `gradient` is the distance's at the suspect.
glm::vec3 probeAt(const NarrowBand::Suspect& s, const Probe& probe, const glm::vec3& gradient, float voxel) {
  if (s.along == glm::vec3(0.0f)) return beyond(s, probe.beyond * voxel, gradient, voxel);
  const glm::vec3 u(s.along.y, s.along.z, s.along.x), v(s.along.z, s.along.x, s.along.y);
  return s.at + s.along * std::clamp(s.share + probe.along, 0.0f, 1.0f) + probe.aside[0] * u +
         probe.aside[1] * v;
}

/// Marks the suspects of a run that the probes confirm.
void confirm(const PointRun& run, const NarrowBand::Suspect* suspects, float voxel, char* confirmed) {
  RunGradients at;
  at.evaluate(run, run.points);
  PointRows places;
  float value[kBatchPoints];
  // Calls take(i, whether the probe of suspect i lies beyond a change of sign).
  const auto look = [&](const Probe& probe, const auto& take) {
    for (std::size_t i = 0; i < run.count; ++i)
      places.set(i, probeAt(suspects[i], probe, at.gradient(i), voxel));
    run.batch.evaluate(*run.tapes.distance, places.rows(), run.count, value);
    for (std::size_t i = 0; i < run.count; ++i)
      take(i, (suspects[i].value < 0.0f ? value[i] : -value[i]) >
                  kOfRounding * distanceRounding(places.at(i), voxel));
  };
  for (const Probe& probe : kAcross) look(probe, [&](std::size_t i, bool across) { confirmed[i] |= across; });
  look(kThrough, [&](std::size_t i, bool across) { confirmed[i] &= !across; });
}

/// Measures what the gradient at each suspect of a run passes through; 0 where it meets nothing, or no end.
void measure(const PointRun& run, const NarrowBand::Suspect* suspects, float voxel, float* thickness) {
  struct Line {
    float start = 0.0f, step = 0.0f;  ///< of the samples, along the line
    float least = 0.0f, leastAt = 0.0f, before = 0.0f;
    float enters = kNowhere, leaves = kNowhere;
  };
  RunGradients at;
  at.evaluate(run, run.points);
  PointRows places;
  float value[kBatchPoints];
  std::vector<Line> lines(run.count, {.step = kMeasured * voxel / kSamples});
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Line& line : lines) line.least = std::numeric_limits<float>::infinity();
    for (int k = 0; k <= kSamples; ++k) {
      for (std::size_t i = 0; i < run.count; ++i)
        places.set(i,
                   suspects[i].at - glm::normalize(at.gradient(i)) *
                                        std::copysign(lines[i].start + k * lines[i].step, suspects[i].value));
      run.batch.evaluate(*run.tapes.distance, places.rows(), run.count, value);
      for (std::size_t i = 0; i < run.count; ++i) {
        Line& line = lines[i];
        const float v = suspects[i].value < 0.0f ? -value[i] : value[i], t = line.start + k * line.step;
        if (v < line.least) line.least = v, line.leastAt = t;
        // Between this sample and the one before.
        const auto zero = [&] { return k == 0 ? t : t - line.step * v / (v - line.before); };
        if (line.enters == kNowhere && v < 0.0f) line.enters = zero(), line.leaves = kNowhere;
        if (line.enters != kNowhere && line.leaves == kNowhere && v >= 0.0f) line.leaves = zero();
        line.before = v;
      }
    }
    if (std::ranges::none_of(lines, [](const Line& line) { return line.enters == kNowhere; })) break;
    for (Line& line : lines) {
      if (line.enters != kNowhere) continue;
      line.start = line.leastAt - line.step;
      line.step *= 2.0f / kSamples;
    }
  }
  for (std::size_t i = 0; i < run.count; ++i)
    thickness[i] = lines[i].enters == kNowhere ? 0.0f : std::max(lines[i].leaves - lines[i].enters, 0.0f);
}

/// The least thickness among the suspects; infinite where none could be measured.
float thinnest(const std::vector<NarrowBand::Suspect>& suspects, float voxel, const LocalField& field,
               Progress& progress) {
  std::vector<float> thickness(suspects.size(), 0.0f);
  forEachRun(
      suspects.size(), [&](std::size_t i) { return suspects[i].at; }, field, progress,
      [&](const PointRun& run) { measure(run, &suspects[run.first], voxel, &thickness[run.first]); });
  float least = std::numeric_limits<float>::infinity();
  for (const float t : thickness)
    if (t > 0.0f) least = std::min(least, t);
  return least;
}

}  // namespace

void findUnresolved(const NarrowBand& band, const LocalField& field, Progress& progress, MeshStats& stats) {
  const std::vector<NarrowBand::Suspect> suspects = band.suspects();
  const float voxel = static_cast<float>(band.voxelSize());
  std::vector<char> confirmed(suspects.size(), 0);
  forEachRun(
      suspects.size(), [&](std::size_t i) { return suspects[i].at; }, field, progress,
      [&](const PointRun& run) { confirm(run, &suspects[run.first], voxel, &confirmed[run.first]); });
  std::vector<NarrowBand::Suspect> found;
  for (std::size_t i = 0; i < suspects.size(); ++i)
    if (confirmed[i]) found.push_back(suspects[i]);
  stats.unresolved = found.size();
  stats.resolvingVoxel = 0.0;
  if (found.empty()) return;
  stats.firstUnresolved = found.front().at;
  std::vector<NarrowBand::Suspect> measured;
  for (std::size_t i = 0; i < found.size(); i += found.size() / kMostMeasured + 1)
    measured.push_back(found[i]);
  if (const float thin = thinnest(measured, voxel, field, progress); std::isfinite(thin))
    stats.resolvingVoxel = std::min(thin, voxel) / std::numbers::sqrt3;
}

}  // namespace sdf
