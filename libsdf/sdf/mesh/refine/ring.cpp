#include "sdf/mesh/refine/ring.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sdf/triangles/tree.h"

namespace sdf {
namespace {

constexpr std::uint32_t kNone = SampledMesh::kNone;
// Weights below this are none.
constexpr float kNoWeight = 1e-3f;
// A sample may lie so far outside of its triangle, in barycentric coordinates: rims are no lines in the
// sector's plane.
constexpr float kOutside = 0.5f;
// Of a triangle's samples, beyond which every second one goes that is not among the far ones.
constexpr std::uint32_t kMostSamples = 40;
// Halvings of the largest distance in search of the least.
constexpr int kBalancings = 5;

glm::vec3 anyAcross(const glm::vec3& n) {
  const glm::vec3 axis = std::abs(n.x) < 0.6f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
  return glm::normalize(glm::cross(n, axis));
}

// Where |off - weight * t * way|, for a unit way, is within the limit.
Range feasibleAlong(const glm::vec3& off, float weight, const glm::vec3& way, float limit) {
  const float along = glm::dot(off, way), root = along * along - glm::dot(off, off) + limit * limit;
  if (weight < kNoWeight || way == glm::vec3(0.0f))
    return glm::dot(off, off) <= limit * limit ? Range{} : Range{1.0f, 0.0f};
  if (root < 0.0f) return {1.0f, 0.0f};
  return {(along - std::sqrt(root)) / weight, (along + std::sqrt(root)) / weight};
}

// Where |height - weight * t| is within the limit.
Range feasibleAlong(float height, float weight, float limit) {
  if (std::abs(weight) < kNoWeight) return std::abs(height) <= limit ? Range{} : Range{1.0f, 0.0f};
  const float a = (height - limit) / weight, b = (height + limit) / weight;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void Ring::add(Index begin, Index end) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  Index e = begin;
  do {
    spokes_.push_back({mesh.to(e), mesh.positions[mesh.to(e)], e, mesh.isCrease(e), sampled_.creaseOf[e]});
    e = mesh.turned(e);
  } while (e != end);
}

void Ring::setAround(Index v) {
  spokes_.clear();
  add(sampled_.mesh.outgoing(v), sampled_.mesh.outgoing(v));
  isTip_ = sampled_.isTip(v);
  gone_[0] = gone_[1] = goneEdge_ = goneEdgeNext_ = kNone;
}

void Ring::setCollapsed(Index h) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  const Index g = mesh.twin(h);
  // From the centre to the vertices opposite to the edge: c and d.
  const Index uc = mesh.turned(h), ud = mesh.next(g), vd = mesh.turned(g), vc = mesh.next(h);
  spokes_.clear();
  if (uc != ud) add(uc, ud);
  if (vd != vc) add(vd, vc);
  isTip_ = sampled_.isTip(mesh.to(h));
  gone_[0] = h / 3, gone_[1] = g / 3;
  apex_[0] = mesh.apex(h), apex_[1] = mesh.apex(g);
  // What goes lies on v's side of a crease of u's, and on u's of one of v's.
  afterApex_[0] = mesh.isCrease(vc), afterApex_[1] = mesh.isCrease(ud);
  for (Spoke& s : spokes_) {
    const bool atC = s.vertex == apex_[0], atD = s.vertex == apex_[1];
    if (!atC && !atD) continue;
    const Index of[2] = {sampled_.creaseOf[atC ? uc : ud], sampled_.creaseOf[atC ? vc : vd]};
    s.edge = of[0] != kNone ? of[0] : of[1];
    s.crease = s.edge != kNone;
  }
  goneEdge_ = sampled_.creaseOf[h], goneEdgeNext_ = kNone;
  if (goneEdge_ == kNone) return;
  for (Index e = mesh.turned(h); e != h; e = mesh.turned(e))
    if (mesh.isCrease(e)) goneEdgeNext_ = mesh.to(e);
}

void Ring::setSplit(Index h) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  const Index g = mesh.twin(h), edge = sampled_.creaseOf[h];
  const auto spoke = [&](Index v, Index halfEdge, bool isOnEdge, bool isNew) {
    spokes_.push_back(
        {v, mesh.positions[v], halfEdge, isOnEdge && edge != kNone, isOnEdge ? edge : kNone, isNew});
  };
  // The numbers that HalfEdgeMesh::split gives.
  spokes_.clear();
  spoke(mesh.to(h), mesh.halfEdges(), true, true);
  spoke(mesh.apex(h), HalfEdgeMesh::next(h), false, false);
  spoke(mesh.from(h), g, true, false);
  spoke(mesh.apex(g), mesh.halfEdges() + 4, false, true);
  isTip_ = false;
  gone_[0] = gone_[1] = goneEdge_ = goneEdgeNext_ = kNone;
}

