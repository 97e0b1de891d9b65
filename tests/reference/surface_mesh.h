// TriangleMesh to and from CGAL's Surface_mesh.
#pragma once
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>

#include <stdexcept>

#include "reference.h"

namespace sdf::accuracy {

/// Throws std::invalid_argument where the mesh is not closed or not a manifold.
template <class SurfaceMesh>
SurfaceMesh toSurfaceMesh(const TriangleMesh& mesh) {
  SurfaceMesh result;
  std::vector<typename SurfaceMesh::Vertex_index> vertices;
  for (const glm::dvec3& p : mesh.points) vertices.push_back(result.add_vertex({p.x, p.y, p.z}));
  for (const glm::ivec3& t : mesh.triangles) {
    if (result.add_face(vertices[t.x], vertices[t.y], vertices[t.z]) == SurfaceMesh::null_face())
      throw std::invalid_argument("the mesh is not a manifold");
  }
  if (!CGAL::is_closed(result)) throw std::invalid_argument("the mesh is not closed");
  return result;
}

/// The mesh must have no vertices that were removed and not collected.
template <class SurfaceMesh>
TriangleMesh fromSurfaceMesh(const SurfaceMesh& mesh) {
  TriangleMesh result;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : mesh.faces()) {
    glm::ivec3 triangle;
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      triangle[corner++] = static_cast<int>(v.idx());
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace sdf::accuracy
