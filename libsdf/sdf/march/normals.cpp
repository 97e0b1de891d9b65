#include "sdf/march/normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/eval/batch.h"

namespace sdf {
namespace {

// Two readings may differ by some roundings of numbers of this size.
constexpr double kRounding = 0x1p-22;

struct Arm {
  glm::dvec3 to;      // where f is read, in steps from the point
  glm::dvec3 weight;  // what it counts for in the gradient
};

std::span<const Arm> armsOf(NormalMethod method) {
  static const Arm forward[] = {
      {{0, 0, 0}, {-1, -1, -1}}, {{1, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}}};
  static const Arm central[] = {{{1, 0, 0}, {1, 0, 0}},   {{-1, 0, 0}, {-1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}},
                                {{0, -1, 0}, {0, -1, 0}}, {{0, 0, 1}, {0, 0, 1}},   {{0, 0, -1}, {0, 0, -1}}};
  static const Arm tetrahedron[] = {{{1, -1, -1}, {1, -1, -1}},
                                    {{-1, -1, 1}, {-1, -1, 1}},
                                    {{-1, 1, -1}, {-1, 1, -1}},
                                    {{1, 1, 1}, {1, 1, 1}}};
  if (method == NormalMethod::Forward) return forward;
  if (method == NormalMethod::Central) return central;
  return tetrahedron;
}

struct FloatRows {
  explicit FloatRows(std::size_t count) : x(count), y(count), z(count), f(count) {}
  std::vector<float> x, y, z, f;
  Rows rows() const { return {x.data(), y.data(), z.data()}; }
};

double largest(const glm::dvec3& v) {
  const glm::dvec3 a = glm::abs(v);
  return std::max({a.x, a.y, a.z});
}

// Unnormalised gradients by differences, those that rounding could explain set to 0.
std::vector<glm::dvec3> differences(const MarchField& field, const Vectors& points,
                                    const NormalOptions& options) {
  const std::size_t count = points.size();
  BatchEvaluator batch;
  FloatRows at(count);
  std::vector<glm::dvec3> sum(count, glm::dvec3(0.0));
  std::vector<double> size(count, 0.0);
  for (const Arm& arm : armsOf(options.method)) {
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 p = points[i] + options.step * arm.to;
      at.x[i] = static_cast<float>(p.x), at.y[i] = static_cast<float>(p.y), at.z[i] = static_cast<float>(p.z);
      size[i] = std::max(size[i], largest(p));
    }
    batch.evaluate(*field.distance, at.rows(), count, at.f.data());
    for (std::size_t i = 0; i < count; ++i) {
      sum[i] += static_cast<double>(at.f[i]) * arm.weight;
      size[i] = std::max(size[i], std::abs(static_cast<double>(at.f[i])));
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    if (largest(sum[i]) <= kRounding * size[i]) sum[i] = glm::dvec3(0.0);
  return sum;
}

std::vector<glm::dvec3> gradients(const MarchField& field, const Vectors& points) {
  const std::size_t count = points.size();
  BatchEvaluator batch;
  FloatRows at(count), gradient(count);
  at.x.assign(points.x.begin(), points.x.end());
  at.y.assign(points.y.begin(), points.y.end());
  at.z.assign(points.z.begin(), points.z.end());
  batch.evaluateGradient(*field.distance, at.rows(), count, at.f.data(), gradient.x.data(), gradient.y.data(),
                         gradient.z.data());
  std::vector<glm::dvec3> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = {gradient.x[i], gradient.y[i], gradient.z[i]};
  return all;
}

}  // namespace

double bestNormalStep(NormalMethod method, double scale) {
  return scale * (method == NormalMethod::Central ? 0x1p-7 : 0x1p-11);
}

Result<Vectors> normals(const MarchField& field, const Vectors& points, const Vectors& otherwise,
                        const NormalOptions& options) {
  if (!(options.step > 0.0 && std::isfinite(options.step)))
    return Error{ErrorKind::Usage, "normals: step must be positive and finite"};
  if (points.size() != otherwise.size())
    return Error{ErrorKind::Usage, "normals: the rows of points and of otherwise differ in length"};
  const std::vector<glm::dvec3> gradient = options.method == NormalMethod::Gradient
                                               ? gradients(field, points)
                                               : differences(field, points, options);
  Vectors result;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const double length = glm::length(gradient[i]);
    result.add(length > 0.0 && std::isfinite(length) ? gradient[i] / length : otherwise[i]);
  }
  return result;
}

}  // namespace sdf
