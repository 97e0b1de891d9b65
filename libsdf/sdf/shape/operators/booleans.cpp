#include "sdf/shape/operators/booleans.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sdf/shape/calibrate/offset.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

using Kind = Blend::Kind;

bool isHard(const Blend& blend) { return blend.kind == Kind::Hard; }

// A distance and the surface that goes with it.
struct Layer {
  Expr distance;
  Attributes surface;
};

// sign times the amount by which the blend differs from the hard minimum or maximum. For every kind but
// Exponential it is h^n k / 2n with h = 1 - |a - b| / k and n = 1 (chamfer), 2, 3. Where a = b, min and max
// show the gradient of their first argument, and abs that of what it is given: with these signs they add up
// to the mean.
Expr difference(const Expr& a, const Expr& b, const Blend& blend, double sign) {
  const Expr apart = abs(sign < 0.0 ? b - a : a - b), &k = blend.k;
  if (blend.kind == Kind::Exponential) return log(exp(apart * (-1.0 / k)) + 1.0) * (sign * k);
  const Expr near = max(k - apart, 0.0);
  if (blend.kind == Kind::Cubic) return square(near) * near * (sign / (6.0 * square(k)));
  return square(near) * (sign * 0.25 / k);
}

// The blended minimum (sign -1) or maximum (1). The gradient of each smooth form is a weighted mean of the
// operands' gradients: the claim on the result.
Expr extreme(const Expr& a, const Expr& b, const Blend& blend, double sign) {
  const auto pick = [&](const Expr& u, const Expr& v) { return sign < 0.0 ? min(u, v) : max(u, v); };
  if (isHard(blend)) return pick(a, b);
  const Expr result = blend.kind == Kind::Chamfer
                          ? pick(pick(a, b), (sign < 0.0 ? a + b - blend.k : a + b + blend.k) * 0.5)
                          : difference(a, b, blend, sign) + pick(a, b);
  return result.claimLipschitz(std::max(a.lipschitz(), b.lipschitz()));
}
Expr lower(const Expr& a, const Expr& b, const Blend& blend) { return extreme(a, b, blend, -1.0); }
Expr upper(const Expr& a, const Expr& b, const Blend& blend) { return extreme(a, b, blend, 1.0); }

// Derivative of lower(a, b) by b.
Expr weightOfSecond(const Expr& a, const Expr& b, const Blend& blend) {
  const Expr& k = blend.k;
  if (blend.kind == Kind::Quadratic) return clamp((a - b) * (0.5 / k) + 0.5, 0.0, 1.0);
  const Expr apart = abs(b - a);
  if (blend.kind == Kind::Chamfer) return select(less(apart, k), 0.5, lessEqual(b, a));
  Expr farther;  // weight of the larger distance
  if (blend.kind == Kind::Cubic) {
    farther = square(max(apart * (-1.0 / k) + 1.0, 0.0)) * 0.5;
  } else {
    const Expr e = exp(apart * (-1.0 / k));
    farther = e / (e + 1.0);
  }
  return select(less(a, b), farther, 1.0 - farther);
}

// Attributes that both share stay the same node: painted alike costs nothing.
Attributes mixSurfaces(const Layer& a, const Layer& b, const Blend& blend) {
  if (a.surface == b.surface) return a.surface;
  std::optional<Expr> weight;
  if (!isHard(blend)) weight = weightOfSecond(a.distance, b.distance, blend);
  return mixed(a.surface, b.surface, lessEqual(b.distance, a.distance), weight);
}

Layer join(const Layer& a, const Layer& b, const Blend& blend) {
  return {lower(a.distance, b.distance, blend), mixSurfaces(a, b, blend)};
}

// All joined in pairs of halves, so that a region where one half wins drops the other half at once.
template <class T, class Join>
T balanced(std::span<const T> all, Join joinTwo) {
  if (all.size() == 1) return all[0];
  const std::size_t half = all.size() / 2;
  return joinTwo(balanced(all.first(half), joinTwo), balanced(all.subspan(half), joinTwo));
}

Expr least(std::span<const Expr> distances) {
  return balanced(distances, [](const Expr& a, const Expr& b) { return min(a, b); });
}
Expr greatest(std::span<const Expr> distances) {
  return balanced(distances, [](const Expr& a, const Expr& b) { return max(a, b); });
}
Layer balancedUnion(std::span<const Layer> layers) {
  return balanced(layers, [](const Layer& a, const Layer& b) { return join(a, b, Blend::hard()); });
}

