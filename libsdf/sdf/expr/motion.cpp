#include "sdf/expr/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sdf/base/fnv.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

/// Far above the rounding of some turns and shifts in double, far below a float's of what they move.
constexpr double kSame = 1e-10;
/// Sine between directions that tell enough of each other's planes for the rounding not to grow beyond kSame.
constexpr double kApart = 1e-3;

/// position . p + normal . n + constant
struct Affine {
  glm::dvec3 position{0.0}, normal{0.0};
  double constant = 0.0;

  bool isConstant() const { return position == glm::dvec3(0.0) && normal == glm::dvec3(0.0); }
};

Affine sum(const Affine& a, const Affine& b) {
  return {a.position + b.position, a.normal + b.normal, a.constant + b.constant};
}
Affine scaled(const Affine& a, double by) { return {a.position * by, a.normal * by, a.constant * by}; }

using Arguments = std::array<const Affine*, 3>;

Affine affineVariable(Variable v) {
  Affine a;
  const int i = static_cast<int>(v);
  (i < 3 ? a.position : a.normal)[i % 3] = 1.0;
  return a;
}

/// What a node is as an affine function; nothing where it is none, or not by these operations.
std::optional<Affine> affineOf(const Expr& e, const Arguments& args) {
  if (e.isConstant()) return Affine{{}, {}, e.constantValue()};
  if (e.op() == Op::Variable) return affineVariable(e.variableIndex());
  const Linearity linearity = info(e.op()).linearity;
  const int count = arity(e.op());
  if (linearity == Linearity::Nonlinear || std::count(args.begin(), args.begin() + count, nullptr) > 0)
    return std::nullopt;
  const bool isSum = linearity == Linearity::Linear;
  // The argument times what the operation multiplies it by.
  const auto part = [&](int k) {
    return scaled(*args[k], evaluateOp<double>(e.op(), [&](int i) {
      return i == k ? 1.0 : isSum ? 0.0 : args[i]->constant;
    }));
  };
  if (isSum) return count == 1 ? part(0) : sum(part(0), part(1));
  if (args[1]->isConstant()) return part(0);
  return linearity == Linearity::Bilinear && args[0]->isConstant() ? std::optional(part(1)) : std::nullopt;
}

class AffineForms {
 public:
  explicit AffineForms(std::span<const Expr> roots) {
    for (const Expr& e : topologicalOrder(roots)) {
      Arguments args{};
      for (int i = 0; i < arity(e.op()); ++i) args[i] = of(e.arg(i));
      if (const std::optional<Affine> form = affineOf(e, args)) forms_.emplace(e, *form);
    }
  }
  const Affine* of(const Expr& e) const {
    const auto it = forms_.find(e);
    return it == forms_.end() ? nullptr : &it->second;
  }

 private:
  std::unordered_map<Expr, Affine> forms_;
};

/// What stands in one place of both graphs. An even place is one whose sign is dropped (Parity::Even).
struct Pair {
  Affine before, after;
  bool even = false;
};

/// Walks both graphs at once and gathers the affine pairs.
class Matching {
 public:
  Matching(std::span<const Expr> before, std::span<const Expr> after) : before_(before), after_(after) {
    for (std::size_t i = 0; i < before.size() && same_; ++i) open_.push_back({before[i], after[i], false});
    while (same_ && !open_.empty()) {
      const Place place = std::move(open_.back());
      open_.pop_back();
      same_ = look(place);
    }
  }
  /// Do the graphs differ in their affine parts alone?
  bool same() const { return same_; }
  const std::vector<Pair>& pairs() const { return pairs_; }

 private:
  struct Place {
    Expr before, after;
    bool even;
  };

  bool look(const Place& place) {
    const Expr a = place.before.unclaimed(), b = place.after.unclaimed();
    if (!seen_.insert({a.node(), b.node(), place.even}).second) return true;
    const Affine *const from = before_.of(a), *const to = after_.of(b);
    if (from && to) {
      pairs_.push_back({*from, *to, place.even});
      return true;
    }
    if (from || to || a.op() != b.op()) return false;
    if (arity(a.op()) == 0 && a != b) return false;
    if (const PayloadPart* p = a.payloadPart(), *q = b.payloadPart();
        p && (p->payload != q->payload || p->part != q->part))
      return false;
    const bool even = info(a.op()).parity == Parity::Even;
    for (int i = 0; i < arity(a.op()); ++i) open_.push_back({a.arg(i), b.arg(i), even});
    return true;
  }

  const AffineForms before_, after_;
  std::vector<Place> open_;
  std::set<std::tuple<const Node*, const Node*, bool>> seen_;
  std::vector<Pair> pairs_;
  bool same_ = true;
};

/// Three pairs whose positions span space, if there are such.
std::optional<std::array<const Pair*, 3>> pivotsOf(const std::vector<Pair>& pairs) {
  std::array<const Pair*, 3> pivots{};
  std::array<glm::dvec3, 3> axes{};
  for (int k = 0; k < 3; ++k) {
    double farthest = kApart;
    for (const Pair& pair : pairs) {
      const double length = glm::length(pair.before.position);
      if (!(length > 0.0)) continue;
      glm::dvec3 rest = pair.before.position / length;
      for (int j = 0; j < k; ++j) rest -= glm::dot(rest, axes[j]) * axes[j];
      if (glm::length(rest) > farthest) {
        farthest = glm::length(rest);
        pivots[k] = &pair;
        axes[k] = rest / farthest;
      }
    }
    if (!pivots[k]) return std::nullopt;
  }
  return pivots;
}

