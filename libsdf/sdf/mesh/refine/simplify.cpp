#include "sdf/mesh/refine/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/refine/crowded.h"
#include "sdf/mesh/refine/flip.h"
#include "sdf/mesh/refine/missed.h"
#include "sdf/mesh/refine/ring.h"
#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {
namespace {

using Index = SampledMesh::Index;

// Shares of the tolerance that collapses are held to one after the other: what costs least goes first. In the
// end they go beyond it, as flips and moves bring most back; of 1.2 to 1.5, 1.3 leaves the fewest triangles
// of balls and blends.
constexpr float kShares[] = {0.06f, 0.25f, 1.0f, 1.3f};
// Rounds of improving and collapsing, the second half of them to the tolerance itself, and sweeps over the
// mesh in each. Twice as many leave 1 % fewer triangles.
constexpr int kImprovements = 4, kSmoothings = 3, kAfterSplits = 2;
// A pass of collapses that takes away less than this share of the triangles is the last.
constexpr std::size_t kWorthIt = 50;
// An unresolved mesh that keeps more triangles than these is not improved: moving and splitting takes longer
// than all collapses there, and leaves no fewer (gyroids of thin walls).
constexpr std::size_t kMostToImprove = 40'000;
// Rounds of splitting what is too far, and of reading the field all over the mesh, at most.
constexpr int kSplitRounds = 12, kLooks = 6;
// How often others are asked what exceeds the tolerance, at most.
constexpr int kOtherLooks = 12;
// Of the tolerance: what is no farther off is flat.
constexpr float kFlat = 0.01f;
// What is left as it is may be off by more than it was by its rounding.
constexpr float kRounded = 1.0f + 1e-5f;
// Where two sheets cross each is within a tolerance of its surface, and a vertex of each within two voxels.
constexpr float kBesides = 2.0f;

float voxelAt(const LocalField& field, const glm::vec3& p) {
  return static_cast<float>(field.finder()->at(p).voxel);
}

class Simplifier {
 public:
  Simplifier(const FeatureMesh& mesh, const LocalField& field, double tolerance,
             const std::vector<glm::vec3>& surface, Progress& progress)
      : field_(field),
        sampled_(mesh, field, progress),
        mesh_(sampled_.mesh),
        tolerance_(static_cast<float>(tolerance)),
        missed_(sampled_, field, surface, tolerance_, progress),
        ring_(sampled_, tolerance_),
        crowded_(sampled_, kBesides * (tolerance_ + voxelAt(field, mesh.positions[0]))),
        limit_(tolerance_),
        progress_(progress),
        taken_(mesh.positions.size(), 0),
        changed_(mesh.positions.size(), 1),
        settled_(mesh.positions.size(), 0),
        near_(mesh.positions.size(), 0),
        failed_(mesh_.halfEdges(), 0),
        unflipped_(mesh_.halfEdges(), 0) {}

  // Colours are not collapsed beyond the tolerance: moves do not bring them back.
  void run(bool painted) {
    if (painted) paint();
    const float most = painted ? 1.0f : kShares[std::size(kShares) - 1];
    for (const float share : kShares) collapseTo(std::min(share, most) * tolerance_);
    progress_.update(0.4);
    for (int i = 0; i < kImprovements && !progress_.stopped(); ++i) {
      if (i == kImprovements / 2) setLimit(tolerance_);
      improve();
      collapse();
      progress_.update(0.4 + 0.4 * (i + 1) / kImprovements);
    }
    improve();
    keep();
    for (int i = 0; i < kAfterSplits; ++i) {  // of what splits have made superfluous
      collapse();
      improve();
      keep();
    }
    progress_.update(1.0);
  }
  // No farther than the tolerance, as moves do not bring colours back; what was too far stays so.
  void runUnresolved(bool painted) {
    if (painted) paint();
    leaveExceeding();
    for (const float share : kShares) collapseTo(std::min(share, 1.0f) * tolerance_);
    if (mesh_.liveTriangles() > kMostToImprove) return;
    for (int i = 0; i < kImprovements && !progress_.stopped(); ++i) {
      progress_.update(0.4 + 0.5 * i / kImprovements);
      improve();
      collapse();
    }
    keep();
    progress_.update(1.0);
  }
  // Returns whether anything was changed for these places that are too far off.
  bool keep(const std::vector<glm::vec3>& exceeding) {
    touch(missed_.addNextTo(exceeding));
    return keep() > 0;
  }
  FeatureMesh take() const {
    FeatureMesh mesh = mesh_.compacted();
    for (Index h = 0; sampled_.tints.any() && h < mesh_.halfEdges(); h += 3) {
      const auto at = [&](Index k) { return sampled_.tints.colorOf(sampled_.tints.corners[h + k]); };
      if (mesh_.alive(h)) mesh.colors.push_back({at(0), at(1), at(2)});
    }
    return mesh;
  }

