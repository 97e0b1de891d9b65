#include "sdf/shape/calibrate/offset.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "sdf/expr/gradient.h"
#include "sdf/shape/calibrate/corners.h"
#include "sdf/shape/calibrate/forms.h"
#include "sdf/shape/calibrate/surface_points.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

// How far the distance is calibrated, and how much farther it grows outside, in what is asked for: as far as
// light and blends may look if that costs little, else as little as keeps the surface from the end.
constexpr double kScant = 1.25;
struct Extent {
  double near, farther;
};
constexpr Extent kExtents[] = {{2.0, 8.0}, {2.0, 0.0}, {kScant, 4.0}, {kScant, 0.0}};
// How far beyond the bounds the calibration goes, in what is asked for.
constexpr double kMargin = 1.5;
// Slopes: one that costs little, and one above which a distance stays as it is.
constexpr double kModerate = 2.0, kSteepest = 6.0;
// A slope so much less is worth a shorter extent.
constexpr double kWorthIt = 0.8;
// A round inside an offset outwards is not asked for, but reached within this share of it.
constexpr double kOtherSide = 0.25;

// Is its gradient of length 1, as far as points of the region tell?
bool looksUnit(const Expr& e, const Box& region) {
  constexpr int kAlong = 4;
  constexpr double kRounding = 1e-6;
  SurfaceReading reading(e);
  Box box = region;
  for (int i = 0; i < 3; ++i) {
    const double size = sizeOf(region);
    if (!(box.min[i] > -kInfinity)) box.min[i] = std::min(box.max[i], size) - 2.0 * size;
    if (!(box.max[i] < kInfinity)) box.max[i] = box.min[i] + 2.0 * size;
  }
  // Off the middle and off planes of symmetry.
  constexpr double kShift = 0.137;
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const glm::dvec3 at(i % kAlong, i / kAlong % kAlong, i / (kAlong * kAlong));
    const glm::dvec3 p = box.min + (at + 0.5 + kShift) / static_cast<double>(kAlong) * box.size();
    if (std::abs(glm::length(reading.at(p).gradient) - 1.0) > kRounding) return false;
  }
  return true;
}

// What a distance is the least and the greatest of.
struct Tree {
  enum class Kind { Face, Least, Greatest };
  Kind kind = Kind::Face;
  std::size_t face = 0;
  std::vector<Tree> of{};
  std::optional<Expr> whole{};  // what its parts' extreme is told by in its place
};

// sign (factor e + offset), with factor and offset uniform, factor positive.
struct Moved {
  Expr factor = 1.0, offset = 0.0;
  bool negative = false;

  Expr of(const Expr& e) const {
    const Expr value = scaled(e, factor);
    const Expr sum = isZero(offset) ? value : value + offset;
    return negative ? -sum : sum;
  }
};

class Offsets {
 public:
  Offsets(const Shape& shape, const Reach& at)
      : shape_(shape),
        at_{at.out > 0.0 ? at.out : kOtherSide * at.in, at.in > 0.0 ? at.in : kOtherSide * at.out},
        region_(grow(shape.bounds, kMargin * at_.out)) {}

  Shape run(const Reach& asked) {
    const Tree tree = parsed(shape_.distance, {});
    if (hasTooMany()) return shape_;
    readFaces();
    const Expr plain = plainOf(tree);
    std::optional<Expr> out, in;
    if (asked.out > 0.0) out = around(tree, at_.out);
    if (asked.in > 0.0) {
      faces_.clear(), negative_.clear();
      const Tree hollow = parsed(shape_.distance, {.negative = true});
      readFaces();
      in = around(hollow, at_.in);
    }
    return calibrates_ || out || in ? finished(plain, out, in) : withTried(shape_);
  }

 private:
  Shape withTried(Shape shape) const {
    shape.claim.uncalibrated = tried_;
    return shape;
  }

  Shape finished(const Expr& plain, const std::optional<Expr>& out, const std::optional<Expr>& in) {
    Expr d = plain;
    double slope = plain.lipschitz();
    if (out || in) {
      const Expr above = out.value_or(plain), below = in ? -*in : plain;
      slope = std::max(above.lipschitz(), below.lipschitz());
      d = select(less(plain, 0.0), below, above).claimLipschitz(slope);
      tried_ = {{d.unclaimed(), at_.out, at_.in}};
    }
    Shape result = withTried(shape_);
    if (calibrates_) {
      d = heldWithin(d, region_);
      result.claim.growth = kInfinity;
    } else {
      result.claim.growth = growthOf(shape_.claim);
    }
    result.distance = d;
    result.claim.kind = ClaimKind::Field;
    result.claim.lipschitz = std::min(d.lipschitz(), std::max(slope, 1.0));
    result.claim.calibrated = calibrates_;
    return settled(std::move(result));
  }

  // The leaf's own distance, made one where it is none; but that of a solid's side is told by the solid's.
  Face faceOf(const Expr& e, bool isSide) {
    if (isUniform(e)) return {e, 0.0};
    if (const auto n = linearGradient(e)) return planeOf(e, *n);
    if (isOneLipschitz(e.lipschitz()) && looksUnit(e, region_)) return {e, 1.0, gradientOf(e)};
    if (!isSide)
      if (const auto level = levelOf(e)) {
        calibrates_ = true;
        return {level->value, level->slope, level->normal};
      }
    return {e, e.lipschitz()};
  }

