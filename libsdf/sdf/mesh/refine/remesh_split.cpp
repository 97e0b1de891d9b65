#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/mesh/refine/remesh_changes.h"
#include "sdf/mesh/refine/remesh_measure.h"

namespace sdf {
namespace {

// Splitting halves an edge and so quarters its error: more rounds than these do not help.
constexpr int kRounds = 16;

// And no more where as many triangles exceed the tolerance as before, and are less than this share of all.
constexpr double kFewSplits = 0.01;

// A triangle whose distances are beyond the tolerance is split where they come from: at a side that has this
// share of the tolerance in its middle, else at the longest.
constexpr float kOnSide = 0.7f;

// Voxels: what exceeds the tolerance on shorter edges is not resolved by the field.
constexpr double kShortestSplit = 1.0 / 16;

}  // namespace

bool RemeshChanges::maySplit(std::uint32_t edge) const {
  const glm::vec3 &a = mesh_.positions[mesh_.from(edge)], &b = mesh_.positions[mesh_.to(edge)];
  if (mesh_.isExempt(mesh_.from(edge)) && mesh_.isExempt(mesh_.to(edge))) return false;
  return glm::distance(a, b) > kShortestSplit * field_.finder()->at(a).voxel;
}

// The triangle's longest side.
std::uint32_t RemeshChanges::longestSide(std::uint32_t h) const {
  const auto length = [&](std::uint32_t e) {
    return glm::distance(mesh_.positions[mesh_.from(e)], mesh_.positions[mesh_.to(e)]);
  };
  std::uint32_t longest = h;
  for (const std::uint32_t e : {HalfEdgeMesh::next(h), HalfEdgeMesh::previous(h)})
    if (length(e) > length(longest)) longest = e;
  return longest;
}

// Around each vertex where the tolerance is exceeded, the edge that has most of it at its middle, or else the
// longest side of the triangle that has most.
std::vector<RemeshChanges::Candidate> RemeshChanges::splitCandidates() {
  const std::uint32_t since = lastSplits_;
  lastSplits_ = ++round_;
  std::vector<std::uint32_t> vertices;
  Fans fans;
  for (std::uint32_t v = 0; v < mesh_.vertices(); ++v) {
    if (!mesh_.vertexAlive(v) || mesh_.isExempt(v) || changed_[v] < since) continue;
    vertices.push_back(v);
    fans.addAround(mesh_, v);
  }
  std::vector<FanError> errors;
  evaluate(fans, Sampling::All, errors);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const FanError& e = errors[i];
    if (e.largest <= tolerance_) continue;
    changed_[vertices[i]] = round_;
    std::uint32_t h = mesh_.outgoing(vertices[i]);
    for (std::uint32_t k = 0; k < (e.spoke > tolerance_ ? e.worstSpoke : e.worst); ++k) h = mesh_.turned(h);
    if (!(e.spoke > tolerance_)) h = longestSide(h);
    if (maySplit(h)) all.push_back({-e.largest, std::min(h, mesh_.twin(h))});
  }
  std::sort(all.begin(), all.end());
  return all;
}

void RemeshChanges::splitRound(const std::vector<Candidate>& candidates, bool onto, bool force) {
  ++round_;
  std::vector<std::uint32_t> chosen;
  Fans fans;
  for (const Candidate& c : candidates) {
    const std::uint32_t a = c.where / 3, b = mesh_.twin(c.where) / 3;
    if (claimed_[a] == round_ || claimed_[b] == round_) continue;
    claimed_[a] = claimed_[b] = round_;
    chosen.push_back(c.where);
    fans.addSplit(mesh_, c.where);
  }
  if (chosen.empty()) return;
  // What is seen on a triangle is seen on its halves no worse.
  std::vector<FanError> errors;
  evaluateFans(fans, tolerance_, Sampling::Few, field_, progress_, errors);
  const Fans middles = fans;
  const std::vector<FanError> atMiddles = errors;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    fans.all[i].centre += onto ? errors[i].onto : errors[i].offset;
  evaluateFans(fans, tolerance_, Sampling::Few, field_, progress_, errors);
  if (progress_.stopped()) return;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const bool moved = errors[i].sound, inPlace = !moved && atMiddles[i].sound;
    if (!moved && !inPlace && !force) continue;
    const std::uint32_t v = mesh_.split(chosen[i], (inPlace ? middles : fans).all[i].centre);
    grow();
    normals_[v] = errors[i].normal;
    touch(v);
  }
}

void RemeshChanges::split() {
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < kRounds && !progress_.stopped(); ++i) {
    const std::vector<Candidate> candidates = splitCandidates();
    const bool few =
        static_cast<double>(candidates.size()) < kFewSplits * static_cast<double>(mesh_.liveTriangles());
    if (candidates.empty() || (few && candidates.size() >= before)) return;
    before = candidates.size();
    splitRound(candidates, false, false);
    flip();
    relocate();
  }
}

void RemeshChanges::splitTriangles(const std::vector<std::uint32_t>& triangles, bool force) {
  std::vector<glm::vec3> middles;
  for (const std::uint32_t t : triangles)
    for (std::uint32_t k = 0; k < 3; ++k)
      middles.push_back(0.5f * (mesh_.positions[mesh_.from(t + k)] + mesh_.positions[mesh_.to(t + k)]));
  const std::vector<float> distances = distancesAt(middles, field_, progress_);
  if (progress_.stopped()) return;
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto first = distances.begin() + static_cast<std::ptrdiff_t>(3 * i),
               worst = std::max_element(first, first + 3);
    const std::uint32_t h = *worst > kOnSide * tolerance_
                                ? triangles[i] + static_cast<std::uint32_t>(worst - first)
                                : longestSide(triangles[i]);
    if (maySplit(h)) all.push_back({0.0f, std::min(h, mesh_.twin(h))});
  }
  std::sort(all.begin(), all.end());
  splitRound(all, true, force);
  flip();
  relocate();
}

}  // namespace sdf
