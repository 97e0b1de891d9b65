// Every operator of the catalog beside the same operation on a mesh.
#pragma once
#include <string>
#include <vector>

#include "accuracy/rows.h"
#include "operator_meshes.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {

/// A shape and its solid's mesh, for cases to build on.
struct Solid {
  Shape shape;
  TriangleMesh mesh;
  double chord = 0.0;  ///< as in Tessellation
};

Solid solidBox(const glm::dvec3& half);
Solid solidTetrahedron(double radius);
Solid solidOctahedron(double radius);
Solid solidSphere(double radius);
/// An L, its inner corner at (0.4, 0.4).
inline const std::vector<glm::dvec2> kL{{-0.3, -0.4}, {1, -0.4},  {1, 0.4},
                                        {0.4, 0.4},   {0.4, 1.1}, {-0.3, 1.1}};
/// A column of it along z: a solid that is not convex and exact.
Solid solidL();
/// The first without the second: a bound only.
Solid operator-(const Solid& a, const Solid& b);
/// Turned about the axis, then moved.
Solid placed(const Solid& s, const glm::dvec3& axis, double angle, const glm::dvec3& offset);
Solid movedBy(const Solid& s, const glm::dvec3& offset);
/// A tetrahedron with no symmetry about any axis or plane of the coordinates, around the origin.
Solid lopsided(double radius);
/// A case of it; its corners are where formulas break, if they are few.
ReferenceCase caseOf(std::string name, const Solid& s);
ReferenceCase caseOf(std::string name, const Shape& shape, const Tessellation& t);

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
/// Makes the cases and checks them, as rowOf does.
Row operatorRow(const OperatorCases& cases, std::uint64_t fraction = 1);

/// How tests name it.
inline void PrintTo(const OperatorCases& c, std::ostream* out) { *out << c.entry; }

// The parts of that list, one file each.
std::vector<OperatorCases> booleanCases();
std::vector<OperatorCases> formCases();
std::vector<OperatorCases> sweepAndWarpCases();
std::vector<OperatorCases> placeCases();
std::vector<OperatorCases> patternCases();

}  // namespace sdf::accuracy
