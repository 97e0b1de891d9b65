#include "sdf/mesh/measure/distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sdf/base/box.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

constexpr int kInside = 4;  // sample points inside a triangle

// A first-order distance is taken for the distance where the surface is met between this share of it and so
// many times it. It says little where the gradient vanishes: x^3 is x / 3 from its zero by first order.
constexpr float kWithin = 1.1f;
// Of the largest coordinate, and of a voxel: distances below are much of rounding, and so are directions. The
// surface is then to be met in one of 26 directions, within twice the distance along each axis.
constexpr float kRoundings = 8.0f * 0x1p-23f;
constexpr double kSmall = 0.01;
// Of a voxel: above it the surface may be nearer in another direction, and is looked for in all.
constexpr double kNear = 0.5;
// Elsewhere the surface is looked for along the gradient, up to kSearchVoxels to either side, and at samples
// around.
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

// Is a point with this value on the surface, or on the side where one that is inside or not is not? What is
// no number is outside.
bool isAcross(float value, bool inside) { return inside ? !(value < 0.0f) : value <= 0.0f; }

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
    return static_cast<std::size_t>(std::find_if(f, f + count, [&](float v) { return isAcross(v, inside); }) -
                                    f);
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
    if (!isAcross(f[i], inside) || !(glm::length(way) <= nearest)) continue;
    nearest = glm::length(way);
    across = way;
  }
  if (nearest == 0.0) return 0.0;
  if (across == glm::dvec3(0.0)) return kInfinity;
  return std::min(nearest, distanceAlong(run, p, inside, across / nearest, nearest));
}

// Up to three branches of the field around a point, each by first order: a plane on which it is 0. The
// surface has an edge or a corner where they meet.
class Branches {
 public:
  /// The field's branch at `at`, relative to the point; false where there is no plane, or it is one of those
  /// before.
  bool add(const glm::dvec3& at, double value, const glm::dvec3& gradient) {
    const double length = glm::length(gradient);
    if (!(length > 0.0 && std::isfinite(length) && std::isfinite(value)) || count_ == 3) return false;
    normals_[count_] = gradient / length;
    heights_[count_] = glm::dot(normals_[count_], at) - value / length;
    ++count_;
    return std::abs(determinant()) > kParallel;
  }

  /// The nearest point at which each branch has this value.
  glm::dvec3 nearest(double value) const {
    const glm::dmat3 products = matrix();
    glm::dvec3 right(0.0), x(0.0);
    for (int k = 0; k < count_; ++k) right[k] = heights_[k] + value;
    right = glm::inverse(products) * right;
    for (int k = 0; k < count_; ++k) x += right[k] * normals_[k];
    return x;
  }

 private:
  static constexpr double kParallel = 1e-6;  // of planes: squares of the sines between them

  // The products of the normals; of those that there are not, 1 with themselves.
  glm::dmat3 matrix() const {
    glm::dmat3 m(1.0);
    for (int i = 0; i < count_; ++i)
      for (int k = 0; k < count_; ++k) m[i][k] = glm::dot(normals_[i], normals_[k]);
    return m;
  }
  double determinant() const { return glm::determinant(matrix()); }

  glm::dvec3 normals_[3];
  double heights_[3] = {};
  int count_ = 0;
};

// Distance from p to where the sign changes on the way to an edge or a corner, found from the field's
// branches; infinite where it does not. The way ends a little behind them, where the next branch is found.
double distanceToBranches(const PointRun& run, const glm::dvec3& p, bool inside) {
  constexpr double kBehind = 0.02;  // of the way
  Branches branches;
  glm::dvec3 x(0.0);
  double nearest = kInfinity;
  for (int k = 0; k < 3; ++k) {
    PointRows at;
    at.set(0, glm::vec3(p + x));
    float value, dx, dy, dz;
    run.batch.evaluateGradient(*run.tapes.distance, at.rows(), 1, &value, &dx, &dy, &dz);
    if (!branches.add(x, value, {dx, dy, dz})) break;
    const double most = kBehind * glm::length(branches.nearest(0.0));
    x = branches.nearest(inside ? most : -most);
    const double reach = glm::length(x);
    if (!(reach > 0.0 && reach <= kFarthestVoxels * run.voxel)) break;
    nearest = std::min(nearest, distanceAlong(run, p, inside, x / reach, reach));
  }
  return nearest;
}

