#include "sdf/mesh/refine/ring.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace sdf {
namespace {

// Of a triangle's samples, beyond which every second one goes that is not among the far ones.
constexpr std::uint32_t kMostSamples = 40;

glm::vec3 anyAcross(const glm::vec3& n) {
  const glm::vec3 axis = std::abs(n.x) < 0.6f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
  return glm::normalize(glm::cross(n, axis));
}

}  // namespace

void Ring::add(Index begin, Index end) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  Index e = begin;
  do {
    spokes_.push_back({mesh.to(e), mesh.positions[mesh.to(e)], e, mesh.isCrease(e), sampled_.creaseOf[e]});
    if (const Tints& tints = sampled_.tints; tints.any()) {
      addRim(tints.corners[HalfEdgeMesh::next(e)], tints.corners[HalfEdgeMesh::previous(e)]);
      centres_.push_back(tints.corners[e]);
    }
    e = mesh.turned(e);
  } while (e != end);
}

void Ring::setAround(Index v) {
  centreVertex_ = v;
  spokes_.clear(), rims_.clear(), centres_.clear();
  add(sampled_.mesh.outgoing(v), sampled_.mesh.outgoing(v));
  isTip_ = sampled_.isTip(v);
  gone_[0] = gone_[1] = goneEdge_ = goneEdgeNext_ = kNone;
}

void Ring::setCollapsed(Index h) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  const Index g = mesh.twin(h);
  // From the centre to the vertices opposite to the edge: c and d.
  const Index uc = mesh.turned(h), ud = mesh.next(g), vd = mesh.turned(g), vc = mesh.next(h);
  centreVertex_ = mesh.to(h);
  spokes_.clear(), rims_.clear(), centres_.clear();
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
  centreVertex_ = mesh.vertices();
  spokes_.clear(), rims_.clear(), centres_.clear();
  spoke(mesh.to(h), mesh.halfEdges(), true, true);
  spoke(mesh.apex(h), HalfEdgeMesh::next(h), false, false);
  spoke(mesh.from(h), g, true, false);
  spoke(mesh.apex(g), mesh.halfEdges() + 4, false, true);
  if (const Tints& tints = sampled_.tints; tints.any()) {
    const std::vector<Tint>& at = tints.corners;
    for (const Index side : {h, g}) {
      const Tint &a = at[side], &b = at[HalfEdgeMesh::next(side)], &c = at[HalfEdgeMesh::previous(side)];
      addRim(b, c), addRim(c, a);
      for (int k = 0; k < 2; ++k) centres_.push_back(mixed(a, b, c, {0.5f, 0.5f, 0.0f}));
    }
  }
  isTip_ = false;
  gone_[0] = gone_[1] = goneEdge_ = goneEdgeNext_ = kNone;
}

std::vector<Ring::Index> Ring::triangles() const {
  std::vector<Index> all;
  for (const Spoke& s : spokes_) all.push_back(s.halfEdge / 3);
  for (const Index g : gone_)
    if (g != kNone) all.push_back(g);
  return all;
}

// Lets the ring begin with that spoke.
void Ring::rotateTo(std::size_t first) {
  const auto rotate = [&](auto& all) {
    if (!all.empty()) std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
  };
  rotate(spokes_), rotate(rims_), rotate(centres_);
}

bool Ring::cut(const glm::vec3& centre) {
  const auto isCrease = [](const Spoke& s) { return s.crease; };
  creases_ = static_cast<int>(std::ranges::count_if(spokes_, isCrease));
  if (const auto first = std::ranges::find_if(spokes_, isCrease); first != spokes_.end())
    rotateTo(static_cast<std::size_t>(first - spokes_.begin()));
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

void Ring::assign(float limit) {
  for (const Spoke& s : spokes_) sampled_.onTriangle.clear(s.halfEdge / 3);
  for (const Index g : gone_)
    if (g != kNone) sampled_.onTriangle.clear(g);
  bool second = false;
  for (const Placed& p : placed_) {
    if (counts_[p.spoke] > kMostSamples && std::max(std::abs(p.height), p.tint) < 0.5f * limit &&
        (second = !second))
      continue;
    sampled_.onTriangle.add(spokes_[p.spoke].halfEdge / 3, p.sample);
  }
  for (std::size_t i = 0; i < rims_.size(); ++i) {
    std::vector<Tint>& at = sampled_.tints.corners;
    const Index e = spokes_[i].halfEdge;
    at[e] = centres_[i], at[HalfEdgeMesh::next(e)] = rims_[i][0], at[HalfEdgeMesh::previous(e)] = rims_[i][1];
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

}  // namespace sdf
