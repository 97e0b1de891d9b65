#include "sdf/proof/prisms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace sdf {
namespace {

// How often a triangle is quartered for a smaller bound, and so that the field is seen to rise.
constexpr int kDepthForGoal = 5;
constexpr int kDepthForRise = 7;
// Where the slope is not known, parts are seldom better.
constexpr int kDepthForSlope = 2;
// Parts of all triangles that are looked at together, at most, and of one of them at least.
constexpr int kMostParts = 40'000, kFewestParts = 200;
// Where the least rise is a smaller share of the largest, parts are divided: the sides' values are bounded by
// it.
constexpr double kEven = 0.25;
// Of the largest rise: sides whose values are proven to be above that are high enough.
constexpr double kHigh = 0.4;
constexpr int kDepthForSides = 6;
// How often what is left of a prism above and below the surface is divided, in height or in four; into how
// many for each triangle; and of how many parts at least together, which take memory.
constexpr int kDepthForSigns = 10, kMostSigns = 6000;
constexpr std::size_t kTogether = 64;
// How much higher than where the surface is proven to be a flattened prism is.
constexpr double kSpare = 1.2;
// A prism that would not get flatter than that stays as it is.
constexpr double kFlatter = 0.9;

struct Part {
  Prism prism;
  std::uint32_t triangle;
  int depth;
  bool flattened;  // no higher than where the surface was proven to be
  double bound;    // from what it was flattened from
};

double longest(const std::array<glm::dvec3, 3>& all) {
  return std::max({glm::length(all[0]), glm::length(all[1]), glm::length(all[2])});
}

double longestSide(const Prism& p) {
  return longest({p.corners[1] - p.corners[0], p.corners[2] - p.corners[1], p.corners[0] - p.corners[2]});
}

// Quarters a triangle, and its prism with it.
void quarter(const Part& part, std::vector<Part>& out) {
  const auto& c = part.prism.corners;
  const auto& o = part.prism.offsets;
  const std::array<glm::dvec3, 6> p{
      c[0], c[1], c[2], 0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0])};
  const std::array<glm::dvec3, 6> q{
      o[0], o[1], o[2], 0.5 * (o[0] + o[1]), 0.5 * (o[1] + o[2]), 0.5 * (o[2] + o[0])};
  for (const auto& [i, j, k] : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {4, 5, 3}})
    out.push_back({{{p[i], p[j], p[k]}, {q[i], q[j], q[k]}},
                   part.triangle,
                   part.depth + 1,
                   part.flattened,
                   part.bound});
}

// Parts no larger than their prism is high are not divided for its sake.
bool mayDivideForRise(const Part& part) {
  return part.depth < kDepthForRise &&
         (part.depth < 2 || longestSide(part.prism) > longest(part.prism.offsets));
}

// What lies from one height to another in a part's prism on the outer or the inner side of its triangle.
struct Slab {
  Part part;
  std::uint32_t open;  // the part that it is of
  double from, to;     // of the offsets
  bool outer;

  Prism prism() const {
    Prism p = part.prism;
    const double middle = (outer ? 0.5 : -0.5) * (from + to), half = 0.5 * (to - from);
    for (int k = 0; k < 3; ++k) {
      p.corners[k] += middle * p.offsets[k];
      p.offsets[k] *= half;
    }
    return p;
  }
};

class PrismProver {
 public:
  PrismProver(const Tape& tape, bool continuous, double goal, ProofReading& reading)
      : tape_(tape), continuous_(continuous), goal_(goal), reading_(reading) {}

  // All parts of all triangles, level by level, so that vectors are full.
  void prove(const Shell& shell, std::span<const std::uint32_t> triangles, std::vector<PrismProof>& proofs) {
    std::vector<Part> parts;
    looked_.assign(triangles.size(), 0);
    most_.assign(triangles.size(), 0.0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      parts.push_back({shell.prism(triangles[i]), i, 0, false, kInfinity});
      proofs[triangles[i]] = {true, true, 0.0, kInfinity};
    }
    const auto proofOf = [&](std::uint32_t i) -> PrismProof& { return proofs[triangles[i]]; };
    readInRounds(std::move(parts), next_, [&](const Part& part, const PrismBounds& bounds) {
      PrismProof& proof = proofOf(part.triangle);
      if (proof.passed) part.flattened ? tighten(part, bounds, proof) : look(part, bounds, proof);
    });
    looked_.assign(triangles.size(), 0);
    // All of a triangle together.
    std::ranges::stable_sort(open_, {}, &Part::triangle);
    for (std::size_t first = 0, end; first < open_.size(); first = end) {
      end = std::min(first + kTogether, open_.size());
      while (end < open_.size() && open_[end].triangle == open_[end - 1].triangle) ++end;
      lookAtSigns({open_.data() + first, end - first}, proofOf);
    }
    lookAtSides(shell, triangles, proofs);
  }

