// Methods of marching at their thresholds: time and readings a ray against what they hit.
#include <glm/geometric.hpp>

#include "measurements.h"
#include "sdf/shape/operators/operators.h"
#include "sdfchart/peers/cone_starts.h"
#include "sdfchart/peers/drawn_rays.h"
#include "sdfchart/truth/march_truth.h"

namespace sdf::chart {
namespace {

struct NamedMethod {
  const char* name;
  MarchMethod method;
  bool lookBehind = false;
};
constexpr NamedMethod kMethods[] = {
    {"plain", MarchMethod::Plain},
    {"over-relaxed", MarchMethod::OverRelaxed},
    {"accelerated", MarchMethod::Accelerated},
    {"auto-relaxed", MarchMethod::AutoRelaxed},
    {"auto-relaxed, looks behind", MarchMethod::AutoRelaxed, true},
    {"segment", MarchMethod::Segment},
    {"bisection", MarchMethod::Bisection},
};

// The viewer's: auto-relaxed steps that look behind, 1e-5 of the view (viewer/render/frame.h).
constexpr double kViewersEpsilon = 1e-5;

// What rays may do: how many steps, and where they start.
struct Allowed {
  int steps;
  bool cones = false;
};

Measurement measurement(const std::shared_ptr<KnownRays>& known, const NamedMethod& method, double epsilon,
                        const Allowed& allowed) {
  Row row{.kind = "marching",
          .scene = budgetName(known->scene().name + (allowed.cones ? ", cone starts" : ""), allowed.steps),
          .method = method.name,
          .setting = formatted("threshold %g", epsilon),
          .size = epsilon};
  row.isDefault =
      method.lookBehind && epsilon == kViewersEpsilon && allowed.steps == kViewersSteps && !allowed.cones;
  row.items = static_cast<double>(known->rays().size());
  const MarchOptions options{.method = method.method,
                             .epsilon = epsilon,
                             .maxSteps = allowed.steps,
                             .lookBehind = method.lookBehind};
  return {row, [known, options, cones = allowed.cones](Row* judged) {
            Marcher marcher = take(Marcher::make(known->field(), options));
            Hits hits;
            double before = 0.0;
            const double seconds = secondsOf([&] {
              if (!cones) return void(hits = take(marcher.trace(known->rays())));
              const StartedRays started = coneStarts(known->field(), known->rays(), known->side());
              before = started.readings;
              hits = take(marcher.trace(started.rays));
            });
            if (judged) {
              judgeHits(hits, known->truth(), *judged);
              judged->evaluations += before;
              judged->truth = kSliver;
            }
            return seconds;
          }};
}

}  // namespace

std::vector<Batch> marchingBatches(const std::vector<Subject>& files, Extent extent) {
  std::vector<MarchedScene> scenes;
  for (const Subject& file : files) {
    const double radius = 0.5 * glm::length(file.bounds.size());
    // The camera looks at the origin.
    const Shape centred = translate(file.shape, Vec3E(-file.bounds.centre()));
    scenes.push_back({file.name, centred, 2.0 * radius * glm::normalize(glm::dvec3(2.0, 1.6, 3.4)), radius});
  }
  if (files.empty()) scenes = marchedScenes(extent == Extent::Full);
  const auto thresholds = byExtent<std::vector<double>>(extent, {1e-2, 1e-3, 1e-4, kViewersEpsilon, 1e-6},
                                                        {1e-2, 1e-3, kViewersEpsilon}, {kViewersEpsilon});
  const auto budgets =
      byExtent<std::vector<int>>(extent, {kViewersSteps, 64}, {kViewersSteps}, {kViewersSteps});
  std::vector<Batch> batches, drawn;
  for (const MarchedScene& scene : scenes) {
    const auto known = [scene, extent, kept = std::make_shared<std::shared_ptr<KnownRays>>()] {
      const double step = byExtent(extent, 1e-3, 2e-3, 4e-3) * scene.radius;
      if (!*kept) *kept = std::make_shared<KnownRays>(scene, byExtent(extent, 64, 32, 12), step);
      return *kept;
    };
    const Batch batch{.weight = byExtent(extent, 25.0, 4.0, 1.0),
                      .runs = byExtent(extent, 5, 3, 1),
                      .budget = byExtent(extent, 15.0, 1.0, 0.0)};
    batches.push_back(batch);
    batches.back().subject = "marching " + scene.name;
    batches.back().make = [=] {
      const auto rays = known();
      std::vector<Allowed> allowed;
      for (const int steps : budgets) allowed.push_back({steps});
      allowed.push_back({kViewersSteps, true});
      std::vector<Measurement> all;
      for (const Allowed& rule : allowed)
        for (const NamedMethod& method : kMethods)
          for (const double epsilon : thresholds) all.push_back(measurement(rays, method, epsilon, rule));
      return all;
    };
    drawn.push_back(batch);
    drawn.back().subject = "drawing " + scene.name;
    drawn.back().make = [=] { return drawnRays(known(), byExtent(extent, 5, 5, 3), budgets); };
  }
  batches.insert(batches.end(), drawn.begin(), drawn.end());
  return batches;
}

}  // namespace sdf::chart
