#include "sdf/outline/biarcs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "sdf/outline/stroke.h"

namespace sdf {
namespace {

// A Bézier curve of degree 2 or 3.
struct Bezier {
  int degree;
  std::array<glm::dvec2, 4> points;

  const glm::dvec2& first() const { return points[0]; }
  const glm::dvec2& last() const { return points[degree]; }
  // de Casteljau's way.
  std::pair<Bezier, Bezier> cut(double t) const {
    Bezier left = *this, right = *this;
    for (int level = 1; level <= degree; ++level) {
      for (int i = 0; i + level <= degree; ++i)
        right.points[i] = (1.0 - t) * right.points[i] + t * right.points[i + 1];
      left.points[level] = right.points[0];
    }
    return {left, right};
  }
  glm::dvec2 at(double t) const { return cut(t).second.first(); }
};

double lengthOf(const glm::dvec2& v) { return std::hypot(v.x, v.y); }

// The direction at the first end, of length 1; that of 0 has none.
glm::dvec2 directionAtStart(const Bezier& b) {
  for (int i = 1; i <= b.degree; ++i)
    if (const glm::dvec2 d = b.points[i] - b.points[0]; lengthOf(d) > 0.0) return d / lengthOf(d);
  return glm::dvec2(0.0);
}

glm::dvec2 directionAtEnd(const Bezier& b) {
  for (int i = b.degree - 1; i >= 0; --i)
    if (const glm::dvec2 d = b.last() - b.points[i]; lengthOf(d) > 0.0) return d / lengthOf(d);
  return glm::dvec2(0.0);
}

// The arc that leaves `from` in this direction, of length 1, and comes to `to`.
ArcCorner arcTo(const glm::dvec2& from, const glm::dvec2& along, const glm::dvec2& to) {
  const glm::dvec2 chord = to - from;
  return {from, crossOf(along, chord) / (lengthOf(chord) + dotOf(along, chord))};
}

// A direction, mirrored in a chord: that of an arc at the chord's other end.
glm::dvec2 acrossArc(const glm::dvec2& direction, const glm::dvec2& chord) {
  return chord * (2.0 * dotOf(direction, chord) / dotOf(chord, chord)) - direction;
}

// Where on the curve two arcs may meet that leave its ends in its directions, having one direction there: by
// the secant method. Nothing where they would turn by much, or it is too close to an end.
std::optional<double> jointOf(const Bezier& b, const glm::dvec2& start, const glm::dvec2& end) {
  const glm::dvec2 way = b.last() - b.first();
  if (dotOf(way, start) <= 0.5 * lengthOf(way) || dotOf(way, end) <= 0.5 * lengthOf(way)) return {};
  constexpr double kStraight = 1e-11, kMargin = 0.1;
  const auto turnAt = [&](double t) {
    const glm::dvec2 joint = b.at(t);
    return crossOf(acrossArc(start, joint - b.first()), acrossArc(end, b.last() - joint));
  };
  double t = 0.5, before = 0.45, turn = turnAt(t), turnBefore = turnAt(before);
  for (int i = 0; i < 12 && !(std::abs(turn) <= kStraight); ++i) {
    const double next = t - turn * (t - before) / (turn - turnBefore);
    before = t, turnBefore = turn;
    t = std::clamp(next, kMargin, 1.0 - kMargin), turn = turnAt(t);
  }
  return std::abs(turn) <= kStraight ? std::optional(t) : std::nullopt;
}

// Is the curve, whose ends are those of the arc, nowhere farther from it than that? Along it the circle's
// equation is a polynomial of twice its degree, which lies between its Bernstein coefficients. The curve must
// not leave the sector of the arc.
bool isNear(const Bezier& b, const Arc& arc, double tolerance) {
  static constexpr double kBinomials[7][7] = {
      {1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}, {1, 6, 15, 20, 15, 6, 1}};
  const int n = b.degree;
  const double slack = 1e-3 * tolerance;
  std::array<glm::dvec2, 4> r{};
  std::array<double, 4> out{};
  for (int i = 0; i <= n; ++i) {
    r[i] = b.points[i] - arc.from;
    out[i] = -crossOf(arc.along, r[i]);
    if (dotOf(r[i], arc.along) < -slack || dotOf(b.points[i] - arc.to, arc.alongTo) > slack) return false;
  }
  double most = 0.0;
  for (int m = 0; m <= 2 * n; ++m) {
    double c = 0.0;
    for (int i = std::max(0, m - n); i <= std::min(n, m); ++i)
      c += kBinomials[n][i] * kBinomials[n][m - i] * (arc.curvature * dotOf(r[i], r[m - i]) + 2.0 * out[i]);
    most = std::max(most, std::abs(c) / kBinomials[2 * n][m]);
  }
  const double least =
      1.0 - std::abs(arc.curvature) * most;  // of the squared distance to the centre, in radii
  return least > 0.0 && most / (1.0 + std::sqrt(least)) <= tolerance - slack;
}

class ContourWriter {
 public:
  explicit ContourWriter(double tolerance) : tolerance_(tolerance) {}

