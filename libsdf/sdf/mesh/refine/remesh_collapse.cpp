#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/refine/remesh_changes.h"

namespace sdf {
namespace {

// Share of the cheapest edges that a round takes, so that later ones find what these have made; and the
// number below which all are taken.
constexpr double kShare = 0.35;
constexpr std::size_t kFewToCollapse = 500;
// A round of all candidates that removes less than this share of the triangles is the last.
constexpr double kStale = 2e-3;
// What a collapse costs is about eight times the chord's error; above this many tolerances none can succeed.
// An edge as long as the tolerance allows in the best mesh has 12.
constexpr float kHopelessCollapse = 14.0f;
// Along a crease relocation evens out more than on a surface, and so collapses may go beyond the tolerance by
// so much.
constexpr float kCrease = 1.2f;
// Vertices nearer to each other than this share of the tolerance are one.
constexpr float kShortestLeft = 0.01f;
// Where the surface is flat the shortest edges go first: of the tolerance, for one that spans the mesh.
constexpr float kFlatLeft = 1e-3f;

}  // namespace

// Distance of the crease vertex from(h) from the chord that a collapse leaves in its place.
float RemeshChanges::creaseCost(std::uint32_t h) const {
  const glm::vec3 p = mesh_.positions[mesh_.from(h)], a = mesh_.positions[mesh_.to(mesh_.otherOnCrease(h))],
                  along = mesh_.positions[mesh_.to(h)] - a;
  const float length = glm::length(along);
  return length > 0.0f ? 2.0f * glm::length(glm::cross(p - a, along)) / length : 0.0f;
}

// How far that chord is from the crease, taken as a parabola through its ends and the vertex.
float RemeshChanges::chordError(std::uint32_t h) const {
  const glm::vec3 p = mesh_.positions[mesh_.from(h)];
  const float a = glm::distance(p, mesh_.positions[mesh_.to(mesh_.otherOnCrease(h))]),
              b = glm::distance(p, mesh_.positions[mesh_.to(h)]);
  return a > 0.0f && b > 0.0f ? 0.5f * creaseCost(h) * (a + b) * (a + b) / (4.0f * a * b) : 0.0f;
}

// How far the surface turns along the edge, times its length.
float RemeshChanges::collapseCost(std::uint32_t h) const {
  const std::uint32_t u = mesh_.from(h), v = mesh_.to(h);
  const glm::vec3 along = mesh_.positions[v] - mesh_.positions[u];
  const float length = glm::length(along);
  const float flat = kFlatLeft * length / size_ * tolerance_;
  if (mesh_.isCrease(h)) return creaseCost(h) + flat;
  glm::vec3 turn(0.0f);
  if (mesh_.creasesAt(u) == 0 && mesh_.creasesAt(v) == 0) {
    turn = normals_[v] - normals_[u];
  } else {
    glm::vec3 facets(0.0f);
    for (const std::uint32_t side : {h, mesh_.twin(h)})
      facets +=
          glm::normalize(glm::cross(mesh_.positions[mesh_.to(side)] - mesh_.positions[mesh_.from(side)],
                                    mesh_.positions[mesh_.apex(side)] - mesh_.positions[mesh_.from(side)]));
    const std::uint32_t smooth = mesh_.creasesAt(u) == 0 ? u : v;
    turn = 2.0f * (normals_[smooth] - glm::normalize(facets));
  }
  return length * glm::length(turn) + flat;
}

// The half-edge of h's edge to collapse along, from the vertex that may go; kNone if there is none.
std::uint32_t RemeshChanges::collapsible(std::uint32_t h) const {
  for (const std::uint32_t side : {h, mesh_.twin(h)}) {
    const int u = mesh_.creasesAt(mesh_.from(side));
    if (u == 0 || (u == 2 && mesh_.isCrease(side))) return side;
  }
  return HalfEdgeMesh::kNone;
}

std::vector<RemeshChanges::Candidate> RemeshChanges::collapseCandidates(bool& more) const {
  std::vector<Candidate> all(mesh_.halfEdges(), {HUGE_VALF, 0});
  tbb::parallel_for(std::uint32_t{0}, mesh_.halfEdges(), [&](std::uint32_t h) {
    if (!mesh_.alive(h) || h > mesh_.twin(h)) return;
    if (tried_[h] > std::max(changed_[mesh_.from(h)], changed_[mesh_.to(h)])) return;
    const std::uint32_t side = collapsible(h);
    if (side == HalfEdgeMesh::kNone) return;
    if (const float cost = collapseCost(side); mesh_.isCrease(h) || cost < kHopelessCollapse * tolerance_)
      all[h] = {cost, side};
  });
  std::erase_if(all, [](const Candidate& c) { return !(c.cost < HUGE_VALF); });
  const auto share = static_cast<std::size_t>(kShare * static_cast<double>(all.size()));
  more = share > kFewToCollapse;
  if (more) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(share), all.end());
    all.resize(share);
  }
  tbb::parallel_sort(all);
  return all;
}

