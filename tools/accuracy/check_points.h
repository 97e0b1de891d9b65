// The points at which shapes are held to their references.
#pragma once
#include <array>
#include <functional>
#include <random>
#include <vector>

#include "check.h"

namespace sdf::accuracy {

/// Between space and the profile's plane of a solid of revolution; does nothing for a case without an axis.
class Turning {
 public:
  explicit Turning(const std::optional<Axis>& axis);
  /// Where the mesh has p's distance.
  glm::dvec3 toMesh(const glm::dvec3& p) const;
  /// A point that toMesh brings to q, or to its mirror image: turned by an angle, four in eight by a multiple
  /// of a right angle.
  glm::dvec3 fromMesh(const glm::dvec3& q, std::mt19937_64& random) const;

 private:
  std::optional<Axis> axis_;
  glm::dvec3 u_{}, w_{};  // across the axis
};

/// The box around a mesh.
Box boxOf(const TriangleMesh& mesh);

/// Picks triangles with chances that are as their areas.
class ByArea {
 public:
  ByArea(const std::vector<glm::dvec3>& points, const std::vector<glm::ivec3>& triangles);
  /// The number of one of them, for a share from 0 to 1 of all area.
  std::size_t at(double share) const;
  std::size_t size() const { return sums_.size(); }

 private:
  std::vector<double> sums_;  // of areas, twice each
};

/// Makes points of every kind that check() promises. Const calls may come from many threads.
class PointMaker {
 public:
  using Random = std::mt19937_64;

  explicit PointMaker(const ReferenceCase& c);

  /// The k-th point; each `k` has its kind, all kinds come within a hundred points. Its coordinates are
  /// floats. `value` reads the shape's distance, which leads to the medial axis.
  glm::dvec3 operator()(std::uint64_t k, Random& random,
                        const std::function<double(const glm::dvec3&)>& value) const;

  /// Longest side of what is tried near, scene units.
  double size() const { return size_; }
  /// Where the mesh has p's distance.
  glm::dvec3 toMesh(const glm::dvec3& p) const { return turning_.toMesh(p); }
  /// Largest coordinate of the mesh, scene units.
  double reach() const { return reach_; }

 private:
  struct OnSurface {
    glm::dvec3 at, normal;
  };
  OnSurface onSurface(Random& random) const;
  glm::dvec3 nearSurface(Random& random) const;
  glm::dvec3 nearSpecial(Random& random) const;
  glm::dvec3 around(Random& random) const;
  glm::dvec3 onSymmetry(Random& random) const;
  glm::dvec3 far(Random& random) const;
  glm::dvec3 onMedialAxis(Random& random, const std::function<double(const glm::dvec3&)>& value) const;
  double offset(Random& random) const;

  const ReferenceCase& case_;
  Turning turning_;
  ByArea byArea_;
  Box box_;
  double size_ = 0.0, reach_ = 0.0;
};

/// The largest coordinate, without its sign.
double largest(const glm::dvec3& p);
glm::dvec3 randomDirection(PointMaker::Random& random);
/// Uniform in [lo, hi).
double uniform(PointMaker::Random& random, double lo, double hi);
/// The gradient by central differences, for functions and coordinates of about 1: what the step of 1e-6 cuts
/// off and what is rounded are both about 1e-10.
glm::dvec3 gradient(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& p);
/// The derivatives along the axes by central differences over steps this long.
template <class F>
auto derivatives(const F& f, const glm::dvec3& p, double step) {
  std::array<decltype(f(p)), 3> all;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 by(0.0);
    by[axis] = step;
    all[axis] = (f(p + by) - f(p - by)) / (2.0 * step);
  }
  return all;
}

}  // namespace sdf::accuracy
