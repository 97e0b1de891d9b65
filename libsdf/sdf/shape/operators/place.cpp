#include "sdf/shape/operators/place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdf/expr/offsets.h"
#include "sdf/shape/calibrate/calibrate.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/operators/booleans.h"

namespace sdf {

namespace {

using Matrix = std::array<Vec3E, 3>;  // rows

Vec3E column(const Matrix& m, int i) { return {component(m[0], i), component(m[1], i), component(m[2], i)}; }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) component(m[i], j) = weighted(column(b, j), a[i]);
  return m;
}

// cos(pi / 2) is 6e-17 in double; a right angle is meant.
Expr snapped(const Expr& e) {
  constexpr double kRoundingOfAngles = 1e-15;
  if (!e.isConstant()) return e;
  const double whole = std::round(e.constantValue());
  return std::abs(e.constantValue() - whole) < kRoundingOfAngles ? Expr(whole) : e;
}

// Turn about coordinate axis `axis`.
Matrix turn(int axis, const Expr& angle) {
  const Expr c = snapped(cos(angle)), s = snapped(sin(angle));
  if (axis == 0) return {Vec3E{1.0, 0.0, 0.0}, {0.0, c, -s}, {0.0, s, c}};
  if (axis == 1) return {Vec3E{c, 0.0, s}, {0.0, 1.0, 0.0}, {-s, 0.0, c}};
  return {Vec3E{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}};
}

// Rodrigues' formula for a unit axis.
Matrix turnAbout(const Vec3E& n, const Expr& angle) {
  const Expr c = snapped(cos(angle)), s = snapped(sin(angle)), rest = 1.0 - c;
  const auto both = [&](const Expr& a, const Expr& b) { return scaled(rest, scaled(b, a)); };
  const auto aside = [&](const Expr& a) { return scaled(s, a); };
  return {Vec3E{both(n.x, n.x) + c, both(n.x, n.y) - aside(n.z), both(n.x, n.z) + aside(n.y)},
          {both(n.x, n.y) + aside(n.z), both(n.y, n.y) + c, both(n.y, n.z) - aside(n.x)},
          {both(n.x, n.z) - aside(n.y), both(n.y, n.z) + aside(n.x), both(n.z, n.z) + c}};
}

Vec3E unit(const Vec3E& v) {
  const Expr scale = 1.0 / length(v);
  return {snapped(v.x * scale), snapped(v.y * scale), snapped(v.z * scale)};
}

double presentLength(const Vec3E& v) {
  return std::hypot(uniformValue(v.x), uniformValue(v.y), uniformValue(v.z));
}

// Heights of the box over the plane through the origin across n.
Interval heightsOver(const Box& b, const Vec3E& n) {
  double lo = 0.0, hi = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Interval part = timesRange(component(n, i).range(), b.min[i], b.max[i]);
    lo += part.lo;
    hi += part.hi;
  }
  return {lo, hi};
}

// The box around the turned box. Where the matrix varies with a parameter, the sphere around the box is a
// second bound.
Box turnedBox(const Box& b, const Matrix& m) {
  if (isEverything(b)) return b;
  Box result;
  bool fixed = true;
  for (int i = 0; i < 3; ++i) {
    const Interval side = heightsOver(b, m[i]);
    result.min[i] = side.lo;
    result.max[i] = side.hi;
    fixed = fixed && m[i].x.range().isPoint() && m[i].y.range().isPoint() && m[i].z.range().isPoint();
  }
  if (fixed) return result;
  return intersect(result, Box::centred(glm::dvec3(radiusOf(b))));
}

// A box grown by m turns into one grown by m times this: the largest sum of |entries| in a row, at most
// sqrt(3).
double turnedGrowth(const Matrix& m) {
  double most = 0.0;
  for (const Vec3E& row : m) {
    double sum = 0.0;
    for (int j = 0; j < 3; ++j) sum += component(row, j).range().magnitude();
    most = std::max(most, sum);
  }
  return std::min(most, std::sqrt(3.0));
}

// The shape as the isometry m leaves it; `from` is where its points come from.
Shape mapped(const Shape& shape, const Matrix& m, const Vec3E& from) {
  Shape result = movedTo(shape, from, 1.0);
  result.bounds = turnedBox(shape.bounds, m);
  result.claim.growth *= turnedGrowth(m);
  result = settled(std::move(result));
  result.copies = movedCopies(shape, from);
  return result;
}

