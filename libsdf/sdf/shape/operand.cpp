#include "sdf/shape/operand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>

namespace sdf {

namespace {
// Far below anything visible and far above where its inverse square overflows float.
constexpr double kHair = 1e-6;
}  // namespace

Check& wantsSolid(Check& check, const Shape& shape) {
  return check.that(shape.dimension == 3, "the shape is flat; extrude or revolve it first");
}

Expr notNegative(const Expr& e) { return e.range().lo >= 0.0 ? e : max(e, 0.0); }
Expr keptPositive(const Expr& e) { return e.range().lo >= kHair || e.isConstant() ? e : max(e, kHair); }
Expr keptFromZero(const Expr& e) {
  const bool away = e.range().lo >= kHair || e.range().hi <= -kHair || e.isConstant();
  return away ? e : select(less(abs(e), kHair), kHair, e);
}

bool isEverything(const Box& b) { return b.contains(Box::everything()); }

Box grow(const Box& b, double by) {
  return by == kInfinity ? Box::everything() : Box{b.min - by, b.max + by};
}

Box overlap(const Box& a, const Box& b) {
  const Box both = intersect(a, b);
  return {glm::min(both.min, both.max), glm::max(both.min, both.max)};
}

Interval timesRange(const Interval& a, double lo, double hi) {
  const auto times = [](double u, double v) { return u == 0.0 || v == 0.0 ? 0.0 : u * v; };
  const auto [least, most] =
      std::minmax({times(a.lo, lo), times(a.lo, hi), times(a.hi, lo), times(a.hi, hi)});
  return {least, most};
}

// In pairs: libstdc++'s hypot of three makes NaN of two infinities.
double radiusOf(const Box& b) {
  const glm::dvec3 far = glm::max(glm::abs(b.min), glm::abs(b.max));
  return std::hypot(std::hypot(far.x, far.y), far.z);
}

double radiusAbout(const Box& b, int axis) {
  glm::dvec3 far = glm::max(glm::abs(b.min), glm::abs(b.max));
  far[axis] = 0.0;
  return std::hypot(std::hypot(far.x, far.y), far.z);
}

double sizeOf(const Box& b) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i)
    if (b.max[i] - b.min[i] < kInfinity) size = std::max(size, b.max[i] - b.min[i]);
  return size > 0.0 ? size : 1.0;
}

Expr outsideSlab(const Expr& x, double lo, double hi) {
  if (lo > -kInfinity && hi < kInfinity) return abs(x - 0.5 * (lo + hi)) - 0.5 * (hi - lo);
  return hi < kInfinity ? x - hi : lo - x;
}

std::optional<Expr> outsideBox(const Box& b) {
  std::optional<Expr> outside;
  const Vec3E p = position();
  for (int i = 0; i < 3; ++i) {
    if (b.min[i] == -kInfinity && b.max[i] == kInfinity) continue;
    const Expr slab = outsideSlab(component(p, i), b.min[i], b.max[i]);
    outside = outside ? max(*outside, slab) : slab;
  }
  return outside;
}

bool isOneLipschitz(double lipschitz) {
  // Of a chain of some thousand interval operations, each outward by an ulp.
  constexpr double kRounding = 1e-12;
  return lipschitz <= 1.0 + kRounding;
}

Shape settled(Shape s) {
  s.distance = s.distance.claimLipschitz(s.claim.lipschitz);
  s.claim.lipschitz = s.distance.lipschitz();
  s.outer.reset();
  s.copies.reset();
  if (s.claim.kind == ClaimKind::Field && isOneLipschitz(s.claim.lipschitz)) s.claim.kind = ClaimKind::Bound;
  return s;
}

Shape withGrowth(Shape s) {
  const auto outside = outsideBox(s.bounds);
  if (growthOf(s.claim) < kInfinity || !outside) return s;
  // Calibrated distances fall short of the way there beside edges: a bound of full slope would cut what is
  // rounded there.
  constexpr double kShare = 0.75;
  s.distance = max(s.distance, min(*outside, *outside * kShare));
  s.claim.lipschitz = std::max(s.claim.lipschitz, 1.0);
  s.claim.growth = 1.0 / kShare;
  const auto copies = s.copies;
  s = settled(std::move(s));
  s.copies = copies;  // of the same solid
  return s;
}

Shape movedTo(const Shape& s, const Vec3E& position, double stretch) {
  std::vector<Expr> graphs{s.distance};
  graphs.insert(graphs.end(), s.surface.begin(), s.surface.end());
  graphs = remap(graphs, {position.x, position.y, position.z}, stretch);
  Shape moved = s;
  moved.distance = graphs[0];
  std::copy(graphs.begin() + 1, graphs.end(), moved.surface.begin());
  return moved;
}