  /// Of what is not closed the last corner is the end.
  ArcContour contourOf(const Contour& contour, bool isClosed) {
    corners_.clear();
    glm::dvec2 at = contour.from;
    for (const Curve& c : contour.curves) {
      if (c.controls == 0)
        line(at);
      else if (c.controls == 1)
        curve({2, {at, c.control[0], c.to}}, kMostHalvings);
      else
        curve({3, {at, c.control[0], c.control[1], c.to}}, kMostHalvings);
      at = c.to;
    }
    line(at);
    return risingOrFalling(isClosed);
  }

 private:
  static constexpr int kMostHalvings = 20;

  void line(const glm::dvec2& from) { corners_.push_back({from, 0.0}); }

  void curve(const Bezier& b, int halvings) {
    if (lengthOf(b.last() - b.first()) == 0.0 && halvings < kMostHalvings) return;
    if (halvings == 0 || isStraight(b)) return line(b.first());
    if (writeArcs(b)) return;
    const auto halves = b.cut(0.5);
    curve(halves.first, halvings - 1);
    curve(halves.second, halvings - 1);
  }

  // Do the control points lie on the segment, in this order?
  static bool isStraight(const Bezier& b) {
    const glm::dvec2 way = b.last() - b.first();
    const double squared = dotOf(way, way);
    double before = 0.0;
    for (int i = 1; i < b.degree; ++i) {
      const glm::dvec2 r = b.points[i] - b.first();
      const double along = dotOf(r, way);
      if (std::abs(crossOf(way, r)) > 1e-14 * squared || along < before || along > squared) return false;
      before = along;
    }
    return squared > 0.0;
  }

  bool writeArcs(const Bezier& b) {
    const glm::dvec2 start = directionAtStart(b), end = directionAtEnd(b);
    const auto joint = jointOf(b, start, end);
    if (!joint) return false;
    const auto parts = b.cut(*joint);
    const glm::dvec2& middle = parts.second.first();
    const ArcCorner first = arcTo(b.first(), start, middle);
    // The second one as it comes back from the end.
    const ArcCorner second{middle, -arcTo(b.last(), -end, middle).bulge};
    if (!isNear(parts.first, Arc::through(first, middle), tolerance_)) return false;
    if (!isNear(parts.second, Arc::through(second, b.last()), tolerance_)) return false;
    corners_.push_back(first);
    corners_.push_back(second);
    return true;
  }

  // Cuts arcs where they turn from rising to falling, and leaves out what has no length.
  ArcContour risingOrFalling(bool isClosed) const {
    ArcContour given, cut;
    for (const ArcCorner& c : corners_) {
      if (!given.empty() && given.back().at == c.at) given.pop_back();
      given.push_back(c);
    }
    while (isClosed && given.size() > 1 && given.back().at == given.front().at) given.pop_back();
    if (given.size() < 2) return {};
    const std::size_t arcs = isClosed ? given.size() : given.size() - 1;
    for (std::size_t i = 0; i < arcs; ++i) {
      const glm::dvec2& to = given[(i + 1) % given.size()].at;
      const Arc arc = Arc::through(given[i], to);
      cut.push_back(given[i]);
      if (arc.curvature == 0.0 || arc.along.y * arc.alongTo.y >= 0.0) continue;
      const glm::dvec2 level(arc.along.x + arc.alongTo.x < 0.0 ? -1.0 : 1.0, 0.0), sum = arc.along + level;
      const glm::dvec2 top =
          arc.from + sum * (2.0 * crossOf(arc.along, level) / (dotOf(sum, sum) * arc.curvature));
      // What would be shorter has no direction to speak of, and hardly turns.
      if (std::min(lengthOf(top - arc.from), lengthOf(to - top)) < 1e-7 * arc.size) continue;
      cut.back() = arc.part(arc.from, top);
      cut.push_back(arc.part(top, to));
    }
    if (!isClosed) cut.push_back(given.back());
    return cut;
  }

  double tolerance_;
  ArcContour corners_;
};

}  // namespace

std::vector<ArcContour> arcContours(const Outline& outline, double tolerance) {
  std::vector<ArcContour> contours;
  ContourWriter writer(tolerance);
  for (const Contour& c : outline.contours) {
    const bool isClosed = !outline.stroke || c.isClosed;
    ArcContour made = writer.contourOf(c, isClosed);
    if (made.size() < 2) continue;
    if (outline.stroke) {
      std::ranges::move(strokeContours(made, isClosed, *outline.stroke), std::back_inserter(contours));
    } else {
      contours.push_back(std::move(made));
    }
  }
  return contours;
}

}  // namespace sdf
