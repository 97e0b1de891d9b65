#include "sdf/mesh/measure/distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/base/box.h"
#include "sdf/mesh/measure/find_surface.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

constexpr int kInside = 4;  // sample points inside a triangle

// Where a triangle's samples exceed this share of a voxel and half of the largest one, the surface has an
// edge or a corner under it, and the largest distance lies somewhere between them: kFine points are looked at
// besides.
constexpr double kEdge = 0.1;
constexpr int kFineSteps = 7;
constexpr int kFine = (kFineSteps + 1) * (kFineSteps + 2) / 2;

// Point k of a triangular grid, corners included.
glm::vec3 finePoint(const std::vector<glm::vec3>& p, const glm::uvec3& t, int k) {
  int row = 0;
  while (k > row) k -= ++row;
  const float u = static_cast<float>(row - k) / kFineSteps, v = static_cast<float>(k) / kFineSteps;
  return (1.0f - u - v) * p[t.x] + u * p[t.y] + v * p[t.z];
}

glm::vec3 samplePoint(const std::vector<glm::vec3>& p, const glm::uvec3& t, int k) {
  const glm::vec3 centroid = (p[t.x] + p[t.y] + p[t.z]) / 3.0f;
  return k == 0 ? centroid : 0.5f * (centroid + p[t[k - 1]]);
}

// Calls take(i, distance, voxel) for each of `count` points, distances negative inside; points of one chunk
// in order, chunks in parallel.
template <class Point, class Take>
void forEachDistance(std::size_t count, const Point& point, const LocalField& field, Progress& progress,
                     const Take& take) {
  forEachRun(count, point, field, progress, [&](const PointRun& run) {
    float distances[kBatchPoints];
    findSurface(run, distances);
    for (std::size_t i = 0; i < run.count; ++i) take(run.first + i, distances[i], run.voxel);
  });
}

// The distance at each of `count` points, negative inside.
template <class Point>
std::vector<float> distancesAt(std::size_t count, const Point& point, const LocalField& field,
                               Progress& progress) {
  std::vector<float> all(count);
  forEachDistance(count, point, field, progress, [&](std::size_t i, float d, double) { all[i] = d; });
  return all;
}

// Distances at the samples of a triangle.
struct TriangleError {
  float inside[kInside] = {};
  float voxels = 0.0f;  // the largest in voxels

  // The sample with the largest.
  int farthest() const {
    return static_cast<int>(std::max_element(inside, inside + kInside, closer) - inside);
  }
  static bool closer(float a, float b) { return std::abs(a) < std::abs(b); }
};

// Mean square over a triangle of the quadratic function with these values at the corners and at the samples:
// the square of its mean, which is that of the three samples `m` around the centroid `c`, and the variances
// of what is symmetric of it and of what is not. Distances to smooth surfaces are such functions, of either
// sign where vertices are balanced; means of the samples' squares are off by up to 40 % there.
double meanSquare(const TriangleError& e, const float (&corners)[3]) {
  const double c = e.inside[0];
  double atCorners = 0.0, around = 0.0;
  for (int k = 0; k < 3; ++k) atCorners += corners[k] / 3.0, around += e.inside[k + 1] / 3.0;
  double squares = around * around + 3.0 / 80.0 * (c - atCorners) * (c - atCorners);
  for (int k = 0; k < 3; ++k) {
    const double v = corners[k] - atCorners, m = e.inside[k + 1] - around;
    squares += 4.0 / 5.0 * m * m - 2.0 / 5.0 * m * v + v * v / 12.0;
  }
  return std::isnan(squares) ? kInfinity : squares;  // of an infinite distance
}

struct Far {
  float distance = 0.0f;
  glm::vec3 at{0.0f};
};

// Points, of which the farthest is asked for; those whose distance is no number are left out.
class FarPoints {
 public:
  void add(float distance, const glm::vec3& at) {
    if (!std::isnan(distance)) points_.push_back({std::abs(distance), at});
    largest_ = std::max(largest_, std::abs(distance));
  }
  /// Of those so far.
  float largest() const { return largest_; }

  /// Each is as far as it was added with or nearer. The surface is looked for in all directions from the
  /// farthest on, and closely from the farthest of these, until no other can be farther.
  Far farthest(const LocalField& field, Progress& progress) {
    Far farthest;
    std::vector<Far> looked;
    std::ranges::make_heap(points_, {}, &Far::distance);
    for (std::size_t count = kFewest; !progress.stopped(); count = std::min(2 * count, kMost)) {
      while (distanceOf(points_) > std::max(distanceOf(looked), farthest.distance) && !progress.stopped())
        for (const Far& far : look(Look::AllAround, takeFrom(points_, kMost), field, progress)) {
          looked.push_back(far);
          std::ranges::push_heap(looked, {}, &Far::distance);
        }
      if (distanceOf(looked) <= kSame * farthest.distance) break;
      for (const Far& far : look(Look::Closely, takeFrom(looked, count), field, progress))
        if (far.distance > farthest.distance) farthest = far;
    }
    return distanceOf(looked) > farthest.distance ? looked.front() : farthest;
  }

