#include "sdf/mesh/refine/ring.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sdf/triangles/tree.h"

namespace sdf {
namespace {

// A sample may lie so far outside of its triangle, in barycentric coordinates: rims are no lines in the
// sector's plane.
constexpr float kOutside = 0.5f;

}  // namespace

bool Ring::place(const glm::vec3& centre, float limit) {
  centre_ = centre;
  placed_.clear();
  counts_.assign(spokes_.size(), 0);
  feasible_ = {};
  if (!placeOnCreases(limit)) return false;
  for (std::size_t k = 0; k < sectors_.size(); ++k)
    if (!placeSector(k, limit)) return false;
  findNearest();
  return rims_.empty() || chooseTints(limit == HUGE_VALF ? limit : std::min(limit, tolerance_));
}

bool Ring::placeSector(std::size_t number, float limit) {
  Sector& s = sectors_[number];
  s.along = glm::dot(way_, s.normal);
  const auto n = static_cast<Index>(spokes_.size());
  rim_.clear(), areas_.clear(), cosines_.clear(), normals_.clear();
  for (Index i = s.first; i <= s.last; ++i) {
    const glm::vec3 d = spokes_[i == n ? 0 : i].at - centre_;
    rim_.emplace_back(glm::dot(d, s.x), glm::dot(d, s.y), glm::dot(d, s.normal));
  }
  s.isBent = false;
  for (std::size_t i = 0; i + 1 < rim_.size(); ++i) {
    const glm::vec3 &a = rim_[i], &b = rim_[i + 1], c = b - a, area = glm::cross(a, b);
    const float longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}),
                size = glm::length(area), cosine = area.z / size;
    if (!(size > kFlattest * longest)) return false;
    if (!(area.z > kFlattest * longest) || (!(cosine > kFacing) && !isTip_)) {
      if (!mayBend_) return false;
      s.isBent = true;
    }
    areas_.push_back(1.0f / area.z), cosines_.push_back(cosine);
    normals_.push_back((area.x * s.x + area.y * s.y + area.z * s.normal) / size);
  }
  const auto take = [&](Index triangle, Index guess) {
    const std::size_t before = placed_.size();
    if (s.isBent ? !placeNearest(triangle, s) : !placeTriangle(triangle, guess, s)) return false;
    if (limit == HUGE_VALF) return true;
    for (std::size_t i = before; i < placed_.size(); ++i) {
      const Range range = feasibleAlong(placed_[i].height, placed_[i].weight, limit);
      feasible_.cut(range.lo, range.hi);
      if (feasible_.empty()) return false;
    }
    return true;
  };
  for (int which = 0; which < 2; ++which)
    if (gone_[which] != kNone && sectorOfGone(which) == number && !take(gone_[which], 0)) return false;
  for (Index i = s.first; i < s.last; ++i)
    if (!spokes_[i].isNew && !take(spokes_[i].halfEdge / 3, i - s.first)) return false;
  return isFacingVertices(s);
}

// What is bent has samples, and is held to the normal at each of its vertices.
bool Ring::isFacingVertices(const Sector& s) const {
  const auto n = static_cast<Index>(spokes_.size());
  for (Index i = s.first; i < s.last && !isTip_; ++i) {
    const glm::vec3& normal = normals_[i - s.first];
    const Index ends[2] = {spokes_[i].vertex, spokes_[i + 1 == n ? 0 : i + 1].vertex};
    if (counts_[i] == 0 && s.isBent && !(sampled_.isSmooth(ends[0]) && sampled_.isSmooth(ends[1])))
      return false;
    for (const Index v : ends)
      if (s.isBent && sampled_.isSmooth(v) && !isFacing(normal, sampled_.normals[v])) return false;
    if (counts_[i] > 0 && !facesNormals_) continue;
    const glm::vec3 around = sampled_.meanNormal({ends[0], ends[1]});
    if (!isNone(around) && !isFacing(normal, around)) return false;
  }
  return true;
}

bool Ring::placeTriangle(Index triangle, Index guess, const Sector& s) {
  for (Index w = sampled_.onTriangle.first(triangle); w != kNone; w = sampled_.onTriangle.after(w)) {
    const glm::vec3 d = sampled_.samples[w].at - centre_;
    const float x = glm::dot(d, s.x), y = glm::dot(d, s.y), z = glm::dot(d, s.normal);
    float inside = -kOutside, alpha = 0.0f, beta = 0.0f;
    Index at = kNone;
    const auto look = [&](Index i) {
      const glm::vec3 &a = rim_[i], &b = rim_[i + 1];
      const float u = (x * b.y - y * b.x) * areas_[i], v = (a.x * y - a.y * x) * areas_[i];
      const float in = std::min({u, v, 1.0f - u - v});
      if (in > inside) inside = in, alpha = u, beta = v, at = i;
      return in >= 0.0f;
    };
    if (!look(guess))
      for (Index i = 0; i + 1 < rim_.size() && !look(i);) ++i;
    if (at == kNone) return false;
    const glm::vec3& normal = sampled_.samples[w].normal;
    if (!isNone(normal) && glm::dot(normal, normals_[at]) < kFacing) return false;
    guess = at;
    const float own = 1.0f - alpha - beta;
    float height = (z - alpha * rim_[at].z - beta * rim_[at + 1].z) * cosines_[at];
    if (inside < 0.0f) {  // beside the rim
      const double square = nearestOf({x, y, z}, glm::dvec3(0.0), rim_[at], rim_[at + 1]).squared;
      height = std::copysign(static_cast<float>(std::sqrt(square)), height);
    }
    Placed& placed = placed_.emplace_back();
    placed.sample = w, placed.spoke = s.first + at;
    placed.weight = own * s.along * cosines_[at], placed.height = height;
    placed.weights = {own, alpha, beta};
    ++counts_[s.first + at];
  }
  return true;
}

