// What winds about the y axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Angle about the y axis, from +x, in the direction in which a helix of this hand rises.
Expr risingAngle(Hand hand) {
  const Vec3E p = position();
  return hand == Hand::Right ? atan2(-p.z, p.x) : atan2(p.z, p.x);
}

// Distance to the helix (radius cos t, rise t, -+radius sin t), |t| <= last. What depends on t in the squared
// distance to a point at (rho, angle, y) is rise^2 (t - y / rise)^2 - 2 radius rho cos(t - angle): a parabola
// and a wave. So the least lies between the parabola's end and one of the wave's peaks on both sides of it
// (of those that remain, where t is held), or at an end of the helix.
class HelixDistance {
 public:
  HelixDistance(const Expr& radius, const Expr& rise, const Expr& last, Hand hand)
      : radius_(radius), rise_(rise), last_(last), hand_(hand) {}

  Expr make() const {
    const Vec3E p = position();
    const Expr angle = risingAngle(hand_), wanted = p.y / rise_;
    const Expr low = floor((clamp(wanted, -last_, last_) - angle) * (1.0 / kTurn)) * kTurn + angle;
    const Expr along = min(beside(low, wanted - low, 1.0), beside(low + kTurn, low + kTurn - wanted, -1.0));
    return min(along, min(toEnd(-last_), toEnd(last_)));
  }

 private:
  // Distance to a place between the wave's peak and the parabola's end, `way` radians from it. It jumps where
  // another peak is the next: only the least of all has a slope.
  Expr beside(const Expr& peak, const Expr& way, double sign) const {
    const Vec3E p = position();
    const Expr rho = norm(p.x, p.z), from = max(way, 0.0);
    const Expr t = clamp(peak + sign * root(rho, from), -last_, last_);
    const Expr turned = t - peak;
    return length(rho - radius_ * cos(turned), radius_ * sin(turned), p.y - rise_ * t);
  }

  // The least v >= 0 with radius rho sin v + rise^2 (v - from) = 0, if there is one up to pi, where the sum
  // is concave. It begins with the parabola 4 v (pi - v) / pi^2 >= sin v, so below the root, and takes
  // Halley's steps.
  Expr root(const Expr& rho, const Expr& from) const {
    constexpr int kSteps = 3;        // they leave 1e-6 of the size; two leave 2e-5, one 3e-4
    constexpr double kLeast = 1e-9;  // of a divisor that may be 0 where there is no root
    const Expr square = rise_ * rise_, sum = radius_ * rho + square;
    const Expr wave = radius_ * rho / sum, line = square / sum;
    const Expr most = min(from, std::numbers::pi);
    const Expr b = wave * (4.0 / std::numbers::pi) + line;
    const Expr inside = b * b - wave * line * from * (16.0 / (std::numbers::pi * std::numbers::pi));
    Expr v = min(2.0 * line * from / (b + sqrt(max(inside, 0.0))), most);
    for (int i = 0; i < kSteps; ++i) {
      const Expr sine = wave * sin(v), value = sine + line * (v - from), slope = wave * cos(v) + line;
      v = clamp(v - 2.0 * value * slope / max(2.0 * slope * slope + value * sine, kLeast), 0.0, most);
    }
    return v;
  }

  Expr toEnd(const Expr& t) const {
    const Vec3E p = position();
    const Expr z = radius_ * sin(t);
    return norm(p.x - radius_ * cos(t), p.y - rise_ * t, hand_ == Hand::Right ? p.z + z : p.z - z);
  }

  const Expr &radius_, &rise_, &last_;
  const Hand hand_;
};

// Up to which radius a tube along the helix does not run into itself: its radius of curvature is at least
// `radius`, and of what lies half a turn and more further along none is nearer than the turn above.
double helixReach(double radius, double rise) {
  constexpr int kSteps = 256;
  double nearest = kInfinity;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = std::numbers::pi * (1.0 + static_cast<double>(i) / kSteps);
    nearest = std::min(nearest, std::hypot(2.0 * radius * std::sin(0.5 * t), rise * t));
  }
  const double between = std::hypot(radius, rise) * std::numbers::pi / (2 * kSteps);
  return std::min(radius, 0.5 * (nearest - between));
}

}  // namespace

Shape spring(const Expr& radius, const Expr& pitch, const Expr& turns, const Expr& wire, Hand hand) {
  Check c("spring");
  c.positive("radius", radius).positive("pitch", pitch).positive("turns", turns).positive("wire", wire);
  if (!c.ok()) return c.failure();
  const Expr r = positiveSize(radius), rise = positiveSize(pitch) * (1.0 / kTurn);
  const Expr last = positiveSize(turns) * std::numbers::pi;
  const double side = upper(r) + upper(wire), end = upper(rise * last) + upper(wire);
  return solid(HelixDistance(r, rise, last, hand).make().claimLipschitz(1.0) - wire,
               Box::centred({side, end, side}), tubeKind(wire, helixReach(lower(r), lower(rise))));
}

Shape thread(const Expr& diameter, const Expr& pitch, const Expr& length, int starts, const Expr& clearance,
             Hand hand) {
  // In pitches: what the root lies below the crest, and half of the crest's width (ISO 68-1).
  constexpr double kDepth = 0.625 * 0.5 * std::numbers::sqrt3, kHalfCrest = 1.0 / 16.0;
  Check c("thread");
  c.positive("diameter", diameter).positive("pitch", pitch).positive("length", length);
  c.integerAtLeast("starts", starts, 1).any("clearance", clearance);
  if (c.ok()) {
    const Expr widest = diameter * (0.5 / kDepth);
    c.below("pitch", pitch, shown(0.5 / kDepth) + " diameters", widest);
    const Expr most = diameter * 0.25 - pitch * (0.5 * kDepth);  // half of the root's radius
    c.that(uniformValue(most + clearance) > 0.0, "clearance must be above " + shown(-uniformValue(most)) +
                                                     ", got " + shown(uniformValue(clearance)));
  }
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr step = positiveSize(pitch), crest = positiveSize(diameter) * 0.5,
             root = positiveSize(crest - step * kDepth), half = positiveSize(length) * 0.5;
  const Expr rho = norm(p.x, p.z);
  const Expr along = p.y - risingAngle(hand) * (step * (starts / kTurn));
  // From the middle of the nearest turn.
  const Expr off = abs(along - round(along / step) * step);
  // A flank rises by 30 degrees along the axis.
  const Expr flank =
      0.5 * (rho - crest) + (0.5 * std::numbers::sqrt3) * (off - step * kHalfCrest) - clearance;
  // Within half of the root's radius, where it would be steeper, the core lies deeper than all of the turns.
  const Expr turns = largest(rho - crest - clearance, flank, 0.5 * root - rho);
  const double lead = starts * upper(step) / (std::numbers::pi * std::max(lower(root), kSmallestSize));
  const double steepest = std::sqrt(1.0 + 0.75 * lead * lead);
  const Expr wound = min(rho - root - clearance, turns) * (1.0 / steepest);
  const Expr end = abs(p.y) - half;
  const Expr chamfer = (rho - root - clearance + end) * std::numbers::sqrt2 * 0.5;
  const double side = upper(crest + clearance), top = upper(half);
  Shape s = solid(largest(wound.claimLipschitz(1.0), end, chamfer.claimLipschitz(1.0)),
                  Box::centred({side, top, side}), ClaimKind::Bound);
  s.claim.growth = steepest;
  return s;
}

}  // namespace sdf
