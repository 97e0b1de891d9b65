#include "sdf/shape/solids/solids.h"
#include "sdf/shape/catalog/entries.h"

namespace sdf {

std::vector<CatalogEntry> solidEntries() {
  using namespace parameter;
  const Parameter half = vector3("half", "half sizes along x, y and z: it reaches from -half to half",
                                 Rule::Positive, "{1, 1, 1}");
  const Parameter ball = size("radius", "of the ball", "1"), column = size("radius", "of the cylinder", "1");
  const Parameter corner = size("radius", "from the centre to a corner", "1");
  const Parameter side = size("radius", "from the axis to a corner", "1");
  const Parameter radii = vector3("radii", "along x, y and z", Rule::Positive, "{1, 0.6, 0.4}");
  const Parameter major = size("major", "from the centre to the middle of the tube", "1");
  const Parameter minor = size("minor", "radius of the tube", "0.25");
  const Parameter cell = size("cell", "period along each axis", "1");
  const Parameter hand = choice("hand", "which way it turns: right is a common screw's", {"right", "left"});
  const std::string tube = "exact; exact outside where the tube runs into itself";
  return {
      entry("sphere", "Ball about the origin.", "exact", {ball}, sphere),
      entry("ellipsoid", "Ellipsoid about the origin.",
            "exact to 5e-7 of the largest radius, for radii in ratios up to 100", {radii}, ellipsoid),
      entry("ellipsoid_bound",
            "Ellipsoid about the origin by the cheapest formula, for where speed counts more than the "
            "distance.",
            "bound, L = 1", {radii}, ellipsoidBound),
      entry("torus", "Ring about the y axis.", "exact; exact outside where minor > major", {major, minor},
            torus),
      entry("capped_torus", "Part of a ring about the y axis, centred on +z, with round ends.", tube,
            {size("angle", "degrees to either side of +z, at most 180", "120"), major, minor},
            [](const Expr& angle, const Expr& majorRadius, const Expr& minorRadius) {
              return cappedTorus(radians(angle), majorRadius, minorRadius);
            }),
      entry("link", "Chain link in the xy plane, longer along y.", tube,
            {number("half_length", "half the length of the straight sides", Rule::NotNegative, "0.5"),
             size("major", "from the middle of a half ring to the middle of the tube", "0.5"),
             size("minor", "radius of the tube", "0.15")},
            link),
      entry("capsule", "All points within a radius of a segment.", "exact",
            {vector3("from", "one end of the segment", Rule::Any, "{0, -0.5, 0}"),
             vector3("to", "the other end", Rule::Any, "{0, 0.5, 0}"),
             size("radius", "around the segment", "0.5")},
            capsule),
      entry("spring", "Wire along a helix about the y axis, with round ends; its middle is on +x.",
            "exact to 1e-6 of its size; exact outside where the wire runs into itself",
            {size("radius", "from the axis to the middle of the wire", "1"),
             size("pitch", "rise of a turn", "0.5"), size("turns", "how many, parts of one too", "4"),
             size("wire", "radius of the wire", "0.1"), hand},
            [](const Expr& radius, const Expr& pitch, const Expr& turns, const Expr& wire, int turned) {
              return spring(radius, pitch, turns, wire, static_cast<Hand>(turned));
            }),
      entry("solid_angle", "Part of a ball around the +y axis, its tip at the origin.", "exact",
            {size("angle", "degrees from the axis to the side, below 180", "30"), ball},
            [](const Expr& angle, const Expr& radius) { return solidAngle(radians(angle), radius); }),
      entry("cut_sphere", "Part of a ball above a plane.", "exact",
            {ball, number("height", "of the plane, between -radius and radius", Rule::Any, "0")}, cutSphere),

      entry("box", "Box about the origin.", "exact", {half}, box),
      entry(
          "round_box", "Box about the origin with rounded edges; the rounding stays within its size.",
          "exact",
          {half, number("radius", "of the edges, at most the smallest half size", Rule::NotNegative, "0.1")},
          roundBox),
      entry("box_frame", "The edges of a box about the origin, as square beams inside it.", "exact outside",
            {half, size("thickness", "of the beams, at most the smallest half size", "0.1")}, boxFrame),
      entry("plane", "All points on the side of a plane that the normal points away from.", "exact",
            {vector3("normal", "away from the solid, any length but 0", Rule::Any, "{0, 1, 0}"),
             number("offset", "distance of the plane from the origin, along the normal", Rule::Any, "0")},
            plane),
      entry("octahedron", "Regular octahedron about the origin, corners on the axes.", "exact", {corner},
            octahedron),
      entry("tetrahedron",
            "Regular tetrahedron about the origin, corners towards (1, 1, 1) and (1, -1, -1) and so on.",
            "exact", {corner}, tetrahedron),
      entry("pyramid", "Pyramid along y over a square with sides along x and z.", "exact",
            {size("half_width", "half the side of the square", "1"), halfHeight("1")}, pyramid),

      entry("cylinder", "Cylinder along y about the origin.", "exact", {column, halfHeight("1")}, cylinder),
      entry("infinite_cylinder", "Endless cylinder along y.", "exact", {column}, infiniteCylinder),
      entry("cone", "Cone along y, its tip at the top.", "exact",
            {size("radius", "of the base", "1"), halfHeight("1")}, cone),
      entry("capped_cone", "Cone along y with its tip cut off.", "exact",
            {number("radius_bottom", "at y = -half_height", Rule::NotNegative, "1"),
             number("radius_top", "at y = half_height", Rule::NotNegative, "0.5"), halfHeight("1")},
            cappedCone),
      entry("round_cone", "Hull of two balls on the y axis.", "exact",
            {size("radius_bottom", "of the ball at y = -half_height", "0.5"),
             size("radius_top", "of the ball at y = half_height", "0.25"),
             size("half_height", "half the distance of the balls' centres", "0.5")},
            roundCone),
      entry("thread",
            "Rod along y with a metric thread (ISO 68-1) and chamfered ends. Of a nut take away one with a "
            "clearance, longer than the nut by a pitch at both ends.",
            "bound, L = 1",
            {size("diameter", "outer one", "1"),
             size("pitch", "from turn to turn, below 0.92 diameters", "0.2"),
             size("length", "of the rod", "2"), integer("starts", "turns side by side", Rule::Count, "1"),
             number("clearance", "how far the thread's surface is moved out, or in below 0", Rule::Any, "0"),
             hand},
            [](const Expr& diameter, const Expr& pitch, const Expr& length, int starts, const Expr& clearance,
               int turned) {
              return thread(diameter, pitch, length, starts, clearance, static_cast<Hand>(turned));
            }),
      entry("hex_prism", "Hexagonal column along y, a corner on +z.", "exact", {side, halfHeight("0.5")},
            hexPrism),
      entry("tri_prism", "Triangular column along y, a corner on +z.", "exact", {side, halfHeight("0.5")},
            triPrism),

      entry("strut_lattice",
            "Round struts along an endless grid: between the nearest of cubes' corners and faces' middles, "
            "along "
            "cubes' edges, from corners to middles, or along the edges of Kelvin's truncated octahedra. A "
            "cube's "
            "corner is at the origin. Intersect it with a solid.",
            "exact outside",
            {choice("kind", "where the struts run", {"octet", "cubic", "body_centred", "kelvin"}), cell,
             size("radius", "of the struts", "0.05")},
            [](int kind, const Expr& size, const Expr& radius) {
              return strutLattice(static_cast<Struts>(kind), size, radius);
            }),
      entry("gyroid", "Walls along the gyroid, an endless labyrinth; intersect it with a solid.",
            "bound, L = 1",
            {cell, size("thickness", "of the walls where thinnest, below 0.2756 cell", "0.1")}, gyroid),
      entry("schwarz_p", "Walls along Schwarz' P surface, endless cubic plumbing.", "bound, L = 1",
            {cell, size("thickness", "of the walls where thinnest, below 0.5513 cell", "0.1")}, schwarzP),
      entry("schwarz_d", "Walls along Schwarz' D surface, endless diamond plumbing.", "bound, L = 1",
            {cell, size("thickness", "of the walls where thinnest, below 0.2598 cell", "0.1")}, schwarzD),
      entry("iwp",
            "Walls along Schoen's I-WP surface, around a grid of pipes from cubes' middles to their corners.",
            "bound, L = 1",
            {cell, size("thickness", "of the walls where thinnest, below 0.3063 cell", "0.1")}, iwp),
      entry("neovius", "Walls along Neovius' surface: chambers with twelve tunnels each.", "bound, L = 1",
            {cell, size("thickness",
                        "of the walls where thinnest, a seventh of the thickest; below 0.5911 cell", "0.03")},
            neovius),
      entry("lidinoid", "Walls along the lidinoid, a gyroid's kin.", "bound, L = 1",
            {cell, size("thickness",
                        "of the walls where thinnest, a fifth of the thickest; below 0.1654 cell", "0.03")},
            lidinoid),
      entry(
          "fischer_koch_s", "Walls along Fischer and Koch's S surface, an endless labyrinth.", "bound, L = 1",
          {cell, size("thickness", "of the walls where thinnest, below 0.1841 cell", "0.05")}, fischerKochS),
  };
}

}  // namespace sdf
