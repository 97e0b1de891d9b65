// Collapsing by what normals foretell.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/mesh/refine/remesh_changes.h"
#include "sdf/mesh/refine/remesh_fan_samples.h"
#include "sdf/mesh/refine/remesh_paint.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// A parabola is as far from its chord as this share of the way from the chord's one end to the tangent at the
// other.
constexpr float kSagitta = 0.25f;

// Stars grow no larger: what many collapses share only one of them can have at a time.
constexpr std::uint32_t kMostSpokes = 14;

}  // namespace

void RemeshChanges::estimate(Fans& fans, std::vector<FanError>& errors) const {
  errors.assign(fans.all.size(), {});
  if (fans.all.empty()) return;
  const auto spacing = static_cast<float>(field_.finder()->at(fans.all[0].centre).voxel);
  const auto viewOf = [&](std::size_t i) { return FanView(fans, i, tolerance_, spacing); };
  std::vector<std::size_t> first{0};
  for (std::size_t i = 0; i < fans.all.size(); ++i) first.push_back(first.back() + viewOf(i).centres());
  std::vector<FanSample> samples;
  samples.reserve(first.back());
  for (std::size_t i = 0; i < fans.all.size(); ++i)
    viewOf(i).forEachCentre([&](const FanSample& s) { samples.push_back(s); });
  std::vector<Reading> readings(samples.size());
  forEachRun(
      samples.size(), [&](std::size_t i) { return samples[i].at; }, field_, progress_,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) {
          const FanSample& s = samples[run.first + i];
          const glm::vec3 n = g.normal(i);
          readings[run.first + i] = {g.distance(i) + glm::dot(n, s.of - s.at), n};
        }
      });
  if (progress_.stopped()) return;
  tbb::parallel_for(std::size_t{0}, fans.all.size(), [&](std::size_t i) {
    const FanView view = viewOf(i);
    const std::span<const Reading> centres(readings.data() + first[i], first[i + 1] - first[i]);
    FanError& e = errors[i];
    Fan& fan = fans.all[i];
    fan.centre += stepOnto(centres);
    if (!centres.empty()) e.normal = centres[0].normal;
    e.smooth = centres.size() == 2 && std::abs(glm::dot(e.normal, centres[1].normal)) >= kOneSide;
    e.sound = fan.count <= kMostSpokes;
    for (std::uint32_t k = 0; k < fan.count; ++k) {
      const std::array<const Fans::Spoke*, 2> ends{&view.rim[k], &view.rim[view.after(k)]};
      const Facet facet(fan.centre, ends[0]->end, ends[1]->end, tolerance_);
      e.sound &= facet.sound;
      const auto hold = [&](const glm::vec3& normal, const Fans::Spoke& s) {
        e.sound &= glm::dot(facet.area, normal) > kFacing * facet.size;
        e.largest = std::max(e.largest, kSagitta * std::abs(glm::dot(normal, s.end - fan.centre)));
      };
      for (const Fans::Spoke* s : ends) {
        if (!centres.empty()) hold(centres[centres.size() == 2 && view.inSecond(k) ? 1 : 0].normal, *s);
        if (mesh_.creasesAt(s->vertex) == 0) hold(normals_[s->vertex], *s);
      }
    }
    if (!(e.largest < HUGE_VALF)) e.sound = false;
  });
  if (painted_ && !progress_.stopped()) addPaintErrors(fans, tolerance_, field_, progress_, errors);
}

}  // namespace sdf
