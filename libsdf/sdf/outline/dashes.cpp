#include "sdf/outline/dashes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace sdf {
namespace {

// Of an arc's length: what is no longer is rounding, and has no direction to speak of.
constexpr double kNothing = 1e-9;

double periodOf(const Stroke& stroke) {
  const double sum = std::accumulate(stroke.dashes.begin(), stroke.dashes.end(), 0.0);
  return stroke.dashes.size() % 2 == 0 ? sum : 2.0 * sum;
}

class Dasher {
 public:
  explicit Dasher(const Stroke& stroke) : lengths_(stroke.dashes) {
    if (lengths_.size() % 2 == 1) lengths_.insert(lengths_.end(), stroke.dashes.begin(), stroke.dashes.end());
    const double period = periodOf(stroke);
    double into = std::fmod(stroke.dashOffset, period);
    if (into < 0.0) into += period;
    while (into > 0.0 && into >= lengths_[turn_] && turn_ + 1 < lengths_.size()) into -= lengths_[turn_++];
    left_ = std::max(lengths_[turn_] - into, 0.0);
    startsDrawn_ = isDrawn();
  }

  void follow(const Arc& arc) {
    double at = 0.0;
    while (left_ < arc.size - at - kNothing * arc.size) {
      draw(arc, at, at + left_);
      at += left_;
      end(arc.at(at), arc.directionAt(at));
      turn_ = (turn_ + 1) % lengths_.size();
      left_ = lengths_[turn_];
    }
    draw(arc, at, arc.size);
    left_ = std::max(left_ - (arc.size - at), 0.0);
    last_ = &arc;
  }

  std::vector<Dash> finish(bool isClosed) {
    if (chain_.empty()) return std::move(dashes_);
    if (isClosed && startsDrawn_ && !dashes_.empty()) {
      ArcContour& first = dashes_.front().chain;
      first.insert(first.begin(), chain_.begin(), chain_.end());
    } else {
      end(last_->to, last_->alongTo);
    }
    return std::move(dashes_);
  }

 private:
  bool isDrawn() const { return turn_ % 2 == 0; }

  void draw(const Arc& arc, double begin, double end) {
    if (!isDrawn() || end - begin <= kNothing * arc.size) return;
    const glm::dvec2 from = begin == 0.0 ? arc.from : arc.at(begin),
                     to = end == arc.size ? arc.to : arc.at(end);
    chain_.push_back(arc.part(from, to));
  }

  void end(const glm::dvec2& at, const glm::dvec2& along) {
    if (!isDrawn()) return;
    chain_.push_back({at, 0.0});
    dashes_.push_back({std::exchange(chain_, {}), along});
  }

  std::vector<double> lengths_;  // drawn, not drawn, and so on
  std::size_t turn_ = 0;
  double left_ = 0.0;  // of the turn
  bool startsDrawn_ = false;
  const Arc* last_ = nullptr;
  ArcContour chain_;
  std::vector<Dash> dashes_;
};

double lengthBetween(const glm::dvec2& a, const glm::dvec2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

}  // namespace

std::vector<Dash> dashesOf(const ArcContour& chain, bool isClosed, const Stroke& stroke) {
  const std::vector<Arc> arcs = arcsOf(chain, isClosed);
  Dasher dasher(stroke);
  for (const Arc& arc : arcs) dasher.follow(arc);
  return dasher.finish(isClosed);
}

double mostDashes(const Outline& outline) {
  if (!outline.stroke || !outline.stroke->isDashed()) return 0.0;
  double length = 0.0;
  for (const Contour& contour : outline.contours) {
    glm::dvec2 at = contour.from;
    for (const Curve& c : contour.curves) {
      for (int i = 0; i < c.controls; ++i)
        length += lengthBetween(std::exchange(at, c.control[i]), c.control[i]);
      length += lengthBetween(std::exchange(at, c.to), c.to);
    }
    length += lengthBetween(at, contour.from);
  }
  const Stroke& stroke = *outline.stroke;
  const double each = 0.5 * static_cast<double>(stroke.dashes.size() * (1 + stroke.dashes.size() % 2));
  return each * (length / periodOf(stroke) + static_cast<double>(outline.contours.size()));
}

}  // namespace sdf
