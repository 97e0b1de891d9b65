#include "sdf/shape/solids/polygon_tree.h"

#include <cmath>

namespace sdf {
namespace {

double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// The tangent of half the angle from one direction to another one, counter-clockwise.
double tangentOfHalf(const glm::dvec2& from, const glm::dvec2& to) {
  const double sine = crossOf(from, to), cosine = from.x * to.x + from.y * to.y;
  return cosine >= 0.0 ? sine / (1.0 + cosine) : (1.0 - cosine) / sine;
}

std::vector<PolygonSide> sidesOf(std::span<const glm::dvec2> corners) {
  const std::size_t n = corners.size();
  std::vector<PolygonSide> sides(n);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 way = corners[(i + 1) % n] - corners[i];
    const double size = std::hypot(way.x, way.y);
    sides[i] = {corners[i], way / size, size, 0.0, 0.0};
  }
  for (std::size_t i = 0; i < n; ++i) {
    PolygonSide& next = sides[(i + 1) % n];
    sides[i].atTo = next.atFrom = tangentOfHalf(sides[i].along, next.along);
  }
  return sides;
}

}  // namespace

SideTree::SideTree(std::span<const glm::dvec2> points) : size_(points.size()) {
  std::vector<Rectangle> boxes((size_ + kLeaf - 1) / kLeaf);
  for (std::size_t i = 0; i < size_; ++i) {
    boxes[i / kLeaf].add(points[i]);
    boxes[i / kLeaf].add(points[(i + 1) % size_]);
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Rectangle>& below = levels_.back();
    std::vector<Rectangle> level((below.size() + 1) / 2);
    for (std::size_t i = 0; i < below.size(); ++i) {
      level[i / 2].add(below[i].lo);
      level[i / 2].add(below[i].hi);
    }
    levels_.push_back(std::move(level));
  }
}

PolygonDistance::PolygonDistance(std::span<const glm::dvec2> corners)
    : tree_(corners), sides_(sidesOf(corners)) {}

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
  const glm::dvec2 normal(side.along.y, -side.along.x);
  const double sign = side.isOutside(place) ? 1.0 : -1.0;
  const double far = std::hypot(place.out, place.past);
  if (place.past == 0.0) return {place.out, normal, nearest};
  return {sign * far, (place.out * normal + place.past * side.along) * (sign / far), nearest};
}

}  // namespace sdf
