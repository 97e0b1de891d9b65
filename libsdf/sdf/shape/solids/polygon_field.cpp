#include "sdf/shape/solids/polygon_field.h"

#include <algorithm>
#include <cmath>

namespace sdf {
namespace {

bool isFinite(const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

// What coordinates, and what is computed of them, are rounded by, in parts of their size.
constexpr double kRounded = 0x1p-50;

double sizeOf(const PolygonDistance& distance, const glm::dvec2& p) {
  const Rectangle& box = distance.bounds();
  return std::hypot(p.x, p.y) + std::hypot(box.lo.x, box.lo.y) + std::hypot(box.hi.x, box.hi.y);
}

}  // namespace

std::shared_ptr<const PolygonField> PolygonField::of(std::span<const glm::dvec2> corners) {
  ArcContour contour;
  for (const glm::dvec2& p : corners) contour.push_back({p, 0.0});
  return of(std::vector<ArcContour>{std::move(contour)});
}

PolygonField::PolygonField(std::vector<ArcContour> contours, std::vector<ArcContour> drawn)
    : contours_(std::move(contours)), drawn_(std::move(drawn)), distance_(contours_) {
  if (!drawn_.empty()) drawnDistance_.emplace(drawn_);
}

std::shared_ptr<const PolygonField> PolygonField::of(std::vector<ArcContour> contours,
                                                     std::vector<ArcContour> drawn) {
  static std::mutex lock;
  static std::vector<std::weak_ptr<const PolygonField>> all;
  const std::lock_guard guard(lock);
  std::erase_if(all, [](const auto& field) { return field.expired(); });
  for (const auto& known : all)
    if (auto field = known.lock(); field && field->contours_ == contours && field->drawn_ == drawn)
      return field;
  const std::shared_ptr<const PolygonField> field(new PolygonField(std::move(contours), std::move(drawn)));
  all.push_back(field);
  return field;
}

const PolygonCells& PolygonField::cells() const {
  std::call_once(made_, [&] { cells_.emplace(drawn()); });
  return *cells_;
}

// Where p is not finite the distance is as far as that, or no number.
double PolygonField::value(const glm::dvec3& p) const { return gradient(p).value; }

ValueAndGradient PolygonField::gradient(const glm::dvec3& p) const {
  const glm::dvec2 at(p);
  if (!isFinite(at)) return {std::sqrt(at.x * at.x + at.y * at.y), glm::dvec3(NAN)};
  const PolygonDistance::Read read = distance_.read(at);
  return {read.distance, glm::dvec3(read.gradient, 0.0)};
}

Interval PolygonField::range(const std::array<Interval, 3>& box) const {
  const bool nan = box[0].nan || box[1].nan;
  glm::dvec2 middle, half;
  for (int k = 0; k < 2; ++k) {
    middle[k] = 0.5 * box[k].lo + 0.5 * box[k].hi;
    half[k] = std::max(box[k].hi - middle[k], middle[k] - box[k].lo);
  }
  if (!isFinite(middle) || !isFinite(half)) return {-HUGE_VAL, HUGE_VAL, nan};
  const double f = distance_.read(middle).distance, reach = std::hypot(half.x, half.y);
  const double slack = kRounded * (sizeOf(distance_, middle) + reach);
  return {f - reach - slack, f + reach + slack, nan};
}

double PolygonField::rounding(const glm::dvec3& p) const {
  return kRounded * sizeOf(distance_, glm::dvec2(p));
}

// Each point begins with the side that was nearest to the one before.
void PolygonField::values(const PayloadRows& p, std::size_t count, float* out) const {
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 at(p[0][i], p[1][i]);
    if (!isFinite(at)) {
      out[i] = static_cast<float>(std::sqrt(at.x * at.x + at.y * at.y));
      continue;
    }
    const PolygonDistance::Read read = distance_.read(at, hint);
    out[i] = static_cast<float>(read.distance), hint = read.side;
  }
}

void PolygonField::gradients(const PayloadRows& p, std::size_t count,
                             const std::array<float*, 4>& out) const {
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 at(p[0][i], p[1][i]);
    PolygonDistance::Read read{std::sqrt(at.x * at.x + at.y * at.y), glm::dvec2(NAN), hint};
    if (isFinite(at)) read = distance_.read(at, hint);
    hint = read.side;
    out[0][i] = static_cast<float>(read.distance);
    out[1][i] = static_cast<float>(read.gradient.x), out[2][i] = static_cast<float>(read.gradient.y);
    out[3][i] = isFinite(at) ? 0.0f : NAN;
  }
}

}  // namespace sdf