  static Face planeOf(const Expr& e, const Vec3E& n) {
    constexpr double kRounding = 1e-12;
    const double length = uniformValue(sdf::length(n));
    if (std::abs(length - 1.0) < kRounding && isOneLipschitz(e.lipschitz())) return {e, 1.0, n};
    if (!n.x.range().isPoint() || !n.y.range().isPoint() || !n.z.range().isPoint()) return {e, e.lipschitz()};
    return {e * (1.0 / length), 1.0, scaled(n, 1.0 / length)};
  }

  // What could not be calibrated for half as much either is not tried again.
  bool isTried(const Expr& e) const {
    const Expr part = withoutSums(e).unclaimed();
    return std::ranges::any_of(shape_.claim.uncalibrated, [&](const UncalibratedPart& tried) {
      return tried.part == part && 2.0 * at_.out >= tried.out && 2.0 * at_.in >= tried.in;
    });
  }

  std::optional<LevelSet> levelOf(const Expr& e) {
    if (isTried(e)) {
      tried_.push_back({withoutSums(e).unclaimed(), at_.out, at_.in});
      return {};
    }
    std::optional<LevelSet> best;
    LevelSets levels(e, region_, at_);
    for (const auto& [near, farther] : kExtents) {
      const auto level = levels.within({near * at_.out, near * at_.in}, farther * at_.out);
      if (level && (!best || level->slope < kWorthIt * best->slope)) best = level;
      if (best && best->slope <= kModerate) break;
    }
    if (best && best->slope <= kSteepest) return best;
    tried_.push_back({withoutSums(e).unclaimed(), at_.out, at_.in});
    return {};
  }

  Tree leaf(const Expr& e, const Moved& moved, int solid = -1) {
    faces_.push_back({Moved{moved.factor, moved.offset}.of(e)});
    faces_.back().solid = solid;
    negative_.push_back(moved.negative);
    return {.face = faces_.size() - 1};
  }

