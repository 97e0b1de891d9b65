#include "sdf/mesh/extract/rims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {
namespace {

using glm::dvec2;

/// A point of the outline, and how far what follows is from the chord to the next point, and turns by.
struct OutlinePoint {
  dvec2 at;
  bool isSharp;
  double sagitta, turn;
};

// Arcs are divided so that chords may be a little shorter or longer than they are.
void addSide(const PolygonSide& side, double tolerance, std::vector<OutlinePoint>& points) {
  constexpr double kShareOfSagitta = 0.1, kMostTurn = 0.25;
  const double turn = std::abs(side.curvature) * side.size,
               parts = std::sqrt(side.sagitta() / (kShareOfSagitta * tolerance));
  const int count = 1 + static_cast<int>(std::max(parts, turn / kMostTurn));
  const bool isSharp = std::abs(side.atFrom) > std::tan(0.5 * kCreaseAngle);
  const dvec2 left(-side.along.y, side.along.x);
  for (int i = 0; i < count; ++i) {
    const double length = side.size * i / count, half = 0.5 * side.curvature * length;
    const double chord = half == 0.0 ? length : length * (std::sin(half) / half);
    points.push_back({side.from + chord * (std::cos(half) * side.along + std::sin(half) * left),
                      i == 0 && isSharp, side.sagitta() / (count * count), turn / count});
  }
}

double distanceToLine(const dvec2& p, const dvec2& a, const dvec2& b) {
  const dvec2 way = b - a;
  return std::abs(crossOf(way, p - a)) / std::hypot(way.x, way.y);
}

// The longest chord from a point that may be drawn: the point that it ends in, counted on beyond the last.
std::size_t endOfChord(const std::vector<OutlinePoint>& points, std::size_t from, std::size_t last,
                       double tolerance) {
  constexpr double kMostTurn = 1.0;  // so that a chord does not pass a contour's other side
  const auto at = [&](std::size_t i) -> const OutlinePoint& { return points[i % points.size()]; };
  double turn = at(from).turn;
  std::size_t end = from + 1;
  for (; end < last && !at(end).isSharp; ++end) {
    turn += at(end).turn;
    if (turn > kMostTurn) break;
    const dvec2 a = at(from).at, b = at(end + 1).at;
    const auto strays = [&](std::size_t i) {
      return distanceToLine(at(i).at, a, b) + std::max(at(i - 1).sagitta, at(i).sagitta) > tolerance;
    };
    bool isFar = false;
    for (std::size_t i = from + 1; i <= end && !isFar; ++i) isFar = strays(i);
    if (isFar) break;
  }
  return end;
}

Rim rimOf(std::span<const PolygonSide> sides, double tolerance) {
  if (std::ranges::all_of(sides, [](const PolygonSide& s) { return s.curvature == 0.0; })) {
    Rim rim;
    for (const PolygonSide& s : sides)
      rim.push_back({s.from, std::abs(s.atFrom) > std::tan(0.5 * kCreaseAngle)});
    return rim;
  }
  std::vector<OutlinePoint> points;
  for (const PolygonSide& side : sides) addSide(side, tolerance, points);
  const auto sharp = std::ranges::find(points, true, &OutlinePoint::isSharp);
  const auto first = static_cast<std::size_t>(sharp == points.end() ? 0 : sharp - points.begin());
  Rim rim;
  for (std::size_t i = first, last = first + points.size(); i < last;) {
    const OutlinePoint& p = points[i % points.size()];
    rim.push_back({p.at, p.isSharp});
    i = endOfChord(points, i, last, tolerance);
  }
  return rim;
}

double areaOf(const Rim& rim) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < rim.size(); ++i)
    area += crossOf(rim[i].at - rim[0].at, rim[i + 1].at - rim[0].at);
  return area;
}

