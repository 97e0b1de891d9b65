#include "sdf/mesh/measure/find_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/base/box.h"
#include "sdf/mesh/measure/branches.h"
#include "sdf/mesh/measure/read_values.h"
#include "sdf/mesh/measure/search.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// A first-order distance is taken for the distance where the surface is met between this share of it and so
// many times it. It says little where the gradient vanishes: x^3 is x / 3 from its zero by first order.
constexpr float kWithin = 1.1f;
// Of the largest coordinate, and of a voxel: distances below are much of rounding, and so are directions. The
// surface is then to be met in one of 26 directions, within twice the distance along each axis.
constexpr float kRoundings = 8.0f * 0x1p-23f;
constexpr double kSmall = 0.01;
// Of the reach of those directions: how far into a tip one looks, which is narrow next to its end.
constexpr float kTip = 4.0f;
// Of a voxel: above it the surface may be nearer in another direction, and is looked for in all.
constexpr double kNear = 0.5;
// Elsewhere the surface is looked for along the gradient, up to so many voxels to either side, and at samples
// around; not there where it was met within so many times the first-order distance.
constexpr double kSearchVoxels = 2.0;
constexpr double kAsExpected = 2.0;

// The distances of the points of a run to where the sign changes, without a sign; infinite or no number where
// the gradient is none, and there is no surface in reach.
class RunDistances {
 public:
  RunDistances(const PointRun& run, const RunGradients& g, Look look, float* distances)
      : run_(run), g_(g), look_(look), distances_(distances) {}

  void find() {
    std::vector<std::size_t> unmet = takeFirstOrder();
    takeSmall(unmet);
    search(unmet);
  }

 private:
  // Takes the first-order distance where the surface is met there, not far away; the other points.
  std::vector<std::size_t> takeFirstOrder() {
    readAcross(1.0f / kWithin, short_);
    readAcross(kWithin, long_);
    std::vector<std::size_t> unmet;
    for (std::size_t i = 0; i < run_.count; ++i) {
      distances_[i] = std::abs(g_.distance(i));
      const bool isTaken = isMet(i) && distances_[i] <= kNear * run_.voxel && look_ == Look::Near;
      if (distances_[i] != 0.0f && !isTaken) unmet.push_back(i);
    }
    return unmet;
  }

  bool isMet(std::size_t i) const {
    return !isAcross(short_[i], isInside(i)) && isAcross(long_[i], isInside(i));
  }
  bool isInside(std::size_t i) const { return g_.value[i] < 0.0f; }

  // Values at so many times the first-order distance.
  void readAcross(float times, float* values) {
    PointRows across;
    for (std::size_t i = 0; i < run_.count; ++i) across.set(i, run_.points.at(i) + times * g_.step(i));
    run_.batch.evaluate(*run_.tapes.distance, across.rows(), run_.count, values);
  }

  /// A point that is about as near as rounding.
  struct Small {
    std::size_t point;
    float reach;
    glm::vec3 rise{0.0f};  // about the mean gradient around it
    bool met = false;
  };

  // Drops those that are as near as rounding, and have the surface around them.
  void takeSmall(std::vector<std::size_t>& unmet) {
    std::vector<Small> small;
    for (const std::size_t i : unmet) {
      const float first = distances_[i], rounding = kRoundings * largestCoordinate(run_.points.at(i));
      if (first <= std::max(double{rounding}, kSmall * run_.voxel))
        small.push_back({i, std::max(rounding, 2.0f * first)});
    }
    meetNeighbours(small);
    meetTips(small);
    std::vector<bool> met(run_.count);
    for (const Small& s : small)
      if (s.met) met[s.point] = true;
    std::erase_if(unmet, [&](std::size_t i) { return met[i]; });
  }

  void meetNeighbours(std::vector<Small>& small) {
    readValues(
        run_.batch, *run_.tapes.distance, kNeighbourhood * small.size(),
        [&](std::size_t k) {
          const Small& s = small[k / kNeighbourhood];
          return run_.points.at(s.point) + s.reach * neighbour(static_cast<int>(k % kNeighbourhood));
        },
        [&](std::size_t k, float value) {
          Small& s = small[k / kNeighbourhood];
          if (isAcross(value, isInside(s.point))) s.met = true;
          s.rise += value * neighbour(static_cast<int>(k % kNeighbourhood));
        });
  }

