#include "sdf/shape/entries.h"
#include "sdf/shape/solids.h"

namespace sdf {

namespace {

using namespace parameter;  // NOLINT: the entries below read as a table

Parameter size(const char* name, const char* doc, const char* fallback) {
  return number(name, doc, Rule::Positive, fallback);
}
Parameter halfHeight(const char* fallback) {
  return size("half_height", "from the centre to the top and to the bottom", fallback);
}
Parameter halfBox() {
  return vector3("half", "half sizes along x, y and z: it reaches from -half to half", Rule::Positive,
                 "{1, 1, 1}");
}
Parameter toCorner(const char* fallback) { return size("radius", "from the centre to a corner", fallback); }

std::vector<CatalogEntry> roundEntries() {
  const Group g = Group::Solid;
  const Parameter major = size("major", "from the centre to the middle of the tube", "1");
  const Parameter minor = size("minor", "radius of the tube", "0.25");
  const Parameter radii = vector3("radii", "along x, y and z", Rule::Positive, "{1, 0.6, 0.4}");
  const std::string tube = "exact; exact outside where the tube runs into itself";
  return {
      {"sphere",
       g,
       "Ball about the origin.",
       "exact",
       {size("radius", "of the ball", "1")},
       [](const Arguments& a) { return sphere(a.number(0)); }},
      {"ellipsoid",
       g,
       "Ellipsoid about the origin.",
       "exact to 5e-7 of the largest radius, for radii in ratios up to 100",
       {radii},
       [](const Arguments& a) { return ellipsoid(a.vector(0)); }},
      {"ellipsoid_bound",
       g,
       "Ellipsoid about the origin by the cheapest formula, for where speed counts more than the distance.",
       "bound, L = 1",
       {radii},
       [](const Arguments& a) { return ellipsoidBound(a.vector(0)); }},
      {"torus",
       g,
       "Ring about the y axis.",
       "exact; exact outside where minor > major",
       {major, minor},
       [](const Arguments& a) { return torus(a.number(0), a.number(1)); }},
      {"capped_torus",
       g,
       "Part of a ring about the y axis, centred on +z, with round ends.",
       tube,
       {size("angle", "degrees to either side of +z, at most 180", "120"), major, minor},
       [](const Arguments& a) { return cappedTorus(radians(a.number(0)), a.number(1), a.number(2)); }},
      {"link",
       g,
       "Chain link in the xy plane, longer along y.",
       tube,
       {number("half_length", "half the length of the straight sides", Rule::NotNegative, "0.5"),
        size("major", "from the middle of a half ring to the middle of the tube", "0.5"),
        size("minor", "radius of the tube", "0.15")},
       [](const Arguments& a) { return link(a.number(0), a.number(1), a.number(2)); }},
      {"capsule",
       g,
       "All points within a radius of a segment.",
       "exact",
       {vector3("from", "one end of the segment", Rule::Any, "{0, -0.5, 0}"),
        vector3("to", "the other end", Rule::Any, "{0, 0.5, 0}"),
        size("radius", "around the segment", "0.5")},
       [](const Arguments& a) { return capsule(a.vector(0), a.vector(1), a.number(2)); }},
      {"solid_angle",
       g,
       "Part of a ball around the +y axis, its tip at the origin.",
       "exact",
       {size("angle", "degrees from the axis to the side, below 180", "30"),
        size("radius", "of the ball", "1")},
       [](const Arguments& a) { return solidAngle(radians(a.number(0)), a.number(1)); }},
      {"cut_sphere",
       g,
       "Part of a ball above a plane.",
       "exact",
       {size("radius", "of the ball", "1"),
        number("height", "of the plane, between -radius and radius", Rule::Any, "0")},
       [](const Arguments& a) { return cutSphere(a.number(0), a.number(1)); }},
  };
}

std::vector<CatalogEntry> boxEntries() {
  const Group g = Group::Solid;
  return {
      {"box",
       g,
       "Box about the origin.",
       "exact",
       {halfBox()},
       [](const Arguments& a) { return box(a.vector(0)); }},
      {"round_box",
       g,
       "Box about the origin with rounded edges; the rounding stays within its size.",
       "exact",
       {halfBox(),
        number("radius", "of the edges, at most the smallest half size", Rule::NotNegative, "0.1")},
       [](const Arguments& a) { return roundBox(a.vector(0), a.number(1)); }},
      {"box_frame",
       g,
       "The edges of a box about the origin, as square beams inside it.",
       "exact outside",
       {halfBox(), size("thickness", "of the beams, at most the smallest half size", "0.1")},
       [](const Arguments& a) { return boxFrame(a.vector(0), a.number(1)); }},
      {"plane",
       g,
       "All points on the side of a plane that the normal points away from.",
       "exact",
       {vector3("normal", "away from the solid, any length but 0", Rule::Any, "{0, 1, 0}"),
        number("offset", "distance of the plane from the origin, along the normal", Rule::Any, "0")},
       [](const Arguments& a) { return plane(a.vector(0), a.number(1)); }},
      {"octahedron",
       g,
       "Regular octahedron about the origin, corners on the axes.",
       "exact",
       {toCorner("1")},
       [](const Arguments& a) { return octahedron(a.number(0)); }},
      {"tetrahedron",
       g,
       "Regular tetrahedron about the origin, corners towards (1, 1, 1) and (1, -1, -1) and so on.",
       "exact",
       {toCorner("1")},
       [](const Arguments& a) { return tetrahedron(a.number(0)); }},
      {"pyramid",
       g,
       "Pyramid along y over a square with sides along x and z.",
       "exact",
       {size("half_width", "half the side of the square", "1"), halfHeight("1")},
       [](const Arguments& a) { return pyramid(a.number(0), a.number(1)); }},
  };
}

std::vector<CatalogEntry> columnEntries() {
  const Group g = Group::Solid;
  return {
      {"cylinder",
       g,
       "Cylinder along y about the origin.",
       "exact",
       {size("radius", "of the cylinder", "1"), halfHeight("1")},
       [](const Arguments& a) { return cylinder(a.number(0), a.number(1)); }},
      {"infinite_cylinder",
       g,
       "Endless cylinder along y.",
       "exact",
       {size("radius", "of the cylinder", "1")},
       [](const Arguments& a) { return infiniteCylinder(a.number(0)); }},
      {"cone",
       g,
       "Cone along y, its tip at the top.",
       "exact",
       {size("radius", "of the base", "1"), halfHeight("1")},
       [](const Arguments& a) { return cone(a.number(0), a.number(1)); }},
      {"capped_cone",
       g,
       "Cone along y with its tip cut off.",
       "exact",
       {number("radius_bottom", "at y = -half_height", Rule::NotNegative, "1"),
        number("radius_top", "at y = half_height", Rule::NotNegative, "0.5"), halfHeight("1")},
       [](const Arguments& a) { return cappedCone(a.number(0), a.number(1), a.number(2)); }},
      {"round_cone",
       g,
       "Hull of two balls on the y axis.",
       "exact",
       {size("radius_bottom", "of the ball at y = -half_height", "0.5"),
        size("radius_top", "of the ball at y = half_height", "0.25"),
        size("half_height", "half the distance of the balls' centres", "0.5")},
       [](const Arguments& a) { return roundCone(a.number(0), a.number(1), a.number(2)); }},
      {"hex_prism",
       g,
       "Hexagonal column along y, a corner on +z.",
       "exact",
       {size("radius", "from the axis to a corner", "1"), halfHeight("0.5")},
       [](const Arguments& a) { return hexPrism(a.number(0), a.number(1)); }},
      {"tri_prism",
       g,
       "Triangular column along y, a corner on +z.",
       "exact",
       {size("radius", "from the axis to a corner", "1"), halfHeight("0.5")},
       [](const Arguments& a) { return triPrism(a.number(0), a.number(1)); }},
  };
}

std::vector<CatalogEntry> latticeEntries() {
  const Group g = Group::Solid;
  const Parameter cell = size("cell", "period along each axis", "1");
  const auto thickness = [](const char* doc) { return size("thickness", doc, "0.1"); };
  return {
      {"gyroid",
       g,
       "Walls along the gyroid, an endless labyrinth; intersect it with a solid.",
       "bound, L = 1",
       {cell, thickness("of the walls where thinnest, below 0.2756 cell")},
       [](const Arguments& a) { return gyroid(a.number(0), a.number(1)); }},
      {"schwarz_p",
       g,
       "Walls along Schwarz' P surface, endless cubic plumbing.",
       "bound, L = 1",
       {cell, thickness("of the walls where thinnest, below 0.5513 cell")},
       [](const Arguments& a) { return schwarzP(a.number(0), a.number(1)); }},
      {"schwarz_d",
       g,
       "Walls along Schwarz' D surface, endless diamond plumbing.",
       "bound, L = 1",
       {cell, thickness("of the walls where thinnest, below 0.2598 cell")},
       [](const Arguments& a) { return schwarzD(a.number(0), a.number(1)); }},
  };
}

}  // namespace

std::vector<CatalogEntry> solidEntries() {
  std::vector<CatalogEntry> all;
  for (auto some : {roundEntries(), boxEntries(), columnEntries(), latticeEntries()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace sdf
