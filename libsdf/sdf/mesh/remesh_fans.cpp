#include "sdf/mesh/remesh_fans.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/mesh/surface_points.h"

namespace sdf {
namespace {

// Beside creases the field is read so many tolerances inside the triangle, where it is the triangle's own
// side's: a crease is at most one tolerance beside the mesh's.
constexpr float kBeside = 4.0f;
// Facets' normals stay within 60 degrees of the gradient.
constexpr float kCosine = 0.5f;
// A triangle's least height: in tolerances, and in units of its corners' rounding.
constexpr float kHeight = 0.02f, kRounding = 16.0f * 0x1p-24f;
// Sides of a crease that meet at less than 5 degrees (cosine) are one.
constexpr float kSmooth = 0.9962f;

// A distance to be read at `at` for the point `of` of the mesh, which moves by `weight` times what the centre
// does.
struct Sample {
  glm::vec3 of, at;
  float weight;
  std::uint32_t triangle;  // of the fan
};

// What was read: signed distance at Sample::of, and the unit gradient.
struct Reading {
  float distance;
  glm::vec3 normal;
};

// One fan with its rim at hand.
struct View {
  const Fan& fan;
  std::span<const Fans::Spoke> rim;
  float beside;

  View(const Fans& fans, std::size_t i, float tolerance)
      : fan(fans.all[i]), rim(fans.rim.data() + fan.first, fan.count), beside(kBeside * tolerance) {}

  const glm::vec3& end(std::uint32_t i) const { return rim[i].end; }
  std::uint32_t after(std::uint32_t i) const { return i + 1 == fan.count ? 0 : i + 1; }
  glm::vec3 centroid(std::uint32_t i) const { return (fan.centre + end(i) + end(after(i))) / 3.0f; }
  bool hasCentre() const { return fan.closed && fan.centred; }

  // From a point of the mesh on a crease a little into one triangle beside it, at right angles to `along`.
  glm::vec3 besideOf(const glm::vec3& p, const glm::vec3& along, std::uint32_t triangle) const {
    glm::vec3 way = centroid(triangle) - p;
    if (const float l = glm::dot(along, along); l > 0.0f) way -= along * (glm::dot(way, along) / l);
    const float length = glm::length(way);
    return length > beside ? p + way * (beside / length) : p + way;
  }

  // Calls take(sample) for each: at the centre, once for each sector; in each triangle; on each spoke,
  // creases from either side.
  template <class Take>
  void forEachSample(const Take& take) const {
    const std::uint32_t n = fan.triangles();
    if (hasCentre() && fan.creases == 0) take(Sample{fan.centre, fan.centre, 1.0f, 0});
    if (hasCentre() && fan.creases > 0)
      forEachSector([&](std::uint32_t first, std::uint32_t count) {
        const std::uint32_t middle = (first + count / 2) % fan.count;
        take(Sample{fan.centre, besideOf(fan.centre, glm::vec3(0.0f), middle), 1.0f, middle});
      });
    for (std::uint32_t i = 0; i < n; ++i) {
      const glm::vec3 c = centroid(i);
      take(Sample{c, c, 1.0f / 3.0f, i});
    }
    const std::uint32_t begin = fan.closed ? 0 : 1, spokes = fan.closed ? fan.count : fan.count - 1;
    for (std::uint32_t i = begin; i < spokes; ++i) {
      const glm::vec3 p = 0.5f * (fan.centre + end(i)), along = end(i) - fan.centre;
      const std::uint32_t before = i == 0 ? fan.count - 1 : i - 1;
      if (!rim[i].crease) {
        take(Sample{p, p, 0.5f, i});
        continue;
      }
      take(Sample{p, besideOf(p, along, i), 0.5f, i});
      take(Sample{p, besideOf(p, along, before), 0.5f, before});
    }
  }

  // Calls take(first triangle, number of triangles) for each sector, from the first crease on.
  template <class Take>
  void forEachSector(const Take& take) const {
    std::uint32_t i = 0;
    while (i < fan.count && !rim[i].crease) ++i;
    for (std::uint32_t k = 0; k < fan.creases; ++k) {
      std::uint32_t n = 1;
      while (!rim[(i + n) % fan.count].crease) ++n;
      take(i, n);
      i = (i + n) % fan.count;
    }
  }

  std::size_t samples() const {
    const std::size_t centre = hasCentre() ? std::max(1u, fan.creases) : 0;
    return centre + fan.triangles() + (fan.closed ? fan.count : fan.count - 2) + fan.creases;
  }

