#include "sdf/shape/operators/deform.h"
#include "sdf/shape/catalog/entries.h"

namespace sdf {

std::vector<CatalogEntry> deformEntries() {
  using namespace parameter;
  const Parameter operand = shape("shape", "the shape to change"), flat = shape("flat", "a flat shape");
  return {
      entry("morph", "Part way from one shape to another; materials are mixed alike.",
            "a bound if both are; L of the steeper shape",
            {shape("from", "the shape at t = 0"), shape("to", "the shape at t = 1"),
             number("t", "how far, 0 to 1", Rule::NotNegative)},
            morph),
      entry("round", "Everything within a radius of the shape: grows it, and rounds its outer edges.",
            "exact outside if the shape is; else calibrated: fields by their gradient, edges and corners of "
            "intersections by their faces' angles; what cannot be stays a bound or a field, and is warned of "
            "where the surface is more than a tenth of the radius off",
            {operand, number("radius", "scene units", Rule::NotNegative)},
            [](const Shape& s, const Expr& radius) { return round(s, radius); }),
      entry("shell", "The skin of the shape, half of its thickness on either side of the surface.",
            "exact outside if the shape is exact, else as round, on both sides of the surface",
            {operand, number("thickness", "scene units", Rule::Positive)}, shell),
      entry("elongate",
            "Cut at the coordinate planes, pulled apart along each axis, and the gaps filled with the cross "
            "sections.",
            "a bound if the shape is; L of the shape",
            {operand,
             vector3("half", "how far each half moves along x, y and z, scene units", Rule::NotNegative)},
            elongate),
      entry("displace", "The surface moved by amplitude sin(wx) sin(wy) sin(wz), w being the frequency.",
            "a field; L of the shape + |amplitude| frequency",
            {operand, number("amplitude", "scene units"),
             number("frequency", "radians a scene unit: bumps repeat every 2 pi / frequency")},
            [](const Shape& s, const Expr& amplitude, const Expr& frequency) {
              return displace(s, amplitude, frequency);
            }),
      entry("extrude", "A flat shape swept along z, both ways from the xy plane.", "as the flat shape",
            {flat, number("half_height", "scene units", Rule::Positive)}, extrude),
      entry("revolve",
            "A flat shape swept around the y axis. What lies at x < 0, after the offset, is dropped.",
            "as the flat shape if it keeps clear of the axis or is symmetric about it; exact outside if "
            "exact and "
            "touching the axis; else bound. Part of a turn: exact outside at most",
            {flat, number("offset", "moves the flat shape along x first, scene units", Rule::Any, "0"),
             size("angle", "degrees of a turn, its middle on +x; at most 360", "360")},
            [](const Shape& s, const Expr& offset, const Expr& angle) {
              return revolve(s, offset, radians(angle));
            }),
      entry(
          "twist", "Turned about the y axis, the more the higher.",
          "near the true one of flat, round and rounded shapes; of other curved ones off by a shear of up to "
          "(a + sqrt(a^2 + 4)) / 2, a = |rate| radius; a field if unbounded in x or z",
          {operand, number("rate", "degrees for each unit of y")},
          [](const Shape& s, const Expr& rate) { return twist(s, radians(rate)); }),
      entry("bend",
            "The x axis bent into a circle towards +y; lengths along it stay. The shape must not reach the "
            "circle's centre nor half way around.",
            "near the true one of flat, round and rounded shapes; of other curved ones off by up to the "
            "stretch, "
            "1 / (1 - y / radius)",
            {operand, number("rate", "degrees for each unit of x; the radius is 57.3 / rate")},
            [](const Shape& s, const Expr& rate) { return bend(s, radians(rate)); }),
      entry("taper", "The cross section at height y scaled by 1 + rate y in x and z.",
            "near the true one of flat, round and rounded shapes; of other curved ones off by up to the "
            "shear; a "
            "field if unbounded in x or z",
            {operand, number("rate", "change of the scale for each unit of y; negative narrows upwards")},
            taper),
  };
}

}  // namespace sdf