  // Leaves are calibrated as they stand, whichever side is asked for.
  void readFaces() {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const Expr value = faces_[i].distance;
      const int solid = faces_[i].solid;
      const auto [place, isNew] = known_.try_emplace(value.node(), Face{});
      if (isNew) {
        kept_.push_back(value);
        place->second = faceOf(value, solid >= 0);
      }
      Face& face = faces_[i] = place->second;
      face.solid = solid;
      if (!negative_[i]) continue;
      face.distance = -face.distance;
      if (face.normal) face.normal = scaled(*face.normal, -1.0);
    }
  }

  Tree several(Op op, const Moved& moved, std::vector<Tree> of) {
    const bool greatest = (op == Op::Max) != moved.negative;
    return {.kind = greatest ? Tree::Kind::Greatest : Tree::Kind::Least, .of = std::move(of)};
  }

  // Takes the distance apart, until there are too many faces. These have no slopes and normals yet.
  Tree parsed(const Expr& claimed, const Moved& moved) {
    if (hasTooMany()) return {};
    const Expr& e = claimed.unclaimed();
    const Op op = e.op();
    const auto arg = [&](int i) -> const Expr& { return e.arg(i); };
    const auto negated = [](Moved m) {
      m.offset = -m.offset, m.negative = !m.negative;
      return m;
    };
    const auto plus = [&](const Expr& more) {
      Moved m = moved;
      m.offset = m.offset + m.factor * more;
      return m;
    };
    if (isUniform(e)) return leaf(claimed, moved);
    if (op == Op::Neg) return parsed(arg(0), negated(moved));
    if (op == Op::Add && isUniform(arg(0))) return parsedOrLeaf(claimed, moved, arg(1), plus(arg(0)));
    if (op == Op::Add && isUniform(arg(1))) return parsedOrLeaf(claimed, moved, arg(0), plus(arg(1)));
    if (op == Op::Sub && isUniform(arg(1))) return parsedOrLeaf(claimed, moved, arg(0), plus(-arg(1)));
    if (op == Op::Sub && isUniform(arg(0)))
      return parsedOrLeaf(claimed, moved, arg(1), negated(plus(arg(0))));
    for (const int i : {0, 1})
      if (op == Op::Mul && isUniform(arg(i)) && arg(i).range().lo > 0.0) {
        Moved m = moved;
        m.factor = m.factor * arg(i);
        return parsedOrLeaf(claimed, moved, arg(1 - i), m);
      }
    if (op == Op::Abs)
      return several(Op::Max, moved, {parsed(arg(0), moved), parsed(arg(0), opposite(moved))});
    if (op == Op::Min || op == Op::Max)
      return several(op, moved, {parsed(arg(0), moved), parsed(arg(1), moved)});
    if (isZero(moved.offset))
      if (const auto sides = partsOfBox(e); !sides.empty()) {
        Tree box = several(Op::Max, moved, {});
        box.whole = moved.of(claimed);
        const int solid = solids_++;
        for (const Expr& side : sides) add(box, side, moved, solid);
        return box;
      }
    return leaf(claimed, moved);
  }

  // sign (-factor e + offset), for |e|.
  static Moved opposite(const Moved& m) { return {m.factor, -m.offset, !m.negative}; }

  // What is an extreme below a sum or product is taken apart; anything else keeps its claim.
  Tree parsedOrLeaf(const Expr& claimed, const Moved& moved, const Expr& inner, const Moved& innerMoved) {
    const Op op = withoutSums(inner).op();
    const bool isExtreme = op == Op::Min || op == Op::Max || op == Op::Abs;
    return isExtreme || (isZero(innerMoved.offset) && !partsOfBox(inner.unclaimed()).empty())
               ? parsed(inner, innerMoved)
               : leaf(claimed, moved);
  }

  static Expr withoutSums(const Expr& claimed) {
    const Expr& e = claimed.unclaimed();
    if (e.op() == Op::Neg) return withoutSums(e.arg(0));
    const bool linear = e.op() == Op::Add || e.op() == Op::Sub || e.op() == Op::Mul;
    for (const int i : {0, 1})
      if (linear && isUniform(e.arg(i)) && !isUniform(e.arg(1 - i))) return withoutSums(e.arg(1 - i));
    return e;
  }

  // The faces of a solid, whose own edges are told by its distance.
  void add(Tree& box, const Expr& side, const Moved& moved, int solid) {
    const Expr& e = side.unclaimed();
    if (e.op() == Op::Sub && isUniform(e.arg(1)) && e.arg(0).unclaimed().op() == Op::Abs) {
      const Expr& x = e.arg(0).unclaimed().arg(0);
      for (const Expr& half : {x - e.arg(1), -x - e.arg(1)}) box.of.push_back(leaf(half, moved, solid));
      return;
    }
    box.of.push_back(leaf(side, moved, solid));
  }

  Expr plainOf(const Tree& tree) const {
    if (tree.whole) return *tree.whole;
    if (tree.kind == Tree::Kind::Face) return faces_[tree.face].distance;
    Expr d = plainOf(tree.of[0]);
    for (std::size_t i = 1; i < tree.of.size(); ++i) {
      const Expr other = plainOf(tree.of[i]);
      d = tree.kind == Tree::Kind::Least ? min(d, other) : max(d, other);
    }
    return d;
  }

  // The tree as the least of terms, each the greatest of faces; nothing where they are too many.
  using Term = std::vector<Face>;
  std::optional<std::vector<Term>> termsOf(const Tree& tree) const {
    constexpr std::size_t kMostTerms = 40, kMostInTerm = 12;
    if (tree.kind == Tree::Kind::Face) return std::vector<Term>{Term{faces_[tree.face]}};
    std::vector<Term> all;
    if (tree.kind == Tree::Kind::Greatest) all.emplace_back();
    for (const Tree& part : tree.of) {
      const auto terms = termsOf(part);
      if (!terms) return {};
      if (tree.kind == Tree::Kind::Least) {
        all.insert(all.end(), terms->begin(), terms->end());
        continue;
      }
      std::vector<Term> products;
      for (const Term& a : all)
        for (const Term& b : *terms) {
          products.push_back(a);
          products.back().insert(products.back().end(), b.begin(), b.end());
          if (products.back().size() > kMostInTerm || products.size() > kMostTerms) return {};
        }
      all = std::move(products);
    }
    if (tree.whole && tree.kind == Tree::Kind::Greatest)
      for (Term& term : all) term.push_back({*tree.whole, std::max(1.0, tree.whole->lipschitz())});
    return all.size() <= kMostTerms ? std::optional(all) : std::nullopt;
  }

  // The distance around edges and corners where it is positive; nothing where there are none.
  std::optional<Expr> around(const Tree& tree, double at) const {
    const auto terms = termsOf(tree);
    if (!terms) return {};
    std::optional<Expr> least;
    bool any = false;
    for (const Term& term : *terms) {
      const auto corners = aroundCorners(term, region_, kScant * at);
      any = any || corners;
      Expr d = corners.value_or(term[0].distance);
      if (!corners)
        for (const Face& f : term) d = max(d, f.distance);
      least = least ? min(*least, d) : d;
    }
    return any ? least : std::nullopt;
  }

  // More than that, as of a union of hundreds, cost too much.
  bool hasTooMany() const { return faces_.size() > 32; }

  const Shape& shape_;
  Reach at_;
  Box region_;
  std::vector<Face> faces_;
  std::vector<bool> negative_;  // by face: is it the solid's other side?
  std::vector<UncalibratedPart> tried_;
  std::map<const Node*, Face> known_;
  std::vector<Expr> kept_;  // keeps the keys alive
  int solids_ = 0;
  bool calibrates_ = false;
};

}  // namespace

Shape fitForOffsets(const Shape& shape, const Reach& at) {
  const bool isAsked = at.out + at.in > 0.0 && std::isfinite(at.out + at.in);
  if (!isAsked || shape.claim.calibrated) return shape;
  return withGrowth(Offsets(shape, at).run(at));
}

}  // namespace sdf
