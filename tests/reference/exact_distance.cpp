#include "exact_distance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cmath>

namespace sdf::accuracy {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

Triangles trianglesOf(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles) {
  Triangles result;
  for (const glm::uvec3& t : triangles)
    result.emplace_back(point(points[t.x]), point(points[t.y]), point(points[t.z]));
  return result;
}

}  // namespace

struct ExactDistance::Tree {
  explicit Tree(Triangles all) : triangles(std::move(all)), boxes(triangles.begin(), triangles.end()) {
    boxes.accelerate_distance_queries();
  }
  Triangles triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> boxes;
};

ExactDistance::ExactDistance(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles)
    : tree_(std::make_unique<Tree>(trianglesOf(points, triangles))) {}
ExactDistance::~ExactDistance() = default;
ExactDistance::ExactDistance(ExactDistance&&) noexcept = default;

// The interval around a lazy number may be wide; that of the exact one is an ulp.
double ExactDistance::operator()(const glm::dvec3& p) const {
  const Kernel::FT square = tree_->boxes.squared_distance(point(p));
  return std::sqrt(CGAL::to_double(square.exact()));
}

}  // namespace sdf::accuracy
