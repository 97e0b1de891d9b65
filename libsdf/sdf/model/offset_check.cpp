#include "sdf/model/offset_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/base/random_point.h"
#include "sdf/eval/scalar_reading.h"

namespace sdf {

namespace {

// Lines through the region and readings along each, and what is looked at of what they meet. Chosen: a check
// takes 1 to 15 ms.
constexpr int kLines = 160, kMostEdges = 24, kMostPoints = 48;
constexpr int kAlongLine = 32, kHalvings = 24;
// How far the offset is looked for, in its amount.
constexpr double kFarthest = 6.0;
constexpr int kOutward = 48;
constexpr double kTurned = 0.9;  // cosine of the angle by which the normals at an edge differ at least

struct Place {
  glm::dvec3 at, normal;
};

// A zero between two places, of which f is positive at one alone.
template <class F>
glm::dvec3 between(const F& f, glm::dvec3 lo, glm::dvec3 hi) {
  const bool positive = f(lo) > 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const glm::dvec3 mid = 0.5 * (lo + hi);
    ((f(mid) > 0.0) == positive ? lo : hi) = mid;
  }
  return lo;
}

class OffsetCheck {
 public:
  OffsetCheck(const OffsetToCheck& offset, const Values& values)
      : of_(Function(offset.of).at(values)),
        offset_(Function(offset.offset).at(values)),
        amount_(Function(offset.amount).uniform(values)[0]),
        region_(finite(offset.bounds)) {
    findSurface();
    if (offset.edges) findEdges();
  }

  double amount() const { return amount_; }

  // The distances from the points of the offset on one side.
  std::vector<double> distances(double side) const {
    std::vector<double> found;
    const std::size_t step = std::max<std::size_t>(1, surface_.size() / kMostPoints);
    for (std::size_t i = 0; i < surface_.size(); i += step) add(surface_[i], side, found);
    for (const Place& edge : edges_) add(edge, side, found);
    return found;
  }

 private:
  static Box finite(const Box& bounds) {
    Box box = bounds;
    double size = 0.0;
    for (int i = 0; i < 3; ++i)
      if (box.max[i] - box.min[i] < kInfinity) size = std::max(size, box.max[i] - box.min[i]);
    if (size == 0.0) size = 1.0;
    for (int i = 0; i < 3; ++i) {
      const bool below = box.min[i] > -kInfinity, above = box.max[i] < kInfinity;
      if (!below) box.min[i] = above ? box.max[i] - size : -size;
      if (!above) box.max[i] = below ? box.min[i] + size : size;
    }
    // Surfaces that lie in their bounds are crossed by lines that begin outside.
    return box.grown(0.05 * size);
  }

  double f(const glm::dvec3& p) const { return evaluate(*of_, p); }
  double g(const glm::dvec3& p) const { return evaluate(*offset_, p); }

  std::optional<Place> placeAt(const glm::dvec3& p) const {
    const glm::dvec3 gradient = evaluateGradient(*of_, p).gradient;
    const double length = glm::length(gradient);
    if (!(length > 0.0 && length < kInfinity)) return {};
    return Place{p, gradient / length};
  }

  void findSurface() {
    std::mt19937 random(1);
    for (int line = 0; line < kLines; ++line) {
      const glm::dvec3 from = pointIn(region_, random), way = pointIn(region_, random) - from;
      glm::dvec3 last = from;
      bool wasOut = f(last) > 0.0;
      for (int i = 1; i <= kAlongLine; ++i) {
        const glm::dvec3 next = from + way * (static_cast<double>(i) / kAlongLine);
        const bool isOut = f(next) > 0.0;
        if (isOut != wasOut)
          if (const auto place = placeAt(between([&](const glm::dvec3& p) { return f(p); }, last, next)))
            surface_.push_back(*place);
        last = next, wasOut = isOut;
      }
    }
  }

  // The place moved onto the surface along gradients.
  std::optional<Place> onSurface(glm::dvec3 p) const {
    constexpr int kSteps = 8;
    for (int i = 0; i < kSteps; ++i) {
      const ValueAndGradient v = evaluateGradient(*of_, p);
      const double square = glm::dot(v.gradient, v.gradient);
      if (!(square > 0.0 && square < kInfinity) || v.value != v.value) return {};
      const glm::dvec3 step = v.gradient * (v.value / square);
      p -= step;
      if (glm::length(step) < 1e-6 * amount_) return placeAt(p);
    }
    return {};
  }