  // A spike may pass between neighbours: it lies where the field falls, seen from all around.
  void meetTips(std::vector<Small>& small) {
    std::vector<Small> tips;
    for (const Small& s : small)
      if (!s.met)
        tips.push_back({s.point, std::max(kTip * s.reach, static_cast<float>(kSmall * run_.voxel))});
    meetNeighbours(tips);
    constexpr float kTilt = 0.15f;  // of the direction, to all sides: neighbours see it askew
    readValues(
        run_.batch, *run_.tapes.distance, kNeighbourhood * tips.size(),
        [&](std::size_t k) {
          const Small& s = tips[k / kNeighbourhood];
          const float size = glm::length(s.rise), way = isInside(s.point) ? s.reach : -s.reach;
          const glm::vec3 tilt = kTilt * neighbour(static_cast<int>(k % kNeighbourhood));
          return run_.points.at(s.point) + way * (tilt + (size > 0.0f ? s.rise / size : glm::vec3(0.0f)));
        },
        [&](std::size_t k, float value) {
          Small& s = tips[k / kNeighbourhood];
          if (isAcross(value, isInside(s.point))) s.met = true;
        });
    small.insert(small.end(), tips.begin(), tips.end());
  }

  void search(const std::vector<std::size_t>& unmet) {
    std::vector<Way> ways;
    for (const std::size_t i : unmet)
      ways.push_back(
          {glm::dvec3(run_.points.at(i)), isInside(i), glm::dvec3(g_.normal(i)), kSearchVoxels * run_.voxel});
    std::vector<Met> met = meetBranches(run_, ways);
    const std::vector<Met> along = meetAlong(run_, ways);
    std::vector<std::size_t> open;
    std::vector<Way> around;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      met[k] = nearer(met[k], along[k]);
      const double distance = met[k].distance;
      if (distance <= kAsExpected * distances_[unmet[k]] && distance <= kNear * run_.voxel &&
          look_ == Look::Near)
        continue;
      open.push_back(k);
      around.push_back(ways[k]);
      around.back().reach = std::min(met[k].distance, kFarthestVoxels * run_.voxel);
    }
    met = meetNearer(run_, ways, std::move(met));
    std::vector<Met> nearest = meetAround(run_, around);
    const std::vector<Met> all = meetAllAround(run_, around, look_ == Look::Closely ? 2 : 1);
    for (std::size_t k = 0; k < open.size(); ++k) nearest[k] = nearer(nearest[k], all[k]);
    nearest = meetNearer(run_, around, std::move(nearest));
    if (look_ == Look::Closely) {
      for (std::size_t k = 0; k < open.size(); ++k) nearest[k] = nearer(nearest[k], met[open[k]]);
      nearest = meetBeside(run_, around, std::move(nearest));
    }
    for (std::size_t k = 0; k < open.size(); ++k) met[open[k]] = nearer(met[open[k]], nearest[k]);
    for (std::size_t k = 0; k < ways.size(); ++k) take(unmet[k], met[k].distance);
  }

  // Where nothing is found the first-order figure stays.
  void take(std::size_t i, double found) {
    if (isMet(i) && look_ != Look::Closely) found = std::min(found, double{distances_[i]});
    if (found < kInfinity) distances_[i] = static_cast<float>(found);
  }

  const PointRun& run_;
  const RunGradients& g_;
  Look look_;
  float* distances_;
  float short_[kBatchPoints], long_[kBatchPoints];
};

}  // namespace

void findSurface(const PointRun& run, float* distances, Look look) {
  RunGradients g;
  g.evaluate(run, run.points);
  RunDistances(run, g, look, distances).find();
  for (std::size_t i = 0; i < run.count; ++i) distances[i] = std::copysign(distances[i], g.value[i]);
}

}  // namespace sdf
