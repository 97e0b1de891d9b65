#include "sdf/march/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "sdf/eval/promise.h"
#include "sdf/eval/rounding.h"
#include "sdf/model/model.h"

namespace sdf {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool sameLength(const Vectors& v, std::size_t count) {
  return v.x.size() == count && v.y.size() == count && v.z.size() == count;
}

// Where a shape is looked at, at most, if it has no bounds: as far as views see by themselves.
constexpr double kSeen = 80.0;

// Read in double where floats are farther off than the readings near 0 are looked at again for (sampler.cpp).
MarchField fieldOf(const Expr& distance, const Expr& step, double lipschitz, const Box& bounds) {
  const Box seen = bounds.finite() ? bounds : intersect(bounds, Box::centred(glm::dvec3(kSeen)));
  const double off = distanceRounding(glm::max(glm::abs(seen.min), glm::abs(seen.max)));
  const TapePtr tape = std::make_shared<const Tape>(std::array{distance, step});
  return {withAccuracy(tape, {seen, off, kInfinity}), lipschitz};
}

// What is wrong with ray i; "" where nothing is.
std::string fault(const Rays& rays, std::size_t i) {
  if (!finite(rays.origin[i])) return "its origin is not finite";
  if (!isUnit(rays.direction[i]))
    return "its direction has length " + std::to_string(glm::length(rays.direction[i])) + "; normalise it";
  if (!std::isfinite(rays.tMin[i]) || !std::isfinite(rays.tMax[i])) return "tMin and tMax must be finite";
  if (!(0.0 <= rays.tMin[i] && rays.tMin[i] <= rays.tMax[i])) return "0 <= tMin <= tMax must hold";
  return {};
}

}  // namespace

Result<MarchField> marchField(const Shape& shape) {
  if (!shape.ok()) return Error{ErrorKind::Scene, *shape.error};
  if (shape.dimension != 3) return Error{ErrorKind::Scene, "the shape is flat; extrude or revolve it"};
  const Marchable field = marchable(shape);
  return fieldOf(field.distance, field.step, field.slope, shape.bounds);
}

MarchField marchField(const Expr& distance, double lipschitz) {
  return fieldOf(distance, lipschitz == 1.0 ? distance : distance / lipschitz, lipschitz, Box::everything());
}

Status checkSlope(const MarchField& field, const char* user) {
  if (field.lipschitz > 0.0 && field.hasSlope()) return okStatus();
  const char* what = field.hasSlope() ? ": the Lipschitz constant must be positive"
                                      : ": the shape's slope has no known bound; state one with "
                                        "field's lipschitz, or march by segments or bisection";
  return Error{ErrorKind::Scene, std::string(user) + what};
}

Status checkRays(const Rays& rays, const char* user) {
  const std::size_t count = rays.size();
  const std::string subject(user);
  if (!sameLength(rays.origin, count) || !sameLength(rays.direction, count) || rays.tMax.size() != count)
    return Error{ErrorKind::Usage, subject + ": the rows of the rays differ in length"};
  for (std::size_t i = 0; i < count; ++i)
    if (const std::string what = fault(rays, i); !what.empty())
      return Error{ErrorKind::Usage, subject + ": ray " + std::to_string(i) + ": " + what};
  return okStatus();
}

}  // namespace sdf
