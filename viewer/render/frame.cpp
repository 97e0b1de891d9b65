#include "viewer/render/frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sdf/scene/background_light.h"

namespace sdf::viewer {
namespace {

// How far rays may start before the eye: up to a ball around the scene.
double aheadOf(const glm::dvec3& forward, const Eye& eye, const std::optional<Box>& bounds) {
  if (!bounds) return 0.0;
  const glm::dvec3 toCentre = bounds->centre() - eye.from;
  const double radius = 0.5 * glm::length(bounds->size()), focal = glm::length(forward);
  const double along = glm::dot(toCentre, forward) / focal - radius;
  // Near the scene there is nothing to gain.
  return along > 4.0 * radius ? along / focal : 0.0;
}

}  // namespace

Frame frameOf(const LookFunction& look, Values parameters, double aspect) {
  Frame frame;
  frame.look = look.at(parameters, aspect);
  frame.parameters = std::move(parameters);
  return frame;
}

OwnInputs::OwnInputs(const Function& function) {
  for (const ParameterInfo& input : function.inputs()) names_.push_back(input.name);
}

bool OwnInputs::move(const Values& inputs) {
  Values own;
  for (const std::string& name : names_)
    if (const auto value = inputs.find(name); value != inputs.end()) own.insert(*value);
  if (own == last_) return false;
  last_ = std::move(own);
  return true;
}

UniformValues::UniformValues(Function numbers) : numbers_(std::move(numbers)), inputs_(numbers_) {
  vectors_.resize((numbers_.outputs().size() + 3) / 4);
}

bool UniformValues::move(const Values& inputs) {
  if (!inputs_.move(inputs)) return false;
  const std::vector<double> values = numbers_.uniform(inputs_.values());
  for (std::size_t i = 0; i < values.size(); ++i)
    vectors_[i / 4][static_cast<int>(i % 4)] = static_cast<float>(values[i]);
  return true;
}

BackgroundValues::BackgroundValues(const Scene& scene)
    : radiance_(backgroundRadiance(scene)), inputs_(radiance_) {}

void BackgroundValues::move(const Values& inputs) {
  if (!inputs_.move(inputs)) return;
  vectors_.clear();
  for (const glm::dvec3& part : backgroundLight(*radiance_.at(inputs_.values())).parts)
    vectors_.emplace_back(glm::vec3(part), 0.0f);
}

Extent::Extent(const Scene& scene) : stated_(scene) {
  const Shape whole = scene.whole();
  if (whole.bounds.finite()) bounds = whole.bounds;
  // Occlusion by steps counts how many it takes to the hit.
  const bool counts = scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps;
  loose = whole.claim.kind > ClaimKind::ExactOutside && !counts;
}

ViewLengths Extent::lengths(const Eye& eye) const {
  ViewLengths lengths = viewLengths(stated_, eye.fittedRadius);
  if (eye.fittedRadius)
    lengths.maxDistance = std::max(lengths.maxDistance, glm::length(eye.to - eye.from) + *eye.fittedRadius);
  return lengths;
}

Shot::Shot(const Frame& frame, int width, int height, const Extent& extent)
    : frame_(frame),
      width_(width),
      height_(height),
      extent_(extent),
      lengths_(extent.lengths(frame.look.eye)) {
  const Eye& eye = frame.look.eye;
  axes_ = axesOf(eye);
  axes_.forward /= 2.0 * std::tan(0.5 * glm::radians(eye.fov));
  ahead_ = aheadOf(axes_.forward, eye, extent_.bounds);
}

double Shot::pixelRadius() const { return std::tan(0.5 * glm::radians(frame_.look.eye.fov)) / height_; }

double Shot::footprint() const { return frame_.filter ? 2.0 * pixelRadius() / frame_.samples : 0.0; }

glm::vec2 Shot::placeBySteps(const glm::dvec2& steps) const {
  const glm::dvec2 place = static_cast<double>(sample_) * steps;
  return {place.x - std::floor(place.x), place.y - std::floor(place.y)};
}

glm::vec2 Shot::within() const {
  const int side = frame_.samples;
  return glm::vec2(sample_ % side + 0.5, sample_ / side + 0.5) / static_cast<float>(side);
}

// Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018: steps by powers of 1 / g in two
// dimensions, where g^3 = g + 1, and in four, where g^5 = g + 1. No combination of all of them by whole
// numbers is one, so that together they fill their cube (Weyl 1916).
glm::vec2 Shot::lobe() const { return placeBySteps({0.7548776662466927, 0.5698402909980532}); }

glm::vec2 Shot::lightPlace() const { return placeBySteps({0.733891856627126, 0.6287067210378087}); }

glm::vec2 Shot::lensPlace() const { return placeBySteps({0.8566748838545029, 0.5385972572236101}); }

void Shot::set(const Program& program, const std::vector<glm::vec4>& values) const {
  const Eye& eye = frame_.look.eye;
  program.set("size", glm::vec2(width_, height_));
  program.set("from", glm::vec3(eye.from + ahead_ * axes_.forward));
  program.set("right", glm::vec3(axes_.right));
  program.set("up", glm::vec3(axes_.up));
  program.set("forward", glm::vec3(axes_.forward));
  program.set("ahead", ahead_);
  program.set("maxDistance", lengths_.maxDistance);
  program.set("pixelRadius", pixelRadius());
  program.set("unit", lengths_.unit);
  program.set("epsilon", frame_.epsilon * lengths_.unit);
  program.set("threshold", extent_.loose ? 0.5 * frame_.threshold : frame_.threshold);
  program.set("maxSteps", frame_.maxSteps);
  program.set("within", within());
  program.set("weight", weight());
  if (!values.empty()) program.set("sdfValues", values);
}

}  // namespace sdf::viewer
