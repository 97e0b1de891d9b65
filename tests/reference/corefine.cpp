#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

#include "reference.h"
#include "surface_mesh.h"

namespace sdf::accuracy {

TriangleMesh corefine(const TriangleMesh& a, const TriangleMesh& b, Boolean which) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using SurfaceMesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
  SurfaceMesh first = toSurfaceMesh<SurfaceMesh>(a), second = toSurfaceMesh<SurfaceMesh>(b), result;
  const bool manifold = which == Boolean::Union ? pmp::corefine_and_compute_union(first, second, result)
                        : which == Boolean::Intersection
                            ? pmp::corefine_and_compute_intersection(first, second, result)
                            : pmp::corefine_and_compute_difference(first, second, result);
  if (!manifold) throw std::runtime_error("the boolean is not a closed manifold");
  result.collect_garbage();
  return fromSurfaceMesh(result);
}

}  // namespace sdf::accuracy
