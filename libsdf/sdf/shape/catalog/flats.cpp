#include "sdf/shape/solids/flats.h"
#include "sdf/shape/catalog/entries.h"

namespace sdf {

std::vector<CatalogEntry> flatEntries() {
  using namespace parameter;
  const Parameter half = vector2("half", "half sizes along x and y", Rule::Positive, "{1, 0.5}");
  const Parameter middle = size("radius", "of the circle in the middle of the band", "1");
  return {
      entry("circle", "Disc about the origin.", "exact", {size("radius", "of the disc", "1")}, circle),
      entry("ellipse", "Ellipse about the origin.",
            "exact to 5e-7 of the largest radius, for radii in ratios up to 100",
            {vector2("radii", "along x and y", Rule::Positive, "{1, 0.5}")},
            [](const Vec3E& radii) { return ellipse(radii.x, radii.y); }),
      entry("ring", "Band around a circle about the origin.", "exact",
            {middle, size("thickness", "of the band, below twice the radius", "0.2")}, ring),
      entry("arc", "Band along part of a circle about the origin, centred on +y, with round ends.",
            "exact; exact outside where the band runs into itself",
            {size("angle", "degrees to either side of +y, at most 180", "120"), middle,
             size("thickness", "of the band", "0.2")},
            [](const Expr& angle, const Expr& radius, const Expr& thickness) {
              return arc(radians(angle), radius, thickness);
            }),

      entry("rectangle", "Rectangle about the origin.", "exact", {half},
            [](const Vec3E& size) { return rectangle(size.x, size.y); }),
      entry(
          "rounded_rectangle", "Rectangle about the origin with rounded corners, within its size.", "exact",
          {half, number("radius", "of the corners, at most the smaller half size", Rule::NotNegative, "0.1")},
          [](const Vec3E& size, const Expr& radius) { return roundedRectangle(size.x, size.y, radius); }),
      entry(
          "trapezoid", "Trapezoid about the origin, the same left and right.", "exact",
          {number("half_bottom", "half width at y = -half_height", Rule::NotNegative, "1"),
           number("half_top", "half width at y = half_height", Rule::NotNegative, "0.5"), halfHeight("0.5")},
          trapezoid),
      entry("segment", "All points within a radius of a segment.", "exact",
            {vector2("from", "one end", Rule::Any, "{-0.5, 0}"),
             vector2("to", "the other end", Rule::Any, "{0.5, 0}"),
             size("radius", "around the segment", "0.25")},
            segment),
      entry("regular_polygon", "Polygon with equal sides about the origin, a corner on +y.", "exact",
            {integer("sides", "how many, at least 3", Rule::Positive, "6"),
             size("radius", "from the centre to a corner", "1")},
            regularPolygon),
      entry("polygon", "Polygon through given points; its edges must not touch or cross.", "exact",
            {points("points", "corners in order, either way round", Rule::Any,
                    "{{-1, -0.5}, {1, -0.5}, {0, 0.2}, {0, 1}}")},
            [](const std::vector<glm::dvec2>& corners) { return polygon(corners); }),
      entry("star", "Star about the origin, a tip on +y.", "exact",
            {integer("points", "how many tips, at least 3", Rule::Positive, "5"),
             size("outer", "radius of the tips", "1"),
             size("inner", "radius of the corners between them, below outer", "0.4")},
            star),
  };
}

}  // namespace sdf
