#include "sdf/shape/solids/polygon_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sdf {
namespace {

// The tangent of half the angle by which an outline turns to the left at a corner. Where it comes straight
// back there is hardly any inside or hardly any outside between the two, as they bend.
double tangentOfHalf(const Arc& in, const Arc& out) {
  constexpr double kStraightBack = 1e-9;
  const double sine = crossOf(in.alongTo, out.along), cosine = dotOf(in.alongTo, out.along);
  if (cosine >= 0.0) return sine / (1.0 + cosine);
  if (std::abs(sine) < kStraightBack && in.curvature + out.curvature != 0.0)
    return in.curvature + out.curvature < 0.0 ? 1.0 / kStraightBack : -1.0 / kStraightBack;
  return (1.0 - cosine) / sine;
}

std::vector<PolygonSide> sidesOf(const std::vector<ArcContour>& contours) {
  std::vector<PolygonSide> sides;
  for (const Arc& arc : arcsOf(contours)) sides.push_back({arc, 0.0, 0.0});
  std::size_t first = 0;
  for (const ArcContour& c : contours) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      PolygonSide &side = sides[first + i], &next = sides[first + (i + 1) % c.size()];
      side.atTo = next.atFrom = tangentOfHalf(side, next);
    }
    first += c.size();
  }
  return sides;
}

std::vector<ArcContour> contoursOf(std::span<const glm::dvec2> corners) {
  std::vector<ArcContour> contours(1);
  for (const glm::dvec2& p : corners) contours[0].push_back({p, 0.0});
  return contours;
}

SideTree treeOver(const std::vector<PolygonSide>& sides) {
  std::vector<Rectangle> boxes;
  for (const PolygonSide& side : sides) boxes.push_back(side.box());
  return SideTree(boxes);
}

}  // namespace

PolygonDistance::PolygonDistance(std::span<const glm::dvec2> corners)
    : PolygonDistance(contoursOf(corners)) {}

PolygonDistance::PolygonDistance(const std::vector<ArcContour>& contours)
    : sides_(sidesOf(contours)), tree_(treeOver(sides_)) {
  for (const ArcContour& c : contours) contourSizes_.push_back(c.size());
  hasArcs_ = std::ranges::any_of(sides_, [](const PolygonSide& s) { return s.curvature != 0.0; });
}

PolygonDistance::Read PolygonDistance::read(const glm::dvec2& p, std::uint32_t hint) const {
  std::uint32_t nearest = hint;
  PolygonSide::Place place = sides_[hint].placeOf(p);
  double least = place.squared();
  tree_.nearest(p, least, [&](std::size_t i) {
    const PolygonSide::Place other = sides_[i].placeOf(p);
    if (!(other.squared() < least)) return;
    nearest = static_cast<std::uint32_t>(i), place = other, least = other.squared();
  });
  const PolygonSide& side = sides_[nearest];
  if (place.past == 0.0) return {place.out, side.normalAt(p), nearest};
  const glm::dvec2& along = place.past < 0.0 ? side.along : side.alongTo;
  const glm::dvec2 normal(along.y, -along.x);
  const double sign = side.isOutside(place) ? 1.0 : -1.0;
  const double far = std::hypot(place.out, place.past);
  return {sign * far, (place.out * normal + place.past * along) * (sign / far), nearest};
}

}  // namespace sdf
