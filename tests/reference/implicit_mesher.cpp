#include "implicit_mesher.h"

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <stdexcept>

#include "surface_mesh.h"

namespace sdf::accuracy {

TriangleMesh meshByCgal(const ImplicitMesh& asked) {
  using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
  using Traits = Triangulation::Geom_traits;
  using Function = std::function<double(const Traits::Point_3&)>;
  struct Stopped {};
  const Function value = [&](const Traits::Point_3& p) {
    if (asked.stopped()) throw Stopped();
    return asked.value({p.x(), p.y(), p.z()});
  };
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const Traits::Point_3 middle(asked.inside.x, asked.inside.y, asked.inside.z);
  const double radius = 1.1 * asked.radius;  // the sphere must not touch the surface
  const CGAL::Implicit_surface_3<Traits, Function> surface(value, Traits::Sphere_3(middle, radius * radius),
                                                           1e-7);
  constexpr double kLeastAngle = 30.0;  // degrees; CGAL proves that it ends up to there
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(kLeastAngle, asked.facetSize,
                                                                      asked.facetDistance);
  try {
    CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag());
  } catch (const Stopped&) {
    throw std::runtime_error("stopped: it took too long");
  }
  CGAL::Surface_mesh<Traits::Point_3> mesh;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
  if (mesh.is_empty()) throw std::runtime_error("no surface was found");
  return fromSurfaceMesh(mesh);
}

}  // namespace sdf::accuracy
