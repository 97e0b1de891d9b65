#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

#include "reference.h"
#include "surface_mesh.h"

namespace sdf::accuracy {

std::vector<glm::ivec3> triangulated(std::span<const glm::dvec2> polygon) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  std::vector<CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index> corners;
  for (const glm::dvec2& p : polygon) corners.push_back(mesh.add_vertex({p.x, p.y, 0.0}));
  mesh.add_face(corners);
  if (!CGAL::Polygon_mesh_processing::triangulate_faces(mesh))
    throw std::invalid_argument("the outline is not a simple polygon");
  return fromSurfaceMesh(mesh).triangles;  // keeps the order of the vertices
}

}  // namespace sdf::accuracy
