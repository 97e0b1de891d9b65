#include "sdf/mesh/measure/find_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sdf/base/box.h"
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
// Of a voxel: above it the surface may be nearer in another direction, and is looked for in all.
constexpr double kNear = 0.5;
// Elsewhere the surface is looked for along the gradient, up to kSearchVoxels to either side, and at samples
// around.
constexpr double kSearchVoxels = 2.0;
constexpr std::size_t kSearchSteps = 16;
// Where the sign changes is then looked for in so many pieces of the step, and of the piece.
constexpr int kRefinements = 4;
constexpr std::size_t kPieces = 32;

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

}  // namespace

void findSurface(const PointRun& run, float* distances) {
  RunGradients g;
  g.evaluate(run, run.points);
  const RunDistances found(run, g);
  for (std::size_t i = 0; i < run.count; ++i)
    distances[i] = std::copysign(static_cast<float>(found.at(i)), g.value[i]);
}

}  // namespace sdf