 private:
  static const Prism& prismOf(const Part& part) { return part.prism; }
  static Prism prismOf(const Slab& slab) { return slab.prism(); }

  // Calls take(part, bounds) for the parts, then for those that this has put into `next`, and so on.
  template <class P, class Take>
  void readInRounds(std::vector<P> parts, std::vector<P>& next, const Take& take) {
    std::vector<Prism> prisms;
    std::vector<PrismBounds> bounds;
    for (; !parts.empty(); parts.swap(next)) {
      prisms.clear();
      for (const P& p : parts) prisms.push_back(prismOf(p));
      bounds.resize(parts.size());
      reading_.prisms(tape_, prisms, bounds.data());
      next.clear();
      for (std::size_t i = 0; i < parts.size(); ++i) take(parts[i], bounds[i]);
    }
  }

  bool divide(const Part& part) {
    if (looked_[part.triangle] >= std::max(kFewestParts, kMostParts / static_cast<int>(looked_.size())))
      return false;
    looked_[part.triangle] += 4;
    quarter(part, next_);
    return true;
  }

  void look(const Part& part, const PrismBounds& b, PrismProof& proof) {
    const bool hasSlope = b.most < kInfinity;
    if (b.least < kEven * b.most && (hasSlope ? mayDivideForRise(part) : part.depth < kDepthForSlope) &&
        divide(part))
      return;
    if (!(b.least > 0.0) || !hasSlope) {  // a field that may jump has no zero for sure
      settle(part, kInfinity, proof);
      return;
    }
    // Lines cross the surface within this share of their half.
    const double share = b.values.magnitude() / b.least * (1.0 + 1e-12);
    const double bound = share * longest(part.prism.offsets);
    const bool canFlatten = kSpare * share < kFlatter;
    if (bound > goal_ && !canFlatten && part.depth < kDepthForGoal && divide(part)) return;
    proof.sides = std::min(proof.sides, b.least - b.values.magnitude());
    most_[part.triangle] = std::max(most_[part.triangle], b.most);
    if (bound > goal_ && canFlatten) {
      next_.push_back(flattened(part, kSpare * share, bound));
    } else {
      settle(part, bound, proof);
    }
  }

  // This bound is proven of the part (or none, infinite); where it does not suffice, signs may give another.
  void settle(Part part, double bound, PrismProof& proof) {
    part.bound = bound;
    if (bound > goal_ && continuous_)
      open_.push_back(part);
    else
      take(bound, proof);
  }
  static void take(double bound, PrismProof& proof) {
    proof.bound = std::max(proof.bound, bound);
    proof.passed = proof.bound < kInfinity;
    if (!proof.passed) proof.sides = -kInfinity;
  }

  static Part flattened(Part part, double share, double bound) {
    part.flattened = true;
    part.bound = bound;
    for (glm::dvec3& o : part.prism.offsets) o *= share;
    return part;
  }

  void tighten(const Part& part, const PrismBounds& b, PrismProof& proof) {
    const double share = b.least > 0.0 ? b.values.magnitude() / b.least * (1.0 + 1e-12) : kInfinity;
    const double bound = std::min(part.bound, share * longest(part.prism.offsets));
    if (bound > goal_ && kSpare * share < kFlatter) {
      next_.push_back(flattened(part, kSpare * share, bound));
      return;
    }
    if (bound > goal_ && part.depth < kDepthForGoal && divide(part)) return;
    settle(part, bound, proof);
  }

