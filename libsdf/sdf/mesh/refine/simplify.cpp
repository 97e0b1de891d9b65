#include "sdf/mesh/refine/simplify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/mesh/refine/blocks.h"
#include "sdf/mesh/refine/coarsen.h"
#include "sdf/mesh/refine/crowded.h"
#include "sdf/mesh/refine/flip.h"
#include "sdf/mesh/refine/missed.h"
#include "sdf/mesh/refine/ring.h"
#include "sdf/mesh/refine/sampled_mesh.h"
#include "sdf/mesh/surface/project.h"

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
// Of the energy: a move that leaves more is not worth what is moved after it. Ten samples: 0.4 % fewer
// triangles than with 0.9, for 3 % more time.
constexpr float kWorthMoving = 0.97f;
// Of the tolerance: what is no farther off is flat.
constexpr float kFlat = 0.01f;
// What is left as it is may be off by more than it was by its rounding.
constexpr float kRounded = 1.0f + 1e-5f;
// Of the tolerance: what coarsening may cost.
constexpr double kCoarse = 0.25;
// Where two sheets cross each is within a tolerance of its surface, or what it is off at the start, and a
// vertex of each within two voxels.
constexpr float kBesides = 2.0f;

float voxelAt(const LocalField& field, const glm::vec3& p) {
  return static_cast<float>(field.finder()->at(p).voxel);
}

// What a thread changes a mesh with. Where it has a block it changes that alone.
struct Work {
  Ring& ring;
  std::uint8_t block = MeshBlocks::kNone;
};

FeatureMesh coarsened(FeatureMesh mesh, const LocalField& field, double tolerance, bool painted,
                      Progress& progress) {
  coarsen(mesh, field, {.off = kCoarse * tolerance, .painted = painted}, progress);
  return mesh;
}

class Simplifier {
 public:
  Simplifier(const FeatureMesh& mesh, const LocalField& field, double tolerance,
             const std::vector<glm::vec3>& surface, bool painted, Progress& progress)
      : field_(field),
        painted_(painted),
        // Colours are seen at the samples alone, which are to be as close as the lattice's vertices.
        sampled_(mesh, field, painted ? voxelAt(field, mesh.positions[0]) : HUGE_VALF, progress),
        mesh_(sampled_.mesh),
        tolerance_(static_cast<float>(tolerance)),
        missed_(sampled_, field, surface, tolerance_, progress),
        ring_(sampled_, tolerance_),
        reach_(kBesides * (std::max(tolerance_, farthest()) + voxelAt(field, mesh.positions[0]))),
        blocks_(mesh_, reach_),
        crowded_(sampled_, blocks_, reach_),
        limit_(tolerance_),
        progress_(progress),
        taken_(mesh.positions.size(), 0),
        changed_(mesh.positions.size(), 1),
        settled_(mesh.positions.size(), 0),
        near_(mesh.positions.size(), 0),
        left_(mesh.positions.size(), 0),
        stale_(mesh.positions.size(), 0),
        exceeding_(mesh_.halfEdges() / 3, 0),
        failed_(mesh_.halfEdges(), 0),
        unflipped_(mesh_.halfEdges(), 0) {}

  // Colours are not collapsed beyond the tolerance: moves do not bring them back.
  void run() {
    if (painted_) paint();
    const float most = painted_ ? 1.0f : kShares[std::size(kShares) - 1];
    for (const float share : kShares) collapseTo(std::min(share, most) * tolerance_);
    for (int i = 0; i < kImprovements && !progress_.stopped(); ++i) {
      if (i == kImprovements / 2) setLimit(tolerance_);
      improve();
      collapse();
    }
    improve();
    keep();
    for (int i = 0; i < kAfterSplits; ++i) {  // of what splits have made superfluous
      collapse();
      improve();
      keep();
    }
  }
  // No farther than the tolerance, as moves do not bring colours back; what was too far stays so.
  void runUnresolved() {
    if (painted_) paint();
    leaveExceeding();
    ring_.faceNormals(false);
    for (const float share : kShares) collapseTo(std::min(share, 1.0f) * tolerance_);
    if (mesh_.liveTriangles() > kMostToImprove) return;
    for (int i = 0; i < kImprovements && !progress_.stopped(); ++i) {
      improve();
      collapse();
    }
    keep();
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
    ring_.mayBend(true), keeps_ = true;
    ++pass_;  // only what is changed from now on is moved and flipped
    std::ranges::fill(settled_, pass_), std::ranges::fill(unflipped_, pass_);
    std::size_t all = splitExceeding() + splitOff();
    for (int i = 0; i < kLooks && !progress_.stopped(); ++i) {
      const std::vector<Index> missed = missed_.add();
      touch(missed);
      if (missed.empty()) break;
      const std::size_t made = splitExceeding() + splitOff();
      if (made == 0) break;
      all += made;
    }
    ring_.mayBend(false), keeps_ = false;
    return all;
  }