bool isWithin(const dvec2& p, const Rim& rim) {
  bool inside = false;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const dvec2 &a = rim[i].at, &b = rim[(i + 1) % rim.size()].at;
    if ((a.y > p.y) != (b.y > p.y) && (crossOf(b - a, p - a) > 0.0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

/// A polygon that takes holes in. Its corners are indices of points.
class Bridges {
 public:
  Bridges(const std::vector<dvec2>& points, std::vector<std::uint32_t> outer)
      : points_(points), corners_(std::move(outer)) {}

  // The hole's rightmost point is joined to a corner that it sees.
  bool take(const std::vector<std::uint32_t>& hole) {
    const auto right = std::ranges::max_element(hole, {}, [&](std::uint32_t i) { return points_[i].x; });
    const auto corner = cornerSeenFrom(points_[*right]);
    if (!corner) return false;
    std::vector<std::uint32_t> there(right, hole.end());
    there.insert(there.end(), hole.begin(), right);
    there.push_back(*right);
    there.push_back(corners_[*corner]);
    corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(*corner) + 1, there.begin(), there.end());
    return true;
  }
  const std::vector<std::uint32_t>& corners() const { return corners_; }

 private:
  const dvec2& at(std::size_t i) const { return points_[corners_[i % corners_.size()]]; }

  // Of the edge that p sees to its right the farther end, unless corners hide it: then the one of these that
  // is seen at the smallest angle.
  std::optional<std::size_t> cornerSeenFrom(const dvec2& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t edge = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const dvec2 &a = at(i), &b = at(i + 1);
      if (!(a.y <= p.y && p.y < b.y)) continue;
      const double x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
      if (x >= p.x && x < nearest) nearest = x, edge = i;
    }
    if (!std::isfinite(nearest)) return {};
    const std::size_t end = at(edge).x > at(edge + 1).x ? edge : (edge + 1) % corners_.size();
    std::size_t best = end;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (i != end && !isHiding(at(i), p, {nearest, p.y}, at(end))) continue;
      if (!isOpenTo(i, p)) continue;
      const dvec2 way = at(i) - p;
      const double angle = std::abs(std::atan2(way.y, way.x));
      const bool isNearer = angle == least && dotOf(way, way) < dotOf(at(best) - p, at(best) - p);
      if (angle < least || isNearer) best = i, least = angle;
    }
    return std::isfinite(least) ? std::optional(best) : std::nullopt;
  }
  static bool isHiding(const dvec2& q, const dvec2& a, dvec2 b, dvec2 c) {
    if (crossOf(b - a, c - a) < 0.0) std::swap(b, c);
    return crossOf(b - a, q - a) >= 0.0 && crossOf(c - b, q - b) >= 0.0 && crossOf(a - c, q - c) >= 0.0;
  }
  // Does p lie within the angle of corner i, seen from it?
  bool isOpenTo(std::size_t i, const dvec2& p) const {
    const dvec2 q = at(i), in = q - at(i + corners_.size() - 1), out = at(i + 1) - q;
    const bool leftOfIn = crossOf(in, p - q) >= 0.0, leftOfOut = crossOf(out, p - q) >= 0.0;
    return crossOf(in, out) >= 0.0 ? leftOfIn && leftOfOut : leftOfIn || leftOfOut;
  }

  const std::vector<dvec2>& points_;
  std::vector<std::uint32_t> corners_;
};

/// All rims' points in one row.
struct RimIndices {
  std::vector<dvec2> points;
  std::vector<std::vector<std::uint32_t>> rims;

  explicit RimIndices(const std::vector<Rim>& all) {
    for (const Rim& rim : all) {
      std::vector<std::uint32_t>& own = rims.emplace_back(rim.size());
      std::iota(own.begin(), own.end(), static_cast<std::uint32_t>(points.size()));
      for (const RimPoint& p : rim) points.push_back(p.at);
    }
  }
  double rightmost(std::size_t rim) const {
    double x = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : rims[rim]) x = std::max(x, points[i].x);
    return x;
  }
};

}  // namespace

std::vector<Rim> rimsOf(const PolygonDistance& outline, double tolerance) {
  std::vector<Rim> rims;
  std::span<const PolygonSide> left = outline.sides();
  for (const std::size_t count : outline.contourSizes()) {
    rims.push_back(rimOf(left.first(count), tolerance));
    left = left.subspan(count);
  }
  return rims;
}

std::optional<std::vector<std::vector<std::uint32_t>>> bridgedRims(const std::vector<Rim>& rims) {
  const RimIndices all(rims);
  std::vector<double> areas;
  for (const Rim& rim : rims) areas.push_back(areaOf(rim));
  std::vector<std::vector<std::size_t>> holes(rims.size());
  for (std::size_t i = 0; i < rims.size(); ++i) {
    if (areas[i] > 0.0) continue;
    std::optional<std::size_t> around;
    for (std::size_t k = 0; k < rims.size(); ++k)
      if (areas[k] > 0.0 && (!around || areas[k] < areas[*around]) && isWithin(rims[i][0].at, rims[k]))
        around = k;
    if (!around) return {};
    holes[*around].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> polygons;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    if (areas[i] <= 0.0) continue;
    std::ranges::sort(holes[i], std::greater<>(), [&](std::size_t hole) { return all.rightmost(hole); });
    Bridges bridges(all.points, all.rims[i]);
    for (const std::size_t hole : holes[i])
      if (!bridges.take(all.rims[hole])) return {};
    polygons.push_back(bridges.corners());
  }
  return polygons;
}

}  // namespace sdf