Shape turned(const Shape& shape, const Matrix& m) {
  const auto back = [&](int i) {
    return weighted(position(), column(m, i));
  };  // by the inverse, m transposed
  Shape result = mapped(shape, m, {back(0), back(1), back(2)});
  result.outer = mappedUnion(shape, [&](const Shape& operand) { return turned(operand, m); });
  return result;
}

// The position, reflected across the plane where it is not on the given side (1: n.p >= 0, -1: n.p <= 0, 0:
// neither).
Vec3E reflected(const Vec3E& n, int side) {
  const Vec3E p = position();
  for (int i = 0; i < 3; ++i) {
    if (!component(n, i).isConstant(1.0) && !component(n, i).isConstant(-1.0)) continue;
    const bool positive = component(n, i).isConstant(1.0) == (side > 0);
    Vec3E q = p;
    const Expr& x = component(p, i);
    component(q, i) = side == 0 ? -x : positive ? abs(x) : -abs(x);
    return q;
  }
  const Expr height = weighted(p, n);
  const Expr wrong = side == 0 ? height : side > 0 ? min(height, 0.0) : max(height, 0.0);
  const auto reflect = [&](const Expr& x, const Expr& slope) {
    return slope.isConstant(0.0) ? x : wrong * (-2.0 * slope) + x;
  };
  return {reflect(p.x, n.x), reflect(p.y, n.y), reflect(p.z, n.z)};
}

Matrix reflection(const Vec3E& n) {
  Matrix m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      component(m[i], j) = Expr(i == j ? 1.0 : 0.0) - scaled(scaled(component(n, i), component(n, j)), 2.0);
  return m;
}

}  // namespace

Shape translate(const Shape& shape, const Vec3E& offset) {
  Check check("translate", shape);
  if (!check.vector("offset", offset, Rule::Any).ok()) return check.failure();
  const Vec3E from = position() - offset;
  Shape result = movedTo(shape, from, 1.0);
  for (int i = 0; i < 3; ++i) {
    const Interval& by = component(offset, i).range();
    result.bounds.min[i] += by.lo;
    result.bounds.max[i] += by.hi;
  }
  result = settled(std::move(result));
  result.outer = mappedUnion(shape, [&](const Shape& operand) { return translate(operand, offset); });
  result.copies = movedCopies(shape, from);
  return result;
}

Expr distanceAt(const Shape& shape, const Vec3E& place) {
  return remap(shape.distance, {place.x, place.y, place.z}, stretchOf(place));
}

namespace {

std::shared_ptr<const Copies> copiesRelativeTo(const Shape& shape, const glm::dvec3& origin) {
  if (!shape.copies) return nullptr;
  auto moved = std::make_shared<Copies>(*shape.copies);
  for (Vec3E& place : moved->places) {
    const std::vector<Expr> at = relativeTo(std::vector<Expr>{place.x, place.y, place.z}, origin);
    place = {at[0], at[1], at[2]};
  }
  if (moved->others) moved->others = relativeTo(std::vector<Expr>{*moved->others}, origin)[0];
  return moved;
}

// Of a shape that is as large along each axis.
std::shared_ptr<const Copies> scaledCopies(const Shape& shape, const Vec3E& back, const Vec3E& factors,
                                           const Expr& least) {
  if (!shape.copies) return nullptr;
  auto grown = std::make_shared<Copies>(*movedCopies(shape, back));
  grown->one = scale(grown->one, factors);
  for (Vec3E& place : grown->places) place = {place.x * factors.x, place.y * factors.y, place.z * factors.z};
  if (grown->others) grown->others = *grown->others * least;
  return grown;
}

}  // namespace

Shape relativeTo(const Shape& shape, const glm::dvec3& origin) {
  if (!shape.ok()) return shape;
  std::vector<Expr> graphs{shape.distance};
  graphs.insert(graphs.end(), shape.surface.begin(), shape.surface.end());
  graphs = relativeTo(graphs, origin);
  Shape result = shape;
  result.distance = graphs[0].claimLipschitz(shape.claim.lipschitz);
  std::copy(graphs.begin() + 1, graphs.end(), result.surface.begin());
  result.bounds = {shape.bounds.min - origin, shape.bounds.max - origin};
  result.outer = mappedUnion(shape, [&](const Shape& operand) { return relativeTo(operand, origin); });
  result.copies = copiesRelativeTo(shape, origin);
  return result;
}

