#include "march_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/shapes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/oracle.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "sdfchart/measure/measure.h"

namespace sdf::chart {
namespace {

// Taubin's heart (1994), a polynomial of degree 6 whose slope grows without bound.
Expr heart() {
  const auto [x, y, z] = position();
  const Expr s = square(x) + square(y) + 2.25 * square(z) - 1.0;
  const Expr cube = square(y) * y;
  return s * s * s - square(x) * cube - 9.0 / 80.0 * square(z) * cube;
}

// A point of the solid between a and b, where the distance is fa and fb, both above 0: by halving until the
// slope proves a piece free, or it is a sliver.
std::optional<RootBracket> sliverBetween(const MarchField& field, const Rays& rays, std::size_t i, double a,
                                         double fa, double b, double fb) {
  if (fa + fb > field.lipschitz * (b - a) || b - a < kSliver) return {};
  const double middle = 0.5 * (a + b), f = evaluate(*field.distance, rays.at(i, middle));
  if (f <= 0.0) return RootBracket{a, middle};
  if (const auto before = sliverBetween(field, rays, i, a, fa, middle, f)) return before;
  return sliverBetween(field, rays, i, middle, f, b, fb);
}

// The first sliver on the ray up to t that steps of this length pass by.
std::optional<RootBracket> sliverBefore(const MarchField& field, const Rays& rays, std::size_t i, double t,
                                        double step) {
  double a = rays.tMin[i], fa = evaluate(*field.distance, rays.at(i, a));
  while (a < t && fa > 0.0) {
    const double b = std::min(t, a + std::max(step, fa / field.lipschitz));
    const double fb = evaluate(*field.distance, rays.at(i, b));
    if (fb <= 0.0) return RootBracket{a, b};  // steps that began elsewhere have passed it by
    if (const auto found = sliverBetween(field, rays, i, a, fa, b, fb)) return found;
    a = b, fa = fb;
  }
  return {};
}

// Where the solid begins between a point before it and one in it.
double halved(const Tape& tape, const Rays& rays, std::size_t i, RootBracket bracket) {
  constexpr int kHalvings = 50;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (bracket.before + bracket.after);
    (evaluate(tape, rays.at(i, middle)) < 0.0 ? bracket.after : bracket.before) = middle;
  }
  return bracket.after;
}

}  // namespace

std::string budgetName(const std::string& scene, int steps) {
  return steps == kViewersSteps ? scene : scene + ", " + std::to_string(steps) + " steps";
}

std::vector<MarchedScene> marchedScenes(bool all) {
  const glm::dvec3 from(2.0, 1.6, 3.4);
  std::vector<MarchedScene> scenes{{"smooth: blended balls", bench::measuringShape(2), from, 2.0},
                                   {"sharp: drilled box", bench::measuringShape(1), from, 1.3},
                                   {"grazing: ground", box(Vec3E(4.0, 0.5, 4.0)), {0.0, 0.62, 4.6}, 2.0},
                                   {"no known slope: a heart's formula", field(heart()), from, 1.5}};
  if (!all) return scenes;
  scenes.push_back({"thin: plate of 0.02", box(Vec3E(1.0, 1.0, 0.01)), {0.6, 0.4, 2.6}, 1.4});
  scenes.push_back({"far: ball from 10000", sphere(1.0), {6000.0, 0.0, 8000.0}, 1.2});
  scenes.push_back({"steep: displaced ball", displace(sphere(1.0), 0.1, 20.0), from, 1.2});
  return scenes;
}

Rays cameraRays(const MarchedScene& scene, int side) {
  const double distance = glm::length(scene.from), tangent = scene.radius / distance;
  const glm::dvec3 forward = -scene.from / distance;
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  Rays rays;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double u = (2.0 * x + 1.0) / side - 1.0, v = 1.0 - (2.0 * y + 1.0) / side;
      rays.add(scene.from, glm::normalize(forward + tangent * (u * right + v * up)), 0.0,
               distance + 3.0 * scene.radius);
    }
  return rays;
}

std::vector<std::optional<double>> trueHits(const MarchField& field, const Rays& rays,
                                            const MarchedScene& scene, double step) {
  // What is far before the scene is free of it.
  Rays near = rays;
  const double first = std::max(0.0, glm::length(scene.from) - 4.0 * scene.radius);
  std::fill(near.tMin.begin(), near.tMin.end(), first);
  std::vector<std::optional<double>> all(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    std::optional<RootBracket> bracket = marchDensely(field, near, i, step);
    if (field.hasSlope())
      if (const auto sliver = sliverBefore(field, near, i, bracket ? bracket->before : near.tMax[i], step))
        bracket = sliver;
    if (bracket) all[i] = halved(*field.distance, near, i, *bracket);
  });
  return all;
}

KnownRays::KnownRays(MarchedScene scene, int side, double step)
    : scene_(std::move(scene)),
      side_(side),
      step_(step),
      field_(take(marchField(scene_.shape))),
      rays_(cameraRays(scene_, side)) {}

const std::vector<std::optional<double>>& KnownRays::truth() {
  if (truth_.empty()) truth_ = trueHits(field_, rays_, scene_, step_);
  return truth_;
}

void judgeHits(const Hits& hits, const std::vector<std::optional<double>>& truth, Row& row) {
  ErrorSum errors;
  double missed = 0.0, wrong = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool hit = hits.status[i] == RayStatus::Hit;
    steps += hits.steps[i];
    missed += truth[i] && !hit;
    wrong += !truth[i] && hit;
    if (truth[i] && hit) errors.add(std::abs(hits.t[i] - *truth[i]));
  }
  const double count = static_cast<double>(truth.size());
  errors.giveTo(row);
  row.missed = missed / count;
  row.falseHits = wrong / count;
  row.evaluations = steps / count;
}

}  // namespace sdf::chart
