#include "triangle_soup.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <glm/geometric.hpp>

namespace sdf::accuracy {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

struct TriangleSoup::Tree {
  Triangles triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
};

TriangleSoup::TriangleSoup(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  for (const glm::ivec3& t : mesh.triangles)
    tree_->triangles.emplace_back(point(mesh.points[t.x]), point(mesh.points[t.y]), point(mesh.points[t.z]));
  tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.build();
  tree_->tree.accelerate_distance_queries();  // now, so that later calls from many threads only read
}
TriangleSoup::~TriangleSoup() = default;
TriangleSoup::TriangleSoup(TriangleSoup&&) noexcept = default;

TriangleSoup::Nearest TriangleSoup::nearest(const glm::dvec3& p) const {
  const auto [at, triangle] = tree_->tree.closest_point_and_primitive(point(p));
  return {{at.x(), at.y(), at.z()}, static_cast<std::size_t>(triangle - tree_->triangles.cbegin())};
}

double TriangleSoup::distance(const glm::dvec3& p) const { return glm::distance(p, nearest(p).point); }

}  // namespace sdf::accuracy