 private:
  // Splits what is too far, here or seen by the field. Returns how often.
  std::size_t keep() {
    ring_.mayBend(true);
    std::size_t all = splitExceeding();
    for (int i = 0; i < kLooks && !progress_.stopped(); ++i) {
      const std::vector<Index> missed = missed_.add();
      touch(missed);
      if (missed.empty()) break;
      const std::size_t made = splitExceeding();
      if (made == 0) break;
      all += made;
    }
    ring_.mayBend(false);
    return all;
  }

  // What is too far off from the start is not split.
  void leaveExceeding() {
    left_.assign(mesh_.vertices(), 0);
    for (Index h = 0; h < mesh_.halfEdges(); h += 3)
      if (sampled_.farthestOf(h / 3).distance > tolerance_)
        for (Index k = 0; k < 3; ++k) left_[mesh_.from(h + k)] = 1;
  }
  bool isLeft(Index v) const { return v < left_.size() && left_[v]; }

  void paint() {
    sampled_.paint(field_, tolerance_, progress_);
    fitTints();
  }

  // Colours are those that fit the samples around best.
  void fitTints() {
    for (Index v = 0; sampled_.tints.any() && v < mesh_.vertices() && !progress_.stopped(); ++v) {
      if (!mesh_.vertexAlive(v)) continue;
      ring_.setAround(v);
      if (ring_.cut(mesh_.positions[v]) && ring_.place(mesh_.positions[v])) ring_.assign(limit_);
    }
  }

  void improve() {
    for (int i = 0; i < kSmoothings; ++i) flipAll(), moveAll();
    fitTints();
  }

  void setLimit(float limit) {
    limit_ = limit;
    ring_.aimAt(std::min(limit, tolerance_));
  }

  void collapseTo(float limit) {
    setLimit(limit);
    std::ranges::fill(failed_, 0);
    collapse();
  }

  void collapse() {
    for (;;) {
      const std::size_t before = mesh_.liveTriangles();
      ++pass_;
      for (Index h = 0; h < mesh_.halfEdges() && !progress_.stopped(); ++h)
        if (mesh_.alive(h)) tryCollapse(h);
      if ((before - mesh_.liveTriangles()) * kWorthIt <= before) return;
    }
  }

  // A vertex that something was collapsed into, or near to, waits for the next pass: rings stay small.
  void tryCollapse(Index h) {
    const Index u = mesh_.from(h), v = mesh_.to(h);
    if (taken_[u] == pass_ || taken_[v] == pass_) return;
    const bool alike = mesh_.creasesAt(u) == mesh_.creasesAt(v), isSmooth = sampled_.isSmooth(v);
    if (alike && u > v) return;  // to their middle, either way
    if (failed_[h] >= std::max(changed_[u], changed_[v])) return;
    if (isFar(u, v) || !mesh_.canCollapse(h)) return;
    failed_[h] = pass_;
    ring_.setCollapsed(h);
    glm::vec3 at = mesh_.positions[v];
    if (alike) at = 0.5f * (mesh_.positions[u] + at);
    if (ring_.size() < 3 || !ring_.cut(at)) return;
    bool placed = false;
    if (alike && isSmooth && limit_ >= tolerance_ && ring_.place(at)) {
      const glm::vec3 better =
          at + ring_.optimalMove(glm::normalize(sampled_.normals[u] + sampled_.normals[v]));
      placed = ring_.place(better, limit_);
      if (placed) at = better;
    }
    if (!placed && !ring_.place(at, limit_)) return;
    if (!moveToMiddle(at) || crowded_.wouldCross(ring_, at)) return;
    ring_.assign(limit_);
    sampled_.collapse(h, at);
    crowded_.replaced(ring_);
    touch(v);
    taken_[v] = pass_;
    for (std::size_t i = 0; i < ring_.size(); ++i) taken_[ring_.vertex(i)] = pass_;
  }

