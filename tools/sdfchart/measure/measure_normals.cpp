// Schemes of normals: their angle to a torus' true normals, over the step and the distance from the origin.
#include "sdf/march/normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "measurements.h"
#include "reference/reference.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::chart {
namespace {

constexpr double kMajor = 1.0, kMinor = 0.4;

// Points of the torus and its normals there, by their definition.
struct Torus {
  MarchField field;
  Vectors points, normals, zero;

  Torus(double away, std::size_t count)
      : field(take(marchField(translate(torus(kMajor, kMinor), Vec3E(away, 0.0, 0.0))))) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(0.0, 2.0 * accuracy::kPi);
    for (std::size_t i = 0; i < count; ++i) {
      const double a = angle(random), b = angle(random);
      const glm::dvec3 out(std::cos(a), 0.0, std::sin(a));
      const glm::dvec3 n = std::cos(b) * out + std::sin(b) * glm::dvec3(0, 1, 0);
      points.add(glm::dvec3(away, 0, 0) + kMajor * out + kMinor * n);
      normals.add(n);
      zero.add(glm::dvec3(0, 1, 0));
    }
  }
};

void judge(const Torus& torus, const Vectors& found, Row& row) {
  ErrorSum errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const glm::dvec3 a = found[i], b = torus.normals[i];
    errors.add(glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))));
  }
  errors.giveTo(row);
}

Measurement measurement(const std::shared_ptr<const Torus>& torus, Row row, const NormalOptions& options) {
  row.kind = "normals";
  row.items = static_cast<double>(torus->points.size());
  constexpr double kReadings[] = {4, 6, 4, 4};  // what normals.h says of each scheme
  row.evaluations = kReadings[static_cast<int>(options.method)];
  return {row, [torus, options](Row* judged) {
            const auto made = [&] {
              return take(normals(torus->field, torus->points, torus->zero, options));
            };
            if (judged) judge(*torus, made(), *judged);
            return secondsOfShort([&] { made(); });
          }};
}

constexpr std::pair<const char*, NormalMethod> kSchemes[] = {{"forward", NormalMethod::Forward},
                                                             {"central", NormalMethod::Central},
                                                             {"tetrahedron", NormalMethod::Tetrahedron}};
constexpr const char* kExact = "exact derivatives";

std::size_t pointsFor(Extent extent) { return byExtent<std::size_t>(extent, 4096, 2048, 512); }

std::vector<Measurement> awayFromOrigin(double away, Extent extent) {
  const auto torus = std::make_shared<const Torus>(away, pointsFor(extent));
  const int factor = byExtent(extent, 1, 2, 6);  // powers of two between steps
  Row row{.scene = formatted("torus %g from the origin", away), .method = kExact, .setting = "no step"};
  row.isDefault = 1.0;
  std::vector<Measurement> all{measurement(torus, row, {})};
  row.isDefault = 0.0;
  for (const auto& [name, method] : kSchemes)
    for (int power = -2; power >= -20; power -= factor) {
      row.method = name;
      row.setting = "step 2^" + std::to_string(power);
      row.size = std::exp2(power);
      all.push_back(measurement(torus, row, {.method = method, .step = row.size}));
    }
  return all;
}

// At one step, the usual one, over the distance.
std::vector<Measurement> overDistance(Extent extent) {
  constexpr int kPower = -10;
  std::vector<Measurement> all;
  for (const double away : byExtent<std::vector<double>>(extent, {1.0, 10.0, 100.0, 1e3, 1e4, 1e5},
                                                         {1.0, 10.0, 100.0, 1e3, 1e4}, {1.0})) {
    const auto torus = std::make_shared<const Torus>(away, pointsFor(extent));
    Row row{.scene = "over the distance from the origin (torus, step 2^" + std::to_string(kPower) + ")",
            .method = kExact,
            .setting = formatted("%g away", away),
            .size = away};
    row.isDefault = 1.0;
    all.push_back(measurement(torus, row, {}));
    row.isDefault = 0.0;
    for (const auto& [name, method] : kSchemes) {
      row.method = name;
      all.push_back(measurement(torus, row, {.method = method, .step = std::exp2(kPower)}));
    }
  }
  return all;
}

}  // namespace

std::vector<Batch> normalBatches(Extent extent) {
  const auto places = byExtent<std::vector<double>>(extent, {0.0, 10.0, 100.0, 1000.0}, {0.0, 100.0}, {0.0});
  std::vector<Batch> batches;
  const auto add = [&](std::function<std::vector<Measurement>()> make) {
    batches.push_back({.subject = "normals",
                       .weight = byExtent(extent, 6.0, 1.0, 0.5),
                       .runs = byExtent(extent, 9, 3, 1),
                       .budget = 5.0,
                       .make = std::move(make)});
  };
  for (const double away : places) add([away, extent] { return awayFromOrigin(away, extent); });
  add([extent] { return overDistance(extent); });
  return batches;
}

}  // namespace sdf::chart