// min - k log sum exp((min - d_i) / k): no exponent is positive, so nothing overflows, and n operands need n
// exponentials where pairs would need 2n functions.
Layer exponentialUnion(const std::vector<Layer>& layers, const Expr& k) {
  const Layer nearest = balancedUnion(layers);
  const Expr& least = nearest.distance;
  std::vector<Expr> weights;
  Expr total = 0.0;
  for (const Layer& l : layers) {
    weights.push_back(exp((least - l.distance) * (1.0 / k)));
    total = total + weights.back();
  }
  Layer result{(log(total) * (-1.0 * k) + least).claimLipschitz(least.lipschitz()), nearest.surface};
  for (int i = 0; i < kAttributeCount; ++i) {
    const auto same = [&](const Layer& l) { return l.surface[i] == layers[0].surface[i]; };
    if (i == static_cast<int>(Attribute::MaterialId) || std::all_of(layers.begin(), layers.end(), same))
      continue;
    Expr sum = 0.0;
    for (std::size_t j = 0; j < layers.size(); ++j) sum = weights[j] * layers[j].surface[i] + sum;
    result.surface[i] = sum / total;
  }
  return result;
}

// Why the operation is impossible: the first operand's error, or something about all of them.
std::optional<Shape> refusal(const char* op, const std::vector<Shape>& shapes, const Blend& blend) {
  for (const Shape& s : shapes)
    if (!s.ok()) return s;
  Check check(op);
  check.that(!shapes.empty(), "needs at least one shape");
  for (std::size_t i = 1; i < shapes.size(); ++i) {
    const std::size_t flat = shapes[i].dimension == 2 ? i : 0;
    check.that(
        shapes[i].dimension == shapes[0].dimension,
        "shape " + std::to_string(flat + 1) + " is flat and others are solid; extrude or revolve it first");
  }
  if (!isHard(blend)) check.positive("k", blend.k);
  return check.ok() ? std::nullopt : std::optional(check.failure());
}

Blend guarded(Blend blend) {
  if (!isHard(blend)) blend.k = keptPositive(blend.k);
  return blend;
}

// Offsets of more parts than some tens are not calibrated (calibrate/offset.cpp).
void addUncalibrated(Claim& claim, const Claim& other) {
  constexpr std::size_t kMost = 32;
  if (claim.uncalibrated.size() + other.uncalibrated.size() > kMost) return;
  claim.uncalibrated.insert(claim.uncalibrated.end(), other.uncalibrated.begin(), other.uncalibrated.end());
}

// What all results share; the caller sets distance, surface and bounds. `best` is the strongest kind the
// operation allows.
Shape combined(const std::vector<Shape>& shapes, const Blend& blend, ClaimKind best) {
  Shape result = shapes[0];
  Claim& claim = result.claim;
  claim.kind = isHard(blend) ? best : ClaimKind::Field;
  for (const Shape& s : shapes) {
    claim.kind = weaker(claim.kind, s.claim.kind);
    claim.lipschitz = std::max(claim.lipschitz, s.claim.lipschitz);
    claim.calibrated = claim.calibrated || s.claim.calibrated;
    if (&s != &shapes[0]) addUncalibrated(claim, s.claim);
  }
  return result;
}

std::vector<Shape> readyToBlend(const std::vector<Shape>& shapes, const Blend& blend) {
  std::vector<Shape> ready;
  for (const Shape& s : shapes) ready.push_back(readyToBlend(s, blend));
  return ready;
}

// The operands, those of hard unions in the place of the union, the first one's list being continued; nothing
// where all operands matter everywhere.
std::shared_ptr<const Union> listOf(const std::vector<Shape>& shapes, const Blend& blend) {
  if (blend.kind == Kind::Exponential) return nullptr;
  const auto isPart = [&](const Shape& s) { return isHard(blend) && s.outer && isHard(s.outer->blend); };
  Union::Operands list;
  if (isPart(shapes[0]))
    list = shapes[0].outer->operands;
  else
    list.reserve(shapes.size()), list.push_back(shapes[0]);
  for (const Shape& s : std::span(shapes).subspan(1))
    if (isPart(s))
      list.append(s.outer->operands);
    else
      list.push_back(s);
  return std::make_shared<Union>(Union{blend, std::move(list)});
}

std::vector<Layer> layersOf(const std::vector<Shape>& shapes) {
  std::vector<Layer> layers;
  for (const Shape& s : shapes) layers.push_back({s.distance, s.surface});
  return layers;
}

}  // namespace

// With x the depth so far, one more operand adds at most h^n / 2n for h = 1 - x, and x + (1 - x)^n / 2n grows
// with x: equal distances are the worst. The sum stays below 1.
double deepestBlend(Kind kind, std::size_t n) {
  if (kind == Kind::Exponential) return std::log(static_cast<double>(n));
  double x = 0.0;
  for (std::size_t i = 1; i < n && kind != Kind::Hard; ++i) {
    const double h = 1.0 - x;
    x += kind == Kind::Chamfer ? h / 2.0 : kind == Kind::Quadratic ? h * h / 4.0 : h * h * h / 6.0;
  }
  return x;
}

std::array<Expr, 3> unionJoin(const Blend& given) {
  const Blend blend = guarded(given);
  const Expr a = position().x, b = position().y, second = lessEqual(b, a);
  return {lower(a, b, blend), isHard(blend) ? second : weightOfSecond(a, b, blend), second};
}

