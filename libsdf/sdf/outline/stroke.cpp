#include "sdf/outline/stroke.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "sdf/outline/dashes.h"

namespace sdf {
namespace {

// Angles, and half widths in radii, that are no nearer to the limit are beyond it: rounding is far less.
constexpr double kSlack = 1e-9;
// Arcs that turn by less where they meet run on smoothly.
constexpr double kSmooth = 1e-6;

glm::dvec2 rightOf(const glm::dvec2& d) { return {d.y, -d.x}; }

class Stroker {
 public:
  Stroker(const ArcContour& chain, bool isClosed, const Stroke& stroke)
      : stroke_(stroke), half_(0.5 * stroke.width), isClosed_(isClosed), arcs_(arcsOf(chain, isClosed)) {
    for (const ArcCorner& corner : chain) bulges_.push_back(corner.bulge);
  }

  std::vector<ArcContour> run() {
    for (std::size_t first = 0; first < arcs_.size();) {
      std::size_t end = first + 1;
      if (isTight(arcs_[first])) {
        fan(first);
      } else {
        while (end < arcs_.size() && !isTight(arcs_[end]) && isSmooth(arcs_[end - 1], arcs_[end])) ++end;
        band(first, end);
      }
      first = end;
    }
    for (std::size_t i = 1; i < arcs_.size(); ++i) join(arcs_[i - 1], arcs_[i]);
    const Arc &first = arcs_.front(), &last = arcs_.back();
    if (isClosed_) {
      join(last, first);
    } else {
      cap(first.from, -first.along);
      cap(last.to, last.alongTo);
    }
    return std::move(contours_);
  }

  /// What a dash of no length covers: its caps.
  std::vector<ArcContour> dot(const glm::dvec2& at, const glm::dvec2& along) {
    cap(at, -along);
    cap(at, along);
    return std::move(contours_);
  }

 private:
  static double turnBetween(const Arc& a, const Arc& b) {
    return std::atan2(crossOf(a.alongTo, b.along), dotOf(a.alongTo, b.along));
  }
  static bool isSmooth(const Arc& a, const Arc& b) { return std::abs(turnBetween(a, b)) < kSmooth; }
  // Does one of its parallels lie beyond the centre?
  bool isTight(const Arc& arc) const { return half_ * std::abs(arc.curvature) > 1.0 - kSlack; }

  // The places beside an arc's ends, `side` half widths to the right.
  glm::dvec2 start(const Arc& arc, double side) const { return arc.from + side * half_ * rightOf(arc.along); }
  glm::dvec2 end(const Arc& arc, double side) const { return arc.to + side * half_ * rightOf(arc.alongTo); }

  // Arcs that run on smoothly: their parallels to the right, and back to the left.
  void band(std::size_t first, std::size_t last) {
    ArcContour contour;
    for (std::size_t i = first; i < last; ++i) contour.push_back({start(arcs_[i], 1.0), bulges_[i]});
    contour.push_back({end(arcs_[last - 1], 1.0), 0.0});
    for (std::size_t i = last; i-- > first;) contour.push_back({end(arcs_[i], -1.0), -bulges_[i]});
    contour.push_back({start(arcs_[first], -1.0), 0.0});
    contours_.push_back(std::move(contour));
  }

  // What the line across a tight arc covers: a slice on either side of the centre.
  void fan(std::size_t i) {
    const Arc& arc = arcs_[i];
    const double outer = arc.curvature > 0.0 ? 1.0 : -1.0;
    const glm::dvec2 centre = arc.from - rightOf(arc.along) / arc.curvature;
    for (const double side : {outer, -outer}) {
      if (side != outer && half_ * std::abs(arc.curvature) < 1.0 + kSlack) continue;
      if (arc.curvature > 0.0)
        contours_.push_back({{centre, 0.0}, {start(arc, side), bulges_[i]}, {end(arc, side), 0.0}});
      else
        contours_.push_back({{centre, 0.0}, {end(arc, side), -bulges_[i]}, {start(arc, side), 0.0}});
    }
  }

  void join(const Arc& before, const Arc& after) {
    if (isSmooth(before, after)) return;
    const double turn = turnBetween(before, after);
    const glm::dvec2 &at = after.from, out = turn > 0.0 ? rightOf(before.alongTo) : -rightOf(after.along),
                     outAfter = turn > 0.0 ? rightOf(after.along) : -rightOf(before.alongTo);
    const double angle = std::abs(turn);
    if (stroke_.join == Stroke::Join::Round) return slice(at, out, angle);
    if (angle > std::numbers::pi - kSmooth) return;  // there and back
    ArcContour contour{{at, 0.0}, {at + half_ * out, 0.0}, {at + half_ * outAfter, 0.0}};
    if (stroke_.join == Stroke::Join::Miter && stroke_.miterLimit * std::cos(0.5 * angle) >= 1.0) {
      const glm::dvec2 tip = (out + outAfter) / (1.0 + dotOf(out, outAfter));
      contour.insert(contour.begin() + 2, {at + half_ * tip, 0.0});
    }
    contours_.push_back(std::move(contour));
  }

  // At an end, beyond which d leads.
  void cap(const glm::dvec2& at, const glm::dvec2& d) {
    const glm::dvec2 right = half_ * rightOf(d), beyond = half_ * d;
    if (stroke_.cap == Stroke::Cap::Round) slice(at, rightOf(d), std::numbers::pi);
    if (stroke_.cap == Stroke::Cap::Square)
      contours_.push_back(
          {{at + right, 0.0}, {at + right + beyond, 0.0}, {at - right + beyond, 0.0}, {at - right, 0.0}});
  }

  // Of a disc, to the left from a direction, cut along the axes: arcs only rise or fall.
  void slice(const glm::dvec2& centre, const glm::dvec2& from, double angle) {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    const double begin = std::atan2(from.y, from.x), last = begin + angle;
    ArcContour contour{{centre, 0.0}};
    double at = begin;
    while (at < last) {
      double next = kQuarter * std::floor(at / kQuarter + 1.0);
      if (next - at < kSmooth) next += kQuarter;
      if (last - next < kSmooth) next = last;
      const glm::dvec2 d = at == begin ? from : glm::dvec2(std::cos(at), std::sin(at));
      contour.push_back({centre + half_ * d, std::tan(0.25 * (next - at))});
      at = next;
    }
    contour.push_back({centre + half_ * glm::dvec2(std::cos(last), std::sin(last)), 0.0});
    contours_.push_back(std::move(contour));
  }

  const Stroke& stroke_;
  const double half_;
  const bool isClosed_;
  std::vector<Arc> arcs_;
  std::vector<double> bulges_;
  std::vector<ArcContour> contours_;
};

}  // namespace

std::vector<ArcContour> strokeContours(const ArcContour& chain, bool isClosed, const Stroke& stroke) {
  if (!stroke.isDashed()) return Stroker(chain, isClosed, stroke).run();
  const std::vector<Dash> dashes = dashesOf(chain, isClosed, stroke);
  const auto isAllAround = [](const ArcContour& c) { return c.size() > 1 && c.front().at == c.back().at; };
  if (isClosed && dashes.size() == 1 && isAllAround(dashes[0].chain))
    return Stroker(chain, true, stroke).run();
  std::vector<ArcContour> contours;
  for (const Dash& dash : dashes) {
    Stroker stroker(dash.chain, false, stroke);
    std::ranges::move(dash.chain.size() > 1 ? stroker.run() : stroker.dot(dash.chain[0].at, dash.along),
                      std::back_inserter(contours));
  }
  return contours;
}

}  // namespace sdf
