// The clauses of a shape's claim, each as a search for a point that refutes it.
//
// No tolerance is guessed: the interval reading at a point encloses the exact value and all rounding on the
// way to it, so a clause is refuted only by what the intervals exclude.
#pragma once
#include <array>
#include <optional>
#include <sstream>

#include "claims/subject.h"
#include "sdf/shape/operators/place.h"

namespace sdf::test {

/// What refutes a clause, and where. Nothing: it stands.
using Verdict = std::optional<std::string>;

template <class... Parts>
Verdict finding(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  return out.str();
}
inline std::string exactly(const glm::dvec3& p) {
  std::ostringstream out;
  out.precision(17);
  out << "(" << p.x << ", " << p.y << ", " << p.z << ")";
  return out.str();
}
inline std::string exactly(const Interval& a) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << a.lo << ", " << a.hi << "]" << (a.nan ? " or NaN" : "");
  return out.str();
}

/// Rounding of a computed position of this size: a turn of the point is nine products, their sums and the
/// matrix' own rounding, each of half an epsilon.
inline double placeRounding(const glm::dvec3& p) { return 16.0 * kEpsilon * glm::length(p); }

/// A formula's own constants are rounded, and those of turns make it steeper or slower by as much.
inline constexpr double kConstantRounding = 256.0 * kEpsilon;

/// Finite everywhere: at the centre, on axes, at the bounds' corners, 1e5 away.
inline Verdict isFinite(const Subject& s) {
  std::vector<double> coordinates{0.0, -0.0, 1e-30, -1e-12, 1.0, 1e5, -1e5};
  for (int i = 0; i < 3; ++i)
    for (const double end : {s.shape().bounds.min[i], s.shape().bounds.max[i]})
      if (std::isfinite(end)) coordinates.push_back(end);
  std::vector<glm::dvec3> points = s.points();
  for (const double c : coordinates) points.emplace_back(c);
  constexpr int kMixed = 100;
  std::mt19937 random = s.random();
  const auto any = [&] { return coordinates[random() % coordinates.size()]; };
  for (int i = 0; i < kMixed; ++i) {
    const double x = any(), y = any();
    points.emplace_back(x, y, any());
  }
  for (const glm::dvec3& p : points)
    if (!std::isfinite(s.value(p))) return finding("f = ", s.value(p), " at ", exactly(p));
  return {};
}

/// The solid lies in the bounds; where f <= c, in the bounds grown by growth c.
inline Verdict isBounded(const Subject& s) {
  const double growth = growthOf(s.shape().claim);
  for (const glm::dvec3& p : s.points()) {
    const Interval f = s.at(p);
    const double level = f.hi + s.exactness();
    const double by = level <= 0.0 ? 0.0 : growth * level;
    if (by != by || by == kInfinity) continue;
    if (s.shape().bounds.grown(by + placeRounding(p)).contains({p, p})) continue;
    return finding("f = ", exactly(f), " at ", exactly(p), ", outside of the bounds ",
                   exactly(s.shape().bounds.min), " to ", exactly(s.shape().bounds.max), " grown by ", by);
  }
  return {};
}

/// A second point for p: some way off in a random direction, or along the slope, where f changes most.
inline glm::dvec3 partner(const Subject& s, const glm::dvec3& p, std::mt19937& random) {
  const glm::dvec3 slope = evaluateGradient(s.tape(), p).gradient;
  const double steep = glm::length(slope);
  const bool along = random() % 2 && steep > 0.0 && std::isfinite(steep);
  const double step = anyScale(random, 1e-7, 2.0) * s.longest();
  return p + (along ? slope * (random() % 2 ? 1.0 : -1.0) / steep : randomDirection(random)) * step;
}

/// Difference quotients over all scales stay within the constant.
inline Verdict keepsItsConstant(const Subject& s) {
  const Claim& claim = s.shape().claim;
  if (!std::isfinite(claim.lipschitz)) return {};
  std::mt19937 random = s.random();
  constexpr int kPartners = 4;
  for (const glm::dvec3& p : s.points()) {
    const Interval fp = s.at(p);
    for (int i = 0; i < kPartners; ++i) {
      const glm::dvec3 q = partner(s, p, random);
      const Interval fq = s.at(q);
      const double change = std::max(fp.lo - fq.hi, fq.lo - fp.hi) - 2.0 * s.exactness();
      const double allowed = claim.lipschitz * glm::distance(p, q) * (1.0 + kConstantRounding);
      if (change > allowed)
        return finding("f = ", exactly(fp), " at ", exactly(p), " and ", exactly(fq), " at ", exactly(q),
                       ": a slope of ", change / glm::distance(p, q), ", claimed ", claim.lipschitz);
    }
  }
  return {};
}

/// |f| does not exceed the distance: a ball of that radius has no change of sign.
inline Verdict neverExceedsTheDistance(const Subject& s) {
  if (s.shape().claim.kind > ClaimKind::Bound) return {};
  std::mt19937 random = s.random();
  constexpr int kDirections = 6;
  for (const glm::dvec3& p : s.points()) {
    const Interval f = s.at(p);
    const double radius = std::max(f.lo, -f.hi) - placeRounding(p) - s.exactness();
    if (!(radius > 0.0)) continue;
    for (int i = 0; i < kDirections; ++i) {
      const glm::dvec3 apart = partner(s, p, random) - p;
      const double share = i % 2 ? 1.0 : uniform(random, 0.0, 1.0);
      const glm::dvec3 q = p + apart * (radius * share * (1.0 - kConstantRounding) / glm::length(apart));
      const Interval there = s.at(q);
      if (f.lo > 0.0 ? there.hi < -s.exactness() : there.lo > s.exactness())
        return finding("f = ", exactly(f), " at ", exactly(p), " but ", exactly(there), " at ", exactly(q));
    }
  }
  return {};
}