bool isEven(const Expr& e, int axis) {
  Vec3E p = position();
  component(p, axis) = -component(p, axis);
  return remap(e, {p.x, p.y, p.z}, 1.0) == e;
}

Attributes mixed(const Attributes& a, const Attributes& b, const Expr& second,
                 const std::optional<Expr>& weight) {
  Attributes both;
  for (int i = 0; i < kAttributeCount; ++i) {
    const bool whole = !weight || i == static_cast<int>(Attribute::MaterialId);
    both[i] = whole ? select(second, b[i], a[i]) : mix(a[i], b[i], *weight);
  }
  return both;
}

std::shared_ptr<const Union> mappedUnion(const Shape& shape,
                                         const std::function<Shape(const Shape&)>& operation) {
  if (!shape.outer) return nullptr;
  auto mapped = std::make_shared<Union>(Union{shape.outer->blend, {}});
  mapped->operands.reserve(shape.outer->operands.size());
  for (const Shape& operand : shape.outer->operands) mapped->operands.push_back(operation(operand));
  return mapped;
}

namespace {

bool hasInputs(const Vec3E& place) {
  return std::ranges::any_of(topologicalOrder(std::array{place.x, place.y, place.z}),
                             [](const Expr& node) { return node.op() == Op::Parameter; });
}

}  // namespace

std::shared_ptr<const Copies> movedCopies(const Shape& shape, const Vec3E& position) {
  if (!shape.copies) {
    const double slope = slopeOf(shape);
    if (isOneLipschitz(slope) || !std::isfinite(slope) || !hasInputs(position)) return nullptr;
    return std::make_shared<Copies>(Copies{shape, {position}, {}});
  }
  const auto at = [&](const Expr& e) { return remap(e, {position.x, position.y, position.z}, 1.0); };
  auto moved = std::make_shared<Copies>(*shape.copies);
  for (Vec3E& place : moved->places) place = {at(place.x), at(place.y), at(place.z)};
  if (moved->others) moved->others = at(*moved->others);
  return moved;
}

namespace {

// The places by the old ones. Most lists are one material, or all new, or begin as the common one does.
Expr renumbered(const Expr& id, const std::vector<double>& places) {
  if (id.isConstant()) return places[static_cast<std::size_t>(id.constantValue())];
  bool inARow = true;
  for (std::size_t i = 1; i < places.size(); ++i) inARow = inARow && places[i] == places[i - 1] + 1.0;
  if (inARow) return places[0] == 0.0 ? id : id + places[0];
  Expr place = places[0];
  for (std::size_t i = 1; i < places.size(); ++i)
    place = select(lessEqual(static_cast<double>(i), id), places[i], place);
  return place;
}

// Of a union's operands, too.
void renumber(Shape& s, const std::vector<double>& places) {
  Expr& id = s.surface[static_cast<int>(Attribute::MaterialId)];
  const Expr moved = renumbered(id, places);
  if (moved == id) return;
  id = moved;
  s.outer = mappedUnion(s, [&](Shape operand) {
    renumber(operand, places);
    return operand;
  });
}

// Materials by first appearance, and their places.
class MaterialList {
 public:
  MaterialList(std::vector<MaterialPtr> first, std::size_t lookUps) : all_(std::move(first)) {
    // A table of all is worth its making only where many are looked up, not for one more shape in a chain.
    constexpr std::size_t kFew = 8;
    if (lookUps <= kFew) return;
    table_.emplace();
    for (std::size_t i = 0; i < all_.size(); ++i) table_->emplace(all_[i].get(), i);
  }

  std::size_t placeOf(const MaterialPtr& m) {
    const std::size_t place = table_ ? table_->try_emplace(m.get(), all_.size()).first->second
                                     : std::ranges::find(all_, m) - all_.begin();
    if (place == all_.size()) all_.push_back(m);
    return place;
  }

  std::vector<MaterialPtr> taken() { return std::move(all_); }

 private:
  std::vector<MaterialPtr> all_;
  std::optional<std::unordered_map<const Material*, std::size_t>> table_;
};

}  // namespace

std::vector<Shape> numberedAlike(std::vector<Shape> shapes) {
  const std::span<Shape> others = std::span(shapes).subspan(1);
  std::size_t lookUps = 0;
  for (const Shape& s : others) lookUps += s.materials.size();
  MaterialList all(std::move(shapes[0].materials), lookUps);
  for (Shape& s : others) {
    std::vector<double> places;
    for (const MaterialPtr& m : s.materials) places.push_back(static_cast<double>(all.placeOf(m)));
    renumber(s, places);
  }
  shapes[0].materials = all.taken();
  return shapes;
}

}  // namespace sdf
