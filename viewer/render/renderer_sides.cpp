// The sides of a split view, which are pictures of two renderers.
#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/render/renderer.h"

namespace sdf::viewer {

// The picture is left of the column at `split`, if there are two sides.
template <class Draw>
Status Renderer::drawSides(const Frame& frame, const Target& target, const Draw& draw) {
  const int width = target.width();
  if (!marched_) return draw(*this, Columns{0, width});
  const int left = std::clamp(static_cast<int>(std::lround(frame.split * width)), 0, width);
  if (left > 0)
    if (auto s = draw(*marched_, Columns{0, left}); !s) return s;
  return left < width ? draw(*this, Columns{left, width - left}) : okStatus();
}

namespace {

Frame relativeTo(Frame frame, const glm::dvec3& origin) {
  frame.look = relativeTo(std::move(frame.look), origin);
  return frame;
}

}  // namespace

Status Renderer::draw(const Frame& there, const Target& target, std::optional<Rows> rows) {
  const Frame frame = relativeTo(there, origin());
  return drawSides(frame, target, [&](Renderer& side, const Columns& columns) {
    return side.drawColumns(frame, target, rows.value_or(Rows{0, target.height()}), columns);
  });
}

Status Renderer::refine(const Frame& there, int drawn, const Target& target, std::optional<Rows> rows) {
  const Frame frame = relativeTo(there, origin());
  return drawSides(frame, target, [&](Renderer& side, const Columns& columns) {
    return side.refineColumns(frame, drawn, target, rows.value_or(Rows{0, target.height()}), columns);
  });
}

// Those of either side add up.
Result<glm::dvec4> Renderer::counts(const Target& target) const {
  if (samples_ == 1) return target.sum(1);
  auto sum = sums_->sum(1);
  if (!sum || !marched_ || !marched_->sums_) return sum;
  const auto marched = marched_->sums_->sum(1);
  if (!marched) return marched;
  return *sum + *marched;
}

Result<double> Renderer::primaryReadings() const {
  const Result<double> cones = hits_ ? hits_->coneReadings() : 0.0;
  if (!cones) return cones;
  const Result<double> marched = marched_ ? marched_->primaryReadings() : 0.0;
  if (!marched) return marched;
  return *marched + (hits_ ? hits_->readings() : 0.0) + *cones / samples_;
}

Result<Readings> Renderer::readings(const Target& target) const {
  const auto sums = counts(target);
  const auto primary = primaryReadings();
  if (!sums) return sums.error();
  if (!primary) return primary.error();
  const double pixels = static_cast<double>(target.width()) * target.height();
  return Readings{(sums->x + *primary) / pixels, sums->y / pixels, sums->z / pixels, sums->w / pixels};
}

}  // namespace sdf::viewer
