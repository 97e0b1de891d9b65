#include "sdf/proof/shell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

constexpr double kSides = 1.0;     // how much of a side's length faces are lifted by
constexpr double kSteepest = 0.2;  // cosine; beyond it a mitre grows no longer
constexpr double kFlat = 0.85;     // cosine of the normals around a vertex with their middle: not on a crease
constexpr double kTurned = 0.7;    // what may become of it

// The axis of a narrow cone around unit vectors (Badoiu, Clarkson 2003).
glm::dvec3 coneAxis(const glm::dvec3* first, const glm::dvec3* last) {
  constexpr int kSteps = 24;
  constexpr double kNarrow = 0.98;  // cosine; a cone that is narrow enough as it is
  glm::dvec3 sum(0.0);
  for (const glm::dvec3* n = first; n != last; ++n) sum += *n;
  if (!(glm::length(sum) > 0.0)) return first != last ? *first : glm::dvec3(0, 1, 0);
  glm::dvec3 axis = glm::normalize(sum);
  for (int k = 1; k < kSteps; ++k) {
    const glm::dvec3* least = std::min_element(first, last, [&](const glm::dvec3& a, const glm::dvec3& b) {
      return glm::dot(a, axis) < glm::dot(b, axis);
    });
    if (glm::dot(*least, axis) > kNarrow) break;
    const glm::dvec3 moved = axis + (*least - axis) / (k + 1.0);
    if (!(glm::length(moved) > 1e-3)) break;
    axis = glm::normalize(moved);
  }
  return axis;
}

Box around(const Prism& p, bool flat) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 reach = flat ? glm::dvec3(0.0) : glm::abs(p.offsets[k]);
    box = unite(box, {p.corners[k] - reach, p.corners[k] + reach});
  }
  return box;
}

// The least cosine between a direction and the normals of the triangles around a vertex.
double leastCosine(const glm::dvec3& axis, std::span<const std::uint32_t> fan,
                   const std::vector<glm::dvec3>& normals) {
  double least = 1.0;
  for (const std::uint32_t t : fan)
    if (normals[t] != glm::dvec3(0.0)) least = std::min(least, glm::dot(normals[t], axis));
  return least;
}

// In the middle of the normals around each vertex, and turned a little towards those of its neighbours:
// beside a crease, so that the field of the face beyond it rises along them, too.
std::vector<glm::dvec3> offsetDirections(const std::vector<glm::uvec3>& triangles, const Incidence& fans,
                                         const std::vector<glm::dvec3>& normals,
                                         std::vector<double>& steepest) {
  const std::size_t count = steepest.size();
  std::vector<glm::dvec3> axes(count), own;
  for (std::size_t v = 0; v < count; ++v) {
    own.clear();
    for (const std::uint32_t t : fans.of(v))
      if (normals[t] != glm::dvec3(0.0)) own.push_back(normals[t]);
    axes[v] = coneAxis(own.data(), own.data() + own.size());
    steepest[v] = leastCosine(axes[v], fans.of(v), normals);
  }
  std::vector<glm::dvec3> turned = axes;
  for (std::size_t v = 0; v < count; ++v) {
    if (steepest[v] < kFlat) continue;
    glm::dvec3 sum(0.0);
    for (const std::uint32_t t : fans.of(v))
      for (int k = 0; k < 3; ++k) sum += axes[triangles[t][k]];
    if (!(glm::length(sum) > 0.0)) continue;
    const glm::dvec3 axis = glm::normalize(sum);
    const double least = leastCosine(axis, fans.of(v), normals);
    if (least < kTurned) continue;
    turned[v] = axis;
    steepest[v] = least;
  }
  return turned;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

Shell::Shell(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles, double least)
    : positions_(positions.begin(), positions.end()), triangles_(triangles), offsets_(positions.size()) {
  const Incidence fans(triangles, positions.size());
  std::vector<glm::dvec3> normals(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3& v = triangles[t];
    const glm::dvec3 n = glm::cross(positions_[v.y] - positions_[v.x], positions_[v.z] - positions_[v.x]);
    if (const double area = glm::length(n); area > 0.0) normals[t] = n / area;
  }
  std::vector<double> steepest(positions.size());
  const std::vector<glm::dvec3> axes = offsetDirections(triangles, fans, normals, steepest);
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    double shortest = kInfinity;
    for (const std::uint32_t t : fans.of(v))
      for (int k = 0; k < 3; ++k)
        if (triangles[t][k] == v)
          shortest = std::min(shortest, glm::length(positions_[triangles[t][(k + 1) % 3]] - positions_[v]));
    if (shortest == kInfinity) continue;
    offsets_[v] = std::max(least, kSides * shortest) / std::max(kSteepest, steepest[v]) * axes[v];
  }
}