  // Where the field is not seen to rise, or no more than by little: it passes 0 all the same where it is
  // positive above the triangle and negative below, from some height on.
  template <class ProofOf>
  void lookAtSigns(std::span<const Part> open, const ProofOf& proofOf) {
    std::vector<Slab> slabs, next;
    std::vector<PrismProof> found(open.size());
    for (std::uint32_t i = 0; i < open.size(); ++i) {
      const double reach = longest(open[i].prism.offsets), from = std::min(goal_ / reach, 0.5);
      for (double to = 1.0; to > from; to *= 0.5)
        for (const bool outer : {true, false})
          slabs.push_back({open[i], i, std::max(from, 0.5 * to), to, outer});
      found[i] = {true, true, from * reach, kInfinity};
    }
    readInRounds(std::move(slabs), next, [&](const Slab& slab, const PrismBounds& bounds) {
      PrismProof& proof = found[slab.open];
      if (!proof.passed || !proofOf(slab.part.triangle).passed) return;
      const double least = slab.outer ? bounds.all.lo : -bounds.all.hi;
      const bool isWrong = slab.outer ? bounds.values.hi < 0.0 : bounds.values.lo > 0.0;
      if (least > 0.0) {
        if (slab.to == 1.0) proof.sides = std::min(proof.sides, least);
      } else if (!isWrong && slab.part.depth < open[slab.open].depth + kDepthForSigns &&
                 looked_[slab.part.triangle] < kMostSigns) {
        looked_[slab.part.triangle] += divide(slab, next);
      } else {
        take(slab.to < 1.0 ? slab.to * longest(slab.part.prism.offsets) : kInfinity, proof);
        if (!proof.passed) take(open[slab.open].bound, proofOf(slab.part.triangle));
      }
    });
    for (std::uint32_t i = 0; i < open.size(); ++i) {
      PrismProof& proof = proofOf(open[i].triangle);
      take(std::min(found[i].bound, open[i].bound), proof);
      if (open[i].bound < kInfinity) continue;
      proof.sides = std::min(proof.sides, found[i].sides);
      most_[open[i].triangle] = std::max(most_[open[i].triangle], longest(open[i].prism.offsets));
    }
  }

  // In height, or in four; returns in how many.
  int divide(const Slab& slab, std::vector<Slab>& next) {
    if ((slab.to - slab.from) * longest(slab.part.prism.offsets) > longestSide(slab.part.prism)) {
      const double middle = 0.5 * (slab.from + slab.to);
      for (const bool upper : {false, true}) {
        next.push_back(slab);
        (upper ? next.back().from : next.back().to) = middle;
        ++next.back().part.depth;
      }
      return 2;
    }
    quarter(slab.part, next_);
    for (const Part& part : next_) next.push_back({part, slab.open, slab.from, slab.to, slab.outer});
    next_.clear();
    return 4;
  }

  // Where the rise promises little of the values on the prisms' sides, beside creases, these are looked at
  // themselves.
  void lookAtSides(const Shell& shell, std::span<const std::uint32_t> triangles,
                   std::vector<PrismProof>& proofs) {
    std::vector<Part> parts;
    std::vector<double> found(triangles.size(), kInfinity);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const PrismProof& proof = proofs[triangles[i]];
      if (!proof.passed || proof.sides > kHigh * most_[i]) continue;
      for (const bool outer : {true, false}) {
        Part side{shell.prism(triangles[i]), i, 0, outer, 0.0};
        for (int k = 0; k < 3; ++k)
          side.prism.corners[k] +=
              (outer ? 1.0 : -1.0) * std::exchange(side.prism.offsets[k], glm::dvec3(0.0));
        parts.push_back(side);
      }
    }
    readInRounds(std::move(parts), next_, [&](const Part& part, const PrismBounds& bounds) {
      const std::uint32_t t = part.triangle;
      if (found[t] <= 0.0) return;
      const double least = part.flattened ? bounds.values.lo : -bounds.values.hi;
      const bool isWrong = part.flattened ? bounds.values.hi < 0.0 : bounds.values.lo > 0.0;
      if (least < kHigh * most_[t] && part.depth < kDepthForSides && !isWrong)
        quarter(part, next_);
      else
        found[t] = std::min(found[t], least);
    });
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      if (PrismProof& proof = proofs[triangles[i]]; found[i] < kInfinity)
        proof.sides = std::max(proof.sides, found[i]);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      if (PrismProof& proof = proofs[triangles[i]]; proof.proven())
        proof.bound = std::min(proof.bound, longest(shell.prism(triangles[i]).offsets));
  }

  const Tape& tape_;
  const bool continuous_;
  const double goal_;
  ProofReading& reading_;
  std::vector<int> looked_;        // parts of each triangle
  std::vector<double> most_;       // largest rise in each
  std::vector<Part> next_, open_;  // open: that signs may tell more about
};

}  // namespace

void provePrisms(const Tape& tape, bool continuous, const Shell& shell,
                 std::span<const std::uint32_t> triangles, double goal, ProofReading& reading,
                 std::vector<PrismProof>& proofs) {
  PrismProver(tape, continuous, goal, reading).prove(shell, triangles, proofs);
}

}  // namespace sdf
