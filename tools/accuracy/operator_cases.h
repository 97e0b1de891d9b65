// Every operator of the catalog beside the same operation on a mesh.
#pragma once
#include <string>
#include <vector>

#include "check.h"
#include "operator_surfaces.h"

namespace sdf::accuracy {

/// A shape and its solid's mesh, for cases to build on.
struct Solid {
  Shape shape;
  TriangleMesh mesh;
  double chord = 0.0;  ///< as in ReferenceCase
};

Solid solidBox(const glm::dvec3& half);
Solid solidTetrahedron(double radius);
Solid solidOctahedron(double radius);
Solid solidSphere(double radius);
/// An L-shaped column along z, its inner corner at (0.4, 0.4): a solid that is not convex and exact.
Solid solidL();
/// Turned about the axis, then moved.
Solid placed(const Solid& s, const glm::dvec3& axis, double angle, const glm::dvec3& offset);
Solid movedBy(const Solid& s, const glm::dvec3& offset);
/// A tetrahedron with no symmetry about any axis or plane of the coordinates, around the origin.
Solid lopsided(double radius);
/// A case of it; its corners are where formulas break, if they are few.
ReferenceCase caseOf(std::string name, const Solid& s);

/// Where solids touch, f is 0 on the seam: a film within what they make together, which is neither side. The
/// case, tried only where x is beyond the seam by a hair.
ReferenceCase beyondSeam(double x, ReferenceCase c);

/// What one catalog entry is held to. Cases are made when asked for, since their meshes are large.
struct OperatorCases {
  std::string entry;
  std::vector<ReferenceCase> (*make)();
};

/// In the catalog's order.
std::vector<OperatorCases> operatorCases();

// The parts of that list, one file each.
std::vector<OperatorCases> booleanCases();
std::vector<OperatorCases> formCases();
std::vector<OperatorCases> sweepAndWarpCases();
std::vector<OperatorCases> placeCases();
std::vector<OperatorCases> patternCases();

}  // namespace sdf::accuracy
