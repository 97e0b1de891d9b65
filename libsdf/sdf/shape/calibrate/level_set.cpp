#include "sdf/shape/calibrate/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/expr/gradient.h"
#include "sdf/shape/calibrate/cells.h"
#include "sdf/shape/calibrate/surface_points.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

// How fast the value grows beyond its reach: so that light finds more room there, at little slope.
constexpr double kBeyond = 0.5;

// What is made of g on one side of the surface, g being positive: g (1 + c g), or where c is negative
// g / (1 - c g), which both grow without end.
struct Profile {
  double c = 0.0;
  double knee = kInfinity;  // from this g on it grows by kBeyond alone
  /// The largest slope at any g from `least` to `most`.
  double slope(double least, double most) const {
    if (least >= knee) return kBeyond;
    return c < 0.0 ? std::pow(1.0 - c * least, -2) : 1.0 + 2.0 * c * std::min(most, knee);
  }
  /// The g of a value; infinite where there is none.
  double of(double v) const {
    if (c < 0.0) return 1.0 + c * v > 0.0 ? v / (1.0 + c * v) : kInfinity;
    return 2.0 * v / (1.0 + std::sqrt(1.0 + 4.0 * c * v));
  }
};

// The bounds of a first step to be taken, and what is made of it, outside and inside.
struct Sides {
  double most[2];
  Profile profile[2];
};

// A formula over a box with its first and second derivatives.
struct Jet {
  Interval value;
  std::array<Interval, 3> gradient;
  std::array<std::array<Interval, 3>, 3> bending;
  double least = 0.0, most = 0.0;  // the gradient's length
  bool known = true;
};

class JetReading {
 public:
  JetReading(const Expr& f, const Vec3E& gradient)
      : reading_(std::array{f, gradient.x, gradient.y, gradient.z}) {}

  std::size_t size() const { return reading_.size(); }

  Jet over(const Box& box) {
    reading_.run(box);
    Jet jet{.value = reading_[0].v, .gradient = {}, .bending = {}};
    jet.known = !jet.value.nan;
    for (std::size_t i = 0; i < 3; ++i) {
      const Sloped& g = reading_[i + 1];
      jet.gradient[i] = g.v;
      jet.least = std::hypot(jet.least, nearest(g.v));
      jet.most = std::hypot(jet.most, farthest(g.v));
      jet.known = jet.known && !g.v.nan;
      for (std::size_t k = 0; k < 3; ++k) {
        jet.bending[i][k] = g.d[k];
        jet.bending[i][k].nan = false;  // as of 0 times an infinite slope
        jet.known = jet.known && farthest(jet.bending[i][k]) < kInfinity;
      }
    }
    return jet;
  }

 private:
  SlopedReading reading_;
};

// A bound of the value's slope in a cell where |grad f| is at least `least`, on the side where g lies in
// [0, most]. The gradient of g is n - g H n / |grad f|, with n of length 1 and H the second derivatives:
// along n it is 1 - g n^T H n / |grad f|, and beside n g times what H n has there.
double slopeOn(const Jet& jet, const Interval& g, double least, const Profile& profile) {
  const Interval length(least, std::max(least, jet.most));
  std::array<Interval, 3> n, turned;
  for (int i = 0; i < 3; ++i) n[i] = max(min(div(jet.gradient[i], length), Interval(1.0)), Interval(-1.0));
  Interval along(0.0);
  double square = 0.0;
  for (int i = 0; i < 3; ++i) {
    turned[i] = Interval(0.0);
    for (int k = 0; k < 3; ++k) turned[i] = add(turned[i], mul(jet.bending[i][k], n[k]));
    along = add(along, mul(turned[i], n[i]));
    square += std::pow(farthest(turned[i]), 2);
  }
  const double beside = std::sqrt(std::max(0.0, square - std::pow(nearest(along), 2)));
  const double most = farthest(g);
  const double ahead = farthest(sub(Interval(1.0), mul(g, div(along, length))));
  return std::hypot(ahead, most * beside / least) * profile.slope(nearest(g), most);
}

// The same in any cell: beyond the sides' bounds the value stays as it is.
double slopeIn(const Box& cell, JetReading& reading, const Sides& sides) {
  const Jet jet = reading.over(cell);
  if (jet.value.nan) return kInfinity;
  double slope = 0.0;
  for (const int side : {0, 1}) {
    const Interval f = side == 0 ? jet.value : neg(jet.value);
    if (f.hi < 0.0) continue;
    const double least = std::max(f.lo, 0.0), longest = sides.most[side];
    if (least > jet.most * longest) continue;
    const double gradient = std::max(jet.least, least / longest);
    if (!(gradient > 0.0) || !jet.known) return kInfinity;
    const Interval g(std::min(longest, least / jet.most), std::min(longest, f.hi / gradient));
    slope = std::max(slope, slopeOn(jet, side == 0 ? g : neg(g), gradient, sides.profile[side]));
  }
  return slope;
}

