#include "sdf/shape/calibrate/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "sdf/expr/gradient.h"
#include "sdf/shape/calibrate/cells.h"
#include "sdf/shape/calibrate/curved.h"
#include "sdf/shape/calibrate/forms.h"
#include "sdf/shape/formula.h"

namespace sdf {

namespace {

// A product of bounds, of which one may be of nothing.
double scaledBy(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

// What the distance is taken apart into. Values are those of the result, told in the operand's space.
struct Part {
  enum class Kind { Uniform, Negative, Least, Greatest, Choice, Box, Length, Linear, Curved, Turning };
  Kind kind;
  std::vector<int> of{};             // the parts that it is made of, before it in the list
  Expr value{};                      // of a leaf
  Expr condition{};                  // of a Choice
  std::vector<bool> cut{};           // of a Length: which parts are cut off at 0
  std::size_t roots = 0;             // of a leaf, a Box or a Length: where its readings begin
  std::optional<Vec3E> direction{};  // of a Linear: where its gradient points, turned, of length 1
};

class Calibration {
 public:
  // Curved parts have their own slope as far as `share` of what they could.
  Calibration(const Expr& distance, const Warp& warp, double share) : warp_(warp), share_(share) {
    // Many, as of a thousand balls, cost too much: the least of their lengths alone takes one root.
    constexpr std::ptrdiff_t kMostCurved = 32;
    of(distance, 0.0);
    if (curved() > kMostCurved) {
      clear();
      share_ = 0.0;
      of(distance, 0.0);
    }
    slopes_ = bounds();
    if (slope() < kInfinity) return;
    clear();
    turning(distance, 0.0);
    slopes_ = bounds();
  }

  double slope() const { return slopes_.back(); }
  std::ptrdiff_t curved() const { return std::ranges::count(parts_, Part::Kind::Curved, &Part::kind); }

  Expr built() const {
    std::vector<Expr> made;
    for (std::size_t i = 0; i < parts_.size(); ++i) made.push_back(built(parts_[i], made, slopes_[i]));
    return made.back();
  }

 private:
  using Kind = Part::Kind;

  void clear() { parts_.clear(), roots_.clear(), done_.clear(); }

  // The place of e + offset, the offset being uniform.
  int of(const Expr& claimed, const Expr& offset) {
    const auto key = std::pair(claimed.node(), offset.node());
    if (const auto it = done_.find(key); it != done_.end()) return it->second;
    kept_.insert(kept_.end(), {claimed, offset});
    const int place = parted(claimed, offset);
    done_.emplace(key, place);
    return place;
  }

  int parted(const Expr& claimed, const Expr& offset) {
    const Expr& e = claimed.unclaimed();
    const Op op = e.op();
    const auto arg = [&](int i) -> const Expr& { return e.arg(i); };
    const auto both = [&](const Expr& a, const Expr& b) { return std::vector{of(a, offset), of(b, offset)}; };
    if (isUniform(e)) return add({Kind::Uniform, {}, e + offset});
    if (op == Op::Neg) return negative(of(arg(0), -offset));
    if (op == Op::Add && isUniform(arg(0))) return of(arg(1), arg(0) + offset);
    if (op == Op::Add && isUniform(arg(1))) return of(arg(0), arg(1) + offset);
    if (op == Op::Sub && isUniform(arg(0))) return negative(of(arg(1), -(arg(0) + offset)));
    if (op == Op::Sub && isUniform(arg(1))) return of(arg(0), -arg(1) + offset);
    for (const int i : {0, 1})
      if (op == Op::Mul && isUniform(arg(i)) && arg(i).range().lo > 0.0 &&
          knowsMore(arg(1 - i), arg(i), claimed))
        return of(arg(1 - i), offset / arg(i));
    if (const auto n = linearGradient(isBeyond(e) ? arg(0) : op == Op::Abs ? arg(0) : e))
      return linear(claimed + offset, *n);
    if (op == Op::Abs) return add({Kind::Greatest, {of(arg(0), offset), negative(of(arg(0), -offset))}});
    if (op == Op::Min) return add({Kind::Least, both(arg(0), arg(1))});
    if (op == Op::Max) return add({Kind::Greatest, both(arg(0), arg(1))});
    if (isZero(offset)) {
      // The sign is that of the dividend.
      if (op == Op::Div && arg(1).range().lo > 0.0) return of(arg(0), offset);
      if (op == Op::Select && meetAtZero(e))
        return add({.kind = Kind::Choice, .of = both(arg(1), arg(2)), .condition = arg(0)});
      if (const auto sides = partsOfBox(e); !sides.empty()) return together(Kind::Box, sides);
      if (const auto parts = partsOfLength(e); !parts.empty()) return together(Kind::Length, parts);
    }
    if (const auto part = curvedPart(claimed, offset, warp_, share_))
      return add({.kind = Kind::Curved, .value = part->value, .roots = addRoots({part->value, part->slope})});
    return turning(claimed, offset);
  }

  // A claim about a product is not known of its factor.
  static bool knowsMore(const Expr& factor, const Expr& scale, const Expr& claimed) {
    constexpr double kRounding = 1e-9;
    return factor.lipschitz() * scale.range().hi <= claimed.lipschitz() * (1.0 + kRounding);
  }

  int add(Part part) {
    parts_.push_back(std::move(part));
    return static_cast<int>(parts_.size()) - 1;
  }
  int negative(int place) { return add({Kind::Negative, {place}}); }
  std::size_t addRoots(std::initializer_list<Expr> roots) {
    roots_.insert(roots_.end(), roots);
    return roots_.size() - roots.size();
  }

  // A distance has a slope: where its branches are negatives of each other, or change as one of them does its
  // sign, both are 0 at the change.
  static bool meetAtZero(const Expr& e) {
    const Expr &c = e.arg(0).unclaimed(), &a = e.arg(1).unclaimed(), &b = e.arg(2).unclaimed();
    const auto isNegativeOf = [](const Expr& u, const Expr& v) {
      return u.op() == Op::Neg && u.arg(0).unclaimed() == v;
    };
    if (isNegativeOf(a, b) || isNegativeOf(b, a)) return true;
    if ((c.op() != Op::Less && c.op() != Op::LessEqual) || !isZero(c.arg(1))) return false;
    return c.arg(0).unclaimed() == a || c.arg(0).unclaimed() == b;
  }

  int together(Kind kind, const std::vector<Expr>& parts) {
    Part result{.kind = kind};
    for (const Expr& part : parts) {
      const Expr& e = part.unclaimed();
      result.cut.push_back(kind == Kind::Length && isMaxWithZero(e));
      result.of.push_back(of(result.cut.back() ? e.arg(0) : part, 0.0));
    }
    result.roots = addRoots({});
    for (const int a : result.of)
      for (const int b : result.of) addRoots({cosine(parts_[a], parts_[b])});
    return add(std::move(result));
  }

  static Expr cosine(const Part& a, const Part& b) {
    return &a != &b && a.direction && b.direction ? abs(weighted(*a.direction, *b.direction)) : Expr(1.0);
  }

  int linear(const Expr& g, const Vec3E& n) {
    const Vec3E v = warp_.pulled(n);
    const Expr s = warp_.stretchAlong(n), value = g / s;
    return add({.kind = Kind::Linear,
                .value = value,
                .roots = addRoots({value, warp_.climb(s)}),
                .direction = scaled(v, 1.0 / s)});
  }

  int turning(const Expr& claimed, const Expr& offset) {
    const Expr value = (claimed + offset) / warp_.usual;
    const Expr steepest = claimed.lipschitz() * warp_.shear;
    return add({.kind = Kind::Turning,
                .value = value,
                .roots = addRoots({value, warp_.climb(warp_.usual), steepest})});
  }

  // Bounds of the parts' slopes.
  std::vector<double> bounds() {
    const std::size_t beyond = addRoots({warp_.beyond});
    IntervalReading reading(roots_);
    std::vector<Interval> values(parts_.size());
    std::vector<double> slopes(parts_.size());
    const auto slopesOf = [&](const Box& box) {
      reading.run(box);
      if (reading[beyond].lo > 0.0) return std::vector<double>(parts_.size(), 0.0);
      for (std::size_t i = 0; i < parts_.size(); ++i)
        bound(parts_[i], reading, values, slopes, values[i], slopes[i]);
      if (values.back().lo >= warp_.cap && !values.back().nan) slopes.back() = 0.0;
      return slopes;
    };
    // Some milliseconds' worth, whatever the size of the graph.
    const std::size_t mostCells = std::clamp<std::size_t>(300000 / reading.size(), 60, 500);
    std::vector<double> most(parts_.size(), 0.0);
    for (const Cell& cell : refined(warp_.region, warp_.size, mostCells, slopesOf))
      std::ranges::transform(most, cell.slopes, most.begin(),
                             [](double a, double b) { return std::max(a, b); });
    return most;
  }

  static void bound(const Part& part, const IntervalReading& reading, std::span<const Interval> values,
                    std::span<const double> slopes, Interval& value, double& slope) {
    const auto is = [&](Kind kind) { return part.kind == kind; };
    const auto valueOf = [&](int i) -> const Interval& { return values[part.of[i]]; };
    const auto slopeOf = [&](int i) { return slopes[part.of[i]]; };
    if (is(Kind::Uniform)) {
      value = part.value.range(), slope = 0.0;
    } else if (is(Kind::Linear) || is(Kind::Turning)) {
      value = reading[part.roots];
      slope = is(Kind::Linear) ? 1.0 : reading.most(part.roots + 2);
      slope += scaledBy(value.nan ? kInfinity : value.magnitude(), reading.most(part.roots + 1));
    } else if (is(Kind::Curved)) {
      value = reading[part.roots], slope = reading.most(part.roots + 1);
    } else if (is(Kind::Negative)) {
      value = neg(valueOf(0)), slope = slopeOf(0);
    } else if (is(Kind::Least) || is(Kind::Greatest)) {
      const Interval &a = valueOf(0), &b = valueOf(1);
      const bool first = !a.nan && !b.nan && (is(Kind::Least) ? a.hi < b.lo : a.lo > b.hi);
      const bool second = !a.nan && !b.nan && (is(Kind::Least) ? b.hi < a.lo : b.lo > a.hi);
      value = is(Kind::Least) ? min(a, b) : max(a, b);
      slope = first ? slopeOf(0) : second ? slopeOf(1) : std::max(slopeOf(0), slopeOf(1));
    } else if (is(Kind::Choice)) {
      value = hull(valueOf(0), valueOf(1)), slope = std::max(slopeOf(0), slopeOf(1));
    } else {
      boundTogether(part, reading, values, slopes, value, slope);
    }
  }

  // The gradient of a length is a mean of its parts' with weights of length 1: at most the root of the
  // largest sum in a row of their products, which are those of their directions and what they are longer.
  // Where all sides of a box are negative the greatest matters alone, else those that are not.
  static void boundTogether(const Part& part, const IntervalReading& reading,
                            std::span<const Interval> values, std::span<const double> slopes, Interval& value,
                            double& slope) {
    const std::size_t n = part.of.size();
    double greatest = -kInfinity;
    Interval squares(0.0), most(-kInfinity);
    for (std::size_t i = 0; i < n; ++i) {
      const Interval& v = values[part.of[i]];
      greatest = std::max(greatest, v.nan ? -kInfinity : v.lo);
      most = max(most, v);
      squares = sdf::add(squares, square(part.kind == Kind::Box || part.cut[i] ? max(v, Interval(0.0)) : v));
    }
    value = part.kind == Kind::Box ? sdf::add(sqrt(squares), min(most, Interval(0.0))) : sqrt(squares);
    const auto matters = [&](std::size_t i) {
      const Interval& v = values[part.of[i]];
      if (part.kind == Kind::Length && !part.cut[i]) return true;
      return v.nan || v.hi >= (part.kind == Kind::Box ? std::min(greatest, 0.0) : 0.0);
    };
    double products = 0.0, cosines = 0.0, longer = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!matters(i)) continue;
      double product = 0.0, cosine = 0.0;
      for (std::size_t j = 0; j < n; ++j)
        if (matters(j)) {
          const double along = reading.most(part.roots + i * n + j);
          product += along + slopes[part.of[i]] * slopes[part.of[j]] - 1.0;
          cosine += along;
        }
      products = std::max(products, product), cosines = std::max(cosines, cosine);
      longer = std::hypot(longer, std::max(slopes[part.of[i]], 1.0) - 1.0);
    }
    slope = std::min(std::sqrt(products), std::sqrt(cosines) + longer);
  }