  float farthest() const {
    float most = 0.0f;
    for (Index h = 0; h < mesh_.halfEdges(); h += 3)
      most = std::max(most, sampled_.farthestOf(h / 3).distance);
    return most;
  }

  // What is too far off from the start is not split.
  void leaveExceeding() {
    asItWas_.assign(mesh_.vertices(), 0);
    for (Index h = 0; h < mesh_.halfEdges(); h += 3)
      if (sampled_.farthestOf(h / 3).distance > tolerance_)
        for (Index k = 0; k < 3; ++k) asItWas_[mesh_.from(h + k)] = 1;
  }
  bool isAsItWas(Index v) const { return v < asItWas_.size() && asItWas_[v]; }
  bool isOfWhatWas(Index h) const {
    return isAsItWas(mesh_.from(h)) || isAsItWas(mesh_.from(h + 1)) || isAsItWas(mesh_.from(h + 2));
  }

  void paint() {
    sampled_.paint(field_, tolerance_, progress_);
    fitTints();
  }

  // Colours are those that fit the samples around best.
  void fitTints() {
    if (!sampled_.tints.any()) return;
    const auto fit = [&](Index v, const Work& work) {
      if (!isOf(v, work)) return;
      work.ring.setAround(v);
      const glm::vec3& at = mesh_.positions[v];
      if (work.ring.cut(at) && work.ring.place(at)) work.ring.assign(limit_);
    };
    inBlocks(blocks_.vertices(), fit);
    for (Index v = 0; v < mesh_.vertices() && !progress_.stopped(); ++v)
      if (mesh_.vertexAlive(v)) fit(v, whole_);
  }

  // Blocks are changed beside one another as long as that decides little, and where colours are held, as that
  // takes the longest. The last collapses of shapes are made all over the mesh: of 31 tolerances at roundings
  // of about their size three were missed where blocks meet, and none or one otherwise.
  bool inParallel() const {
    return limit_ < tolerance_ || (!keeps_ && (sampled_.tints.any() || !asItWas_.empty()));
  }

  // Is it the work's to change what lies around the vertex? What is inside of a block is not the whole's, but
  // for what would have left it.
  bool isOf(Index v, const Work& work) const {
    if (work.block != MeshBlocks::kNone) return blocks_.isInside(v, work.block);
    return !inParallel() || left_[v] == pass_ || !blocks_.isInside(v);
  }

  // Calls change(item, work) for the items of each block, blocks beside one another.
  template <class Change>
  void inBlocks(const std::vector<std::vector<Index>>& items, const Change& change) {
    if (!inParallel()) return;
    tbb::parallel_for(std::size_t{1}, items.size(), [&](std::size_t block) {
      Ring ring = ring_;
      const Work work{ring, static_cast<std::uint8_t>(block)};
      for (const Index item : items[block])
        if (!progress_.stopped()) change(item, work);
    });
  }
  // The same for the sides of each block's triangles.
  template <class Change>
  void inSides(const Change& change) {
    inBlocks(blocks_.triangles(), [&](Index h, const Work& work) {
      for (Index k = 0; k < 3; ++k)
        if (mesh_.alive(h + k)) change(h + k, work);
    });
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

  // Reads the normals of vertices that have moved since. Those at what voxels do not resolve tell little: the
  // mesh rounds it off (a mug's rims would keep a quarter more triangles).
  void readNormals() {
    if (!asItWas_.empty()) return;
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh_.vertices(); ++v)
      if (std::exchange(stale_[v], char{0}) && mesh_.vertexAlive(v) && sampled_.isSmooth(v))
        vertices.push_back(v);
    std::vector<glm::vec3> points, normals;
    for (const Index v : vertices) points.push_back(mesh_.positions[v]);
    refineVertices(points, normals, field_, progress_);
    for (std::size_t i = 0; i < vertices.size() && !progress_.stopped(); ++i)
      sampled_.normals[vertices[i]] = normals[i];
  }

  void collapse() {
    for (;;) {
      readNormals();
      const std::size_t before = mesh_.liveTriangles();
      ++pass_;
      inSides([&](Index h, const Work& work) { tryCollapse(h, work); });
      for (Index h = 0; h < mesh_.halfEdges() && !progress_.stopped(); ++h)
        if (mesh_.alive(h)) tryCollapse(h, whole_);
      if ((before - mesh_.liveTriangles()) * kWorthIt <= before) return;
    }
  }