// The c by which the median of the points at this distance along the normals has it as its value: of
// g (1 + c g) = v it is (v / g - 1) / g, of g / (1 - c g) = v it is (v / g - 1) / v.
Profile profileAt(SurfaceReading& reading, const std::vector<SurfacePoint>& points, double side, double at) {
  std::vector<double> all;
  for (const SurfacePoint& s : points) {
    const SurfacePoint p = reading.at(s.at + side * at * glm::normalize(s.gradient));
    const double g = side * p.value / glm::length(p.gradient);
    if (g > 0.0 && g < kInfinity) all.push_back((at / g - 1.0) / std::min(g, at));
  }
  if (all.empty()) return {};
  const auto median = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, median);
  return {*median};
}

Expr shaped(const Expr& g, const Profile& profile) {
  const Expr near = profile.knee < kInfinity ? min(g, profile.knee) : g;
  const Expr value = profile.c < 0.0 ? near / (1.0 - near * profile.c) : near * (near * profile.c + 1.0);
  return profile.knee < kInfinity ? value + max(g - profile.knee, 0.0) * kBeyond : value;
}

}  // namespace

struct LevelSets::Readings {
  Expr f;
  Vec3E gradient;
  Profile out, in;
  JetReading jets;
  Box part;  // of the region: of what is the same on both sides of a plane, one
  std::size_t mostCells;

  Readings(const Expr& formula, const Box& region, const Profile& outside, const Profile& inside)
      : f(formula), gradient(gradientOf(f)), out(outside), in(inside), jets(f, gradient), part(region) {
    mostCells = affordableCells(100000, jets.size(), 2500);
    for (int i = 0; i < 3; ++i)
      if (isEven(f, i) && part.min[i] < 0.0 && part.max[i] >= -part.min[i]) part.min[i] = 0.0;
  }
};

LevelSets::LevelSets(const Expr& f, const Box& region, const Reach& at) {
  // Enough for a median that is right to a tenth of how far the points differ; of a graph so large that they
  // take more than a tenth of a second, fewer.
  constexpr std::size_t kLines = 100, kFewest = 10, kLinesTimesOperations = 300'000;
  if (!region.finite()) return;
  SurfaceReading points(f);
  const std::size_t lines = std::clamp(kLinesTimesOperations / points.size(), kFewest, kLines);
  std::vector<SurfacePoint> zeros = points.zeros(region, static_cast<int>(lines));
  std::erase_if(zeros, [](const SurfacePoint& p) { return !(glm::length(p.gradient) > 0.0); });
  if (zeros.empty()) return;
  const Profile out = profileAt(points, zeros, 1.0, at.out), in = profileAt(points, zeros, -1.0, at.in);
  readings_ = std::make_unique<Readings>(f, region, out, in);
}

LevelSets::~LevelSets() = default;

std::optional<LevelSet> LevelSets::within(const Reach& reach, double farther) {
  if (!readings_) return {};
  auto& [f, gradient, outside, in, jets, part, mostCells] = *readings_;
  Profile out = outside;
  Sides sides{{out.of(reach.out), in.of(reach.in)}, {out, in}};
  if (farther > 0.0) {
    out.knee = sides.most[0];
    sides.most[0] += farther / kBeyond;
    sides.profile[0] = out;
  }
  if (!(sides.most[0] < kInfinity) || !(sides.most[1] < kInfinity)) return {};

  double slope = 0.0;
  const auto slopesOf = [&, &read = jets](const Box& box) { return std::vector{slopeIn(box, read, sides)}; };
  for (const Cell& cell : refined(part, part.longestSide(), mostCells, slopesOf))
    slope = std::max(slope, cell.worst());
  if (!(slope < kInfinity)) return {};

  const Expr steepness = length(gradient);
  const Expr capped = max(f * (1.0 / sides.most[0]), f * (-1.0 / sides.most[1]));
  // Which is within these by itself, but intervals may not see it.
  const Expr g = clamp(f / max(steepness, capped), -sides.most[1], sides.most[0]);
  const Expr value = select(less(g, 0.0), -shaped(-g, in), shaped(g, out));
  return LevelSet{value.claimLipschitz(slope), scaled(gradient, 1.0 / steepness), slope};
}

}  // namespace sdf