 private:
  static constexpr std::size_t kFewest = 16, kMost = 2 * kBatchPoints;  // at a time
  // What is farther by less is not looked at closely, and taken as it is.
  static constexpr float kSame = 1.001f;

  // Of the farthest in a heap.
  static float distanceOf(const std::vector<Far>& heap) {
    return heap.empty() ? 0.0f : heap.front().distance;
  }

  static std::vector<Far> takeFrom(std::vector<Far>& heap, std::size_t count) {
    std::vector<Far> taken;
    while (taken.size() < count && !heap.empty()) {
      std::ranges::pop_heap(heap, {}, &Far::distance);
      taken.push_back(heap.back());
      heap.pop_back();
    }
    return taken;
  }

  static std::vector<Far> look(Look look, std::vector<Far> points, const LocalField& field,
                               Progress& progress) {
    forEachRun(
        points.size(), [&](std::size_t i) { return points[i].at; }, field, progress,
        [&](const PointRun& run) {
          float distances[kBatchPoints];
          findSurface(run, distances, look);
          for (std::size_t i = 0; i < run.count; ++i) {
            float& d = points[run.first + i].distance;
            const float found = std::abs(distances[i]);
            if (found < d || (look == Look::Closely && found > d)) d = found;
          }
        });
    return points;
  }

  std::vector<Far> points_;
  float largest_ = 0.0f;
};

}  // namespace

std::vector<float> measureDistance(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                   Progress& progress, MeshStats& stats) {
  std::vector<float> atVertices = distancesAt(
      positions.size(), [&](std::size_t i) { return positions[i]; }, field, progress);
  static_assert(kRunChunk % kInside == 0, "a triangle's samples must lie in one chunk");
  std::vector<TriangleError> inside(triangles.size());
  forEachDistance(
      kInside * triangles.size(),
      [&](std::size_t i) {
        return samplePoint(positions, triangles[i / kInside], static_cast<int>(i % kInside));
      },
      field, progress,
      [&](std::size_t i, float d, double voxel) {
        TriangleError& e = inside[i / kInside];
        e.inside[i % kInside] = d;
        e.voxels = std::max(e.voxels, static_cast<float>(std::abs(d) / voxel));
      });
  double area = 0.0, squares = 0.0;
  FarPoints far;
  for (std::size_t i = 0; i < positions.size(); ++i) far.add(atVertices[i], positions[i]);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3& v = triangles[t];
    const double a =
        0.5 * glm::length(glm::cross(positions[v.y] - positions[v.x], positions[v.z] - positions[v.x]));
    area += a;
    squares += a * meanSquare(inside[t], {atVertices[v.x], atVertices[v.y], atVertices[v.z]});
    const int k = inside[t].farthest();
    far.add(inside[t].inside[k], samplePoint(positions, v, k));
  }
  const float largest = far.largest();
  std::vector<std::uint32_t> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (inside[t].voxels > kEdge && std::abs(inside[t].inside[inside[t].farthest()]) > 0.5 * largest)
      edges.push_back(t);
  const auto fine = [&](std::size_t i) {
    return finePoint(positions, triangles[edges[i / kFine]], static_cast<int>(i % kFine));
  };
  const std::vector<float> atFine = distancesAt(kFine * edges.size(), fine, field, progress);
  for (std::size_t i = 0; i < atFine.size(); ++i) far.add(atFine[i], fine(i));
  const Far farthest = far.farthest(field, progress);
  // Where all distances are equal, rounding may lift their mean above them.
  stats.rmsDistance = area > 0.0 ? std::min(std::sqrt(squares / area), double{farthest.distance}) : 0.0;
  stats.maxDistance = farthest.distance;
  stats.farthest = farthest.at;
  for (float& d : atVertices) d = std::abs(d);
  return atVertices;
}

void measureRounding(const std::vector<glm::vec3>& positions, const std::vector<glm::dvec3>& places,
                     MeshStats& stats) {
  double squares = 0.0;
  for (std::size_t v = 0; v < places.size(); ++v) {
    const double off = glm::distance(glm::dvec3(positions[v]), places[v]);
    squares += off * off;
    if (off > stats.maxDistance) stats.maxDistance = off, stats.farthest = positions[v];
  }
  stats.rmsDistance = std::sqrt(squares / static_cast<double>(places.size()));
  stats.surfacePoints = places.size();
}

}  // namespace sdf
