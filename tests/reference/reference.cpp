#include "reference.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <stdexcept>

#include "surface_mesh.h"

namespace sdf::accuracy {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
// Triangles kept beside the mesh: fetching their corners from it took up to half of a query.
using Primitive =
    CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh, CGAL::Default, CGAL::Tag_true, CGAL::Tag_true>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel, CGAL::Default, Tree>;

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

struct Reference::Trees {
  explicit Trees(const TriangleMesh& source)
      : mesh(toSurfaceMesh<SurfaceMesh>(source)),
        tree(faces(mesh).first, faces(mesh).second, mesh),
        side(tree) {
    tree.build();
    tree.accelerate_distance_queries();
    side(point(
        source.points[0]));  // builds what it needs now, so that later calls from many threads only read
  }
  SurfaceMesh mesh;
  Tree tree;
  Side side;
};

Reference::Reference(const TriangleMesh& mesh) : trees_(std::make_unique<Trees>(mesh)) {}
Reference::~Reference() = default;
Reference::Reference(Reference&&) noexcept = default;

double Reference::distance(const glm::dvec3& p) const {
  return std::sqrt(trees_->tree.squared_distance(point(p)));
}

int Reference::side(const glm::dvec3& p) const {
  switch (trees_->side(point(p))) {
    case CGAL::ON_BOUNDED_SIDE:
      return -1;
    case CGAL::ON_UNBOUNDED_SIDE:
      return 1;
    default:
      return 0;
  }
}

}  // namespace sdf::accuracy
