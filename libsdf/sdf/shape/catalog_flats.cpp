#include "sdf/shape/entries.h"
#include "sdf/shape/flats.h"

namespace sdf {

namespace {

using namespace parameter;  // NOLINT: the entries below read as a table

Parameter size(const char* name, const char* doc, const char* fallback) {
  return number(name, doc, Rule::Positive, fallback);
}
Parameter halfSizes() { return vector2("half", "half sizes along x and y", Rule::Positive, "{1, 0.5}"); }

std::vector<CatalogEntry> straightEntries() {
  const Group g = Group::Flat;
  return {
      {"rectangle",
       g,
       "Rectangle about the origin.",
       "exact",
       {halfSizes()},
       [](const Arguments& a) { return rectangle(a.vector(0).x, a.vector(0).y); }},
      {"rounded_rectangle",
       g,
       "Rectangle about the origin with rounded corners, within its size.",
       "exact",
       {halfSizes(),
        number("radius", "of the corners, at most the smaller half size", Rule::NotNegative, "0.1")},
       [](const Arguments& a) { return roundedRectangle(a.vector(0).x, a.vector(0).y, a.number(1)); }},
      {"trapezoid",
       g,
       "Trapezoid about the origin, the same left and right.",
       "exact",
       {number("half_bottom", "half width at y = -half_height", Rule::NotNegative, "1"),
        number("half_top", "half width at y = half_height", Rule::NotNegative, "0.5"),
        size("half_height", "from the centre to the top and to the bottom", "0.5")},
       [](const Arguments& a) { return trapezoid(a.number(0), a.number(1), a.number(2)); }},
      {"segment",
       g,
       "All points within a radius of a segment.",
       "exact",
       {vector2("from", "one end", Rule::Any, "{-0.5, 0}"),
        vector2("to", "the other end", Rule::Any, "{0.5, 0}"), size("radius", "around the segment", "0.25")},
       [](const Arguments& a) { return segment(a.vector(0), a.vector(1), a.number(2)); }},
      {"regular_polygon",
       g,
       "Polygon with equal sides about the origin, a corner on +y.",
       "exact",
       {integer("sides", "how many, at least 3", Rule::Positive, "6"),
        size("radius", "from the centre to a corner", "1")},
       [](const Arguments& a) { return regularPolygon(a.integer(0), a.number(1)); }},
      {"polygon",
       g,
       "Polygon through given points; its edges must not touch or cross.",
       "exact",
       {points("points", "corners in order, either way round", "{{-1, -0.5}, {1, -0.5}, {0, 0.2}, {0, 1}}")},
       [](const Arguments& a) { return polygon(a.points(0)); }},
      {"star",
       g,
       "Star about the origin, a tip on +y.",
       "exact",
       {integer("points", "how many tips, at least 3", Rule::Positive, "5"),
        size("outer", "radius of the tips", "1"),
        size("inner", "radius of the corners between them, below outer", "0.4")},
       [](const Arguments& a) { return star(a.integer(0), a.number(1), a.number(2)); }},
  };
}

std::vector<CatalogEntry> roundEntries() {
  const Group g = Group::Flat;
  return {
      {"circle",
       g,
       "Disc about the origin.",
       "exact",
       {size("radius", "of the disc", "1")},
       [](const Arguments& a) { return circle(a.number(0)); }},
      {"ellipse",
       g,
       "Ellipse about the origin.",
       "exact to 5e-7 of the largest radius, for radii in ratios up to 100",
       {vector2("radii", "along x and y", Rule::Positive, "{1, 0.5}")},
       [](const Arguments& a) { return ellipse(a.vector(0).x, a.vector(0).y); }},
      {"ring",
       g,
       "Band around a circle about the origin.",
       "exact",
       {size("radius", "of the circle in the middle of the band", "1"),
        size("thickness", "of the band, below twice the radius", "0.2")},
       [](const Arguments& a) { return ring(a.number(0), a.number(1)); }},
      {"arc",
       g,
       "Band along part of a circle about the origin, centred on +y, with round ends.",
       "exact; exact outside where the band runs into itself",
       {size("angle", "degrees to either side of +y, at most 180", "120"),
        size("radius", "of the circle in the middle of the band", "1"),
        size("thickness", "of the band", "0.2")},
       [](const Arguments& a) { return arc(radians(a.number(0)), a.number(1), a.number(2)); }},
  };
}

}  // namespace

std::vector<CatalogEntry> flatEntries() {
  std::vector<CatalogEntry> all = roundEntries();
  for (auto& entry : straightEntries()) all.push_back(std::move(entry));
  return all;
}

}  // namespace sdf
