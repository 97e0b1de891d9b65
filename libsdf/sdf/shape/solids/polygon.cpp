#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "sdf/outline/biarcs.h"
#include "sdf/outline/boundary.h"
#include "sdf/outline/dashes.h"
#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/polygon_field.h"
#include "sdf/shape/solids/polygon_tree.h"

namespace sdf {

namespace {

using Points = std::vector<glm::dvec2>;

// A formula up to here: of stars' halves with a ball cut out, meshes take as long either way from 64 corners
// on and frames from 96, with 128 half as long by data. Formulas can be proven, and shaders compile them.
constexpr std::size_t kMostSides = 64;

// Twice the signed area of a, b, c: positive where they turn left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) { return crossOf(b - a, c - a); }

bool between(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool touch(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  const auto opposite = [](double u, double v) { return (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0); };
  return (opposite(abc, abd) && opposite(cda, cdb)) || (abc == 0.0 && between(a, b, c)) ||
         (abd == 0.0 && between(a, b, d)) || (cda == 0.0 && between(c, d, a)) ||
         (cdb == 0.0 && between(c, d, b));
}

// Does the edge into `corner` come straight back out of it?
bool foldsBack(const glm::dvec2& before, const glm::dvec2& corner, const glm::dvec2& after) {
  const glm::dvec2 in = corner - before, out = after - corner;
  return crossOf(in, out) == 0.0 && in.x * out.x + in.y * out.y < 0.0;
}

std::string pointName(std::size_t i) { return std::to_string(i + 1); }

void checkEdges(const Points& points, Check& c) {
  const std::size_t n = points.size();
  const auto at = [&](std::size_t i) { return points[i % n]; };
  for (std::size_t i = 0; i < n; ++i)
    if (at(i) == at(i + 1))
      return void(
          c.that(false, "points " + pointName(i) + " and " + pointName((i + 1) % n) + " are the same"));
  for (std::size_t i = 0; i < n; ++i)
    if (foldsBack(at(i), at(i + 1), at(i + 2)))
      return void(c.that(false, "the edges at point " + pointName((i + 1) % n) + " lie on each other"));
  std::vector<Rectangle> boxes(n);
  for (std::size_t i = 0; i < n; ++i) boxes[i].add(at(i)), boxes[i].add(at(i + 1));
  const SideTree tree(boxes);
  for (std::size_t i = 0; i < n; ++i) {
    const Rectangle& box = boxes[i];
    const auto touches = [&](std::size_t j) {
      if (j < i + 2 || j + 1 - i == n || !touch(at(i), at(i + 1), at(j), at(j + 1))) return false;
      c.that(false, "edges " + pointName(i) + " and " + pointName(j) + " touch or cross");
      return true;
    };
    if (tree.any([&](const Rectangle& other) { return other.meets(box); }, touches)) return;
  }
}

// Counter-clockwise.
Points oriented(Points points) {
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    area += crossOf(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  if (area < 0.0) std::reverse(points.begin(), points.end());
  return points;
}

bool isConvex(const Points& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0.0) return false;
  return true;
}

// One edge, counter-clockwise.
struct Side {
  Expr out;   // distance from its line, to its right
  Expr past;  // along it, past its ends
  glm::dvec2 along;
};

Side sideOf(const glm::dvec2& from, const glm::dvec2& to) {
  const double size = std::hypot(to.x - from.x, to.y - from.y);
  const glm::dvec2 e = (to - from) / size;
  const Expr x = position().x - from.x, y = position().y - from.y;
  const Expr out = (scaled(x, e.y) - scaled(y, e.x)).claimLipschitz(1.0);
  const Expr along = (scaled(x, e.x) + scaled(y, e.y)).claimLipschitz(1.0);
  return {out, beyond(along, size), e};
}

Expr convexDistance(const std::vector<Side>& sides) {
  std::optional<Expr> most;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[(i + 1) % sides.size()];
    const double sine = crossOf(a.along, b.along);
    if (sine == 0.0) continue;  // one straight line
    const Expr corner = cornerDistance(a.out, b.out, glm::dot(a.along, b.along), sine);
    most = most ? max(*most, corner) : corner;
  }
  return *most;
}

// Any simple polygon: the sign from the winding number (Sunday 2001), 1 inside and 0 outside.
Expr windingDistance(const std::vector<Side>& sides, const Points& points) {
  const Expr y = position().y;
  const auto distanceTo = [&](std::size_t i) { return segmentDistance(sides[i].out, sides[i].past); };
  Expr distance = distanceTo(0), winding = 0.0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    distance = min(distance, distanceTo(i));
    const glm::dvec2 &a = points[i], &b = points[(i + 1) % points.size()];
    if (a.y == b.y) continue;
    const Expr above = lessEqual(a.y, y) - lessEqual(b.y, y);  // 1 where the edge passes the point upwards
    winding = winding + above * (a.y < b.y ? less(sides[i].out, 0.0) : less(0.0, sides[i].out));
  }
  // On an edge the winding number may be either; the gradient of `distance` points out of it.
  return select(min(winding, less(0.0, distance)), -distance, distance);
}

Expr formulaOf(const Points& points) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < points.size(); ++i)
    sides.push_back(sideOf(points[i], points[(i + 1) % points.size()]));
  return isConvex(points) ? convexDistance(sides) : windingDistance(sides, points);
}

