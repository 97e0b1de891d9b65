#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/mesh/refine/remesh_fan_samples.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// The t in reach that makes the largest |d + a t| least, all a being positive: where the largest d + a t and
// the largest -(d + a t) are equal.
class Balance {
 public:
  void add(float d, float a) {
    if (a > 0.05f) lines_.push_back({d, a}), reach_ = std::max(reach_, std::abs(d));
  }
  void clear() { lines_.clear(), reach_ = 0.0f; }
  float solve() const {
    if (lines_.empty()) return 0.0f;
    float low = -4.0f * reach_, high = 4.0f * reach_;
    for (int k = 0; k < 14; ++k) {
      const float t = 0.5f * (low + high);
      float above = -HUGE_VALF, below = -HUGE_VALF;
      for (const auto& [d, a] : lines_) {
        above = std::max(above, d + a * t);
        below = std::max(below, -(d + a * t));
      }
      (above > below ? high : low) = t;
    }
    return 0.5f * (low + high);
  }

 private:
  std::vector<std::pair<float, float>> lines_;
  float reach_ = 0.0f;
};

// A triangle's readings at its centroid and at the middles of both spokes.
struct Three {
  const Reading* r[3] = {};
  glm::vec3 at[3];
};

// A thread's memory for judging.
struct Rooms {
  std::vector<FanSample> samples;
  std::vector<glm::vec3> facets;
  std::vector<float> areas;
  std::vector<std::pair<float, float>> spread;
  Balance sides[2];
  std::vector<Three> three;
};

// The errors of one fan from its readings.
class Judge {
 public:
  Judge(const FanView& view, std::span<const Reading> readings, float tolerance, Rooms& rooms)
      : view_(view),
        readings_(readings),
        tolerance_(tolerance),
        samples_(rooms.samples),
        facets_(rooms.facets),
        areas_(rooms.areas),
        spread_(rooms.spread),
        sides_(rooms.sides),
        three_(rooms.three) {
    samples_.clear(), facets_.clear(), areas_.clear();
    view.forEachSample([&](const FanSample& s) { samples_.push_back(s); });
  }

  FanError judge() {
    const Fan& fan = view_.fan;
    spread_.assign(fan.triangles(), {0.0f, 0.0f});
    FanError e;
    facets(e);
    for (std::size_t i = 0; i < samples_.size(); ++i) take(i, e);
    extrema(e);
    if (view_.hasCentre() && fan.creases == 0) extremaOnSpokes(e);
    if (!(e.largest < HUGE_VALF)) e.sound = false;
    if (!view_.hasCentre()) return e;
    offset(e);
    balance(e);
    descend(e);
    return e;
  }

 private:
  void addEnergy(float distance, FanError& e) const {
    const float share = std::min(distance / tolerance_, kLargestShare), square = share * share,
                fourth = square * square, eighth = fourth * fourth;
    e.energy += eighth * eighth;
  }

  void facets(FanError& e) {
    const Fan& fan = view_.fan;
    for (std::uint32_t i = 0; i < fan.triangles(); ++i) {
      const Facet facet(fan.centre, view_.end(i), view_.end(view_.after(i)), tolerance_);
      if (!facet.sound) e.sound = false;
      facets_.push_back(facet.size > 0.0f ? facet.area / facet.size : facet.area);
      areas_.push_back(facet.size);
    }
  }

  void take(std::size_t i, FanError& e) {
    const FanSample& s = samples_[i];
    const Reading& r = readings_[i];
    float d = std::abs(r.distance);
    // On a crease, of two readings the second's: to the line where both planes meet.
    if (s.at != s.of && i > 0 && samples_[i - 1].of == s.of) {
      const Reading& o = readings_[i - 1];
      const float c = glm::dot(r.normal, o.normal);
      if (std::abs(c) < kOneSide) d = glm::length(leastStep(r.normal, o.normal, r.distance, o.distance));
    }
    if (!(d <= e.largest)) e.largest = d, e.worst = s.triangle;
    if (s.kind == FanSample::Spoke && !(d <= e.spoke)) {
      const bool second = s.at != s.of && samples_[i - 1].of == s.of;
      e.spoke = d, e.worstSpoke = second ? view_.after(s.triangle) : s.triangle;
    }
    if (s.kind == FanSample::Inner) return;
    addEnergy(d, e);
    if (!(glm::dot(facets_[s.triangle], r.normal) > kFacing)) e.sound = false;
    const auto spread = [&](std::uint32_t t) {
      auto& [low, high] = spread_[t];
      low = std::min(low, r.distance), high = std::max(high, r.distance);
    };
    spread(s.triangle);
    if (s.kind == FanSample::Spoke && s.at == s.of && view_.fan.closed)
      spread(s.triangle == 0 ? view_.fan.count - 1 : s.triangle - 1);
  }