void RemeshChanges::tryCollapses(const std::vector<std::uint32_t>& edges, Fans& fans,
                                 std::vector<FanError>& errors) const {
  for (const std::uint32_t h : edges) {
    fans.addCollapsed(mesh_, h);
    // The distance does not tell where a border is: its vertices stay on it.
    if (painted_ && mesh_.isCrease(h)) fans.all.back().centre = mesh_.positions[mesh_.to(h)];
  }
  evaluateFans(fans, tolerance_, Sampling::Few, field_, progress_, errors);
  moveToOffsets(fans, errors);
  evaluate(fans, Sampling::Few, errors);
  if (progress_.stopped()) return;
  for (std::size_t i = 0; painted_ && i < edges.size(); ++i)
    if (mesh_.isCrease(edges[i]) && errors[i].smooth)
      errors[i].largest = std::max(errors[i].largest, chordError(edges[i]));
  std::vector<std::uint32_t> passing;
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    if (errors[i].sound && errors[i].largest <= kCrease * tolerance_) passing.push_back(i);
  const std::vector<FanError> closely = lookClosely(fans, passing);
  if (progress_.stopped()) return;
  for (std::size_t k = 0; k < passing.size(); ++k)
    errors[passing[k]].largest = std::max(errors[passing[k]].largest, closely[k].largest);
}

bool RemeshChanges::collapseRound(std::size_t most, Care care, bool& more) {
  ++round_;
  std::vector<std::uint32_t> chosen;
  bool any = false;
  for (const Candidate& c : collapseCandidates(more)) {
    if (chosen.size() >= most) break;
    any = true;
    if (!mesh_.canCollapse(c.where)) {
      tried_[c.where] = tried_[mesh_.twin(c.where)] = round_;
      continue;
    }
    if (claimEdge(c.where)) chosen.push_back(c.where);
  }
  if (!any) return false;
  std::sort(chosen.begin(), chosen.end());
  Fans fans;
  std::vector<FanError> errors;
  tryCollapses(chosen, fans, errors);
  if (progress_.stopped()) return false;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::uint32_t h = chosen[i], v = mesh_.to(h);
    const float limit = tolerance_ * (mesh_.isCrease(h) && care == Care::Usual ? kCrease : 1.0f);
    if (!errors[i].sound || !(errors[i].largest <= limit) || !mesh_.canCollapse(h)) {
      tried_[h] = tried_[mesh_.twin(h)] = round_;
      continue;
    }
    mesh_.collapse(h);
    mesh_.positions[v] = fans.all[i].centre;
    if (fans.all[i].centred) normals_[v] = errors[i].normal;
    touch(v);
  }
  return true;
}

std::size_t RemeshChanges::collapseShortest() {
  ++round_;
  std::size_t gone = 0;
  for (std::uint32_t h = 0; h < mesh_.halfEdges(); ++h) {
    if (!mesh_.alive(h) || h > mesh_.twin(h)) continue;
    const std::uint32_t side = collapsible(h);
    if (side == HalfEdgeMesh::kNone) continue;
    const std::uint32_t v = mesh_.to(side);
    if (!(glm::distance(mesh_.positions[mesh_.from(side)], mesh_.positions[v]) <
          kShortestLeft * tolerance_) ||
        !mesh_.canCollapse(side))
      continue;
    mesh_.collapse(side);
    touch(v);
    ++gone;
  }
  return gone;
}

void RemeshChanges::collapse(Care care) {
  while (!progress_.stopped() && mesh_.liveTriangles() > 4) {
    const std::size_t before = mesh_.liveTriangles();
    bool more = false;
    if (!collapseRound((before + 1) / 2, care, more)) return;
    const auto gone = static_cast<double>(before - mesh_.liveTriangles());
    const bool enough = !more && before > kFewToCollapse;
    if (enough && gone < kStale * static_cast<double>(before)) return;
  }
}

}  // namespace sdf