  // To the middle of where all samples are within the limit.
  bool moveToMiddle(glm::vec3& at) {
    const Range range = ring_.feasible(limit_);
    if (range.empty()) return false;
    at += range.middle() * ring_.way();
    return ring_.place(at) && ring_.isWithin(limit_);
  }

  // The middle of an edge is off by |dn . e| / 8, and those of what a collapse makes of it by twice that and
  // more, a limit to either side of which can be kept.
  bool isFar(Index u, Index v) const {
    if (!sampled_.isSmooth(u) || !sampled_.isSmooth(v)) return false;
    const glm::vec3 turn = sampled_.normals[v] - sampled_.normals[u];
    return std::abs(glm::dot(turn, mesh_.positions[v] - mesh_.positions[u])) > 8.0f * limit_;
  }

  // These triangles have more samples.
  void touch(const std::vector<Index>& triangles) {
    for (const Index h : triangles)
      for (Index k = 0; k < 3; ++k) changed_[mesh_.from(h + k)] = pass_ + 1;
  }

  // What the ring shows was changed.
  void touch(Index v) {
    changed_[v] = pass_ + 1;
    for (std::size_t i = 0; i < ring_.size(); ++i) changed_[ring_.vertex(i)] = pass_ + 1;
  }

  void moveAll() {
    ++pass_;
    for (Index v = 0; v < mesh_.vertices() && !progress_.stopped(); ++v) {
      if (!isMovable(v) || settled_[v] >= changed_[v]) continue;
      settled_[v] = pass_;
      move(v);
    }
  }
  bool isMovable(Index v) const {
    return mesh_.vertexAlive(v) && (mesh_.creasesAt(v) == 0 || mesh_.creasesAt(v) == 2);
  }

  // Towards the best place as long as that helps.
  void move(Index v) {
    const glm::vec3 before = mesh_.positions[v];
    ring_.setAround(v);
    if (!ring_.cut(before) || !ring_.place(before)) return;
    const glm::vec3 move = ring_.isSmooth()       ? ring_.optimalMove(sampled_.normals[v])
                           : ring_.creases() == 2 ? ring_.moveAlongCrease()
                                                  : glm::vec3(0.0f);
    // Where the ring is so bent that samples are seen over other triangles than their own it is left.
    const float was = ring_.largest() > limit_ ? std::max(limit_, largestAround(v)) : limit_,
                off = std::max(tolerance_, ring_.centreDistance());
    if (ring_.largest() > was) return;
    const float energy = ring_.energy(limit_);
    glm::vec3 best = before;
    for (const float share : {1.0f, 0.4f, 0.0f}) {
      glm::vec3 at = before + share * move;
      if (!ring_.place(at)) continue;
      at += ring_.balanced() * ring_.way();
      if (!ring_.place(at) || !(ring_.energy(limit_) < energy)) continue;
      best = at;
      break;
    }
    if (best == before || ring_.largest() > was || ring_.centreDistance() > off) return;
    moveTo(best);
  }

  // As it was placed; not where it would cross something.
  bool moveTo(const glm::vec3& at) {
    if (crowded_.wouldCross(ring_, at)) return false;
    ring_.assign(limit_);
    mesh_.positions[ring_.centre()] = at;
    crowded_.replaced(ring_);
    touch(ring_.centre());
    return true;
  }

  // The largest distance of a sample from its triangle.
  float largestAround(Index v) const {
    float most = 0.0f;
    Index e = mesh_.outgoing(v);
    do {
      most = std::max(most, sampled_.farthestOf(e / 3).distance);
      e = mesh_.turned(e);
    } while (e != mesh_.outgoing(v));
    return most;
  }

