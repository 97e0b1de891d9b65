// Solids as meshes from their geometric definitions, each with a proven distance from the true surface.
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "accuracy/check.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {

/// A curve of lines and arcs as a polyline. An arc of radius r cut into steps of angle s lies within
/// r (1 - cos(s / 2)) of its chords, and they of it; `chord` is the largest of these.
struct Outline {
  std::vector<glm::dvec2> points;
  double chord = 0.0;
  std::vector<glm::dvec2> special{};  ///< ends of lines and arcs, and centres

  Outline& to(const glm::dvec2& p);
  /// Angles in radians from +x towards +y; `to` may be below `from`.
  Outline& arc(const glm::dvec2& centre, double radius, double from, double to, int steps);

 private:
  void add(const glm::dvec2& p);
};

using Triangle = std::array<glm::dvec3, 3>;
/// Triangles by their corners; equal corners become one vertex, triangles that lose a corner by that are left
/// out, and all are turned where the volume is negative.
TriangleMesh welded(std::span<const Triangle> triangles);
/// The surface through rows of equally many points, each row joined to the next; with `closed`, a row's last
/// point to its first. Not welded.
std::vector<Triangle> rowsJoined(std::span<const std::vector<glm::dvec3>> rows, bool closed);

/// Convex faces by the numbers of their corners.
Tessellation polyhedron(std::vector<glm::dvec3> points, std::span<const std::vector<int>> faces);
/// The cells of a grid that are solid. Cells may touch along faces only, not along an edge or corner alone.
Tessellation cells(const std::array<std::vector<double>, 3>& cuts,
                   const std::function<bool(const glm::ivec3&)>& solid);

/// About the origin, with `around` (even) steps to a circle.
Tessellation ellipsoidSurface(const glm::dvec3& radii, int around);
/// A solid of revolution by its profile (x = distance from the axis, y along it), as ReferenceCase has it:
/// either closed, or from the axis to the axis.
Tessellation turned(const Outline& profile, const Axis& axis = {});
/// A closed simple outline, extruded along z; region keeps off the ends.
Tessellation extruded(const Outline& outline);
/// The band between two outlines of equally many points, one in the other, extruded likewise.
Tessellation extrudedBand(const Outline& outer, const Outline& inner);
/// A closed simple outline along another axis, from -half to half: `turn` gives the place of (x, y, along).
Tessellation prism(const Outline& outline, double half,
                   const std::function<glm::dvec3(const glm::dvec3&)>& turn);

/// Box from -half to half with edges and corners of this radius, `steps` to a quarter circle.
Tessellation roundedBox(const glm::dvec3& half, double radius, int steps);
/// All points within `minor` of the arc of radius `major` about the y axis, `angle` (radians) to both sides
/// of +z; only the outer boundary where it overlaps itself. `steps` to the circle of the tube, `along` to the
/// half circle of the arc.
Tessellation bentTube(double angle, double major, double minor, int steps, int along);
/// All points within `minor` of two half circles 2 * halfLength apart along y and the lines that join them.
Tessellation chainLink(double halfLength, double major, double minor, int steps, int along);
/// All points within `wire` of the helix (major cos t, pitch t / 2 pi, -hand major sin t), |t| <= pi turns,
/// where it does not run into itself. `steps` to the circle of the tube, `aTurn` to one of the helix.
Tessellation helicalTube(double major, double pitch, double turns, double wire, double hand, int steps,
                         int aTurn);
/// An endless rod about the y axis with a metric thread, its surface moved out by the clearance; region keeps
/// off the ends.
Tessellation helicalThread(double diameter, double pitch, int starts, double clearance, double hand,
                           int steps);
/// Half-space dot(p, normal) <= offset within a cube of some hundred units.
Tessellation halfSpace(const glm::dvec3& normal, double offset);

// The flat shapes' outlines from their definitions; angles in radians.

Outline circleOutline(double radius);
Outline ellipseOutline(double radiusX, double radiusY);
/// Its half x >= 0.
Outline halfEllipseOutline(double radiusX, double radiusY);
/// Rectangle with these half sizes, its corners rounded with this radius, which may be 0.
Outline rectangleOutline(double halfWidth, double halfHeight, double radius);
/// All points within `radius` of the segment.
Outline segmentOutline(const glm::dvec2& from, const glm::dvec2& to, double radius);
/// Corners at `outer` from the origin, one on +y; with `inner` > 0 as many at that distance between them.
Outline starOutline(int points, double outer, double inner = 0.0);
Outline polygonOutline(std::span<const glm::dvec2> points);
/// All points within `half` of the arc of this radius, `angle` to both sides of +y; only the outer boundary
/// where the band overlaps itself.
Tessellation bentBand(double angle, double radius, double half);

/// A wave of period 2 pi along each axis.
struct Wave {
  double (*value)(const glm::dvec3&);
  double steepest;   ///< its largest slope
  double curvature;  ///< bound of its Hessian's largest eigenvalue
};
/// The wall |wave| <= level with level = thickness / 2 * frequency * steepest, around the origin.
Tessellation wall(const Wave& wave, double cell, double thickness, int cellsAPeriod);
/// The solid wave <= level, around the origin. Of one whose curvature is infinite the chord is what a cell is
/// wide.
Tessellation filled(const Wave& wave, double cell, double level, int cellsAPeriod);
/// All points within `radius` of the struts of such a grid, by their list.
Tessellation strutsMesh(Struts kind, double cell, double radius, int cellsAPeriod);

}  // namespace sdf::accuracy
