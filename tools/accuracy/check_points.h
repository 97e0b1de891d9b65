// The points at which shapes are held to their references.
#pragma once
#include <random>
#include <vector>

#include "check.h"

namespace sdf::accuracy {

/// Makes points of every kind that check() promises. Const calls may come from many threads.
class PointMaker {
 public:
  using Random = std::mt19937_64;

  PointMaker(const ReferenceCase& c, const Reference& reference);

  /// The k-th point; each `k` has its kind, all kinds come within some hundred points. Its coordinates are
  /// floats.
  glm::dvec3 operator()(std::uint64_t k, Random& random) const;

  /// Longest side of what is tried near, scene units.
  double size() const { return size_; }
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
  glm::dvec3 onMedialAxis(Random& random) const;
  double offset(Random& random) const;

  const ReferenceCase& case_;
  const Reference& reference_;
  std::vector<double> areas_;  // running sums
  Box box_;
  double size_ = 0.0, reach_ = 0.0;
};

glm::dvec3 randomDirection(PointMaker::Random& random);
/// Uniform in [lo, hi).
double uniform(PointMaker::Random& random, double lo, double hi);

}  // namespace sdf::accuracy
