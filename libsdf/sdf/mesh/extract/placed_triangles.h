// The triangles of meshes from files, and of extruded polygons, that are nothing but moved.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/eval/function.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// Triangles, and where their vertices are before they are rounded to floats. A point of a triangle is as far
/// from its place as the farthest of the corners, at most.
struct PlacedTriangles {
  FeatureMesh mesh;
  std::vector<glm::dvec3> places;  ///< by vertex
  double offBy = 0.0;              ///< how far triangles between places on the surface may be off it
};

/// The surface of a shape that is a mesh from a file, only moved, turned and scaled: its triangles, at their
/// places for these values of inputs. Creases are the edges where two of them meet at more than 30 degrees.
/// Where triangles touch, edges may have more of them. Or that of an extruded polygon of many sides
/// (polygon_prism.h), or of an outline: its sides, curves as chords within `tolerance`, and its lids cut into
/// triangles; creases are its rims, and its edges where sides meet at more than 5 degrees. Nothing where the
/// shape is something else, or its triangles cross one another. Cost: n log n.
std::optional<PlacedTriangles> placedTriangles(const Shape& shape, const Values& values, double tolerance);

}  // namespace sdf
