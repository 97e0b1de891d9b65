#include "light_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::chart {
namespace {

// The i-th of n points evenly spread over the unit disc.
std::pair<double, double> onDisc(int i, int n) {
  constexpr double kGolden = std::numbers::pi * (3.0 - 2.23606797749979);
  const double r = std::sqrt((i + 0.5) / n), a = kGolden * i;
  return {r * std::cos(a), r * std::sin(a)};
}

bool meetsBall(const glm::dvec3& from, const glm::dvec3& d, double radius, double reach) {
  const double b = glm::dot(from, d), c = glm::dot(from, from) - radius * radius, square = b * b - c;
  if (square < 0.0) return false;
  const double first = -b - std::sqrt(square), last = -b + std::sqrt(square);
  return last > 0.0 && first < reach;
}

bool meetsBlock(const glm::dvec3& from, const glm::dvec3& d, const glm::dvec3& half, double reach) {
  double first = 0.0, last = reach;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (-half[axis] - from[axis]) / d[axis], b = (half[axis] - from[axis]) / d[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last;
}

// The i-th place of the square.
glm::dvec3 groundPoint(int i, int n) {
  return {4.0 * (i % n + 0.5) / n - 2.0, 0.0, 4.0 * (i / n + 0.5) / n - 2.0};
}

}  // namespace

Shape Blocker::shape() const { return translate(ball ? sphere(half.x) : box(Vec3E(half)), Vec3E(centre)); }

bool Blocker::meets(const glm::dvec3& p, const glm::dvec3& d, double reach) const {
  return ball ? meetsBall(p - centre, d, half.x, reach) : meetsBlock(p - centre, d, half, reach);
}

Vectors groundPoints(const Blocker& blocker, int n) {
  Vectors points;
  for (int i = 0; i < n * n; ++i) {
    const glm::dvec3 p = groundPoint(i, n);
    const glm::dvec3 q = glm::abs(p - blocker.centre);
    const bool inside =
        blocker.ball ? glm::length(q) < blocker.half.x : glm::all(glm::lessThanEqual(q, blocker.half));
    if (!inside) points.add(p);
  }
  return points;
}

std::string groundPicture(const Vectors& points, const std::vector<double>& light, int n) {
  constexpr const char* kDigits = "0123456789abcdef";
  constexpr double kBrightest = 0xfe;
  std::string digits;
  std::size_t next = 0;
  for (int i = 0; i < n * n; ++i) {
    unsigned byte = 0xff;
    if (next < points.size() && points[next] == groundPoint(i, n))
      byte = static_cast<unsigned>(std::lround(kBrightest * std::clamp(light[next++], 0.0, 1.0)));
    digits += {kDigits[byte >> 4], kDigits[byte & 0xf]};
  }
  return digits;
}

std::vector<glm::dvec3> lampDirections(const glm::dvec3& towards, double radius, int count) {
  const glm::dvec3 u = glm::normalize(glm::cross(towards, glm::dvec3(0.3, 0.1, 0.9)));
  const glm::dvec3 v = glm::cross(towards, u);
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = onDisc(i, count);
    all.push_back(glm::normalize(towards + std::tan(radius) * (a * u + b * v)));
  }
  return all;
}

std::vector<glm::dvec3> skyDirections(int count) {
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = onDisc(i, count);
    all.emplace_back(a, std::sqrt(std::max(0.0, 1.0 - a * a - b * b)), b);
  }
  return all;
}

std::vector<double> lightOf(const Blocker& blocker, const Vectors& points,
                            const std::vector<glm::dvec3>& directions, double reach) {
  std::vector<double> light;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto met = std::count_if(directions.begin(), directions.end(),
                                   [&](const glm::dvec3& d) { return blocker.meets(points[i], d, reach); });
    light.push_back(1.0 - static_cast<double>(met) / static_cast<double>(directions.size()));
  }
  return light;
}

}  // namespace sdf::chart
