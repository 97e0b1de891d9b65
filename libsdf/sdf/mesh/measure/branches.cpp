#include "sdf/mesh/measure/branches.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sdf/base/box.h"
#include "sdf/mesh/measure/find_surface.h"

namespace sdf {
namespace {

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

// A point, its branches so far, and where the next is looked for.
struct Corner {
  std::size_t point;
  Branches branches;
  glm::dvec3 x{0.0};  // relative to the point
};

// Each corner with its next branch, and x moved behind where they meet; without those that have none.
std::vector<Corner> withNextBranch(const PointRun& run, const std::vector<Way>& points,
                                   const std::vector<Corner>& corners) {
  constexpr double kBehind = 0.02;  // of the way
  PointRows at, gradients;
  float values[kBatchPoints];
  for (std::size_t k = 0; k < corners.size(); ++k)
    at.set(k, glm::vec3(points[corners[k].point].from + corners[k].x));
  run.batch.evaluateGradient(*run.tapes.distance, at.rows(), corners.size(), values, gradients.x, gradients.y,
                             gradients.z);
  std::vector<Corner> next;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Corner corner = corners[k];
    if (!corner.branches.add(corner.x, values[k], gradients.at(k))) continue;
    const double behind = kBehind * glm::length(corner.branches.nearest(0.0));
    corner.x = corner.branches.nearest(points[corner.point].inside ? behind : -behind);
    const double length = glm::length(corner.x);
    if (length > 0.0 && length <= kFarthestVoxels * run.voxel) next.push_back(corner);
  }
  return next;
}

}  // namespace

std::vector<Met> meetBranches(const PointRun& run, const std::vector<Way>& points) {
  std::vector<Met> met(points.size());
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < points.size(); ++i) corners.push_back({i, {}});
  for (int branch = 0; branch < 3 && !corners.empty(); ++branch) {
    corners = withNextBranch(run, points, corners);
    std::vector<Way> ways;
    for (const Corner& corner : corners) {
      const Way& point = points[corner.point];
      const double length = glm::length(corner.x);
      ways.push_back({point.from, point.inside, corner.x / length, length});
    }
    const std::vector<Met> along = meetAlong(run, ways);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      Met& m = met[corners[k].point];
      m = nearer(m, along[k]);
    }
  }
  return met;
}

}  // namespace sdf
