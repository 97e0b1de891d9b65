// Shadows and ambient occlusion against rays by formulas of their own.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "measurements.h"
#include "sdf/march/ambient_occlusion.h"
#include "sdf/march/shadow.h"
#include "sdf/scene/scene.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "sdfchart/truth/light_truth.h"

namespace sdf::chart {
namespace {

constexpr double kStart = 0.02;  // where shadow rays begin
constexpr double kReach = 10.0;
constexpr double kCutoff = 1.0;  // how far occlusion looks

struct Ground {
  std::string name;
  Blocker blocker;
  int side;
  MarchField field;  // of the blocker; with the ground for occlusion
  Vectors points, up;
  std::vector<double> truth{};

  Ground(std::string what, const Blocker& b, int n, bool ground)
      : name(std::move(what)), blocker(b), side(n) {
    const Shape shape = blocker.shape();
    field = take(marchField(ground ? unite(shape, plane({0, 1, 0}, 0.0)) : shape));
    points = groundPoints(blocker, side);
    for (std::size_t i = 0; i < points.size(); ++i) up.add({0, 1, 0});
  }
};

using Light = std::function<std::vector<double>(const Ground&)>;

void judge(const std::vector<double>& light, const Ground& ground, Row& row) {
  ErrorSum errors;
  for (std::size_t i = 0; i < ground.truth.size(); ++i) errors.add(std::abs(light[i] - ground.truth[i]));
  errors.giveTo(row);
  row.picture = groundPicture(ground.points, light, ground.side);
  row.truePicture = groundPicture(ground.points, ground.truth, ground.side);
  row.pictureSide = ground.side;
}

Measurement measurement(const std::shared_ptr<const Ground>& ground, Row row, Light light) {
  row.scene = ground->name;
  row.items = static_cast<double>(ground->points.size());
  return {row, [ground, light = std::move(light)](Row* judged) {
            if (judged) judge(light(*ground), *ground, *judged);
            return secondsOfShort([&] { light(*ground); });
          }};
}

glm::dvec3 lamp() { return glm::normalize(glm::dvec3(0.5, 1.0, 0.3)); }

Light lampShadow(ShadowMethod method, double radius) {
  return [method, radius](const Ground& ground) {
    const Rays rays = raysTowards(ground.points, lamp(), kStart, kReach);
    return take(shadows(ground.field, rays, {.method = method, .sharpness = 1.0 / std::tan(radius)})).light;
  };
}

// Hard shadows of so many points of the lamp.
Light lampPoints(int count, double radius) {
  return [directions = lampDirections(lamp(), radius, count)](const Ground& ground) {
    std::vector<double> light(ground.points.size());
    for (const glm::dvec3& d : directions) {
      const Shade shade = take(shadows(ground.field, raysTowards(ground.points, d, kStart, kReach), {}));
      for (std::size_t i = 0; i < light.size(); ++i)
        light[i] += shade.light[i] / static_cast<double>(directions.size());
    }
    return light;
  };
}

std::vector<Measurement> ofLamp(const std::string& what, const Blocker& blocker, double degrees, int side) {
  constexpr int kTrueRays = 1024;
  const double radius = glm::radians(degrees);
  const auto ground =
      std::make_shared<Ground>(what + formatted(", lamp of %g°", degrees), blocker, side, false);
  ground->truth = lightOf(blocker, ground->points, lampDirections(lamp(), radius, kTrueRays), kReach);
  Row row{.kind = "shadows"};
  row.truth = 1.0 / std::sqrt(kTrueRays);
  std::vector<Measurement> all;
  const auto add = [&](const char* method, const std::string& setting, double size, Light light) {
    row.method = method, row.setting = setting, row.size = size;
    row.isDefault = std::string(method) == "soft";
    all.push_back(measurement(ground, row, std::move(light)));
  };
  add("hard", "one ray", 1, lampShadow(ShadowMethod::Hard, radius));
  add("soft", "one ray", 1, lampShadow(ShadowMethod::Soft, radius));
  add("improved", "one ray", 1, lampShadow(ShadowMethod::Improved, radius));
  add("signed", "one ray", 1, lampShadow(ShadowMethod::Signed, radius));
  for (const int count : {4, 16, 64})
    add("points of the lamp", std::to_string(count) + " rays", count, lampPoints(count, radius));
  return all;
}

Light byTaps(TapWeights weights, int count, double strength) {
  return [=](const Ground& ground) {
    const TapOptions taps{
        .count = count, .spacing = kCutoff / count, .strength = strength, .weights = weights};
    return take(occlusionByTaps(ground.field, ground.points, ground.up, taps));
  };
}

Light byRays(int count) {
  return [=](const Ground& ground) {
    OcclusionRayOptions options;
    options.count = count;
    options.cutoff = kCutoff;
    return take(occlusionByRays(ground.field, ground.points, ground.up, options)).light;
  };
}

std::vector<Measurement> ofSky(const std::string& what, const Blocker& blocker, int side) {
  constexpr int kTrueRays = 4096;
  const auto ground = std::make_shared<Ground>(what, blocker, side, true);
  ground->truth = lightOf(blocker, ground->points, skyDirections(kTrueRays), kCutoff);
  Row row{.kind = "occlusion"};
  row.truth = 1.0 / std::sqrt(kTrueRays);
  std::vector<Measurement> all;
  const auto add = [&](const char* method, const std::string& setting, double size, Light light) {
    row.method = method, row.setting = setting, row.size = size;
    all.push_back(measurement(ground, row, std::move(light)));
  };
  for (const int count : {2, 5, 10}) {
    const std::string setting = std::to_string(count) + " taps";
    add("taps, halving", setting, count, byTaps(TapWeights::Halving, count, 1.0));
    add("taps, relative", setting, count, byTaps(TapWeights::Relative, count, 1.0 / count));
    all.back().row.isDefault = count == AmbientOcclusion{}.count;  // of the same strength, too
  }
  for (const int count : {16, 64, 256}) add("rays", std::to_string(count) + " rays", count, byRays(count));
  return all;
}

const std::vector<std::pair<std::string, Blocker>>& blockers() {
  static const std::vector<std::pair<std::string, Blocker>> all{
      {"ball", {true, {0.0, 0.8, 0.0}, glm::dvec3(0.5)}},
      {"block", {false, {0.0, 0.5, 0.0}, glm::dvec3(0.5)}},
      {"plate of 0.02", {false, {0.0, 0.8, 0.0}, {0.5, 0.01, 0.5}}}};
  return all;
}

Batch batch(const std::string& subject, Extent extent, std::function<std::vector<Measurement>()> make) {
  return {.subject = subject,
          .weight = byExtent(extent, 6.0, 1.5, 0.5),
          .runs = byExtent(extent, 7, 3, 1),
          .budget = byExtent(extent, 5.0, 0.5, 0.0),
          .make = std::move(make)};
}

}  // namespace

std::vector<Batch> shadowBatches(Extent extent) {
  const int side = byExtent(extent, 48, 24, 8);
  std::vector<Batch> batches;
  for (const auto& [name, blocker] : blockers())
    for (const double degrees : byExtent<std::vector<double>>(extent, {0.5, 2.0, 7.0}, {2.0, 7.0}, {7.0}))
      batches.push_back(batch("shadows", extent, [=] { return ofLamp(name, blocker, degrees, side); }));
  return batches;
}

std::vector<Batch> occlusionBatches(Extent extent) {
  const int side = byExtent(extent, 32, 20, 8);
  std::vector<Batch> batches;
  for (const auto& [name, blocker] : blockers())
    batches.push_back(
        batch("occlusion", extent, [=] { return ofSky(name + " over the ground", blocker, side); }));
  return batches;
}

}  // namespace sdf::chart
