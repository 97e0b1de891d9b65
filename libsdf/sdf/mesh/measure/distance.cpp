#include "sdf/mesh/measure/distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/base/box.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

constexpr int kInside = 4;  // sample points inside a triangle

// First-order distances above this share of a voxel are doubted: near a place where the gradient vanishes
// they come out too large. There the surface is looked for along the gradient, up to kSearchVoxels to either
// side.
constexpr double kDoubtful = 0.5;
constexpr double kSearchVoxels = 2.0;
constexpr std::size_t kSearchSteps = 16;
// Where the sign changes is then looked for in so many pieces of the step, and of the piece.
constexpr int kRefinements = 4;
constexpr std::size_t kPieces = 32;

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

// Distance from p to where f changes sign along a unit direction, at most `reach` away to either side;
// infinite where it does not. Any point of the surface bounds the distance from above.
double distanceAlong(const PointRun& run, const glm::dvec3& p, bool inside, const glm::dvec3& direction,
                     double reach) {
  PointRows at;
  float f[kBatchPoints];
  // The first of so many ways along which the sign is another, or their number.
  const auto firstAcross = [&](std::size_t count, const auto& way) {
    for (std::size_t i = 0; i < count; ++i) at.set(i, glm::vec3(p + way(i) * direction));
    run.batch.evaluate(*run.tapes.distance, at.rows(), count, f);
    return static_cast<std::size_t>(
        std::find_if(f, f + count, [&](float v) { return (v < 0.0f) != inside; }) - f);
  };
  const double step = reach / kSearchSteps;
  const std::size_t found = firstAcross(
      2 * kSearchSteps, [&](std::size_t i) { return (i / 2 + 1.0) * (i % 2 == 0 ? step : -step); });
  if (found == 2 * kSearchSteps) return kInfinity;
  double width = found % 2 == 0 ? step : -step, near = width * static_cast<double>(found / 2);
  for (int k = 0; k < kRefinements; ++k) {
    width /= kPieces;
    near += width * static_cast<double>(
                        firstAcross(kPieces - 1, [&](std::size_t i) { return near + width * (i + 1.0); }));
  }
  return std::abs(near + width);
}

// Distance from p to where f changes sign on the way to the nearest sample of the lattice on the other side;
// infinite where none is within kFarthestVoxels. What is not a number is outside, as it is for the mesher.
double distanceAround(const PointRun& run, const glm::dvec3& p, bool inside) {
  constexpr int kReach = static_cast<int>(kFarthestVoxels), kSide = 2 * kReach + 1;
  constexpr std::size_t kCount = kSide * kSide * kSide;
  static_assert(kCount <= kBatchPoints);
  const glm::dvec3 first = glm::round(p / run.voxel) - static_cast<double>(kReach);
  PointRows at;
  float f[kBatchPoints];
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::dvec3 offset(i / (kSide * kSide), i / kSide % kSide, i % kSide);
    at.set(i, glm::vec3((first + offset) * run.voxel));
  }
  run.batch.evaluate(*run.tapes.distance, at.rows(), kCount, f);
  double nearest = kFarthestVoxels * run.voxel;
  glm::dvec3 across(0.0);
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::dvec3 way = glm::dvec3(at.at(i)) - p;
    if (!(inside ? !(f[i] < 0.0f) : f[i] <= 0.0f) || !(glm::length(way) <= nearest)) continue;
    nearest = glm::length(way);
    across = way;
  }
  if (across == glm::dvec3(0.0)) return kInfinity;
  return std::min(nearest, distanceAlong(run, p, inside, across / nearest, nearest));
}

// |distance| of point i of a run; infinite where it is no number and there is no surface in reach.
float distanceOf(const PointRun& run, const RunGradients& g, std::size_t i) {
  const float first = std::abs(g.distance(i));
  if (first <= kDoubtful * run.voxel) return first;
  const glm::dvec3 p(run.points.at(i)), gradient(g.gradient(i));
  const bool inside = g.value[i] < 0.0f;
  double found = kInfinity;
  if (const double length = glm::length(gradient); length > 0.0 && std::isfinite(length))
    found = distanceAlong(run, p, inside, gradient / length, kSearchVoxels * run.voxel);
  if (found == kInfinity) found = distanceAround(run, p, inside);
  return first < found ? first : static_cast<float>(found);  // the first may be no number
}

// Calls take(i, distance, voxel) for each of `count` points, distances negative inside; points of one chunk
// in order, chunks in parallel.
template <class Point, class Take>
void forEachDistance(std::size_t count, const Point& point, const LocalField& field, Progress& progress,
                     const Take& take) {
  forEachRun(count, point, field, progress, [&](const PointRun& run) {
    RunGradients g;
    g.evaluate(run, run.points);
    for (std::size_t i = 0; i < run.count; ++i)
      take(run.first + i, std::copysign(distanceOf(run, g, i), g.value[i]), run.voxel);
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

// The largest distance so far, and its place.
struct Farthest {
  double distance = 0.0;
  glm::vec3 at{0.0f};

  template <class Point>
  void take(double d, const Point& point) {
    if (std::abs(d) > distance) distance = std::abs(d), at = point();
  }
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
  Farthest farthest;
  for (std::size_t i = 0; i < positions.size(); ++i)
    farthest.take(atVertices[i], [&] { return positions[i]; });
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3& v = triangles[t];
    const double a =
        0.5 * glm::length(glm::cross(positions[v.y] - positions[v.x], positions[v.z] - positions[v.x]));
    area += a;
    squares += a * meanSquare(inside[t], {atVertices[v.x], atVertices[v.y], atVertices[v.z]});
    const int k = inside[t].farthest();
    farthest.take(inside[t].inside[k], [&] { return samplePoint(positions, v, k); });
  }
  std::vector<std::uint32_t> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (inside[t].voxels > kEdge &&
        std::abs(inside[t].inside[inside[t].farthest()]) > 0.5 * farthest.distance)
      edges.push_back(t);
  const auto fine = [&](std::size_t i) {
    return finePoint(positions, triangles[edges[i / kFine]], static_cast<int>(i % kFine));
  };
  const std::vector<float> atFine = distancesAt(kFine * edges.size(), fine, field, progress);
  for (std::size_t i = 0; i < atFine.size(); ++i) farthest.take(atFine[i], [&] { return fine(i); });
  // Where all distances are equal, rounding may lift their mean above them.
  stats.rmsDistance = area > 0.0 ? std::min(std::sqrt(squares / area), farthest.distance) : 0.0;
  stats.maxDistance = farthest.distance;
  stats.farthest = farthest.at;
  for (float& d : atVertices) d = std::abs(d);
  return atVertices;
}

}  // namespace sdf
