// Sums and products of two doubles, kept as two doubles (Dekker 1971; Knuth, TAOCP 2, section 4.2.2).
#pragma once
#include <array>
#include <cmath>
#include <glm/vec3.hpp>

namespace sdf {

/// high + low, where low is less than half an ulp of high. Relative error of what follows: some 2^-104 of the
/// terms. Precondition: no overflow, and no product less than 2^-960.
struct Twofold {
  double high = 0.0, low = 0.0;
};

inline Twofold twofoldSum(double a, double b) {
  const double sum = a + b, shadow = sum - a;
  return {sum, (a - (sum - shadow)) + (b - shadow)};
}
inline Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold high = twofoldSum(a.high, b.high), low = twofoldSum(a.low, b.low);
  const Twofold sum = twofoldSum(high.high, high.low + low.high);
  return twofoldSum(sum.high, sum.low + low.low);
}
inline Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }
inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const double product = a.high * b.high;
  return twofoldSum(product, std::fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high));
}

using TwofoldVec = std::array<Twofold, 3>;

inline TwofoldVec twofoldDifference(const glm::dvec3& a, const glm::dvec3& b) {
  return {twofoldSum(a.x, -b.x), twofoldSum(a.y, -b.y), twofoldSum(a.z, -b.z)};
}
inline Twofold dot(const TwofoldVec& a, const TwofoldVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline TwofoldVec cross(const TwofoldVec& a, const TwofoldVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline glm::dvec3 rounded(const TwofoldVec& a) { return {a[0].high, a[1].high, a[2].high}; }

}  // namespace sdf
