#include "sdf/model/model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sdf/model/region_steps.h"
#include "sdf/shape/operand.h"

namespace sdf {
namespace {

std::vector<Expr> surfaceOutputs(const Shape& shape) {
  const auto attribute = [&](Attribute a) { return shape.surface[static_cast<int>(a)]; };
  return {shape.distance,
          attribute(Attribute::Red),
          attribute(Attribute::Green),
          attribute(Attribute::Blue),
          attribute(Attribute::AmbientRed),
          attribute(Attribute::AmbientGreen),
          attribute(Attribute::AmbientBlue),
          attribute(Attribute::MaterialId)};
}

// The largest gap between the boxes along an axis; 0 where they meet.
double gapBetween(const Box& a, const Box& b) {
  const glm::dvec3 gaps = glm::max(a.min - b.max, b.min - a.max);
  return std::max({0.0, gaps.x, gaps.y, gaps.z});
}

}  // namespace

Model::Model(Shape shape) {
  auto compiled = std::make_shared<Compiled>();
  compiled->shape = std::move(shape);
  compiled_ = compiled;
  for (const Shape& operand : operands()) compiled->functions.emplace_back(surfaceOutputs(operand));
  if (!this->shape().outer || this->shape().outer->blend.kind == Blend::Kind::Hard) return;
  const Blend& blend = this->shape().outer->blend;
  const auto join = unionJoin(blend);
  compiled->blend.emplace(std::vector<Expr>{join[0], join[1], join[2], blend.k});
}

std::span<const Shape> Model::operands() const {
  const Shape& s = shape();
  return s.outer ? std::span<const Shape>(s.outer->operands) : std::span(&s, 1);
}

ModelTapes Model::at(const Values& values, const std::optional<Accuracy>& accuracy) const {
  ModelTapes result;
  std::vector<TapePtr> tapes;
  for (const Function& f : functions()) tapes.push_back(f.at(values));
  const bool covered =
      std::ranges::all_of(functions(), [&](const Function& f) { return f.covers(values); }) &&
      (!compiled_->blend || compiled_->blend->covers(values));
  for (std::size_t i = 0; accuracy && i < tapes.size(); ++i) {
    Accuracy own = *accuracy;
    if (covered) own.region = intersect(own.region, operands()[i].bounds);
    tapes[i] = withAccuracy(tapes[i], own);
  }
  result.slope_ = covered ? slopeOf(shape()) : kInfinity;
  for (std::uint32_t i = 0; i < tapes.size(); ++i) result.all_.push_back(i);
  if (!shape().outer) {
    result.whole_ = tapes.front();
    return result;
  }
  TapePtr join;
  if (compiled_->blend) {
    join = compiled_->blend->at(values);
    const double k = join->constant(join->outputs().back().index());
    result.blendDepth_ = k * deepestBlend(shape().outer->blend.kind, tapes.size());
    result.blendWidth_ = k + result.blendDepth_;
  }
  result.tapes_.emplace(tapes, join);
  result.whole_ = result.tapes_->link(result.all_);
  for (const Shape& operand : operands()) {
    const Box bounds = covered ? operand.bounds : Box::everything();
    result.bounds_.push_back({bounds, growthOf(operand.claim)});
  }
  return result;
}

// Where the model's distance is at most `most`, some operand's is at most most + depth. Among the distances
// of n operands there is then a gap of a width between those and most + depth + (n + 1) widths: what lies
// beyond it has no part in what is blended before it, and whatever was blended before is lost in the first
// operand that is nearer than the gap (see booleans.h: a blend is its lesser distance where the other is k
// larger).
std::vector<std::uint32_t> ModelTapes::relevantOperands(const Box& box, double most,
                                                        std::span<const std::uint32_t> among) const {
  if (!tapes_) return {among.begin(), among.end()};
  std::vector<double> least(among.size());
  for (std::size_t i = 0; i < among.size(); ++i) {
    const auto& [bounds, growth] = bounds_[among[i]];
    const double gap = gapBetween(box, bounds);
    least[i] = gap > 0.0 ? gap / growth : 0.0;
  }
  std::vector<std::uint32_t> result;
  std::size_t before;
  do {
    before = result.size();
    const double limit = most + blendDepth_ + blendWidth_ * static_cast<double>(before + 1);
    result.clear();
    for (std::size_t i = 0; i < among.size(); ++i)
      if (least[i] <= limit) result.push_back(among[i]);
  } while (blendWidth_ != 0.0 && result.size() != before);
  return result;
}

TapePtr ModelTapes::link(std::span<const std::uint32_t> operands) const {
  return tapes_ && operands.size() < all_.size() ? tapes_->link(operands) : whole_;
}

namespace {

constexpr double kConstant = 0x1p-64;  // stands for 0: the slope of a distance that is the same everywhere

bool isInput(const Expr& node) { return node.op() == Op::Parameter; }

// Inputs whose values these steps do not know.
bool hasOpenInputs(const Expr& e, Steps steps) {
  return std::ranges::any_of(topologicalOrder({&e, 1}), [&](const Expr& node) {
    if (!isInput(node)) return false;
    const bool isTaken =
        node.parameterInfo().name == "time" ? steps == Steps::ByRegionNow : steps >= Steps::ByRegionOfSliders;
    return !isTaken || !node.range().isPoint();
  });
}

// What distances are divided by. What is 1-Lipschitz up to rounding counts as such.
double divisorOf(double slope) {
  return slope >= 1.0 && isOneLipschitz(slope) ? 1.0 : std::max(slope, kConstant);
}

// By regions of the distance; nothing where these lead no farther, or hang on inputs.
std::optional<RegionStep> regionStepOf(const Steep& steep, Steps steps) {
  if (hasOpenInputs(steep.distance, steps)) return {};
  const bool hangs = std::ranges::any_of(topologicalOrder({&steep.distance, 1}), isInput);
  const auto step = stepByRegion(steep.distance, steep.bounds, divisorOf(steep.slope));
  return step && (step->gain >= kWorthwhile || hangs) ? step : std::nullopt;
}

// By regions of the one that is copied; nothing where these lead no farther.
std::optional<RegionStep> stepByCopies(const Copies& copies, Steps steps) {
  const Marchable one = marchable(copies.one, steps);
  if (one.gain == 1.0) return {};
  std::optional<Expr> least = copies.others;
  for (const auto& [x, y, z] : copies.places) {
    const Expr seen = remap(one.step, {x, y, z}, kInfinity);
    least = least ? min(*least, seen) : seen;
  }
  return RegionStep{*least, one.gain};
}

Marchable marchableBy(const Steep& steep, Steps steps) {
  const auto& [distance, slope, bounds, copies] = steep;
  const double divisor = divisorOf(slope);
  if (divisor == 1.0) return {distance, distance, slope};
  Expr step = distance * (1.0 / divisor);
  if (divisor < 1.0 || bounds.empty()) return {distance, step, slope};
  if (const auto outside = outsideBox(bounds)) step = max(step, *outside);
  if (steps == Steps::BySlope) return {distance, step, slope};
  const auto near = copies ? stepByCopies(*copies, steps) : regionStepOf(steep, steps);
  if (!near) return {distance, step, slope};
  return {distance, max(step, near->step), slope, near->gain};
}

// As a balanced tree.
Expr leastOf(std::span<const Expr> all) {
  if (all.size() == 1) return all.front();
  const std::size_t half = all.size() / 2;
  return min(leastOf(all.first(half)), leastOf(all.subspan(half)));
}

Marchable leastOf(const Marchable& a, const Marchable& b) {
  return {min(a.distance, b.distance), min(a.step, b.step), std::max(a.slope, b.slope),
          std::max(a.gain, b.gain)};
}

Marchable leastOf(std::span<const Shape> operands, Steps steps) {
  std::vector<Steep> known;
  std::optional<Marchable> others;
  for (const Shape& operand : operands) {
    if (slopeOf(operand) < kInfinity) {
      known.push_back(steepOf(operand));
      continue;
    }
    const Marchable one = marchable(operand, steps);
    others = others ? leastOf(*others, one) : one;
  }
  if (known.empty()) return *others;
  const Marchable least = leastOf(known, steps);
  return others ? leastOf(least, *others) : least;
}

}  // namespace

Steep steepOf(const Shape& shape) {
  const double slope = divisorOf(slopeOf(shape));
  return {shape.distance, slope, shape.bounds, slope > 1.0 ? shape.copies : nullptr};
}

bool waitsForInputs(const Shape& shape, Steps steps) {
  const Steep steep = steepOf(shape);
  if (steep.slope <= 1.0) return false;
  return steep.copies ? waitsForInputs(steep.copies->one, steps) : hasOpenInputs(steep.distance, steps);
}

Marchable leastOf(std::span<const Steep> all, Steps steps) {
  constexpr std::size_t kMostByRegion = 3;  // each of which a shader has a texture for
  struct Alike {
    std::vector<Expr> distances;
    Box bounds;
    std::shared_ptr<const Copies> copies;
  };
  std::map<std::pair<double, std::size_t>, Alike> bySlope;  // what is copied alone
  for (const Steep& one : all) {
    Alike& alike = bySlope[{divisorOf(one.slope), one.copies ? bySlope.size() + 1 : 0}];
    alike.distances.push_back(one.distance);
    alike.bounds = unite(alike.bounds, one.bounds);
    alike.copies = one.copies;
  }
  std::vector<Expr> distances, ways;
  double gain = 1.0;
  for (std::size_t left = bySlope.size(); const auto& [key, alike] : bySlope) {
    distances.push_back(leastOf(alike.distances));
    const Steps here = left-- <= kMostByRegion ? steps : Steps::BySlope;
    const Marchable one = marchableBy({distances.back(), key.first, alike.bounds, alike.copies}, here);
    ways.push_back(one.step);
    gain = std::max(gain, one.gain);
  }
  return {leastOf(distances), leastOf(ways), bySlope.rbegin()->first.first, gain};
}

Marchable marchable(const Shape& shape, Steps steps) {
  const Steep steep = steepOf(shape);
  if (shape.outer && shape.outer->blend.kind == Blend::Kind::Hard) {
    const auto isAlike = [&](const Shape& operand) {
      const Steep one = steepOf(operand);
      return one.slope == steep.slope && !one.copies;
    };
    if (steep.slope == kInfinity || !std::ranges::all_of(shape.outer->operands, isAlike))
      return leastOf(shape.outer->operands, steps);
  }
  if (steep.slope == kInfinity) return {shape.distance, shape.distance, kInfinity};
  return marchableBy(steep, steps);
}

}  // namespace sdf