Shape readyToBlend(const Shape& shape, const Blend& blend) {
  if (isHard(blend) || shape.claim.kind != ClaimKind::Field || shape.claim.calibrated) return shape;
  // The other distance being k more or less, the blend's surface is at most half as far from either.
  const double half = 0.5 * blend.k.range().hi;
  return fitForOffsets(shape, {half, half});
}

Shape unite(const std::vector<Shape>& operands, const Blend& given) {
  if (auto refused = refusal("union", operands, given)) return *refused;
  if (operands.size() == 1) return operands[0];
  const Blend blend = guarded(given);
  const std::vector<Shape> shapes = numberedAlike(readyToBlend(operands, blend));
  const std::vector<Layer> layers = layersOf(shapes);
  Layer joined;
  if (isHard(blend)) {
    joined = balancedUnion(layers);
  } else if (blend.kind == Kind::Exponential && layers.size() > 2) {
    joined = exponentialUnion(layers, blend.k);
  } else {
    joined = layers[0];
    for (std::size_t i = 1; i < layers.size(); ++i) joined = join(joined, layers[i], blend);
  }
  Shape result = combined(shapes, blend, ClaimKind::ExactOutside);
  result.distance = joined.distance;
  result.surface = joined.surface;
  const double swell = isHard(blend) ? 0.0 : deepestBlend(blend.kind, shapes.size()) * blend.k.range().hi;
  result.bounds = Box{};
  result.claim.growth = 0.0;
  for (const Shape& s : shapes) {
    const double growth = growthOf(s.claim);
    result.bounds = unite(result.bounds, swell > 0.0 ? grow(s.bounds, growth * swell) : s.bounds);
    result.claim.growth = std::max(result.claim.growth, growth);
  }
  result = settled(std::move(result));
  result.outer = listOf(shapes, blend);
  return result;
}

Shape intersect(const std::vector<Shape>& operands, const Blend& given) {
  if (auto refused = refusal("intersection", operands, given)) return *refused;
  if (operands.size() == 1) return operands[0];
  const Blend blend = guarded(given);
  const std::vector<Shape> shapes = readyToBlend(operands, blend);
  Shape result = combined(shapes, blend, ClaimKind::Bound);
  result.claim.growth = 0.0;
  std::vector<Expr> distances;
  for (const Shape& s : shapes) {
    distances.push_back(s.distance);
    result.bounds = overlap(result.bounds, s.bounds);
    // What has no bounds cannot leave them: a lattice cut to a box grows as the box does.
    if (!isEverything(s.bounds)) result.claim.growth = std::max(result.claim.growth, growthOf(s.claim));
  }
  if (isHard(blend)) {
    result.distance = greatest(distances);
  } else {
    for (std::size_t i = 1; i < shapes.size(); ++i)
      result.distance = upper(result.distance, distances[i], blend);
  }
  return settled(std::move(result));
}

Shape subtract(const std::vector<Shape>& operands, const Blend& given) {
  if (auto refused = refusal("difference", operands, given)) return *refused;
  if (operands.size() == 1) return operands[0];
  const Blend blend = guarded(given);
  const std::vector<Shape> shapes = readyToBlend(operands, blend);
  Shape result = combined(shapes, blend, ClaimKind::Bound);
  result.claim.growth = growthOf(shapes[0].claim);
  std::vector<Expr> cutters;
  for (const Shape& s : std::span(shapes).subspan(1)) cutters.push_back(s.distance);
  if (isHard(blend)) cutters = {least(cutters)};
  for (const Expr& cutter : cutters) result.distance = upper(result.distance, -cutter, blend);
  return settled(std::move(result));
}

Shape exclude(const std::vector<Shape>& operands, const Blend& given) {
  if (auto refused = refusal("xor", operands, given)) return *refused;
  const Blend blend = guarded(given);
  const std::vector<Shape> shapes = readyToBlend(operands, blend);
  Shape result = shapes[0];
  for (std::size_t i = 1; i < shapes.size(); ++i) {
    const Shape a = result;
    const Shape& b = shapes[i];
    const Shape either = unite(a, b, blend);
    result = combined({a, b}, blend, ClaimKind::Bound);
    result.distance = upper(either.distance, -upper(a.distance, b.distance, blend), blend);
    // Where it is b's surface that is seen, b <= a holds, inside and outside: the union's rule serves.
    result.surface = either.surface;
    result.materials = either.materials;
    result.bounds = either.bounds;
    result.claim.growth = growthOf(either.claim);
    result = settled(std::move(result));
  }
  return result;
}

Shape unite(const Shape& a, const Shape& b, const Blend& blend) { return unite(std::vector{a, b}, blend); }
Shape intersect(const Shape& a, const Shape& b, const Blend& blend) {
  return intersect(std::vector{a, b}, blend);
}
Shape subtract(const Shape& a, const Shape& b, const Blend& blend) {
  return subtract(std::vector{a, b}, blend);
}
Shape exclude(const Shape& a, const Shape& b, const Blend& blend) {
  return exclude(std::vector{a, b}, blend);
}

}  // namespace sdf