  void flipAll() {
    ++pass_;
    for (Index h = 0; h < mesh_.halfEdges() && !progress_.stopped(); ++h) {
      if (!mesh_.alive(h) || h > mesh_.twin(h)) continue;
      const Index changed = std::max({changed_[mesh_.from(h)], changed_[mesh_.to(h)], changed_[mesh_.apex(h)],
                                      changed_[mesh_.apex(mesh_.twin(h))]});
      if (unflipped_[h] >= changed || !mesh_.canFlip(h)) continue;
      unflipped_[h] = pass_;
      if (!flipIfBetter(sampled_, crowded_, h, kFlat * tolerance_)) continue;
      for (const Index v : {mesh_.from(h), mesh_.to(h), mesh_.apex(h), mesh_.apex(mesh_.twin(h))})
        changed_[v] = pass_ + 1;
    }
  }

  // Returns how often something was split or moved for it.
  std::size_t splitExceeding() {
    std::size_t all = 0;
    for (int i = 0; i < kSplitRounds && !progress_.stopped(); ++i) {
      std::size_t made = 0;
      for (Index v = 0; v < mesh_.vertices(); ++v) {
        if (!isMovable(v) || isLeft(v) || near_[v] >= changed_[v]) continue;
        near_[v] = pass_;
        if (moveNear(v) && i == 0) ++made;
      }
      const Index end = mesh_.halfEdges();
      for (Index h = 0; h < end; ++h)
        if (mesh_.alive(h) && mesh_.isCrease(h) && h < mesh_.twin(h) && splitCreaseIfExceeding(h)) ++made;
      for (Index h = 0; h < end; h += 3)
        if (mesh_.alive(h) && splitIfExceeding(h)) ++made;
      if (made == 0) break;
      flipAll(), moveAll();
      all += made;
    }
    return all;
  }

  // Moves a vertex that is too far from the surface itself, at the cost of the triangles around.
  bool moveNear(Index v) {
    glm::vec3 at = mesh_.positions[v];
    ring_.setAround(v);
    if (!ring_.cut(at) || !ring_.place(at) || ring_.centreDistance() <= tolerance_) return false;
    const float too = ring_.centreDistance() - tolerance_, was = std::max(limit_, largestAround(v));
    at += too / ring_.centreDistance() * ring_.centreOff();
    return ring_.place(at) && ring_.largest() <= was + too && moveTo(at);
  }

  // Splits the side of the triangle that is next to its farthest sample, there.
  bool splitIfExceeding(Index h) {
    if (isLeft(mesh_.from(h)) || isLeft(mesh_.from(h + 1)) || isLeft(mesh_.from(h + 2))) return false;
    const SampledMesh::Farthest farthest = sampled_.farthestOf(h / 3);
    if (!(farthest.distance > tolerance_)) return false;
    const glm::vec3 p = sampled_.samples[farthest.sample].at;
    std::array<std::pair<float, Index>, 3> sides;
    for (Index k = 0; k < 3; ++k) {
      const glm::vec3 from = mesh_.positions[mesh_.from(h + k)],
                      way = mesh_.positions[mesh_.to(h + k)] - from;
      sides[k] = {glm::length(glm::cross(p - from, way)) / glm::length(way), h + k};
    }
    std::ranges::sort(sides);
    // There, else in the middle of a side; on a crease at one of its samples.
    const auto atSample = [&](const auto& s) {
      return mesh_.isCrease(s.second) ? splitCreaseNear(s.second, p) : split(s.second, p);
    };
    const auto atMiddle = [&](const auto& s) {
      const Index from = mesh_.from(s.second), to = mesh_.to(s.second);
      return !mesh_.isCrease(s.second) &&
             split(s.second, 0.5f * (mesh_.positions[from] + mesh_.positions[to]));
    };
    return std::ranges::any_of(sides, atSample) || std::ranges::any_of(sides, atMiddle);
  }

  // Splits an edge on a crease at its sample that is nearest to p.
  bool splitCreaseNear(Index h, const glm::vec3& p) {
    Index nearest = Lists::kNone;
    float least = HUGE_VALF;
    const Index edge = sampled_.creaseOf[h];
    for (Index w = sampled_.onCrease.first(edge); w != Lists::kNone; w = sampled_.onCrease.after(w))
      if (const float d = glm::distance(sampled_.samples[w].at, p); d < least) least = d, nearest = w;
    return nearest != Lists::kNone && split(h, sampled_.samples[nearest].at);
  }

