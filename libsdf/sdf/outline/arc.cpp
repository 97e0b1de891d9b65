#include "sdf/outline/arc.h"

namespace sdf {
namespace {

// d, turned to the left by an angle.
glm::dvec2 turned(const glm::dvec2& d, double cosine, double sine) {
  return {d.x * cosine - d.y * sine, d.x * sine + d.y * cosine};
}

}  // namespace

Arc Arc::through(const ArcCorner& from, const glm::dvec2& to) {
  const glm::dvec2 chord = to - from.at;
  const double length = std::hypot(chord.x, chord.y), b = from.bulge;
  const glm::dvec2 direction = chord / length;
  if (b == 0.0) return {from.at, direction, to, direction, length, 0.0};
  // Of half the angle by which it turns.
  const double sine = 2.0 * b / (1.0 + b * b), cosine = (1.0 - b) * (1.0 + b) / (1.0 + b * b);
  const double curvature = 2.0 * sine / length;
  return {from.at,
          turned(direction, cosine, -sine),
          to,
          turned(direction, cosine, sine),
          length * (2.0 * std::atan(b) / sine),
          curvature};
}

glm::dvec2 Arc::at(double length) const {
  const double half = 0.5 * curvature * length, chord = half == 0.0 ? length : length * std::sin(half) / half;
  return from + chord * turned(along, std::cos(half), std::sin(half));
}

glm::dvec2 Arc::directionAt(double length) const {
  return turned(along, std::cos(curvature * length), std::sin(curvature * length));
}

glm::dvec2 Arc::middle() const {
  const glm::dvec2 chord = to - from;
  const double height = sagitta(), length = std::hypot(chord.x, chord.y);
  const glm::dvec2 right = glm::dvec2(chord.y, -chord.x) / length;
  return 0.5 * (from + to) + (curvature < 0.0 ? -height : height) * right;
}

double Arc::sagitta() const {
  const glm::dvec2 chord = to - from;
  const double half = 0.5 * std::hypot(chord.x, chord.y), sine = std::min(1.0, std::abs(curvature) * half);
  return half * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)));
}

Rectangle Arc::box() const {
  Rectangle box;
  box.add(from);
  box.add(to);
  const glm::dvec2 middle = along + alongTo;
  // Where it runs along an axis it is at its farthest along the other one. It gets there by a chord.
  for (int k = 0; k < 2; ++k) {
    if (along[1 - k] * alongTo[1 - k] >= 0.0) continue;
    glm::dvec2 d(0.0);
    d[k] = middle[k] < 0.0 ? -1.0 : 1.0;
    const glm::dvec2 sum = along + d;
    box.add(from + sum * (2.0 * crossOf(along, d) / (dotOf(sum, sum) * curvature)));
  }
  return box;
}

ArcCorner Arc::part(const glm::dvec2& a, const glm::dvec2& b) const {
  const double sine = 0.5 * curvature * std::hypot(b.x - a.x, b.y - a.y);
  return {a, sine / (1.0 + std::sqrt(std::max(0.0, (1.0 - sine) * (1.0 + sine))))};
}

// Between the arc and its chord the circle tells on which side p is, elsewhere the chord.
int Arc::windingAt(const glm::dvec2& p) const {
  const bool up = from.y <= p.y && p.y < to.y, down = to.y <= p.y && p.y < from.y;
  if (!up && !down) return 0;
  const glm::dvec2 r = p - from;
  const double left = crossOf(to - from, r);
  bool isLeft = left > 0.0;
  if (curvature > 0.0 && !isLeft) isLeft = circleAt(r, -crossOf(along, r)) < 0.0;
  if (curvature < 0.0 && isLeft) isLeft = circleAt(r, -crossOf(along, r)) < 0.0;
  if (up) return isLeft ? 1 : 0;
  return isLeft ? 0 : -1;
}

std::vector<Arc> arcsOf(const ArcContour& chain, bool isClosed) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i + (isClosed ? 0 : 1) < chain.size(); ++i)
    arcs.push_back(Arc::through(chain[i], chain[(i + 1) % chain.size()].at));
  return arcs;
}

std::vector<Arc> arcsOf(const std::vector<ArcContour>& contours) {
  std::vector<Arc> arcs;
  for (const ArcContour& c : contours) {
    const std::vector<Arc> own = arcsOf(c, true);
    arcs.insert(arcs.end(), own.begin(), own.end());
  }
  return arcs;
}

SideTree treeOf(const std::vector<Arc>& arcs) {
  std::vector<Rectangle> boxes;
  for (const Arc& arc : arcs) boxes.push_back(arc.box());
  return SideTree(boxes);
}

int windingNumber(const std::vector<Arc>& arcs, const SideTree& tree, const glm::dvec2& p) {
  int winding = 0;
  tree.any([&](const Rectangle& box) { return box.lo.y <= p.y && p.y <= box.hi.y && box.hi.x >= p.x; },
           [&](std::size_t i) {
             winding += arcs[i].windingAt(p);
             return false;
           });
  return winding;
}

}  // namespace sdf