Shape rotate(const Shape& shape, const Vec3E& angles) {
  Check check("rotate", shape);
  check.vector("angles", angles, Rule::Any);
  check.that(shape.dimension == 3 || (angles.x.isConstant(0.0) && angles.y.isConstant(0.0)),
             "a flat shape turns about z only; extrude or revolve it first");
  if (!check.ok()) return check.failure();
  return turned(shape, product(turn(2, angles.z), product(turn(1, angles.y), turn(0, angles.x))));
}

Shape rotateAbout(const Shape& shape, const Vec3E& axis, const Expr& angle) {
  Check check("rotate_about", shape);
  check.vector("axis", axis, Rule::Any).any("angle", angle);
  if (check.ok()) check.that(presentLength(axis) > 0.0, "axis must not be {0, 0, 0}");
  check.that(shape.dimension == 3 || (axis.x.isConstant(0.0) && axis.y.isConstant(0.0)),
             "a flat shape turns about z only; extrude or revolve it first");
  if (!check.ok()) return check.failure();
  return turned(shape, turnAbout(unit(axis), angle));
}

Shape scale(const Shape& shape, const Vec3E& factors) {
  Check check("scale", shape);
  const int axes = shape.dimension;
  if (!check.vector("factor", factors, Rule::NotZero, axes).ok()) return check.failure();
  Vec3E by{keptFromZero(factors.x), keptFromZero(factors.y), axes == 3 ? keptFromZero(factors.z) : Expr(1.0)};
  const bool uniform = by.x == by.y && (axes == 2 || by.x == by.z);
  Expr least = min(abs(by.x), abs(by.y)), most = max(abs(by.x), abs(by.y));
  if (axes == 3) {
    least = min(least, abs(by.z));
    most = max(most, abs(by.z));
  }
  const Vec3E p = position();
  // A flat shape's z stays as it is, in its colours too.
  const double stretch = 1.0 / (axes == 3 ? least.range().lo : std::min(least.range().lo, 1.0));
  const Vec3E back{p.x * (1.0 / by.x), p.y * (1.0 / by.y), p.z * (1.0 / by.z)};
  Shape result = movedTo(shape, back, stretch);
  for (int i = 0; i < 3; ++i) {
    const Interval side = timesRange(component(by, i).range(), shape.bounds.min[i], shape.bounds.max[i]);
    result.bounds.min[i] = side.lo;
    result.bounds.max[i] = side.hi;
  }
  if (uniform) {
    result.distance = result.distance * least;
  } else {
    const auto pulled = [=](const Vec3E& n) -> Vec3E {
      return {scaled(n.x, 1.0 / by.x), scaled(n.y, 1.0 / by.y), scaled(n.z, 1.0 / by.z)};
    };
    const Expr uneven = sqrt(most / least);
    result.distance = calibrated(shape.distance, {back, pulled, uneven / most, uneven, 1.0 / uneven,
                                                  Box::everything(), -1.0, sizeOf(shape.bounds)});
    result.claim = {ClaimKind::Field, result.distance.lipschitz(),
                    growthOf(shape.claim) * most.range().hi / least.range().lo, true};
  }
  result = settled(std::move(result));
  if (shape.outer && shape.outer->blend.kind == Blend::Kind::Hard)
    result.outer = mappedUnion(shape, [&](const Shape& operand) { return scale(operand, factors); });
  if (uniform) result.copies = scaledCopies(shape, back, by, least);
  return result;
}

Shape scale(const Shape& shape, const Expr& factor) { return scale(shape, Vec3E(factor)); }

Shape mirror(const Shape& shape, const Vec3E& normal) {
  Check check("mirror", shape);
  check.vector("normal", normal, Rule::Any);
  if (check.ok()) check.that(presentLength(normal) > 0.0, "normal must not be {0, 0, 0}");
  check.that(shape.dimension == 3 || normal.z.isConstant(0.0),
             "a flat shape needs a normal without a z part");
  if (!check.ok()) return check.failure();
  const Vec3E n = unit(normal);
  const Interval heights = heightsOver(shape.bounds, n);
  const int side = heights.lo >= 0.0 ? 1 : heights.hi <= 0.0 ? -1 : 0;
  Shape image = mapped(shape, reflection(n), reflected(n, side));
  if (side == 0) return unite(shape, image);
  image.bounds = unite(shape.bounds, image.bounds);
  // Halves that touch share their inside, where an inner distance stops at a face that is none.
  const bool apart = heights.lo > 0.0 || heights.hi < 0.0;
  if (!apart) image.claim.kind = weaker(image.claim.kind, ClaimKind::ExactOutside);
  return image;
}

}  // namespace sdf