bool Ring::cut(const glm::vec3& centre) {
  const auto isCrease = [](const Spoke& s) { return s.crease; };
  creases_ = static_cast<int>(std::ranges::count_if(spokes_, isCrease));
  if (const auto first = std::ranges::find_if(spokes_, isCrease); first != spokes_.end())
    std::rotate(spokes_.begin(), first, spokes_.end());
  sectors_.clear();
  const auto n = static_cast<Index>(spokes_.size());
  for (Index i = 0; i < n;) {
    Sector s{i, i + 1, glm::vec3(0.0f), {}, {}};
    while (s.last < n && !spokes_[s.last].crease) ++s.last;
    for (; i < s.last; ++i)
      s.normal += glm::cross(spokes_[i].at - centre, spokes_[i + 1 == n ? 0 : i + 1].at - centre);
    const float size = glm::length(s.normal);
    if (!(size > 0.0f)) return false;
    s.normal /= size;
    s.x = anyAcross(s.normal), s.y = glm::cross(s.normal, s.x);
    sectors_.push_back(s);
  }
  return true;
}

bool Ring::place(const glm::vec3& centre, float limit) {
  centre_ = centre;
  placed_.clear();
  feasible_ = {};
  if (!placeOnCreases(limit)) return false;
  for (std::size_t k = 0; k < sectors_.size(); ++k)
    if (!placeSector(k, limit)) return false;
  findNearest();
  return true;
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
  for (std::size_t i = 0; i + 1 < rim_.size(); ++i) {
    const glm::vec3 &a = rim_[i], &b = rim_[i + 1], c = b - a, area = glm::cross(a, b);
    const float longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    if (!(area.z > kFlattest * longest)) return false;
    const float cosine = area.z / glm::length(area);
    if (!(cosine > kFacing) && !isTip_) return false;
    areas_.push_back(1.0f / area.z), cosines_.push_back(cosine);
    normals_.push_back((area.x * s.x + area.y * s.y + area.z * s.normal) / glm::length(area));
  }
  const auto take = [&](Index triangle, Index guess) {
    const std::size_t before = placed_.size();
    if (!placeTriangle(triangle, guess, s)) return false;
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
  return isEmptyFacing(s);
}

// What has no samples is held to the normals at its vertices.
bool Ring::isEmptyFacing(const Sector& s) {
  const auto n = static_cast<Index>(spokes_.size());
  counts_.assign(n, 0);
  for (const Placed& p : placed_) ++counts_[p.spoke];
  for (Index i = s.first; i < s.last && !isTip_; ++i) {
    if (counts_[i] > 0) continue;
    glm::vec3 around(0.0f);
    for (const Index k : {i, i + 1})
      if (const Index v = spokes_[k == n ? 0 : k].vertex; sampled_.isSmooth(v)) around += sampled_.normals[v];
    if (!isNone(around) && !isFacing(normals_[i - s.first], glm::normalize(around))) return false;
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
    Placed placed{w, s.first + at, (1.0f - alpha - beta) * s.along * cosines_[at],
                  (z - alpha * rim_[at].z - beta * rim_[at + 1].z) * cosines_[at]};
    if (inside < 0.0f) {  // beside the rim
      const double square = nearestOf({x, y, z}, glm::dvec3(0.0), rim_[at], rim_[at + 1]).squared;
      placed.height = std::copysign(static_cast<float>(std::sqrt(square)), placed.height);
    }
    placed_.push_back(placed);
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

// Along a crease the way is where its samples are on the whole, across the line through its neighbours.
void Ring::findWay() {
  way_ = creases_ == 0 && !isTip_ ? sectors_[0].normal : glm::vec3(0.0f);
  chord_ = glm::vec3(0.0f);
  if (creases_ != 2) return;
  glm::vec3 ends[2], sum(0.0f);
  int count = 0;
  for (const Spoke& s : spokes_)
    if (s.crease) ends[count++] = s.at;
  const glm::vec3 chord = ends[1] - ends[0], out = centre_ - ends[0];
  const float square = glm::dot(chord, chord);
  if (!(square > 0.0f)) return;
  chord_ = chord / std::sqrt(square);
  sum = out - glm::dot(out, chord) / square * chord;
  for (const PlacedOnCrease& p : placedOnCreases_) sum += p.weight * p.off;
  sum -= glm::dot(sum, chord) / square * chord;
  // Of the chord: a crease that bends less is straight but for rounding.
  if (const float size = glm::length(sum); size * size > 0x1p-40f * square) way_ = sum / size;
}

// A centre between samples is seen by none of them: the tangent of the next one tells of it.
void Ring::findNearest() {
  centreOff_ = glm::vec3(0.0f);
  if (isTip_ || creases_ == 1 || creases_ > 2) return;
  float least = HUGE_VALF;
  Index nearest = kNone;
  const auto look = [&](Index sample) {
    const glm::vec3 d = sampled_.samples[sample].at - centre_;
    if (const float square = glm::dot(d, d); square < least) least = square, nearest = sample;
  };
  if (creases_ == 0)
    for (const Placed& p : placed_) look(p.sample);
  for (const PlacedOnCrease& p : placedOnCreases_) look(p.sample);
  if (nearest == kNone) return;
  const glm::vec3 d = sampled_.samples[nearest].at - centre_;
  const glm::vec3& along = creases_ == 0 ? sampled_.samples[nearest].normal : chord_;
  centreOff_ = glm::dot(d, along) * along;
  if (creases_ == 2) centreOff_ = d - centreOff_;
}

Range Ring::feasible(float limit) const {
  Range range = feasibleAlong(centreOff_, 1.0f, way_, std::min(limit, tolerance_));
  for (const PlacedOnCrease& p : placedOnCreases_) {
    const Range own = feasibleAlong(p.off, p.weight, way_, limit);
    range.cut(own.lo, own.hi);
  }
  for (const Placed& p : placed_) {
    const Range own = feasibleAlong(p.height, p.weight, limit);
    range.cut(own.lo, own.hi);
    if (range.empty()) break;
  }
  return range;
}

float Ring::balanced() const {
  float most = std::max(largest(), centreDistance()), least = 0.0f, way = 0.0f;
  for (int i = 0; i < kBalancings; ++i) {
    const float middle = 0.5f * (least + most);
    const Range range = feasible(middle);
    if (range.empty())
      least = middle;
    else
      most = middle, way = range.middle();
  }
  return way;
}

float Ring::largest() const {
  float most = 0.0f;
  for (const Placed& p : placed_) most = std::max(most, std::abs(p.height));
  for (const PlacedOnCrease& p : placedOnCreases_) most = std::max(most, glm::length(p.off));
  return most;
}

float Ring::energy(float limit) const {
  const float scale = 1.0f / (limit * limit);
  const auto eighth = [&](float square) {
    square *= scale, square *= square, square *= square;
    return square * square;
  };
  float sum = eighth(glm::dot(centreOff_, centreOff_));
  for (const Placed& p : placed_) sum += eighth(p.height * p.height);
  for (const PlacedOnCrease& p : placedOnCreases_) sum += eighth(glm::dot(p.off, p.off));
  return sum;
}

void Ring::assign(float limit) {
  for (const Spoke& s : spokes_) sampled_.onTriangle.clear(s.halfEdge / 3);
  for (const Index g : gone_)
    if (g != kNone) sampled_.onTriangle.clear(g);
  counts_.assign(spokes_.size(), 0);
  for (const Placed& p : placed_) ++counts_[p.spoke];
  bool second = false;
  for (const Placed& p : placed_) {
    if (counts_[p.spoke] > kMostSamples && std::abs(p.height) < 0.5f * limit && (second = !second)) continue;
    sampled_.onTriangle.add(spokes_[p.spoke].halfEdge / 3, p.sample);
  }
  if (creases_ == 0) return;
  for (Spoke& s : spokes_) {
    if (!s.crease) continue;
    if (s.isNew) s.edge = sampled_.creaseOf[s.halfEdge];
    sampled_.onCrease.clear(s.edge);
  }
  if (goneEdge_ != kNone) sampled_.onCrease.clear(goneEdge_);
  for (const PlacedOnCrease& p : placedOnCreases_) sampled_.onCrease.add(spokes_[p.spoke].edge, p.sample);
}

glm::vec3 Ring::optimalMove(const glm::vec3& normal) const {
  // The second fundamental form (a b; b c) that turns the normal best as the vertices' around are turned.
  const Sector& s = sectors_[0];
  glm::dmat3 left(0.0);
  glm::dvec3 right(0.0);
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (!sampled_.isSmooth(spokes_[i].vertex)) continue;
    const glm::dvec2 d(rim_[i].x, rim_[i].y);
    const glm::vec3 turn = sampled_.normals[spokes_[i].vertex] - normal;
    const double weight = 1.0 / glm::dot(d, d);
    const glm::dvec3 rows[2] = {{d.x, d.y, 0.0}, {0.0, d.x, d.y}};
    const double turns[2] = {glm::dot(turn, s.x), glm::dot(turn, s.y)};
    for (int k = 0; k < 2; ++k) {
      left += weight * glm::outerProduct(rows[k], rows[k]);
      right += weight * turns[k] * rows[k];
    }
  }
  if (!(std::abs(glm::determinant(left)) > 1e-6)) return glm::vec3(0.0f);
  const glm::dvec3 form = glm::inverse(left) * right;
  const double mean = 0.5 * (form.x + form.z), half = 0.5 * (form.x - form.z),
               radius = std::hypot(half, form.y), angle = 0.5 * std::atan2(form.y, half);
  const double largest = std::max(std::abs(mean + radius), std::abs(mean - radius));
  if (!(largest > 0.0)) return glm::vec3(0.0f);
  // Flat directions count as somewhat curved, so that triangles stay a thousand times as long as wide at
  // most.
  const double least = 1e-6 * largest, first = std::sqrt(std::max(std::abs(mean + radius), least)),
               second = std::sqrt(std::max(std::abs(mean - radius), least));
  const glm::dmat2 turn(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
  const auto inMetric = [&](const glm::vec3& d) {
    return glm::dvec2(first, second) * (turn * glm::dvec2(d.x, d.y));
  };
  glm::dvec2 sum(0.0);
  double area = 0.0;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const glm::dvec2 p = inMetric(rim_[i]), q = inMetric(rim_[i + 1]);
    area += p.x * q.y - p.y * q.x;
    sum += glm::dvec2(q.y - p.y, p.x - q.x) * (glm::dot(p, p) + glm::dot(q, q));
  }
  if (!(area > 0.0)) return glm::vec3(0.0f);
  const glm::dvec2 move = glm::transpose(turn) * (sum / (2.0 * area) / glm::dvec2(first, second));
  return static_cast<float>(move.x) * s.x + static_cast<float>(move.y) * s.y;
}

glm::vec3 Ring::moveAlongCrease() const {
  glm::vec3 sum(0.0f), ends[2];
  int count = 0;
  for (const Spoke& s : spokes_)
    if (s.crease && count < 2) ends[count++] = s.at, sum += s.at - centre_;
  const glm::vec3 chord = ends[1] - ends[0];
  return 0.5f * glm::dot(sum, chord) / glm::dot(chord, chord) * chord;
}

}  // namespace sdf
