#include "sdf/mesh/surface/surface_paint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "sdf/mesh/surface/surface_points.h"
#include "sdf/model/model.h"

namespace sdf {
namespace {

// Paint is read so far inside, in floats' distances at the place: on a face that a border of the paint lies
// in rounding would decide otherwise.
constexpr float kInside = 8.0f * 0x1p-23f;

float unit(float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f; }
float notNegative(float v) { return std::isfinite(v) ? std::max(v, 0.0f) : 0.0f; }

// The paint of a run's points, which may have moved since the run was made.
void readRun(const PointRun& run, const PointRows& points, const PointRows& normals, Paint* paint) {
  PointRows inside;
  for (std::size_t i = 0; i < run.count; ++i) {
    const glm::vec3 p = points.at(i);
    inside.set(i, p - kInside * largestCoordinate(p) * normals.at(i));
  }
  constexpr int kOutputs = static_cast<int>(SurfaceOutput::Count);
  float values[kOutputs][kBatchPoints];
  float* out[kOutputs];
  for (int k = 0; k < kOutputs; ++k) out[k] = values[k];
  run.batch.evaluate(*run.tapes.surface, inside.rows(normals), run.count, out);
  for (std::size_t i = 0; i < run.count; ++i) {
    const auto at = [&](SurfaceOutput output) { return values[static_cast<int>(output)][i]; };
    paint[i] = {{unit(at(SurfaceOutput::Red)), unit(at(SurfaceOutput::Green)), unit(at(SurfaceOutput::Blue))},
                {notNegative(at(SurfaceOutput::AmbientRed)), notNegative(at(SurfaceOutput::AmbientGreen)),
                 notNegative(at(SurfaceOutput::AmbientBlue))},
                static_cast<int>(std::lround(at(SurfaceOutput::MaterialId)))};
  }
}

float difference(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = glm::abs(glm::sqrt(a + kDark) - glm::sqrt(b + kDark));
  return std::max({d.x, d.y, d.z});
}

}  // namespace

float colorDifference(const Paint& a, const Paint& b) {
  return std::max(difference(a.color, b.color), difference(a.ambient, b.ambient));
}

std::vector<Paint> readPaint(std::size_t count, const std::function<glm::vec3(std::size_t)>& point,
                             const std::function<glm::vec3(std::size_t)>& normal, const LocalField& field,
                             Progress& progress) {
  std::vector<Paint> paint(count);
  forEachRun(count, point, field, progress, [&](const PointRun& run) {
    PointRows normals;
    for (std::size_t i = 0; i < run.count; ++i) normals.set(i, normal(run.first + i));
    readRun(run, run.points, normals, &paint[run.first]);
  });
  return paint;
}

std::vector<Paint> readPaintBeside(const std::vector<glm::vec3>& points, const LocalField& field,
                                   Progress& progress) {
  std::vector<Paint> paint(points.size());
  forEachGroupedRun(points, field, progress, [&](const PointRun& run, const std::size_t* which) {
    RunGradients g;
    PointRows there, normals;
    Paint read[kBatchPoints];
    g.evaluate(run, run.points);
    for (std::size_t i = 0; i < run.count; ++i) {
      there.set(i, run.points.at(i) + g.step(i));
      normals.set(i, g.normal(i));
    }
    readRun(run, there, normals, read);
    for (std::size_t i = 0; i < run.count; ++i) paint[which[i]] = read[i];
  });
  return paint;
}

}  // namespace sdf