  // A vertex that something was collapsed into, or near to, waits for the next pass: rings stay small.
  void tryCollapse(Index h, const Work& work) {
    Ring& ring = work.ring;
    const Index u = mesh_.from(h), v = mesh_.to(h);
    if (taken_[u] == pass_ || taken_[v] == pass_) return;
    const bool alike = mesh_.creasesAt(u) == mesh_.creasesAt(v);
    if (alike && u > v) return;  // to their middle, either way
    if (failed_[h] >= std::max(changed_[u], changed_[v])) return;
    if (work.block != MeshBlocks::kNone ? !isOf(u, work) || !isOf(v, work) : !isOf(u, work) && !isOf(v, work))
      return;
    if (isFar(u, v) || !mesh_.canCollapse(h)) return;
    ring.setCollapsed(h);
    failed_[h] = pass_;
    glm::vec3 at = mesh_.positions[v];
    if (alike) at = 0.5f * (mesh_.positions[u] + at);
    if (ring.size() < 3 || !ring.cut(at) || !placeCollapsed(u, v, at, ring)) return;
    if (leaves(at, work)) {
      failed_[h] = 0;
      return;
    }
    if (crowded_.wouldCross(ring, at, work.block)) return;
    ring.assign(limit_);
    sampled_.collapse(h, at);
    stale_[v] = 1;
    replaced(work);
    taken_[v] = pass_;
    for (std::size_t i = 0; i < ring.size(); ++i) taken_[ring.vertex(i)] = pass_;
  }

  // Puts the ring of a collapse of u into v where it holds all samples, at first at `at` or, in the end,
  // better than there. Where colours bend sharply one of the ends may do, and their middle not.
  bool placeCollapsed(Index u, Index v, glm::vec3& at, Ring& ring) const {
    const bool alike = mesh_.creasesAt(u) == mesh_.creasesAt(v);
    if (alike && sampled_.isSmooth(v) && limit_ >= tolerance_ && ring.place(at)) {
      const glm::vec3 better =
          at + ring.optimalMove(glm::normalize(sampled_.normals[u] + sampled_.normals[v]));
      if (ring.place(better, limit_)) at = better;
    }
    if (placeWithin(at, ring)) return true;
    if (!alike || !sampled_.tints.any()) return false;
    return placeWithin(at = mesh_.positions[u], ring) || placeWithin(at = mesh_.positions[v], ring);
  }
  bool placeWithin(glm::vec3& at, Ring& ring) const {
    return ring.place(at, limit_) && moveToMiddle(at, ring);
  }

  // To the middle of where all samples are within the limit.
  bool moveToMiddle(glm::vec3& at, Ring& ring) const {
    const Range range = ring.feasible(limit_);
    if (range.empty()) return false;
    at += range.middle() * ring.way();
    return ring.place(at) && ring.isWithin(limit_);
  }