/// The motion that takes the pivots' functions to those after it, negated where `signs` says; nothing if none
/// is rigid.
std::optional<RigidMotion> motionOf(const std::array<const Pair*, 3>& pivots,
                                    const std::array<double, 3>& signs) {
  glm::dmat3 from, to;
  glm::dvec3 shift;
  for (int k = 0; k < 3; ++k) {
    const Pair& pair = *pivots[k];
    const double length = glm::length(pair.before.position);
    from[k] = pair.before.position / length;
    to[k] = signs[k] * pair.after.position / length;
    shift[k] = (signs[k] * pair.after.constant - pair.before.constant) / length;
  }
  // after(p) = before(T p + d) with T the turn's inverse: T' from = to, and d . from = shift.
  const glm::dmat3 turn = to * glm::inverse(from);
  const glm::dmat3 product = turn * glm::transpose(turn);
  double off = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) off = std::max(off, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
  if (!(off < kSame / kApart) || glm::determinant(turn) < 0.0) return std::nullopt;
  glm::dquat rotation = glm::normalize(glm::quat_cast(turn));
  // What only moves is not to be turned by rounding.
  if (glm::length(glm::dvec3(rotation.x, rotation.y, rotation.z)) < 0.1 * kSame)
    rotation = {1.0, 0.0, 0.0, 0.0};
  return RigidMotion{rotation, -(rotation * (glm::inverse(glm::transpose(from)) * shift))};
}

/// Does the motion take the function before to the one after?
bool fits(const Affine& before, const Affine& after, const RigidMotion& m, double reach) {
  const glm::dvec3 turned = m.rotation * before.position, turnedNormal = m.rotation * before.normal;
  const double steepness = glm::length(before.position);
  const double constant = before.constant - glm::dot(turned, m.translation);
  const double size = steepness * reach + std::max(std::abs(before.constant), std::abs(after.constant));
  return glm::distance(turned, after.position) <= kSame * steepness &&
         glm::distance(turnedNormal, after.normal) <= kSame * glm::length(before.normal) &&
         std::abs(constant - after.constant) <= kSame * size;
}

/// How far from the origin the functions' zeros and what moves reach: what their constants are rounded by.
double reachOf(const std::vector<Pair>& pairs, const RigidMotion& m) {
  double reach = glm::length(m.translation);
  for (const Pair& pair : pairs)
    if (const double steepness = glm::length(pair.before.position); steepness > 0.0)
      reach = std::max(
          {reach, std::abs(pair.before.constant) / steepness, std::abs(pair.after.constant) / steepness});
  return reach;
}

bool fitsAll(const std::vector<Pair>& pairs, const RigidMotion& m) {
  const double reach = reachOf(pairs, m);
  return std::ranges::all_of(pairs, [&](const Pair& pair) {
    return fits(pair.before, pair.after, m, reach) ||
           (pair.even && fits(pair.before, scaled(pair.after, -1.0), m, reach));
  });
}

/// Cosine of half the angle between the two.
double nearness(const RigidMotion& a, const RigidMotion& b) {
  return std::abs(glm::dot(a.rotation, b.rotation));
}

}  // namespace

std::optional<RigidMotion> motionBetween(std::span<const Expr> before, std::span<const Expr> after,
                                         const RigidMotion& near) {
  if (before.size() != after.size()) return std::nullopt;
  const Matching matching(before, after);
  if (!matching.same()) return std::nullopt;
  std::optional<RigidMotion> best;
  const auto consider = [&](const RigidMotion& m) {
    if ((!best || nearness(m, near) > nearness(*best, near) + kSame) && fitsAll(matching.pairs(), m))
      best = m;
  };
  consider({});
  if (const auto pivots = pivotsOf(matching.pairs())) {
    for (int choice = 0; choice < 8; ++choice) {
      std::array<double, 3> signs;
      bool allowed = true;
      for (int k = 0; k < 3; ++k) {
        signs[k] = choice >> k & 1 ? -1.0 : 1.0;
        allowed = allowed && (signs[k] > 0.0 || (*pivots)[k]->even);
      }
      if (!allowed) continue;
      if (const std::optional<RigidMotion> m = motionOf(*pivots, signs)) consider(*m);
    }
  }
  return best;
}

std::size_t hashWithoutMotion(std::span<const Expr> graphs) {
  const AffineForms forms(graphs);
  std::unordered_map<Expr, std::size_t> hashes;
  const auto hashOf = [&](const Expr& e) { return hashes.at(e.unclaimed()); };
  for (const Expr& e : topologicalOrder(graphs)) {
    std::size_t& hash = hashes[e] = kFnvBegin<std::size_t>;
    if (forms.of(e)) continue;
    hash = fnv(hash, static_cast<std::size_t>(e.op()));
    for (int i = 0; i < arity(e.op()); ++i) hash = fnv(hash, hashOf(e.arg(i)));
  }
  std::size_t all = kFnvBegin<std::size_t>;
  for (const Expr& e : graphs) all = fnv(all, hashOf(e));
  return all;
}

}  // namespace sdf
