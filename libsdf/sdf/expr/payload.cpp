#include "sdf/expr/payload.h"

#include <algorithm>
#include <cmath>

namespace sdf {

void Payload::values(const PayloadRows& p, std::size_t count, float* out) const {
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(value({p[0][i], p[1][i], p[2][i]}));
}

void Payload::gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const {
  for (std::size_t i = 0; i < count; ++i) {
    const ValueAndGradient f = gradient({p[0][i], p[1][i], p[2][i]});
    out[0][i] = static_cast<float>(f.value);
    for (int k = 0; k < 3; ++k) out[k + 1][i] = static_cast<float>(f.gradient[k]);
  }
}

double payloadAt(const PayloadPart& part, double a, double b, double c) {
  if (part.part == 0) return part.payload->value({a, b, c});
  return part.payload->gradient({a, b, c}).gradient[part.part - 1];
}

Interval payloadAt(const PayloadPart& part, const Interval& a, const Interval& b, const Interval& c) {
  const Interval range = part.payload->range({a, b, c});
  return part.part == 0 ? range : payloadSlope({part.payload}, range);
}

std::array<double, 4> payloadSlopes(const PayloadPart& part, double a, double b, double c) {
  const ValueAndGradient f = part.payload->gradient({a, b, c});
  if (part.part != 0) return {f.gradient[part.part - 1], NAN, NAN, NAN};
  return {f.value, f.gradient.x, f.gradient.y, f.gradient.z};
}

void payloadSlopes(const PayloadPart& part, const PayloadRows& p, std::size_t count, bool slopes,
                   const std::array<float*, 4>& out) {
  if (part.part == 0 && !slopes) return part.payload->values(p, count, out[0]);
  part.payload->gradients(p, count, out);
  if (part.part == 0) return;
  std::copy_n(out[part.part], count, out[0]);
  for (int k = 1; k < 4; ++k) std::fill_n(out[k], count, NAN);
}

Interval payloadSlope(const PayloadPart& part, const Interval& range) {
  const double slope = part.payload->lipschitz();
  if (part.part != 0 || !std::isfinite(slope)) return Interval::everything();
  return {-slope, slope, range.nan || !std::isfinite(range.magnitude())};
}

}  // namespace sdf