  // The extremum of the quadratic function along each spoke that has the reading and the slope at its middle
  // and the reading at the centre: on a saddle the largest distances lie on edges, off their middles.
  void extremaOnSpokes(FanError& e) {
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const FanSample& s = samples_[i];
      if (s.kind != FanSample::Spoke) continue;
      const Reading& r = readings_[i];
      const glm::vec3 half = s.of - view_.fan.centre;
      const float slope = glm::dot(r.normal, half),
                  bend = 2.0f * (readings_[0].distance - r.distance + slope);
      if (!(std::abs(slope) < std::abs(bend))) continue;
      const float d = std::abs(r.distance - 0.5f * slope * slope / bend);
      addEnergy(d, e);
      if (d > e.largest) e.largest = d, e.worst = s.triangle;
      if (d > e.spoke) e.spoke = d, e.worstSpoke = s.triangle;
    }
  }

  // The extremum of the quadratic function that has the readings' gradients at the centroid and at the
  // middles of both spokes.
  void extrema(FanError& e) {
    const Fan& fan = view_.fan;
    std::vector<Three>& of = three_;
    of.assign(fan.triangles(), {});
    const auto put = [&](std::uint32_t t, int k, std::size_t i) {
      of[t].r[k] = &readings_[i], of[t].at[k] = samples_[i].of;
    };
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const FanSample& s = samples_[i];
      if (s.kind == FanSample::Centre || s.kind == FanSample::Inner) continue;
      if (s.kind == FanSample::Centroid) {
        put(s.triangle, 0, i);
        continue;
      }
      const bool beside = s.at != s.of, second = beside && samples_[i - 1].of == s.of;
      if (!second) put(s.triangle, 1, i);
      if (second) put(s.triangle, 2, i);
      if (!beside) put(s.triangle == 0 ? fan.count - 1 : s.triangle - 1, 2, i);
    }
    for (std::uint32_t t = 0; t < fan.triangles(); ++t) {
      const Three& f = of[t];
      if (!f.r[0] || !f.r[1] || !f.r[2]) continue;
      const glm::vec3 u = f.at[1] - f.at[0], v = f.at[2] - f.at[0], g = f.r[0]->normal;
      // In coordinates along u and v: the gradient, and the second derivatives, made symmetric.
      const glm::vec3 du = f.r[1]->normal - g, dv = f.r[2]->normal - g;
      const float gu = glm::dot(g, u), gv = glm::dot(g, v), a = glm::dot(du, u), c = glm::dot(dv, v),
                  b = 0.5f * (glm::dot(du, v) + glm::dot(dv, u)), det = a * c - b * b;
      const float x = -(gu * c - gv * b), y = -(gv * a - gu * b);
      // Inside the triangle: the centre is at (2, 2), the other corners at (-... ) of these coordinates.
      const float p = x / det, q = y / det;
      if (!(std::abs(p) < 2.0f && std::abs(q) < 2.0f)) continue;
      // u = (r0 - (c + r0 + r1)/3 ...): barycentric weights of the corners.
      const float w0 = 1.0f / 3.0f + p / 6.0f + q / 6.0f, w1 = 1.0f / 3.0f + p / 6.0f - q / 3.0f,
                  w2 = 1.0f / 3.0f - p / 3.0f + q / 6.0f;
      if (!(w0 >= 0.0f && w1 >= 0.0f && w2 >= 0.0f)) continue;
      const float d = std::abs(f.r[0]->distance + 0.5f * (gu * p + gv * q));
      addEnergy(d, e);
      if (d > e.largest) e.largest = d, e.worst = t;
    }
  }

  void descend(FanError& e) {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const float d = readings_[i].distance / tolerance_;
      sum -= d * d * d * std::abs(d * d) * samples_[i].weight * readings_[i].normal;
    }
    if (view_.fan.creases != 0) return;
    sum -= glm::dot(sum, e.normal) * e.normal;
    const float length = glm::length(sum);
    if (length > 0.0f) e.descent = sum / length;
  }

  void offset(FanError& e) {
    glm::vec3 normals[2]{glm::vec3(0.0f), glm::vec3(0.0f)};
    const bool two = view_.fan.creases == 2;
    const auto sector = [&](const FanSample& s) { return two && view_.inSecond(s.triangle) ? 1 : 0; };
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (samples_[i].kind == FanSample::Centre) normals[sector(samples_[i])] += readings_[i].normal;
    const bool apart = two && std::abs(glm::dot(normals[0], normals[1])) < kOneSide;
    e.normal = normals[0];
    e.smooth = two && !apart;
    e.onto = stepOnto(readings_.first(view_.centres()));
    for (Balance& side : sides_) side.clear();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const int k = apart ? sector(samples_[i]) : 0;
      if (samples_[i].kind == FanSample::Inner) continue;
      sides_[k].add(readings_[i].distance, samples_[i].weight * glm::dot(readings_[i].normal, normals[k]));
    }
    e.offset = apart ? leastStep(normals[0], normals[1], sides_[0].solve(), sides_[1].solve())
                     : normals[0] * sides_[0].solve();
  }

  // Towards the mean of the triangles' centroids, weighted by how much distance each spans, which grows with
  // its area in the curvature's metric (Chen, Holst 2011, for triangles of one size); along a crease, towards
  // the middle of its neighbours.
  void balance(FanError& e) {
    const Fan& fan = view_.fan;
    if (fan.creases == 2) {
      glm::vec3 sum(0.0f);
      for (const Fans::Spoke& s : view_.rim)
        if (s.crease) sum += s.end;
      e.balance = 0.5f * sum - fan.centre;
      return;
    }
    float areas = 0.0f, weights = 0.0f;
    for (const float a : areas_) areas += a;
    if (!(areas > 0.0f)) return;
    glm::vec3 sum(0.0f);
    for (std::uint32_t i = 0; i < fan.triangles(); ++i) {
      const float w = spread_[i].second - spread_[i].first + 1e-2f * tolerance_ * areas_[i] / areas;
      sum += w * view_.centroid(i);
      weights += w;
    }
    const glm::vec3 way = sum / weights - fan.centre;
    e.balance = way - glm::dot(way, e.normal) * e.normal;
  }

  const FanView& view_;
  std::span<const Reading> readings_;
  float tolerance_;
  std::vector<FanSample>& samples_;
  std::vector<glm::vec3>& facets_;
  std::vector<float>& areas_;
  std::vector<std::pair<float, float>>& spread_;
  Balance (&sides_)[2];
  std::vector<Three>& three_;
};

}  // namespace