  // Which sector a triangle belongs to, for two of them.
  bool inSecond(std::uint32_t triangle) const {
    bool second = false;
    for (std::uint32_t i = 0; i <= triangle; ++i) second ^= rim[i].crease;
    return second;
  }
};

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

// The least step that moves by s along a and by t along b.
glm::vec3 leastStep(const glm::vec3& a, const glm::vec3& b, float s, float t) {
  const float c = glm::dot(a, b), det = 1.0f - c * c;
  return ((s - c * t) * a + (t - c * s) * b) / det;
}

// A triangle's readings at its centroid and at the middles of both spokes.
struct Three {
  const Reading* r[3] = {};
  glm::vec3 at[3];
};

// A thread's memory for judging.
struct Rooms {
  std::vector<Sample> samples;
  std::vector<glm::vec3> facets;
  std::vector<float> areas;
  std::vector<std::pair<float, float>> spread;
  Balance sides[2];
  std::vector<Three> three;
};

// The errors of one fan from its readings.
class Judge {
 public:
  Judge(const View& view, std::span<const Reading> readings, float tolerance, Rooms& rooms)
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
    view.forEachSample([&](const Sample& s) { samples_.push_back(s); });
  }

  FanError judge() {
    const Fan& fan = view_.fan;
    spread_.assign(fan.triangles(), {0.0f, 0.0f});
    FanError e;
    facets(e);
    for (std::size_t i = 0; i < samples_.size(); ++i) take(i, e);
    extrema(e);
    if (!(e.largest < HUGE_VALF)) e.sound = false;
    if (!view_.hasCentre()) return e;
    offset(e);
    balance(e);
    descend(e);
    return e;
  }

 private:
  void facets(FanError& e) {
    const Fan& fan = view_.fan;
    for (std::uint32_t i = 0; i < fan.triangles(); ++i) {
      const glm::vec3 &a = fan.centre, &b = view_.end(i), &c = view_.end(view_.after(i));
      const glm::vec3 area = glm::cross(b - a, c - a);
      const float size = glm::length(area);
      const float longest =
          std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
      const float scale = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), longest});
      if (!(size > longest * std::max(kHeight * tolerance_, kRounding * scale))) e.sound = false;
      facets_.push_back(size > 0.0f ? area / size : area);
      areas_.push_back(size);
    }
  }

  void take(std::size_t i, FanError& e) {
    const Sample& s = samples_[i];
    const Reading& r = readings_[i];
    float d = std::abs(r.distance);
    // On a crease, of two readings the second's: to the line where both planes meet.
    if (s.at != s.of && i > 0 && samples_[i - 1].of == s.of) {
      const Reading& o = readings_[i - 1];
      const float c = glm::dot(r.normal, o.normal);
      if (std::abs(c) < kSmooth) d = glm::length(leastStep(r.normal, o.normal, r.distance, o.distance));
    }
    if (!(d <= e.largest)) e.largest = d, e.worst = s.triangle;
    if (s.weight == 0.5f && !(d <= e.spoke)) {
      const bool second = s.at != s.of && samples_[i - 1].of == s.of;
      e.spoke = d, e.worstSpoke = second ? view_.after(s.triangle) : s.triangle;
    }
    const float share = d / tolerance_, square = share * share;
    e.energy += square * square * square * square;
    if (!(glm::dot(facets_[s.triangle], r.normal) > kCosine)) e.sound = false;
    const auto spread = [&](std::uint32_t t) {
      auto& [low, high] = spread_[t];
      low = std::min(low, r.distance), high = std::max(high, r.distance);
    };
    spread(s.triangle);
    if (s.weight == 0.5f && s.at == s.of && view_.fan.closed)
      spread(s.triangle == 0 ? view_.fan.count - 1 : s.triangle - 1);
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
      const Sample& s = samples_[i];
      if (s.weight == 1.0f) continue;
      if (s.weight != 0.5f) {
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
    const auto sector = [&](const Sample& s) { return two && view_.inSecond(s.triangle) ? 1 : 0; };
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (samples_[i].weight == 1.0f) normals[sector(samples_[i])] += readings_[i].normal;
    e.normal = normals[0];
    e.onto = -readings_[0].distance * readings_[0].normal;
    const bool apart = two && std::abs(glm::dot(normals[0], normals[1])) < kSmooth;
    if (apart)
      e.onto =
          leastStep(readings_[0].normal, readings_[1].normal, -readings_[0].distance, -readings_[1].distance);
    for (Balance& side : sides_) side.clear();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const int k = apart ? sector(samples_[i]) : 0;
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
    glm::vec3 sum(0.0f);
    for (std::uint32_t i = 0; i < fan.triangles(); ++i) {
      const float w = spread_[i].second - spread_[i].first + 1e-2f * tolerance_ * areas_[i] / areas;
      sum += w * view_.centroid(i);
      weights += w;
    }
    const glm::vec3 way = sum / weights - fan.centre;
    e.balance = way - glm::dot(way, e.normal) * e.normal;
  }

  const View& view_;
  std::span<const Reading> readings_;
  float tolerance_;
  std::vector<Sample>& samples_;
  std::vector<glm::vec3>& facets_;
  std::vector<float>& areas_;
  std::vector<std::pair<float, float>>& spread_;
  Balance (&sides_)[2];
  std::vector<Three>& three_;
};

}  // namespace

