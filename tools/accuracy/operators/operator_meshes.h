// What operators are held to: meshes changed vertex by vertex, never through a distance formula, and curved
// surfaces.
#pragma once
#include <functional>
#include <glm/mat3x3.hpp>
#include <vector>

#include "accuracy/solids/meshes.h"

namespace sdf::accuracy {

TriangleMesh boxMesh(const glm::dvec3& half);
/// Corners on the axes at this radius.
TriangleMesh octahedronMesh(double radius);
/// Corners at this radius, as sdf::tetrahedron has them.
TriangleMesh tetrahedronMesh(double radius);
/// The outline (counter-clockwise, all of it in sight of `middle`) swept along z by halfHeight both ways.
TriangleMesh prismMesh(const std::vector<glm::dvec2>& outline, const glm::dvec2& middle, double halfHeight);
/// Inscribed in the sphere: an octahedron of 8 * 4^times triangles.
TriangleMesh sphereMesh(double radius, int times);

/// The rotation by `angle` (radians, right-hand rule) about `axis`.
glm::dmat3 turn(const glm::dvec3& axis, double angle);

using PointMap = std::function<glm::dvec3(const glm::dvec3&)>;
/// What twist, bend and taper do to a point, by their definitions; radians.
PointMap twistMap(double rate);
PointMap bendMap(double k);
PointMap taperMap(double rate);
/// Each vertex moved; `reflects`: the map turns space inside out.
TriangleMesh mapped(TriangleMesh mesh, const PointMap& map, bool reflects = false);
TriangleMesh moved(const TriangleMesh& mesh, const glm::dvec3& by);
TriangleMesh turned(const TriangleMesh& mesh, const glm::dmat3& by);
/// The same surface seen from the other side: a cavity.
TriangleMesh flipped(TriangleMesh mesh);
/// The meshes side by side as one. Their insides must be apart, or each a cavity in the one before.
TriangleMesh together(const std::vector<TriangleMesh>& parts);
/// What is in any of the meshes, which may overlap.
TriangleMesh united(const std::vector<TriangleMesh>& parts);
/// Each triangle cut into four, `times` times over.
TriangleMesh refined(TriangleMesh mesh, int times);
double longestEdge(const TriangleMesh& mesh);

/// Cut where the coordinate on this axis is 0, the halves moved apart by `half` each, the gap walled along
/// the cut.
TriangleMesh pulledApart(const TriangleMesh& mesh, int axis, double half);
TriangleMesh pulledApart(const TriangleMesh& mesh, const glm::dvec3& half);

// Curved surfaces as meshes, each with a proven bound on its distance to the surface.

/// The sphere about the origin.
Tessellation sphereSurface(double radius, int times);

/// The flat outline (x >= 0, counter-clockwise) swept around the y axis in this many steps; points at x = 0
/// become one.
Tessellation revolved(const std::vector<glm::dvec2>& outline, int steps);
/// `angle` radians of that turn, half of it to either side of +x, of an outline at x > 0 that is seen whole
/// from `middle`.
Tessellation partlyRevolved(const std::vector<glm::dvec2>& outline, const glm::dvec2& middle, double angle,
                            int steps);

/// A mesh of flat faces, refined and mapped. `bending` bounds the map's second derivative along any unit
/// direction over the mesh.
Tessellation warped(const TriangleMesh& flatFaces, int times, const PointMap& map, double bending);

/// A surface g = 0 that is seen whole from the origin.
struct Star {
  std::function<double(const glm::dvec3&)> g;  ///< grows along every ray where it is 0
  double nearest = 0.0, farthest = 0.0;        ///< the surface's radii lie between
  double bending = 0.0;  ///< bounds g's second derivative along any unit direction, within each piece
  /// Which smooth piece of g a point belongs to; absent: g is smooth.
  std::function<int(const glm::dvec3&)> piece{};
};
/// A smooth star.
Tessellation tessellated(const Star& star, int times);
/// A star that is its own image under turns about the y axis: its outline in 384 steps, turned in 128.
Tessellation tessellatedAboutY(const Star& star);

}  // namespace sdf::accuracy
