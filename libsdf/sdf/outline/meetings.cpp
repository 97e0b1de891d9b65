#include "sdf/outline/meetings.h"

namespace sdf {
namespace {

// The circle k |p|² + 2 dot(right, p) + rest = 0 about a point of reference.
struct Circle {
  double curvature;
  glm::dvec2 right;
  double rest;
};

Circle circleOf(const Arc& arc, const glm::dvec2& reference) {
  const glm::dvec2 r = reference - arc.from, right(arc.along.y, -arc.along.x);
  return {arc.curvature, right + arc.curvature * r, arc.circleAt(r, dotOf(right, r))};
}

// The points of a line, dot(right, p) + half = 0 with `right` of any length, that are on the circle. A point
// of contact is there twice.
std::vector<glm::dvec2> onLine(const glm::dvec2& right, double half, const Circle& circle, double reach) {
  const double length = std::hypot(right.x, right.y);
  const glm::dvec2 normal = right / length, along(-normal.y, normal.x), foot = normal * (-half / length);
  // a t² + 2 b t + c = 0 along the line.
  const double a = circle.curvature, b = a * dotOf(foot, along) + dotOf(circle.right, along);
  const double c = a * dotOf(foot, foot) + 2.0 * dotOf(circle.right, foot) + circle.rest;
  double root = b * b - a * c;
  if (root < 0.0 && -root <= 4.0 * std::abs(a) * reach) root = 0.0;
  if (root < 0.0) return {};
  const double q = b < 0.0 ? -b + std::sqrt(root) : -b - std::sqrt(root);
  std::vector<glm::dvec2> points;
  if (q != 0.0) points.push_back(foot + along * (c / q));
  if (a != 0.0) points.push_back(foot + along * (q / a));
  return points;
}

// Of two circles: those that one of them has on the line through the points of both.
std::vector<glm::dvec2> meetings(const Circle& a, const Circle& b, double reach) {
  const Circle& rounder = std::abs(a.curvature) > std::abs(b.curvature) ? a : b;
  const Circle& other = &rounder == &a ? b : a;
  if (other.curvature == 0.0) return onLine(other.right, 0.5 * other.rest, rounder, reach);
  const double share = other.curvature / rounder.curvature;
  const glm::dvec2 right = other.right - share * rounder.right;
  if (dotOf(right, right) < 1e-24) return {};  // of one centre
  return onLine(right, 0.5 * (other.rest - share * rounder.rest), rounder, reach);
}

bool isOn(const Arc& arc, const glm::dvec2& p, double reach) {
  return arc.placeOf(p).squared() <= reach * reach;
}

}  // namespace

std::vector<glm::dvec2> meetingsOf(const Arc& a, const Arc& b, double reach) {
  std::vector<glm::dvec2> found;
  for (const glm::dvec2& end : {a.from, a.to})
    if (isOn(b, end, reach)) found.push_back(end);
  for (const glm::dvec2& end : {b.from, b.to})
    if (isOn(a, end, reach)) found.push_back(end);
  const glm::dvec2 reference = a.middle();
  const Circle one = circleOf(a, reference), two = circleOf(b, reference);
  const bool areParallel =
      one.curvature == 0.0 && two.curvature == 0.0 && std::abs(crossOf(one.right, two.right)) < 1e-14;
  if (areParallel) return found;
  for (const glm::dvec2& p : meetings(one, two, reach))
    if (isOn(a, reference + p, reach) && isOn(b, reference + p, reach)) found.push_back(reference + p);
  return found;
}

}  // namespace sdf