void Fans::begin(const glm::vec3& centre) {
  all.push_back({.centre = centre, .first = static_cast<std::uint32_t>(rim.size()), .count = 0});
}

void Fans::add(const RemeshTopology& mesh, std::uint32_t vertex, bool crease) {
  rim.push_back({mesh.positions[vertex], vertex, crease});
  ++all.back().count;
  all.back().creases += crease;
}

void Fans::addAround(const RemeshTopology& mesh, std::uint32_t v) {
  begin(mesh.positions[v]);
  all.back().centred = mesh.creasesAt(v) == 0 || mesh.creasesAt(v) == 2;
  std::uint32_t h = mesh.outgoing(v);
  do {
    add(mesh, mesh.to(h), mesh.isCrease(h));
    h = mesh.turned(h);
  } while (h != mesh.outgoing(v));
}

void Fans::addCollapsed(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t u = mesh.from(h), v = mesh.to(h), g = mesh.twin(h);
  const int creases = mesh.creasesAt(v);
  begin(mesh.creasesAt(u) == creases ? 0.5f * (mesh.positions[u] + mesh.positions[v]) : mesh.positions[v]);
  all.back().centred = creases == 0 || creases == 2;
  // Around v from behind the edge, and around u; the corners across come once.
  std::uint32_t e = mesh.turned(g);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(g)));
  for (e = mesh.turned(e); mesh.turned(e) != g; e = mesh.turned(e)) add(mesh, mesh.to(e), mesh.isCrease(e));
  e = mesh.turned(h);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(h)));
  for (e = mesh.turned(e); mesh.turned(e) != h; e = mesh.turned(e)) add(mesh, mesh.to(e), mesh.isCrease(e));
}

void Fans::addEdge(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.from(h)]);
  all.back().closed = false;
  add(mesh, mesh.apex(g), false), add(mesh, mesh.to(h), mesh.isCrease(h)), add(mesh, mesh.apex(h), false);
}

void Fans::addFlipped(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.apex(h)]);
  all.back().closed = false;
  add(mesh, mesh.from(h), false), add(mesh, mesh.apex(g), false), add(mesh, mesh.to(h), false);
}

void Fans::addSplit(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  const bool crease = mesh.isCrease(h);
  begin(0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]));
  add(mesh, mesh.to(h), crease);
  add(mesh, mesh.apex(h), false);
  add(mesh, mesh.from(h), crease);
  add(mesh, mesh.apex(g), false);
}

void evaluateFans(const Fans& fans, float tolerance, const LocalField& field, Progress& progress,
                  std::vector<FanError>& errors) {
  std::vector<std::size_t> first{0};
  for (std::size_t i = 0; i < fans.all.size(); ++i)
    first.push_back(first.back() + View(fans, i, tolerance).samples());
  std::vector<glm::vec3> points(first.back());
  std::vector<Reading> readings(first.back());
  tbb::parallel_for(std::size_t{0}, fans.all.size(), [&](std::size_t i) {
    std::size_t k = first[i];
    View(fans, i, tolerance).forEachSample([&](const Sample& s) { points[k++] = s.at; });
  });
  forEachRun(
      points.size(), [&](std::size_t i) { return points[i]; }, field, progress,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) {
          const glm::vec3 n = g.gradient(i);
          const float length = glm::length(n);
          readings[run.first + i] = {g.distance(i), length > 0.0f ? n / length : n};
        }
      });
  errors.assign(fans.all.size(), {});
  tbb::enumerable_thread_specific<Rooms> rooms;
  if (progress.stopped()) return;
  tbb::parallel_for(std::size_t{0}, fans.all.size(), [&](std::size_t i) {
    const View view(fans, i, tolerance);
    const std::span<Reading> own(readings.data() + first[i], first[i + 1] - first[i]);
    std::size_t k = 0;
    view.forEachSample([&](const Sample& s) {
      Reading& r = own[k++];
      r.distance += glm::dot(r.normal, s.of - s.at);
    });
    errors[i] = Judge(view, own, tolerance, rooms.local()).judge();
  });
}

}  // namespace sdf
