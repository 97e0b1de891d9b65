#include "sdf/mesh/measure/climb.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sdf/mesh/measure/read_values.h"
#include "sdf/mesh/measure/search.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// Directions of steps; the first step, in voxels; and the last, of the distance to the mesh.
constexpr int kSides = 8;
constexpr double kFirst = 0.5, kLast = 0x1p-7;
// A step that makes less of a difference is not worth another one of its length.
constexpr double kWorthwhile = 1.001;
constexpr int kMostRounds = 100;

// A point on its way.
struct Climber {
  std::size_t number;
  double step = 0.0;
  std::uint32_t nearest = 0;  // triangle
  FarPoint next{};            // the farthest that was found around it
};

// Ways that meet the surface a step from each point of a run, to all sides. They lead from a place beneath
// the point, or above it, so that edges are seen from there whatever their angle.
std::vector<Way> waysAround(const PointRun& run, const std::vector<double>& steps, double turned) {
  RunGradients gradients;
  gradients.evaluate(run, run.points);
  std::vector<Way> ways;
  for (std::size_t i = 0; i < run.count; ++i) {
    const glm::dvec3 at(run.points.at(i)), normal(gradients.normal(i, glm::vec3(0, 1, 0)));
    for (const glm::dvec3& aside : allAround(normal, kSides, turned))
      for (const double side : {-1.0, 1.0})
        ways.push_back({glm::dvec3(glm::vec3(at + steps[i] * aside)), false,
                        (aside + side * normal) / std::numbers::sqrt2, std::numbers::sqrt2 * steps[i]});
  }
  readValues(
      run.batch, *run.tapes.distance, ways.size(), [&](std::size_t k) { return ways[k].from; },
      [&](std::size_t k, float value) { ways[k].inside = value < 0.0f; });
  return ways;
}

// A place that was found beside a climber.
struct Found {
  std::size_t climber;  // of the run
  std::size_t way;
  FarPoint point;
};

// Drops what is no surface: films, and what floats alone take for it.
void dropFilms(std::vector<Found>& found, const PointRun& run, const std::vector<Way>& ways,
               const std::vector<Met>& met, double size) {
  std::vector<glm::dvec3> beside;
  for (const Found& f : found) {
    const glm::dvec3 at(f.point.at), film = double{filmAt(f.point.at, size)} * met[f.way].direction;
    beside.push_back(at - film);
    beside.push_back(at + film);
  }
  std::vector<float> values(beside.size());
  run.batch.evaluateExactly(*run.tapes.distance, beside, values.data());
  std::size_t k = 0;
  std::erase_if(found, [&](const Found& f) {
    const bool before = values[2 * k] < 0.0f, behind = values[2 * k + 1] < 0.0f;
    ++k;
    return before != ways[f.way].inside || behind == before;
  });
}

// Looks around all climbers.
void look(std::vector<Climber>& climbers, const std::vector<FarPoint>& points, const LocalField& field,
          double size, const TriangleTree& mesh, double turned, Progress& progress) {
  std::vector<glm::vec3> from;
  for (const Climber& c : climbers) from.push_back(points[c.number].at);
  forEachGroupedRun(from, field, progress, [&](const PointRun& run, const std::size_t* which) {
    std::vector<double> steps;
    for (std::size_t i = 0; i < run.count; ++i) {
      Climber& c = climbers[which[i]];
      if (c.step == 0.0) c.step = kFirst * run.voxel;
      c.next = points[c.number];
      steps.push_back(c.step);
    }
    const std::vector<Way> ways = waysAround(run, steps, turned);
    const std::vector<Met> met = meetAlong(run, ways);
    std::vector<Found> found;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (!(met[k].distance < kInfinity)) continue;
      Climber& c = climbers[which[k / (2 * kSides)]];
      const glm::vec3 at(ways[k].from + met[k].distance * met[k].direction);
      const NearestPoint nearest = mesh.nearest(at, c.nearest);
      c.nearest = nearest.triangle;
      const double distance = std::sqrt(nearest.squared);
      if (distance > c.next.distance) found.push_back({k / (2 * kSides), k, {at, distance}});
    }
    dropFilms(found, run, ways, met, size);
    for (const Found& f : found) {
      Climber& c = climbers[which[f.climber]];
      if (f.point.distance > c.next.distance) c.next = f.point;
    }
  });
}

}  // namespace

void climb(std::vector<FarPoint>& points, const LocalField& field, double size, const TriangleTree& mesh,
           Progress& progress) {
  std::vector<Climber> climbers;
  double farthest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    climbers.push_back({i});
    farthest = std::max(farthest, points[i].distance);
  }
  for (int round = 0; round < kMostRounds && !climbers.empty() && !progress.stopped(); ++round) {
    look(climbers, points, field, size, mesh, 0.5 * (round % 2), progress);
    for (Climber& c : climbers) {
      if (!(c.next.distance > kWorthwhile * points[c.number].distance)) c.step /= 2.0;
      points[c.number] = c.next;
      farthest = std::max(farthest, c.next.distance);
    }
    // No point is farther by more than its way to there.
    std::erase_if(climbers, [&](const Climber& c) {
      const double d = points[c.number].distance;
      return d + 2.0 * std::numbers::sqrt2 * c.step < farthest || c.step < kLast * farthest;
    });
  }
}

}  // namespace sdf