  // Splits an edge on a crease at its farthest sample.
  bool splitCreaseIfExceeding(Index h) {
    if (isLeft(mesh_.from(h)) || isLeft(mesh_.to(h))) return false;
    const glm::vec3 a = mesh_.positions[mesh_.from(h)], way = mesh_.positions[mesh_.to(h)] - a;
    float most = tolerance_;
    glm::vec3 worst;
    const Index edge = sampled_.creaseOf[h];
    for (Index w = sampled_.onCrease.first(edge); w != Lists::kNone; w = sampled_.onCrease.after(w)) {
      const glm::vec3 d = sampled_.samples[w].at - a;
      const float t = std::clamp(glm::dot(d, way) / glm::dot(way, way), 0.0f, 1.0f);
      if (const float off = glm::distance(d, t * way); off > most) most = off, worst = sampled_.samples[w].at;
    }
    return most > tolerance_ && split(h, worst);
  }

  // Not where it is so short that nothing along it is farther off than the tolerance.
  bool split(Index h, const glm::vec3& p) {
    if (glm::distance(mesh_.positions[mesh_.from(h)], mesh_.positions[mesh_.to(h)]) < 2.0f * tolerance_)
      return false;
    ring_.setSplit(h);
    const float was = std::max(
        {tolerance_, sampled_.farthestOf(h / 3).distance, sampled_.farthestOf(mesh_.twin(h) / 3).distance});
    if (!ring_.cut(p) || !ring_.place(p)) return false;
    const glm::vec3 at = p + ring_.balanced() * ring_.way();
    if (!ring_.place(at) || !ring_.isWithin(kRounded * was) || crowded_.wouldCross(ring_, at)) return false;
    const Index v = sampled_.split(h, at);
    taken_.resize(mesh_.vertices(), 0), changed_.resize(mesh_.vertices(), pass_ + 1);
    settled_.resize(mesh_.vertices(), 0), near_.resize(mesh_.vertices(), 0);
    failed_.resize(mesh_.halfEdges(), 0), unflipped_.resize(mesh_.halfEdges(), 0);
    ring_.assign(limit_);
    crowded_.replaced(ring_);
    touch(v);
    return true;
  }

  const LocalField& field_;
  SampledMesh sampled_;
  HalfEdgeMesh& mesh_;
  float tolerance_;
  MissedSamples missed_;
  Ring ring_;
  CrowdedTriangles crowded_;
  float limit_;
  Progress& progress_;
  // A pass over the mesh has a number; 0 stands for none.
  Index pass_ = 0;
  std::vector<Index> taken_;      // by vertex: the last pass in which a collapse changed it
  std::vector<Index> changed_;    // by vertex: the pass before which something around it was last changed
  std::vector<Index> settled_;    // by vertex: the last pass in which it was to be moved
  std::vector<Index> near_;       // by vertex: the last pass in which its distance was looked at
  std::vector<char> left_;        // by vertex, of the first ones: is it of what is not split?
  std::vector<Index> failed_;     // by half-edge: the last pass in which its collapse failed
  std::vector<Index> unflipped_;  // by half-edge: the last pass in which it was to be flipped
};

}  // namespace

bool simplify(FeatureMesh& mesh, const LocalField& field, double tolerance,
              const std::vector<glm::vec3>& surface,
              const std::function<std::vector<glm::vec3>(const FeatureMesh&)>& exceeding, bool painted,
              Progress& progress) {
  Simplifier simplifier(mesh, field, tolerance, surface, progress);
  simplifier.run(painted);
  std::vector<glm::vec3> asked;
  const auto isAsked = [&](const glm::vec3& p) { return std::ranges::find(asked, p) != asked.end(); };
  for (int i = 0;; ++i) {
    mesh = simplifier.take();
    std::vector<glm::vec3> places = exceeding(mesh);
    if (places.empty() || progress.stopped()) return !progress.stopped();
    std::erase_if(places, isAsked);
    if (places.empty() || i == kOtherLooks || !simplifier.keep(places)) return false;
    asked.insert(asked.end(), places.begin(), places.end());
  }
}

void simplifyUnresolved(FeatureMesh& mesh, const LocalField& field, double tolerance, bool painted,
                        Progress& progress) {
  Simplifier simplifier(mesh, field, tolerance, {}, progress);
  simplifier.runUnresolved(painted);
  mesh = simplifier.take();
}

}  // namespace sdf
