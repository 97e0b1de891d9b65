#include "viewer/render/present_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sdf/expr/alike.h"
#include "sdf/model/groups.h"
#include "sdf/model/region_steps.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace {

using Names = std::set<std::string>;

std::vector<Shape> operandsOf(const Scene& scene) {
  std::vector<Shape> all;
  for (const Part& part : scene.parts)
    if (isHardUnion(part.shape))
      all.insert(all.end(), part.shape.outer->operands.begin(), part.shape.outer->operands.end());
    else
      all.push_back(part.shape);
  return all;
}

// An exact distance is the same whatever its inputs' ranges are.
bool isExact(const Shape& shape) { return shape.claim.kind <= ClaimKind::ExactOutside; }

void addInputs(const Expr& e, Names& names) {
  for (const Expr& node : topologicalOrder({&e, 1}))
    if (node.op() == Op::Parameter) names.insert(node.parameterInfo().name);
}

bool isClose(double a, double b) {
  constexpr double kRounding = 1e-9;  // of bounds that intervals derive in another order
  return a == b || std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b)) ||
         (std::isnan(a) && std::isnan(b));
}

// Whether two distances are written alike, with the same numbers where inputs have these values.
bool sameAt(const Expr& a, const Expr& b, const Values& values) {
  const std::vector<Expr> lists[] = {{a}, {b}};
  const std::vector<Alike> sorts = groupByStructure(lists, hidden("number "));
  if (sorts.size() > 1) return false;
  const auto& rows = sorts.front().rows;
  return std::ranges::equal(Function(rows[0]).uniform(values), Function(rows[1]).uniform(values), isClose);
}

// Steps go to bounds where slopes are more than this: without it they are shorter by no more.
constexpr double kSteep = 1.3;

bool sameBounds(const Box& a, const Box& b) {
  for (int i = 0; i < 3; ++i)
    if (!isClose(a.min[i], b.min[i]) || !isClose(a.max[i], b.max[i])) return false;
  return true;
}

bool sameAt(const Shape& a, const Shape& b, const Values& values) {
  const double slope = slopeOf(a);
  return a.claim.kind == b.claim.kind && isClose(slope, slopeOf(b)) &&
         (slope <= kSteep || sameBounds(a.bounds, b.bounds)) && sameAt(a.distance, b.distance, values);
}

// Whether such steps are known of the second alone.
bool isKnownBy(Steps steps, const Shape& a, const Shape& b) {
  return waitsForInputs(a, steps) && !waitsForInputs(b, steps);
}

// The inputs of those operands of a scene that are others in one which was made for fewer values.
Names inputsOfOthers(const Scene& scene, const Scene& narrow, const Values& values, Steps steps) {
  const std::vector<Shape> all = operandsOf(scene), others = operandsOf(narrow);
  const auto isSame = [&](std::size_t i) {
    return all.size() == others.size() && !isKnownBy(steps, all[i], others[i]) &&
           sameAt(all[i], others[i], values);
  };
  Names names;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!isExact(all[i]) && !isSame(i)) addInputs(all[i].distance, names);
  return names;
}

// By how much farther regions lead where they are known of the second scene alone; 1 where they are not.
double gainOf(Steps steps, const Scene& scene, const Scene& narrow) {
  const std::vector<Shape> all = operandsOf(scene), others = operandsOf(narrow);
  std::vector<Steep> steep;
  for (std::size_t i = 0; i < std::min(all.size(), others.size()); ++i)
    if (isKnownBy(steps, all[i], others[i])) steep.push_back(steepOf(others[i]));
  return steep.empty() ? 1.0 : leastOf(steep, steps).gain;
}

// A table takes about as long as a frame, measured on two cores of a CPU that draws 640 x 360 pixels as well:
// those that the clock changes pay from gains of about 16 on.
Steps stepsFor(double gain) {
  constexpr double kWorthAFrame = 16.0;
  return gain >= kWorthAFrame  ? Steps::ByRegionNow
         : gain >= kWorthwhile ? Steps::ByRegionOfSliders
                               : Steps::ByRegion;
}

// Within each range, away from its ends and its middle; those that the script has read stay.
Values elsewhere(const Scene& scene, const Values& parameters) {
  constexpr double kWithin = 0.381966;  // the golden section of a range
  Values values = parameters;
  for (const ParameterInfo& p : scene.parameters)
    if (p.name != "time" && !scene.valuesRead.contains(p.name))
      values[p.name] = p.min + kWithin * (p.max - p.min);
  return values;
}

Values withTime(Values values, double time) {
  values["time"] = time;
  return values;
}

}  // namespace

PresentScene::PresentScene(SceneFile file, const Scene& scene, const Values& parameters, double time)
    : file_(std::move(file)) {
  for (const ParameterInfo& p : scene.parameters) known_.insert(p.name);
  Names bounded;
  for (const Shape& shape : operandsOf(scene))
    if (!isExact(shape)) addInputs(shape.distance, bounded);
  if (bounded.empty()) return;
  constexpr double kLater = 0.618;  // seconds
  Values values = elsewhere(scene, parameters);
  double moment = scene.valuesRead.contains("time") ? time : time + kLater;
  other_ = run(values, moment, bounded);
  if (!other_) other_ = run(values = parameters, moment = time, bounded);
  if (!other_) return;
  const Values all = withTime(values, moment);
  steps_ = stepsFor(gainOf(Steps::ByRegionNow, scene, *other_));
  inputs_ = inputsOfOthers(scene, *other_, all, steps_);
  for (const std::string& name : Names(inputs_)) {
    Names fewer = inputs_;
    fewer.erase(name);
    auto narrow = fewer.empty() ? std::nullopt : run(values, moment, fewer);
    if (!narrow || !inputsOfOthers(*narrow, *other_, all, steps_).empty()) continue;
    inputs_ = std::move(fewer);
  }
  other_ = inputs_.empty() ? std::nullopt : run(values, moment, inputs_);
  move(parameters, time);
}

std::optional<Scene> PresentScene::run(const Values& parameters, double time, const Names& inputs) const {
  Values known = parameters;
  std::erase_if(known,
                [&](const auto& value) { return value.first == "time" || !known_.contains(value.first); });
  auto scene = file_.load({.values = std::move(known), .time = time, .narrowed = inputs});
  return scene ? std::optional(std::move(*scene)) : std::nullopt;
}

bool PresentScene::move(const Values& parameters, double time) {
  Values now = withTime(parameters, time);
  std::erase_if(now, [&](const auto& value) { return !inputs_.contains(value.first); });
  return std::exchange(last_, now) != now;
}

Scene PresentScene::at(const Scene& all, const Values& parameters, double time) const {
  if (inputs_.empty()) return all;
  auto scene = run(parameters, time, inputs_);
  return scene ? std::move(*scene) : all;
}

}  // namespace sdf::viewer