  Expr placed(const Expr& e) const { return remap(e, {warp_.back.x, warp_.back.y, warp_.back.z}, kInfinity); }

  Expr built(const Part& part, std::span<const Expr> made, double slope) const {
    std::vector<Expr> d;
    for (std::size_t i = 0; i < part.of.size(); ++i) {
      const Expr& e = made[part.of[i]];
      d.push_back(!part.cut.empty() && part.cut[i] ? max(e, 0.0) : e);
    }
    switch (part.kind) {
      case Kind::Uniform:
        return part.value;
      case Kind::Negative:
        return -d[0];
      case Kind::Least:
        return min(d[0], d[1]);
      case Kind::Greatest:
        return max(d[0], d[1]);
      case Kind::Choice:
        return select(placed(part.condition), d[0], d[1]).claimLipschitz(slope);
      case Kind::Box:
        return boxDistance(d, slope);
      case Kind::Length:
        return (d.size() == 2 ? length(d[0], d[1]) : length(d[0], d[1], d[2])).claimLipschitz(slope);
      case Kind::Linear:
      case Kind::Curved:
      case Kind::Turning:
        break;
    }
    return placed(part.value).claimLipschitz(slope);
  }

  const Warp& warp_;
  double share_;
  std::vector<Part> parts_;
  std::vector<double> slopes_;  // bounds of the parts'
  std::vector<Expr> roots_;     // what is read of a cell
  std::vector<Expr> kept_;      // keeps the keys alive
  std::map<std::pair<const Node*, const Node*>, int> done_;
};

}  // namespace

Expr Warp::stretchAlong(const Vec3E& n) const {
  const Vec3E v = pulled(n);
  return sqrt(weighted(v, v));
}
Expr Warp::climb(const Expr& s) const { return scaled(stretchAlong(gradientOf(s)), 1.0 / s); }

// Curved parts have their own slopes as far as that does not make the whole much steeper.
Expr calibrated(const Expr& distance, const Warp& warp) {
  constexpr double kModerate = 6.0, kMuchSteeper = 2.0;
  const Calibration whole(distance, warp, 1.0);
  if (whole.slope() <= kModerate || whole.curved() == 0) return whole.built();
  const Calibration none(distance, warp, 0.0);
  const double most = std::max(kModerate, kMuchSteeper * none.slope());
  if (whole.slope() <= most) return whole.built();
  const Calibration some(distance, warp, 0.25);
  return some.slope() <= most ? some.built() : none.built();
}

}  // namespace sdf
