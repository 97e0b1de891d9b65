// Relocation and flips: changes that keep the number of triangles.
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/refine/remesh_changes.h"

namespace sdf {
namespace {

// A change has to gain as much of the distances' energy to be made: what is less may be rounding.
constexpr float kGain = 1e-3f;
// And so much for each triangle as it is better shaped, so that where the surface is flat rounding decides
// nothing.
constexpr float kShape = 1e-5f;

// What each square of a vertex's distance from having six neighbours counts for in loose sweeps.
constexpr float kEven = 0.3f;
// A fan whose distances are below this share of the tolerance is flat.
constexpr float kFlatToAdjust = 0.02f;
// How far vertices are moved at once: of the way to the balance, and of the spokes' length.
constexpr float kBalance = 0.7f, kDescend = 0.04f;

// Sum over a fan's triangles of their sides' squares by their areas: least where they are equilateral.
float shapeOf(const Fans& fans, const Fan& fan) {
  float sum = 0.0f;
  for (std::uint32_t i = 0; i < fan.triangles(); ++i) {
    const glm::vec3 u = fans.rim[fan.first + i].end - fan.centre,
                    v = fans.rim[fan.first + (i + 1) % fan.count].end - fan.centre;
    sum += (glm::dot(u, u) + glm::dot(v, v) + glm::dot(u - v, u - v)) /
           std::max(glm::length(glm::cross(u, v)), 1e-30f);
  }
  return sum;
}

// Where a fan's distances are a small part of the tolerance there is nothing to balance.
void dropFlat(Fans& fans, std::vector<FanError>& errors, std::vector<std::uint32_t>& chosen,
              float tolerance) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (errors[i].sound && errors[i].largest < kFlatToAdjust * tolerance) continue;
    chosen[kept] = chosen[i], fans.all[kept] = fans.all[i], errors[kept] = errors[i];
    ++kept;
  }
  chosen.resize(kept), fans.all.resize(kept), errors.resize(kept);
}

float spokeLength(const Fans& fans, std::size_t i) {
  const Fan& fan = fans.all[i];
  float sum = 0.0f;
  for (std::uint32_t k = 0; k < fan.count; ++k) sum += glm::distance(fan.centre, fans.rim[fan.first + k].end);
  return sum / static_cast<float>(fan.count);
}

}  // namespace

bool RemeshChanges::worsens(const FanError& before, const FanError& after) const {
  return after.largest > std::max(before.largest, tolerance_);
}

void RemeshChanges::dropWorse(const Fans& before, const Fans& after,
                              std::vector<std::uint32_t>& changes) const {
  const std::vector<FanError> old = lookClosely(before, changes), now = lookClosely(after, changes);
  if (progress_.stopped()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (!worsens(old[i], now[i])) changes[kept++] = changes[i];
  changes.resize(kept);
}

std::vector<std::uint32_t> RemeshChanges::claimSome(std::vector<std::uint32_t>& waiting, Fans& fans) {
  ++round_;
  std::vector<std::uint32_t> chosen;
  std::erase_if(waiting, [&](std::uint32_t v) {
    if (!claim(v)) return false;
    chosen.push_back(v);
    fans.addAround(mesh_, v);
    return true;
  });
  return chosen;
}

std::size_t RemeshChanges::relocate(float loose) {
  std::size_t moved = 0;
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t v = 0; v < mesh_.vertices(); ++v)
    if (mesh_.vertexAlive(v) && (mesh_.creasesAt(v) == 0 || mesh_.creasesAt(v) == 2) &&
        changed_[v] >= settled_[v])
      waiting.push_back(v);
  while (!waiting.empty() && !progress_.stopped()) {
    Fans before;
    std::vector<std::uint32_t> chosen = claimSome(waiting, before);
    for (const std::uint32_t v : chosen) settled_[v] = round_ + 1;
    std::vector<FanError> old, errors;
    evaluate(before, Sampling::Few, old);
    if (progress_.stopped()) return moved;
    dropFlat(before, old, chosen, tolerance_);
    for (FanError& e : old)
      if (painted_ && e.smooth) e.balance = glm::vec3(0.0f);
    std::vector<float> best(chosen.size());
    std::vector<glm::vec3> to(chosen.size()), normal(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i)
      best[i] = old[i].sound
                    ? (1.0f + loose - kGain) * (old[i].energy + kShape * shapeOf(before, before.all[i]))
                    : HUGE_VALF;
    for (const bool balancing : {true, false}) {
      Fans after = before;
      for (std::size_t i = 0; i < chosen.size(); ++i)
        after.all[i].centre += balancing ? kBalance * old[i].balance
                                         : kDescend * spokeLength(before, i) * old[i].descent + old[i].offset;
      if (balancing) {
        evaluateFans(after, tolerance_, Sampling::Few, field_, progress_, errors);
        moveToOffsets(after, errors);
      }
      evaluate(after, Sampling::Few, errors);
      if (progress_.stopped()) return moved;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const float energy = errors[i].energy + kShape * shapeOf(after, after.all[i]);
        if (!errors[i].sound || !(energy < best[i]) || worsens(old[i], errors[i])) continue;
        best[i] = energy;
        to[i] = after.all[i].centre;
        normal[i] = errors[i].normal;
      }
    }
    Fans after = before;
    std::vector<std::uint32_t> better;
    for (std::uint32_t i = 0; i < chosen.size(); ++i) {
      if (normal[i] == glm::vec3(0.0f)) continue;
      after.all[i].centre = to[i];
      better.push_back(i);
    }
    dropWorse(before, after, better);
    if (progress_.stopped()) return moved;
    for (const std::uint32_t i : better) {
      mesh_.positions[chosen[i]] = to[i];
      normals_[chosen[i]] = normal[i];
      touch(chosen[i]);
      ++moved;
    }
  }
  return moved;
}