void evaluateFans(const Fans& fans, float tolerance, Sampling sampling, const LocalField& field,
                  Progress& progress, std::vector<FanError>& errors) {
  if (fans.all.empty()) return errors.clear();
  const float spacing = sampling == Sampling::Few
                            ? HUGE_VALF
                            : static_cast<float>(field.finder()->at(fans.all[0].centre).voxel);
  std::vector<std::size_t> first{0};
  for (std::size_t i = 0; i < fans.all.size(); ++i)
    first.push_back(first.back() + FanView(fans, i, tolerance, spacing).samples());
  std::vector<glm::vec3> points(first.back());
  std::vector<Reading> readings(first.back());
  tbb::parallel_for(std::size_t{0}, fans.all.size(), [&](std::size_t i) {
    std::size_t k = first[i];
    FanView(fans, i, tolerance, spacing).forEachSample([&](const FanSample& s) { points[k++] = s.at; });
  });
  forEachGradient(points, field, progress, [&](std::size_t i, const RunGradients& g, std::size_t k) {
    readings[i] = {g.distance(k), g.normal(k)};
  });
  errors.assign(fans.all.size(), {});
  tbb::enumerable_thread_specific<Rooms> rooms;
  if (progress.stopped()) return;
  tbb::parallel_for(std::size_t{0}, fans.all.size(), [&](std::size_t i) {
    const FanView view(fans, i, tolerance, spacing);
    const std::span<Reading> own(readings.data() + first[i], first[i + 1] - first[i]);
    std::size_t k = 0;
    view.forEachSample([&](const FanSample& s) {
      Reading& r = own[k++];
      r.distance += glm::dot(r.normal, s.of - s.at);
    });
    errors[i] = Judge(view, own, tolerance, rooms.local()).judge();
  });
}

}  // namespace sdf