float largest(const glm::vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

// Is one of 26 points around p across the surface?
bool isNear(const PointRun& run, const glm::vec3& p, bool inside, float reach) {
  PointRows around;
  std::size_t count = 0;
  for (int i = 0; i < 27; ++i)
    if (i != 13) around.set(count++, p + reach * glm::vec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
  float f[kBatchPoints];
  run.batch.evaluate(*run.tapes.distance, around.rows(), count, f);
  return std::any_of(f, f + count, [&](float v) { return isAcross(v, inside); });
}

// The distances of the points of a run to where the sign changes.
class RunDistances {
 public:
  RunDistances(const PointRun& run, const RunGradients& g) : run_(run), g_(g) {
    readAcross(1.0f / kWithin, short_);
    readAcross(kWithin, long_);
  }

  /// Without a sign; infinite or no number where the gradient is none, and there is no surface in reach.
  double at(std::size_t i) const {
    const float first = std::abs(g_.distance(i));
    if (first == 0.0f) return 0.0;
    const bool inside = g_.value[i] < 0.0f,
               meets = !isAcross(short_[i], inside) && isAcross(long_[i], inside);
    const glm::vec3 p = run_.points.at(i);
    if (meets && first <= kNear * run_.voxel) return first;
    const float rounding = kRoundings * largest(p);
    if (first <= std::max(double{rounding}, kSmall * run_.voxel) &&
        isNear(run_, p, inside, std::max(rounding, 2.0f * first)))
      return first;
    const double found = std::min(searched(i, first), meets ? double{first} : kInfinity);
    return found < kInfinity ? found : first;
  }

 private:
  // Values at so many times the first-order distance.
  void readAcross(float times, float* values) {
    PointRows across;
    for (std::size_t i = 0; i < run_.count; ++i) across.set(i, run_.points.at(i) + times * g_.step(i));
    run_.batch.evaluate(*run_.tapes.distance, across.rows(), run_.count, values);
  }

  // To see around costs hundreds of readings, and is left out where the surface was met about where it was
  // expected.
  double searched(std::size_t i, double expected) const {
    constexpr double kAsExpected = 2.0;
    const glm::dvec3 p(run_.points.at(i)), normal(g_.normal(i));
    const bool inside = g_.value[i] < 0.0f;
    double found = distanceToBranches(run_, p, inside);
    if (normal != glm::dvec3(0.0))
      found = std::min(found, distanceAlong(run_, p, inside, normal, kSearchVoxels * run_.voxel));
    if (found <= kAsExpected * expected && found <= kNear * run_.voxel) return found;
    return std::min(found, distanceAround(run_, p, inside));
  }

  const PointRun& run_;
  const RunGradients& g_;
  float short_[kBatchPoints], long_[kBatchPoints];
};

// Calls take(i, distance, voxel) for each of `count` points, distances negative inside; points of one chunk
// in order, chunks in parallel.
template <class Point, class Take>
void forEachDistance(std::size_t count, const Point& point, const LocalField& field, Progress& progress,
                     const Take& take) {
  forEachRun(count, point, field, progress, [&](const PointRun& run) {
    RunGradients g;
    g.evaluate(run, run.points);
    const RunDistances distances(run, g);
    for (std::size_t i = 0; i < run.count; ++i)
      take(run.first + i, std::copysign(static_cast<float>(distances.at(i)), g.value[i]), run.voxel);
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