float RemeshChanges::evenness(std::uint32_t h) const {
  const auto off = [&](std::uint32_t v, int more) {
    int n = more;
    std::uint32_t e = mesh_.outgoing(v);
    do ++n, e = mesh_.turned(e);
    while (e != mesh_.outgoing(v));
    return static_cast<float>((n - 6) * (n - 6));
  };
  const std::uint32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.apex(h), d = mesh_.apex(mesh_.twin(h));
  return off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) - off(a, 0) - off(b, 0) - off(c, 0) - off(d, 0);
}

void RemeshChanges::project(const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t v : vertices)
    if (mesh_.creasesAt(v) == 0 || mesh_.creasesAt(v) == 2) waiting.push_back(v);
  while (!waiting.empty() && !progress_.stopped()) {
    Fans fans;
    const std::vector<std::uint32_t> chosen = claimSome(waiting, fans);
    std::vector<FanError> old, errors;
    evaluate(fans, Sampling::Few, old);
    for (std::size_t i = 0; i < chosen.size(); ++i) fans.all[i].centre += old[i].onto;
    evaluate(fans, Sampling::Few, errors);
    if (progress_.stopped()) return;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (old[i].sound && !errors[i].sound) continue;
      mesh_.positions[chosen[i]] = fans.all[i].centre;
      touch(chosen[i]);
    }
  }
}

std::size_t RemeshChanges::flip(float loose) {
  const std::uint32_t since = lastFlips_;
  lastFlips_ = ++round_;
  std::vector<std::uint32_t> edges;
  Fans before, after;
  for (std::uint32_t h = 0; h < mesh_.halfEdges(); ++h) {
    if (!mesh_.alive(h) || h > mesh_.twin(h)) continue;
    if (std::max({changed_[mesh_.from(h)], changed_[mesh_.to(h)], changed_[mesh_.apex(h)],
                  changed_[mesh_.apex(mesh_.twin(h))]}) < since)
      continue;
    if (!mesh_.canFlip(h)) continue;
    edges.push_back(h);
    before.addEdge(mesh_, h);
    after.addFlipped(mesh_, h);
  }
  std::vector<FanError> old, errors;
  evaluate(before, Sampling::Few, old);
  evaluate(after, Sampling::Few, errors);
  if (progress_.stopped()) return 0;
  std::vector<Candidate> gains;
  std::vector<std::uint32_t> better;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (!errors[i].sound || worsens(old[i], errors[i])) continue;
    const float then = errors[i].energy + kShape * shapeOf(after, after.all[i]),
                now = old[i].energy + kShape * shapeOf(before, before.all[i]);
    const float even = (loose > 0.0f ? kEven : 0.0f) * evenness(edges[i]);
    if (old[i].sound && !(then + even < (1.0f - kGain) * now)) continue;
    gains.push_back({then + even - now, i});
    better.push_back(i);
  }
  dropWorse(before, after, better);
  if (progress_.stopped()) return 0;
  std::erase_if(gains, [&](const Candidate& c) { return !std::ranges::binary_search(better, c.where); });
  for (Candidate& c : gains) c.where = edges[c.where];
  std::sort(gains.begin(), gains.end());
  std::size_t flips = 0;
  for (const Candidate& c : gains) {
    const std::uint32_t h = c.where, a = h / 3, b = mesh_.twin(h) / 3;
    if (claimed_[a] == round_ || claimed_[b] == round_ || !mesh_.canFlip(h)) continue;
    claimed_[a] = claimed_[b] = round_;
    mesh_.flip(h);
    for (const std::uint32_t v : {mesh_.from(h), mesh_.to(h), mesh_.apex(h), mesh_.apex(mesh_.twin(h))})
      changed_[v] = round_;
    ++flips;
  }
  return flips;
}

}  // namespace sdf