  // Would the ring's centre leave the block, while others are changed?
  bool leaves(const glm::vec3& at, const Work& work) {
    if (work.block == MeshBlocks::kNone || blocks_.contains(work.block, at)) return false;
    left_[work.ring.centre()] = pass_;
    return true;
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
  void replaced(const Work& work) {
    const Ring& ring = work.ring;
    if (work.block == MeshBlocks::kNone) blocks_.moved(ring.centre());
    crowded_.replaced(ring);
    changed_[ring.centre()] = pass_ + 1;
    for (std::size_t i = 0; i < ring.size(); ++i) changed_[ring.vertex(i)] = pass_ + 1;
  }

  void moveAll() {
    readNormals();
    ++pass_;
    const auto settle = [&](Index v, const Work& work) {
      if (settled_[v] >= changed_[v] || !isOf(v, work)) return;
      settled_[v] = pass_;
      move(v, work);
    };
    inBlocks(blocks_.vertices(), [&](Index v, const Work& work) {
      if (isMovable(v)) settle(v, work);
    });
    for (Index v = 0; v < mesh_.vertices() && !progress_.stopped(); ++v)
      if (isMovable(v)) settle(v, whole_);
  }
  bool isMovable(Index v) const {
    return mesh_.vertexAlive(v) && (mesh_.creasesAt(v) == 0 || mesh_.creasesAt(v) == 2);
  }

  // Towards the best place as long as that helps.
  void move(Index v, const Work& work) {
    Ring& ring = work.ring;
    const glm::vec3 before = mesh_.positions[v];
    ring.setAround(v);
    if (!ring.cut(before) || !ring.place(before)) return;
    const glm::vec3 move = ring.isSmooth()       ? ring.optimalMove(sampled_.normals[v])
                           : ring.creases() == 2 ? ring.moveAlongCrease()
                                                 : glm::vec3(0.0f);
    // Where the ring is so bent that samples are seen over other triangles than their own it is left.
    const float was = ring.largest() > limit_ ? std::max(limit_, largestAround(v)) : limit_,
                off = std::max(tolerance_, ring.centreDistance());
    if (ring.largest() > was) return;
    const float energy = kWorthMoving * ring.energy(limit_);
    // Where the centre, moved along its way, promises less.
    const auto balanced = [&](const glm::vec3& at) {
      const float along = ring.balanced();
      return ring.energy(limit_, along) < energy ? at + along * ring.way() : before;
    };
    const glm::vec3 here = balanced(before);
    glm::vec3 best = before;
    for (const float share : {1.0f, 0.4f, 0.0f}) {
      const glm::vec3 at = before + share * move;
      const glm::vec3 to = share == 0.0f ? here : ring.place(at) ? balanced(at) : before;
      if (to == before || !ring.place(to) || !(ring.energy(limit_) < energy)) continue;
      best = to;
      break;
    }
    if (best == before || ring.largest() > was || ring.centreDistance() > off) return;
    if (leaves(best, work))
      settled_[v] = 0;
    else
      moveTo(best, work);
  }

  // As it was placed; not where it would cross something.
  bool moveTo(const glm::vec3& at, const Work& work) {
    if (crowded_.wouldCross(work.ring, at, work.block)) return false;
    work.ring.assign(limit_);
    mesh_.positions[work.ring.centre()] = at;
    stale_[work.ring.centre()] = 1;
    replaced(work);
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
    readNormals();
    ++pass_;
    inSides([&](Index h, const Work& work) { tryFlip(h, work); });
    for (Index h = 0; h < mesh_.halfEdges() && !progress_.stopped(); ++h)
      if (mesh_.alive(h)) tryFlip(h, whole_);
  }

  void tryFlip(Index h, const Work& work) {
    if (h > mesh_.twin(h)) return;
    const auto corners = [&] {
      return std::array{mesh_.from(h), mesh_.to(h), mesh_.apex(h), mesh_.apex(mesh_.twin(h))};
    };
    const std::array<Index, 4> around = corners();
    const std::uint8_t block = blocks_.of(around[0]);
    const bool isOne = std::ranges::all_of(around, [&](Index v) { return blocks_.of(v) == block; });
    if ((isOne && inParallel() ? block : MeshBlocks::kNone) != work.block) return;
    const Index changed = std::ranges::max(around, {}, [&](Index v) { return changed_[v]; });
    if (unflipped_[h] >= changed_[changed] || !mesh_.canFlip(h)) return;
    unflipped_[h] = pass_;
    if (!flipIfBetter(sampled_, crowded_, h, kFlat * tolerance_, work.block)) return;
    for (const Index v : corners()) changed_[v] = pass_ + 1;
  }

  // Returns how often something was split or moved for it.
  std::size_t splitExceeding() {
    std::size_t all = 0;
    for (int i = 0; i < kSplitRounds && !progress_.stopped(); ++i) {
      std::size_t made = 0;
      for (Index v = 0; v < mesh_.vertices(); ++v) {
        if (!isMovable(v) || isAsItWas(v) || near_[v] >= changed_[v]) continue;
        near_[v] = pass_;
        if (moveNear(v) && i == 0) ++made;
      }
      const Index end = mesh_.halfEdges();
      for (Index h = 0; h < end; ++h)
        if (mesh_.alive(h) && mesh_.isCrease(h) && h < mesh_.twin(h) && splitCreaseIfExceeding(h)) ++made;
      for (Index h = 0; h < end; h += 3)
        if (mesh_.alive(h) && isChangedSince(exceeding_, h) && splitIfExceeding(h)) ++made;
      if (made == 0) break;
      flipAll(), moveAll();
      all += made;
    }
    return all;
  }

  // Has the triangle been changed, or been given samples, since it was last asked for here?
  bool isChangedSince(std::vector<Index>& asked, Index h) {
    const Index changed =
        std::max({changed_[mesh_.from(h)], changed_[mesh_.from(h + 1)], changed_[mesh_.from(h + 2)]});
    return std::exchange(asked[h / 3], pass_) < changed;
  }

  // Moves a vertex that is too far from the surface itself, at the cost of the triangles around.
  bool moveNear(Index v) {
    glm::vec3 at = mesh_.positions[v];
    ring_.setAround(v);
    if (!ring_.cut(at) || !ring_.place(at) || ring_.centreDistance() <= tolerance_) return false;
    const float too = ring_.centreDistance() - tolerance_, was = std::max(limit_, largestAround(v));
    at += too / ring_.centreDistance() * ring_.centreOff();
    return ring_.place(at) && ring_.largest() <= was + too && moveTo(at, whole_);
  }

  // Splits what sticks out of the surface, of which no sample tells. Returns how often.
  std::size_t splitOff() {
    std::size_t made = 0;
    for (const OffSurface& off : missed_.takeOff())
      if (mesh_.alive(off.triangle) && mesh_.corners(off.triangle) == off.corners &&
          !isOfWhatWas(off.triangle) && splitNextTo(off.triangle, off.at, off.next))
        ++made;
    if (made > 0) flipAll(), moveAll();
    return made;
  }

  // Splits the side of the triangle that is next to its farthest sample, there.
  bool splitIfExceeding(Index h) {
    if (isOfWhatWas(h)) return false;
    const SampledMesh::Farthest farthest = sampled_.farthestOf(h / 3);
    if (!(farthest.distance > tolerance_)) return false;
    const glm::vec3 p = sampled_.samples[farthest.sample].at;
    return splitNextTo(h, p, p);
  }

  // The same of the side that is next to a place, at a point of the surface.
  bool splitNextTo(Index h, const glm::vec3& place, const glm::vec3& p) {
    std::array<std::pair<float, Index>, 3> sides;
    for (Index k = 0; k < 3; ++k) {
      const glm::vec3 from = mesh_.positions[mesh_.from(h + k)],
                      way = mesh_.positions[mesh_.to(h + k)] - from;
      sides[k] = {glm::length(glm::cross(place - from, way)) / glm::length(way), h + k};
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
    if (isAsItWas(mesh_.from(h)) || isAsItWas(mesh_.to(h))) return false;
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
    sampled_.split(h, at);
    taken_.resize(mesh_.vertices(), 0), changed_.resize(mesh_.vertices(), pass_ + 1);
    settled_.resize(mesh_.vertices(), 0), near_.resize(mesh_.vertices(), 0);
    left_.resize(mesh_.vertices(), 0), stale_.resize(mesh_.vertices(), 1);
    exceeding_.resize(mesh_.halfEdges() / 3, 0);
    failed_.resize(mesh_.halfEdges(), 0), unflipped_.resize(mesh_.halfEdges(), 0);
    ring_.assign(limit_);
    replaced(whole_);
    return true;
  }

  const LocalField& field_;
  bool painted_;  // are colours held?
  SampledMesh sampled_;
  HalfEdgeMesh& mesh_;
  float tolerance_;
  MissedSamples missed_;
  Ring ring_;
  const Work whole_{ring_};
  float reach_;  // within which sheets of the mesh may come to cross
  MeshBlocks blocks_;
  CrowdedTriangles crowded_;
  float limit_;
  bool keeps_ = false;  // is what is too far being split?
  Progress& progress_;
  // A pass over the mesh has a number; 0 stands for none.
  Index pass_ = 0;
  std::vector<Index> taken_;      // by vertex: the last pass in which a collapse changed it
  std::vector<Index> changed_;    // by vertex: the pass before which something around it was last changed
  std::vector<Index> settled_;    // by vertex: the last pass in which it was to be moved
  std::vector<Index> near_;       // by vertex: the last pass in which its distance was looked at
  std::vector<Index> left_;       // by vertex: the last pass in which it would have left its block
  std::vector<char> stale_;       // by vertex: has it moved since its normal was read?
  std::vector<char> asItWas_;     // by vertex, of the first ones: is it of what is not split?
  std::vector<Index> exceeding_;  // by triangle: the last pass in which its samples were looked at
  std::vector<Index> failed_;     // by half-edge: the last pass in which its collapse failed
  std::vector<Index> unflipped_;  // by half-edge: the last pass in which it was to be flipped
};

}  // namespace

bool simplify(FeatureMesh& mesh, const LocalField& field, double tolerance,
              const std::vector<glm::vec3>& surface,
              const std::function<std::vector<glm::vec3>(const FeatureMesh&)>& exceeding, bool painted,
              Progress& progress) {
  Simplifier simplifier(coarsened(mesh, field, tolerance, painted, progress), field, tolerance, surface,
                        painted, progress);
  simplifier.run();
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
  Simplifier simplifier(coarsened(mesh, field, tolerance, painted, progress), field, tolerance, {}, painted,
                        progress);
  simplifier.runUnresolved();
  mesh = simplifier.take();
}

}  // namespace sdf
