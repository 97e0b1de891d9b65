#include "sdf/mesh/stages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/eval/promise.h"

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

}  // namespace

void findUnresolved(const NarrowBand& band, const LocalField& field, Progress& progress, MeshStats& stats) {
  const std::vector<NarrowBand::Suspect> suspects = band.suspects();
  const float voxel = static_cast<float>(band.voxelSize());
  std::vector<char> confirmed(suspects.size(), 0);
  forEachRun(
      suspects.size(), [&](std::size_t i) { return suspects[i].at; }, field, progress,
      [&](const PointRun& run) { confirm(run, &suspects[run.first], voxel, &confirmed[run.first]); });
  stats.unresolved = 0;
  for (std::size_t i = 0; i < suspects.size(); ++i)
    if (confirmed[i] && stats.unresolved++ == 0) stats.firstUnresolved = suspects[i].at;
}

}  // namespace sdf