// About the middle of the contours, if that is far from the origin: floats are fine there.
Expr fieldOf(std::vector<ArcContour> contours, std::vector<ArcContour> drawn, const Rectangle& box) {
  const glm::dvec2 size = box.hi - box.lo, middle = 0.5 * (box.lo + box.hi);
  const bool isFar = std::max(std::abs(middle.x), std::abs(middle.y)) > std::max(size.x, size.y);
  const glm::dvec2 origin = isFar ? middle : glm::dvec2(0.0);
  for (std::vector<ArcContour>* all : {&contours, &drawn})
    for (ArcContour& contour : *all)
      for (ArcCorner& corner : contour) corner.at -= origin;
  const Expr x = position().x, y = position().y;
  return Expr::payload({PolygonField::of(std::move(contours), std::move(drawn)), 0},
                       {isFar ? x - origin.x : x, isFar ? y - origin.y : y, 0.0});
}

Expr distanceTo(const Points& points, const Rectangle& box) {
  if (points.size() <= kMostSides) return formulaOf(points);
  ArcContour contour;
  for (const glm::dvec2& p : points) contour.push_back({p, 0.0});
  return fieldOf({std::move(contour)}, {}, box);
}

}  // namespace

Shape polygon(std::span<const glm::dvec2> given) {
  Check c("polygon");
  Points points(given.begin(), given.end());
  if (points.size() > 1 && points.front() == points.back()) points.pop_back();
  c.that(points.size() >= 3, "at least 3 points are needed, got " + std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size() && c.ok(); ++i)
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y))
      c.that(false, "point " + pointName(i) + " must be finite, got {" + shown(points[i].x) + ", " +
                        shown(points[i].y) + "}");
  if (c.ok()) checkEdges(points, c);
  if (!c.ok()) return c.failure();

  points = oriented(std::move(points));
  Rectangle box;
  for (const glm::dvec2& p : points) box.add(p);
  return flat(distanceTo(points, box), box.lo, box.hi);
}

namespace {

// Of one outline, by lengths that may be three times the curves' own. 2,700 round ones were drawn in 8 s.
constexpr double kMostDashes = 10'000;

bool isFinite(const Outline& outline) {
  const auto good = [](const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  return std::ranges::all_of(outline.contours, [&](const Contour& contour) {
    return good(contour.from) && std::ranges::all_of(contour.curves, [&](const Curve& c) {
             return good(c.control[0]) && good(c.control[1]) && good(c.to);
           });
  });
}

// The border of what they enclose together.
Result<std::vector<ArcContour>> borderOf(std::span<const Outline> outlines, double tolerance) {
  std::vector<ArcContour> all;
  for (const Outline& outline : outlines) {
    auto own = boundaryOf(arcContours(outline, tolerance), outline.stroke ? FillRule::NonZero : outline.rule);
    if (!own || outlines.size() == 1) return own;
    all.insert(all.end(), std::move_iterator(own->begin()), std::move_iterator(own->end()));
  }
  return boundaryOf(all, FillRule::NonZero);
}

}  // namespace

Shape outline(std::span<const Outline> outlines, const CurveTolerance& tolerance, const std::string& name) {
  Check c(name);
  c.that(std::ranges::all_of(outlines, [](const Outline& o) { return isFinite(o); }),
         "its points must be finite");
  c.that(std::ranges::all_of(outlines, [](const Outline& o) { return mostDashes(o) <= kMostDashes; }),
         "it has more than 10,000 dashes; make them longer");
  for (const double t : {tolerance.exact, tolerance.drawn})
    c.that(std::isfinite(t) && t > 0.0, "its tolerances must be positive, got " + shown(t));
  if (!c.ok()) return c.failure();
  auto border = borderOf(outlines, tolerance.exact);
  auto drawn = borderOf(outlines, tolerance.drawn);
  for (const auto* made : {&border, &drawn})
    if (!made->ok()) c.that(false, made->error().message);
  c.that(!border || !border->empty(), "it encloses no area");
  if (!c.ok()) return c.failure();
  Rectangle box;
  for (const Arc& arc : arcsOf(*border)) box.add(arc.box());
  return flat(fieldOf(std::move(*border), std::move(*drawn), box), box.lo, box.hi);
}

}  // namespace sdf