// Each over the triangle that it is nearest to, of those that face it.
bool Ring::placeNearest(Index triangle, const Sector& s) {
  for (Index w = sampled_.onTriangle.first(triangle); w != kNone; w = sampled_.onTriangle.after(w)) {
    const SurfaceSample& sample = sampled_.samples[w];
    const glm::vec3 d = sample.at - centre_, p(glm::dot(d, s.x), glm::dot(d, s.y), glm::dot(d, s.normal));
    float least = HUGE_VALF;
    Index at = kNone;
    for (Index i = 0; i + 1 < rim_.size(); ++i) {
      if (!isNone(sample.normal) && glm::dot(sample.normal, normals_[i]) < kFacing) continue;
      const float distance = over(p, {glm::vec3(0.0f), rim_[i], rim_[i + 1]}).distance;
      if (distance < least) least = distance, at = i;
    }
    if (at == kNone) return false;
    const glm::vec3 &a = rim_[at], &b = rim_[at + 1], n = glm::cross(a, b);
    const float square = glm::dot(n, n), alpha = glm::dot(glm::cross(p, b), n) / square,
                beta = glm::dot(glm::cross(a, p), n) / square, own = 1.0f - alpha - beta;
    placed_.push_back({w,
                       s.first + at,
                       std::clamp(own, 0.0f, 1.0f) * glm::dot(way_, normals_[at]),
                       std::copysign(least, glm::dot(p, n)),
                       {own, alpha, beta}});
    ++counts_[s.first + at];
  }
  return true;
}

std::size_t Ring::sectorOfGone(int which) const {
  for (std::size_t k = 0; sectors_.size() > 1 && k < sectors_.size(); ++k)
    for (Index i = sectors_[k].first; i < sectors_[k].last; ++i) {
      if (spokes_[i].vertex != apex_[which]) continue;
      return i != sectors_[k].first || afterApex_[which] ? k : (k + sectors_.size() - 1) % sectors_.size();
    }
  return 0;
}

bool Ring::placeOnEdge(Index edge, Index from, Index to) {
  for (Index w = sampled_.onCrease.first(edge); w != kNone; w = sampled_.onCrease.after(w)) {
    PlacedOnCrease best{w, kNone, 0.0f, {}};
    float least = HUGE_VALF;
    for (Index i = from; i < to; ++i) {
      if (!spokes_[i].crease) continue;
      const glm::vec3 d = sampled_.samples[w].at - centre_, edgeWay = spokes_[i].at - centre_;
      const float t = std::clamp(glm::dot(d, edgeWay) / glm::dot(edgeWay, edgeWay), 0.0f, 1.0f);
      const glm::vec3 off = d - t * edgeWay;
      if (const float square = glm::dot(off, off); square < least)
        least = square, best.spoke = i, best.weight = 1.0f - t, best.off = off;
    }
    if (best.spoke == kNone) return false;
    placedOnCreases_.push_back(best);
  }
  return true;
}

bool Ring::placeOnCreases(float limit) {
  placedOnCreases_.clear();
  const auto n = static_cast<Index>(spokes_.size());
  for (Index i = 0; i < n; ++i) {
    if (!spokes_[i].crease) continue;
    if (spokes_[i].isNew) continue;  // its samples are the other half's
    // At corners samples stay with their edges.
    const Index from = creases_ == 2 ? 0 : i, to = creases_ == 2 ? n : i + 1;
    if (!placeOnEdge(spokes_[i].edge, from, to)) return false;
    const bool takesGone = goneEdge_ != kNone && spokes_[i].vertex == goneEdgeNext_;
    if (takesGone && !placeOnEdge(goneEdge_, from, to)) return false;
  }
  findWay();
  if (limit == HUGE_VALF) return true;
  for (const PlacedOnCrease& p : placedOnCreases_) {
    const Range range = feasibleAlong(p.off, p.weight, way_, limit);
    feasible_.cut(range.lo, range.hi);
  }
  return !feasible_.empty();
}

}  // namespace sdf
