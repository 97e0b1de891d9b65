// Moving the vertices of a mesh off its surface, so that its triangles err to both sides.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// Moves the vertices of a closed mesh, which lie on its surface, along their normals so that the mean square
/// distance of the triangles to the surface becomes small: between vertices on the surface all of a triangle
/// lies on the side to which the surface bends. The distance in a triangle is the parabola that the normals
/// at its vertices tell of, and the moves are the least squares' with a lumped mass matrix; on a regular mesh
/// the root mean square becomes a quarter. Vertices on a crease move with its polyline, towards where it
/// bends from. Where normals turn by more than 40 degrees along an edge nothing is known of the distance, and
/// moves are cut short where they could tilt a triangle by more than 20 degrees. `normals` are unit gradients
/// at the vertices; zero on creases, and where there is none.
void balanceVertices(FeatureMesh& mesh, const std::vector<glm::vec3>& normals);

}  // namespace sdf