  void findEdges() {
    for (std::size_t i = 0; i + 1 < surface_.size() && edges_.size() < kMostEdges; ++i) {
      Place a = surface_[i], b = surface_[i + 1];
      for (int k = 0; k < kHalvings && glm::dot(a.normal, b.normal) < kTurned; ++k) {
        const auto mid = onSurface(0.5 * (a.at + b.at));
        if (!mid) break;
        (glm::dot(a.normal, mid->normal) < glm::dot(b.normal, mid->normal) ? b : a) = *mid;
      }
      const glm::dvec3 both = a.normal + b.normal;
      const bool isEdge =
          glm::distance(a.at, b.at) < 1e-3 * amount_ && glm::dot(a.normal, b.normal) < kTurned;
      if (isEdge && glm::length(both) > 1e-3)
        edges_.push_back({0.5 * (a.at + b.at), glm::normalize(both)}), sides_.insert(sides_.end(), {a, b});
    }
  }

  // Along the normal, and then to the surface.
  void add(const Place& from, double side, std::vector<double>& found) const {
    const glm::dvec3 way = side * kFarthest * amount_ * from.normal;
    glm::dvec3 last = from.at;
    for (int i = 1; i <= kOutward; ++i) {
      const glm::dvec3 next = from.at + way * (static_cast<double>(i) / kOutward);
      if (g(next) > 0.0) {
        if (!(g(last) > 0.0))
          found.push_back(toSurface(between([&](const glm::dvec3& p) { return g(p); }, last, next), from));
        return;
      }
      last = next;
    }
  }

  double toSurface(const glm::dvec3& p, const Place& from) const {
    constexpr std::size_t kNearest = 4;
    std::vector<std::pair<double, const Place*>> all;
    for (const Place& s : surface_) all.emplace_back(glm::distance(s.at, p), &s);
    for (const Place& s : sides_) all.emplace_back(glm::distance(s.at, p), &s);
    std::ranges::nth_element(all, all.begin() + std::min(kNearest, all.size() - 1), {},
                             [](const auto& a) { return a.first; });
    double least = nearestFrom(p, from);
    for (std::size_t i = 0; i < std::min(kNearest, all.size()); ++i)
      least = std::min(least, nearestFrom(p, *all[i].second));
    return least;
  }

  // By steps along the surface, which are halved where they lead away.
  double nearestFrom(const glm::dvec3& p, Place at) const {
    constexpr int kSteps = 24;
    double distance = glm::distance(at.at, p), share = 0.7;
    for (int i = 0; i < kSteps && share > 0.01; ++i) {
      const glm::dvec3 way = p - at.at;
      const glm::dvec3 along = way - glm::dot(way, at.normal) * at.normal;
      if (glm::length(along) < 1e-3 * distance) break;
      const auto next = onSurface(at.at + share * along);
      const double now = next ? glm::distance(next->at, p) : kInfinity;
      if (now < distance)
        at = *next, distance = now;
      else
        share *= 0.5;
    }
    return distance;
  }

  TapePtr of_, offset_;
  double amount_;
  Box region_;
  std::vector<Place> surface_;
  std::vector<Place> edges_;  // with the direction between their faces' normals
  std::vector<Place> sides_;  // of the edges, with either face's
};

}  // namespace

std::optional<OffsetFigures> checkOffset(const OffsetToCheck& offset, const Values& values) {
  const OffsetCheck check(offset, values);
  if (!(check.amount() > 0.0) || !(check.amount() < kInfinity)) return {};
  std::vector<double> all;
  for (const double side : {1.0, -1.0}) {
    if (!(side > 0.0 ? offset.out : offset.in)) continue;
    const std::vector<double> some = check.distances(side);
    all.insert(all.end(), some.begin(), some.end());
  }
  if (all.empty()) return {};
  const auto [least, most] = std::ranges::minmax(all);
  return OffsetFigures{least, most, check.amount()};
}

}  // namespace sdf