Prism Shell::prism(std::uint32_t t) const {
  Prism p;
  for (int k = 0; k < 3; ++k) {
    p.corners[k] = positions_[triangles_[t][k]];
    p.offsets[k] = offsets_[triangles_[t][k]];
  }
  return p;
}

Box Shell::boxOf(std::uint32_t t) const { return around(prism(t), false); }
Box Shell::flatBoxOf(std::uint32_t t) const { return around(prism(t), true); }

glm::dvec3 Shell::centre(std::uint32_t t) const {
  const Prism p = prism(t);
  return (p.corners[0] + p.corners[1] + p.corners[2]) / 3.0;
}

ShellDegree::ShellDegree(const Shell& shell) : shell_(shell) {
  constexpr int kMostColumns = 1024;
  const std::uint32_t count = 2 * static_cast<std::uint32_t>(shell.size());
  columns_ = std::clamp(static_cast<int>(std::sqrt(0.25 * count)), 1, kMostColumns);
  for (std::uint32_t t = 0; t < shell.size(); ++t) bounds_ = unite(bounds_, shell.boxOf(t));
  first_.assign(static_cast<std::size_t>(columns_) * columns_ + 1, 0);
  const auto each = [&](const auto& take) {
    for (std::uint32_t s = 0; s < count; ++s) {
      const auto [lo, hi] = columnsOf(side(s));
      for (int y = lo.x; y <= hi.x; ++y)
        for (int z = lo.y; z <= hi.y; ++z) take(static_cast<std::size_t>(y) * columns_ + z, s);
    }
  };
  each([&](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  sides_.resize(first_.back());
  std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
  each([&](std::size_t c, std::uint32_t s) { sides_[at[c]++] = s; });
}

ShellDegree::Triangle ShellDegree::side(std::uint32_t s) const {
  const Prism p = shell_.prism(s / 2);
  Triangle t;
  for (int k = 0; k < 3; ++k) t[k] = s % 2 == 0 ? p.corners[k] + p.offsets[k] : p.corners[k] - p.offsets[k];
  return t;
}

int ShellDegree::column(double x, int axis) const {
  const double width = bounds_.max[axis] - bounds_.min[axis];
  const double at = width > 0.0 ? (x - bounds_.min[axis]) / width * columns_ : 0.0;
  return static_cast<int>(std::clamp(std::floor(at), 0.0, columns_ - 1.0));
}

// The columns of y and z that a triangle is over. What rounding adds cannot matter: column() is monotone.
std::pair<glm::ivec2, glm::ivec2> ShellDegree::columnsOf(const Triangle& t) const {
  const auto range = [&](int axis) {
    const auto [lo, hi] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    return std::pair(column(lo, axis), column(hi, axis));
  };
  const auto [y0, y1] = range(1);
  const auto [z0, z1] = range(2);
  return {{y0, z0}, {y1, z1}};
}

std::optional<int> ShellDegree::at(const glm::dvec3& p) const {
  // Of products of two or three differences of coordinates, each rounded some times.
  constexpr double kRounding = 1e-13;
  const double size = glm::length(bounds_.size()) + glm::length(bounds_.centre()) + glm::length(p);
  const std::size_t at = static_cast<std::size_t>(column(p.y, 1)) * columns_ + column(p.z, 2);
  const glm::dvec2 flat(p.y, p.z);
  int degree = 0;
  for (std::uint32_t i = first_[at]; i < first_[at + 1]; ++i) {
    const Triangle t = side(sides_[i]);
    if (t[0].x < p.x && t[1].x < p.x && t[2].x < p.x) continue;
    double turn[3];
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 a(t[k].y, t[k].z), b(t[(k + 1) % 3].y, t[(k + 1) % 3].z);
      turn[k] = cross(b - a, flat - a);
      const double unsure = kRounding * size * (glm::length(b - a) + glm::length(flat - a));
      positive += turn[k] > unsure;
      negative += turn[k] < -unsure;
    }
    if (positive > 0 && negative > 0) continue;
    if (positive < 3 && negative < 3) return std::nullopt;
    if (!(t[0].x > p.x && t[1].x > p.x && t[2].x > p.x)) {
      // The ray's line meets it at the mean by the areas opposite to the corners.
      const double area = turn[0] + turn[1] + turn[2];
      double reach = 0.0;
      for (int k = 0; k < 3; ++k) reach = std::max(reach, glm::length(t[(k + 1) % 3] - t[k]));
      if (std::abs(area) < 1e6 * kRounding * size * reach) return std::nullopt;
      const double x = (turn[1] * t[0].x + turn[2] * t[1].x + turn[0] * t[2].x) / area;
      if (std::abs(x - p.x) < 1e-4 * reach) return std::nullopt;
      if (x < p.x) continue;
    }
    // A side seen from within has its normal along the ray.
    const int sign = positive == 3 ? 1 : -1;
    degree += sides_[i] % 2 == 0 ? sign : -sign;
  }
  return degree;
}

}  // namespace sdf