/// Is there a crease within a billionth of the size (where iterated: within what the iteration rounds it by)?
/// Around it derivatives are those of several sides, or, at the vertical tangent of a root, anything.
inline bool isCreased(const Subject& s, const glm::dvec3& p) {
  constexpr double kNear = 1e-9, kOneSide = 1e-3;
  const Subject::Slopes f = s.slopesOver(around(p, kNear * s.longest() + s.exactness()));
  return std::any_of(std::begin(f.d), std::end(f.d),
                     [](const Interval& d) { return d.nan || !(d.width() < kOneSide); });
}

/// Where exact, the slope is 1 off creases, and p - f grad f lies on the surface.
inline Verdict isExact(const Subject& s) {
  const ClaimKind kind = s.shape().claim.kind;
  if (kind > ClaimKind::ExactOutside) return {};
  // The slope of an iteration that is right to e within e / t for steps of t; t is a thousandth of the size.
  const double slopeError = kConstantRounding + 2e3 * s.exactness() / s.longest();
  for (const glm::dvec3& p : s.points()) {
    const Subject::Slopes f = s.slopesOver({p, p});
    if (!(f.v.lo > 0.0 || (kind == ClaimKind::Exact && f.v.hi < 0.0)) || isCreased(s, p)) continue;
    Interval steep(0.0);
    Box foot{p, p};
    for (int i = 0; i < 3; ++i) {
      steep = add(steep, square(f.d[i]));
      const Interval c = sub(Interval(p[i]), mul(f.v, f.d[i]));
      foot.min[i] = c.lo, foot.max[i] = c.hi;
    }
    const Interval length = sqrt(steep);
    if (length.lo > 1.0 + slopeError || length.hi < 1.0 - slopeError)
      return finding("the slope is ", exactly(length), " at ", exactly(p), ", where f = ", exactly(f.v));
    const double reach = 2.0 * s.exactness() + slopeError * f.v.magnitude();
    const Interval landed = s.over(foot);
    if (landed.lo > reach || landed.hi < -reach)
      return finding("from ", exactly(p), ", where f = ", exactly(f.v),
                     ", a step of f lands where f = ", exactly(landed));
  }
  return {};
}

/// A turn, a scale and a move, and the same of shapes.
struct Motion {
  glm::dvec3 angles, offset;
  double factor;

  Motion(std::mt19937& random, int dimension) {
    angles = {uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0)};
    offset = {uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)};
    factor = anyScale(random, 0.2, 5.0);
    if (dimension == 2) angles.x = angles.y = offset.z = 0.0;
  }
  Shape operator()(const Shape& s) const {
    return translate(scale(rotate(s, Vec3E(angles)), Expr(factor)), Vec3E(offset));
  }
  glm::dvec3 operator()(glm::dvec3 p) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double c = std::cos(angles[axis]), sn = std::sin(angles[axis]), pu = p[u], pv = p[v];
      p[u] = c * pu - sn * pv;
      p[v] = sn * pu + c * pv;
    }
    return p * factor + offset;
  }
};

/// Moved, turned and scaled: f'(T p) = scale f(p), of the same kind and constant.
inline Verdict movesRigidly(const Subject& s) {
  std::mt19937 random = s.random();
  const Motion motion(random, s.shape().dimension);
  const Shape moved = motion(s.shape());
  if (!moved.ok()) return finding("moved: ", *moved.error);
  const Claim &before = s.shape().claim, &after = moved.claim;
  // The product of the constants of three places, each rounded outwards by some ulps.
  const bool sameConstant = after.lipschitz <= before.lipschitz * (1.0 + 64.0 * kEpsilon);
  if (after.kind != before.kind || !sameConstant)
    return finding("moved, kind ", static_cast<int>(before.kind), " becomes ", static_cast<int>(after.kind),
                   " and the constant ", before.lipschitz, " becomes ", after.lipschitz);
  const Tape tape(moved.distance);
  for (const glm::dvec3& p : s.points()) {
    const glm::dvec3 q = motion(p);
    // Either way the point is rounded: three turns, a product and a sum.
    const double off =
        4.0 * (placeRounding(q) + motion.factor * placeRounding(p)) + placeRounding(motion.offset);
    const Interval here = mul(Interval(motion.factor), s.over(around(p, off / motion.factor)));
    const Interval there = evaluate(tape, around(q, off));
    if (here.hi < there.lo || there.hi < here.lo)
      return finding("f = ", exactly(here), " at ", exactly(p), ", moved ", exactly(there), " at ",
                     exactly(q));
    if (s.at(p).hi <= 0.0 && !moved.bounds.grown(off).contains({q, q}))
      return finding("moved, ", exactly(q), " is solid and outside of the bounds");
  }
  return {};
}

struct Clause {
  const char* name;
  Verdict (*refute)(const Subject&);
};

inline constexpr Clause kClaimClauses[] = {{"finite", isFinite},
                                           {"bounds", isBounded},
                                           {"constant", keepsItsConstant},
                                           {"bound", neverExceedsTheDistance},
                                           {"exact", isExact},
                                           {"moves", movesRigidly}};

}  // namespace sdf::test
