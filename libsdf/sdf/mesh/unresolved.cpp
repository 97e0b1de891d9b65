#include "sdf/mesh/stages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/eval/promise.h"

namespace sdf {
namespace {

// Around the expected crossing: along the edge, and to its sides, where solids that touch part.
constexpr std::size_t kProbes = 7;
constexpr float kAlongEdge[kProbes] = {0.0f, -0.1f, 0.1f, 0.0f, 0.0f, 0.0f, 0.0f};
constexpr float kAside[kProbes][2] = {{0, 0}, {0, 0}, {0, 0}, {0.4f, 0}, {-0.4f, 0}, {0, 0.4f}, {0, -0.4f}};
// Beyond the expected surface, as shares of a voxel.
constexpr float kBeyond[kProbes] = {0.002f, 0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.4f};
// Beyond what is thinner than a voxel, but not beyond the tip of something larger that is seen elsewhere.
constexpr float kThrough = 1.0f;
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

/// Where probe k of a suspect is to look; `gradient` is the distance's at the suspect.
glm::vec3 probeAt(const NarrowBand::Suspect& s, std::size_t k, const glm::vec3& gradient, float voxel) {
  if (s.along == glm::vec3(0.0f)) return beyond(s, kBeyond[k] * voxel, gradient, voxel);
  const glm::vec3 u(s.along.y, s.along.z, s.along.x), v(s.along.z, s.along.x, s.along.y);
  return s.at + s.along * std::clamp(s.share + kAlongEdge[k], 0.0f, 1.0f) + kAside[k][0] * u +
         kAside[k][1] * v;
}

/// Where the sign must be the suspect's again.
glm::vec3 probeThrough(const NarrowBand::Suspect& s, const glm::vec3& gradient, float voxel) {
  return s.along == glm::vec3(0.0f) ? beyond(s, kThrough * voxel, gradient, voxel) : s.at;
}

/// One run's points, and which of them lie beyond a sign change.
struct Probes : PointRows {
  float value[kBatchPoints];

  void evaluate(const PointRun& run) { run.batch.evaluate(*run.tapes.distance, rows(), run.count, value); }
  bool isAcross(std::size_t i, float suspect, float voxel) const {
    return (suspect < 0.0f ? value[i] : -value[i]) > kOfRounding * distanceRounding(at(i), voxel);
  }
};

/// Marks the suspects of a run that the probes confirm.
void confirm(const PointRun& run, const NarrowBand::Suspect* suspects, float voxel, char* confirmed) {
  Probes probes;
  for (std::size_t i = 0; i < run.count; ++i) probes.set(i, suspects[i].at);
  RunGradients at;
  at.evaluate(run, probes);
  for (std::size_t k = 0; k < kProbes; ++k) {
    for (std::size_t i = 0; i < run.count; ++i) probes.set(i, probeAt(suspects[i], k, at.gradient(i), voxel));
    probes.evaluate(run);
    for (std::size_t i = 0; i < run.count; ++i) confirmed[i] |= probes.isAcross(i, suspects[i].value, voxel);
  }
  for (std::size_t i = 0; i < run.count; ++i) probes.set(i, probeThrough(suspects[i], at.gradient(i), voxel));
  probes.evaluate(run);
  for (std::size_t i = 0; i < run.count; ++i) confirmed[i] &= !probes.isAcross(i, suspects[i].value, voxel);
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
