// Distances to triangles in exact arithmetic.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace sdf::accuracy {

/// Any triangles with an area, by a tree of CGAL's.
class ExactDistance {
 public:
  ExactDistance(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles);
  ~ExactDistance();
  ExactDistance(ExactDistance&&) noexcept;

  /// The distance from p, not signed: the root of the exact square, which is rounded once before. Not to be
  /// called from several threads. Cost: some hundred microseconds.
  double operator()(const glm::dvec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sdf::accuracy
