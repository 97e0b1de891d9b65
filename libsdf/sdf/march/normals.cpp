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

/// Points that one pass takes.
struct Block {
  const MarchField& field;
  const Vectors& points;
  std::size_t first, count;

  glm::dvec3 at(std::size_t i) const { return points[first + i]; }
};

double largest(const glm::dvec3& v) {
  const glm::dvec3 a = glm::abs(v);
  return std::max({a.x, a.y, a.z});
}

// Unnormalised gradients by differences, those that rounding could explain set to 0.
void differences(const Block& block, const NormalOptions& options, BatchEvaluator& batch, glm::dvec3* sum) {
  PointRows at;
  float f[kBatchPoints];
  double size[kBatchPoints] = {};
  std::fill_n(sum, block.count, glm::dvec3(0.0));
  for (const Arm& arm : armsOf(options.method)) {
    for (std::size_t i = 0; i < block.count; ++i) {
      const glm::dvec3 p = block.at(i) + options.step * arm.to;
      at.set(i, p);
      size[i] = std::max(size[i], largest(p));
    }
    batch.evaluate(*block.field.distance, at.rows(), block.count, f);
    for (std::size_t i = 0; i < block.count; ++i) {
      sum[i] += static_cast<double>(f[i]) * arm.weight;
      size[i] = std::max(size[i], std::abs(static_cast<double>(f[i])));
    }
  }
  for (std::size_t i = 0; i < block.count; ++i)
    if (largest(sum[i]) <= kRounding * size[i]) sum[i] = glm::dvec3(0.0);
}

void gradients(const Block& block, BatchEvaluator& batch, glm::dvec3* all) {
  PointRows at, gradient;
  float f[kBatchPoints];
  for (std::size_t i = 0; i < block.count; ++i) at.set(i, block.at(i));
  batch.evaluateGradient(*block.field.distance, at.rows(), block.count, f, gradient.x, gradient.y,
                         gradient.z);
  for (std::size_t i = 0; i < block.count; ++i) all[i] = gradient.at(i);
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
  BatchEvaluator batch;
  glm::dvec3 gradient[kBatchPoints];
  Vectors result;
  for (std::size_t first = 0; first < points.size(); first += kBatchPoints) {
    const Block block{field, points, first, std::min(kBatchPoints, points.size() - first)};
    if (options.method == NormalMethod::Gradient)
      gradients(block, batch, gradient);
    else
      differences(block, options, batch, gradient);
    for (std::size_t i = 0; i < block.count; ++i) {
      const double length = glm::length(gradient[i]);
      result.add(length > 0.0 && std::isfinite(length) ? gradient[i] / length : otherwise[first + i]);
    }
  }
  return result;
}

}  // namespace sdf
