// Solids. Each is centred at the origin unless it says otherwise, with its axis along y.
//
// Sizes may be expressions of parameters (not of position); lengths are in scene units, angles in radians. An
// argument that is not finite, depends on position or breaks a rule stated here gives a failed shape whose
// error says so. Rules are checked on the parameters' present values; the claims hold over all of their
// ranges, a size being held above 1e-6 where its range would let it vanish. Bounds cover every value in the
// ranges. Sizes from 1e-30 to 1e30 keep their claims; the float readings square coordinates, so they lose
// what is below 1e-19 and overflow beyond 1e19.
//
// "Exact" means exact as real numbers; L is 1 unless stated. Many of the distances follow Quilez, "Distance
// functions" (iquilezles.org); where ours differ, the source file says why.
#pragma once
#include "sdf/shape/shape.h"

namespace sdf {

/// Ball. radius > 0. Exact.
Shape sphere(const Expr& radius);
/// Box that reaches from -half to half. half > 0 in each component. Exact.
Shape box(const Vec3E& half);
/// Box that reaches from -half to half, edges and corners rounded. half > 0; 0 <= radius <= the smallest half
/// size. Exact.
Shape roundBox(const Vec3E& half, const Expr& radius);
/// The twelve edges of the box from -half to half, as square beams of this thickness inside it.
/// 0 < thickness <= the smallest half size (where the beams meet and leave no opening). Exact outside.
Shape boxFrame(const Vec3E& half, const Expr& thickness);
/// Ring about the y axis; major: from the centre to the middle of the tube, minor: radius of the tube. Both
/// > 0. Exact; exact outside where minor > major (then there is no hole, and the tube overlaps itself).
Shape torus(const Expr& major, const Expr& minor);
/// Part of the torus within `angle` to both sides of the z axis, with round ends. 0 < angle <= pi. Exact;
/// exact outside where the tube runs into itself.
Shape cappedTorus(const Expr& angle, const Expr& major, const Expr& minor);
/// Chain link in the xy plane: two half rings, 2 * halfLength apart along y, joined by straight tubes. Sizes
/// > 0, halfLength >= 0. Exact; exact outside where minor > major.
Shape link(const Expr& halfLength, const Expr& major, const Expr& minor);
/// Cylinder from y = -halfHeight to halfHeight. Both > 0. Exact.
Shape cylinder(const Expr& radius, const Expr& halfHeight);
/// Endless cylinder about the y axis. radius > 0. Exact.
Shape infiniteCylinder(const Expr& radius);
/// All points within `radius` > 0 of the segment between two points, which may coincide. Exact.
Shape capsule(const Vec3E& from, const Vec3E& to, const Expr& radius);
/// Cone with its base at y = -halfHeight and its tip at y = halfHeight. Both > 0. Exact.
Shape cone(const Expr& radius, const Expr& halfHeight);
/// Cone cut off: radii at y = -halfHeight and halfHeight. Radii >= 0, not both 0; halfHeight > 0. Exact.
Shape cappedCone(const Expr& radiusBottom, const Expr& radiusTop, const Expr& halfHeight);
/// Hull of two balls at y = -halfHeight and halfHeight. Radii > 0; they differ by less than 2 * halfHeight,
/// for else one ball holds the other. Exact.
Shape roundCone(const Expr& radiusBottom, const Expr& radiusTop, const Expr& halfHeight);
/// Half-space of the points with dot(p, n) <= offset, n being the normal made to length 1. normal != 0.
/// Exact.
Shape plane(const Vec3E& normal, const Expr& offset);
/// Ellipsoid with these radii along x, y and z, all > 0. Exact: an iteration unrolled in the expression, off
/// by at most 5e-7 largest radii for radii in ratios up to 100. Some 200 operations; some 120 where two radii
/// are the same expression.
Shape ellipsoid(const Vec3E& radii);
/// Ellipsoid by the cheapest formula. A bound: at the end of the longest axis it gives smallest / largest
/// radius of the distance.
Shape ellipsoidBound(const Vec3E& radii);
/// Hexagonal column, a corner on +z; radius from the axis to a corner. Both > 0. Exact.
Shape hexPrism(const Expr& radius, const Expr& halfHeight);
/// Triangular column, a corner on +z; radius from the axis to a corner. Both > 0. Exact.
Shape triPrism(const Expr& radius, const Expr& halfHeight);
/// Regular octahedron, corners on the axes at `radius` > 0. Exact.
Shape octahedron(const Expr& radius);
/// Regular tetrahedron, corners at `radius` > 0 from the centre in the directions (1, 1, 1), (1, -1, -1),
/// (-1, 1, -1), (-1, -1, 1). Exact.
Shape tetrahedron(const Expr& radius);
/// Pyramid over the square |x|, |z| <= halfWidth at y = -halfHeight, with its tip at y = halfHeight. Both >
/// 0. Exact.
Shape pyramid(const Expr& halfWidth, const Expr& halfHeight);
/// Part of the ball of this radius within `angle` of the +y axis, a tip at the origin. 0 < angle < pi, radius
/// > 0. Exact.
Shape solidAngle(const Expr& angle, const Expr& radius);
/// Part of the ball of this radius with y >= height. -radius < height < radius. Exact.
Shape cutSphere(const Expr& radius, const Expr& height);

/// Which way a helix about the y axis turns: a right-handed one rises counter-clockwise, seen from above.
enum class Hand { Right, Left };
/// Wire of radius `wire` along a helix about the y axis with round ends: `radius` from the axis to the wire's
/// middle, `turns` turns, each rising by `pitch`, centred, with its middle on +x. All > 0. Exact to 1e-6 of
/// radius and pitch (the nearest point of a helix by Halley's iteration, unrolled), some 200 operations;
/// exact outside where the wire runs into itself.
Shape spring(const Expr& radius, const Expr& pitch, const Expr& turns, const Expr& wire,
             Hand hand = Hand::Right);
/// Rod along y of this length with a metric thread (ISO 68-1: flanks at 60 degrees, crests an eighth and
/// roots a quarter of the pitch wide) and ends chamfered at 45 degrees to the root. `diameter` is the outer
/// one, `pitch` from turn to turn, of which `starts` run side by side. `clearance` moves the thread's surface
/// out, for a hole that the same thread turns in, or in where it is negative. diameter, pitch, length > 0;
/// pitch < 0.92 diameter; starts >= 1. Bound.
Shape thread(const Expr& diameter, const Expr& pitch, const Expr& length, int starts = 1,
             const Expr& clearance = 0.0, Hand hand = Hand::Right);

/// Endless grids: lines between the nearest of cubes' corners and their faces' middles; the edges of cubes;
/// lines from cubes' corners to their middles; the edges of truncated octahedra about cubes' corners and
/// middles (Thomson 1887).
enum class Struts { Octet, Cubic, BodyCentred, Kelvin };
/// Round struts along such a grid; `cell` is the cubes' side, a corner at the origin. Both > 0. Exact
/// outside.
Shape strutLattice(Struts kind, const Expr& cell, const Expr& radius);

/// Schoen's gyroid as a wall, |sin x cos y + sin y cos z + sin z cos x| small; endless, `cell` is its period
/// along each axis. Thin walls are between 1 and 1.23 times `thickness` thick. Both > 0, thickness < 0.2756
/// cell (beyond that all space is solid). Bound.
Shape gyroid(const Expr& cell, const Expr& thickness);
/// Schwarz' P surface as a wall, |cos x + cos y + cos z| small. Thin walls are between 1 and 1.74 times
/// `thickness` thick; thickness < 0.5513 cell. Else like gyroid.
Shape schwarzP(const Expr& cell, const Expr& thickness);
/// Schwarz' D surface as a wall, |cos x cos y cos z - sin x sin y sin z| small. Thin walls are between
/// 1 and 1.23 times `thickness` thick; thickness < 0.2598 cell. Else like gyroid.
Shape schwarzD(const Expr& cell, const Expr& thickness);
/// Schoen's I-WP surface as a wall, |2 (cos x cos y + cos y cos z + cos z cos x) - cos 2x - cos 2y - cos 2z|
/// small. Thin walls are between 1 and 1.54 times `thickness` thick; thickness < 0.3063 cell. Else like
/// gyroid.
Shape iwp(const Expr& cell, const Expr& thickness);
/// Neovius' surface as a wall, |3 (cos x + cos y + cos z) + 4 cos x cos y cos z| small. Thin walls are
/// between 1 and 7 times `thickness` thick; thickness < 0.5911 cell. Else like gyroid.
Shape neovius(const Expr& cell, const Expr& thickness);
/// The lidinoid (Lidin, Larsson 1990) as a wall, where sin 2x cos y sin z + sin 2y cos z sin x +
/// sin 2z cos x sin y is near cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x - 0.3. Thin walls are between 1
/// and 5.29 times `thickness` thick; thickness < 0.1654 cell. Else like gyroid.
Shape lidinoid(const Expr& cell, const Expr& thickness);
/// Fischer and Koch's S surface as a wall, |cos 2x sin y cos z + cos x cos 2y sin z + sin x cos y cos 2z|
/// small. Thin walls are between 1 and 2.03 times `thickness` thick; thickness < 0.1841 cell. Else like
/// gyroid.
Shape fischerKochS(const Expr& cell, const Expr& thickness);

/// Any formula of position() and parameters as a shape: solid where distance <= 0. Claimed a field: only the
/// zero set and the sign count. `bounds`, where given, must contain the solid; `lipschitz`, where given, is
/// trusted as a bound on the formula's gradient within the bounds, otherwise what the graph proves is used.
/// Where that is nothing but the bounds are finite, the distance is the formula's only as far as half their
/// longest side beyond them; its slope is bounded by intervals over cells of that box, and further out it is
/// at least the way there. A formula that is steeper around its bounds than it is said to be is no more there
/// than the way to the bounds, or than its value at their nearest point, allows. lipschitz > 0.
Shape field(const Expr& distance, const Box& bounds = Box::everything(), double lipschitz = kInfinity);

struct SteepPlace {
  glm::dvec3 at;
  double slope;
};
/// Where a formula is the steepest of 125 points within finite bounds, if it is steeper there than the
/// lipschitz that is stated of it, whatever the values of its parameters.
std::optional<SteepPlace> steeperThan(const Expr& formula, const Box& bounds, double lipschitz);

}  // namespace sdf
