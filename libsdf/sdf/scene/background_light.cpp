#include "sdf/scene/background_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "sdf/eval/scalar_reading.h"

namespace sdf {
namespace {

constexpr int kTerms = 9, kDirections = 16'384;

std::array<double, kTerms> termsOf(const glm::dvec3& d) {
  return {1.0, d.x, d.y, d.z, d.x * d.y, d.y * d.z, d.z * d.x, 3.0 * d.z * d.z - 1.0, d.x * d.x - d.y * d.y};
}

// The inverse of each term's mean square over the sphere, times what the cosine leaves of its order: 1, 2/3
// and 1/4 (Ramamoorthi, Hanrahan 2001, equation 8, divided by pi).
constexpr double kWeights[kTerms] = {
    1.0,        3.0 * 2.0 / 3.0, 3.0 * 2.0 / 3.0, 3.0 * 2.0 / 3.0, 15.0 / 4.0,
    15.0 / 4.0, 15.0 / 4.0,      5.0 / 4.0 / 4.0, 15.0 / 4.0 / 4.0};

// The i-th of directions that lie evenly all over: Fibonacci's lattice (Gonzalez, "Measurement of areas on a
// sphere using Fibonacci and latitude-longitude lattices", 2010), whose rows halve at the horizon.
glm::dvec3 direction(int i) {
  const double height = 1.0 - (2.0 * i + 1.0) / kDirections, level = std::sqrt(1.0 - height * height);
  const double turn = 2.0 * std::numbers::pi * std::fmod(i / std::numbers::phi, 1.0);
  return {level * std::cos(turn), height, level * std::sin(turn)};
}

double sound(double radiance) { return radiance > 0.0 && std::isfinite(radiance) ? radiance : 0.0; }

}  // namespace

glm::dvec3 BackgroundLight::at(const glm::dvec3& normal) const {
  const auto terms = termsOf(normal);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kTerms; ++i) sum += terms[i] * parts[i];
  return glm::max(sum, 0.0);
}

Function backgroundRadiance(const Scene& scene) {
  const Vec3E radiance = scene.background * scene.backgroundLight;
  return Function({radiance.x, radiance.y, radiance.z});
}

BackgroundLight backgroundLight(const Tape& radiance) {
  ScalarReading<double> reading;
  BackgroundLight light;
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec3 d = direction(i);
    reading.run(radiance, {d.x, d.y, d.z, 0.0, 0.0, 0.0});
    const glm::dvec3 seen(sound(reading.output(0)), sound(reading.output(1)), sound(reading.output(2)));
    const auto terms = termsOf(d);
    for (int k = 0; k < kTerms; ++k) light.parts[k] += terms[k] * seen;
  }
  for (int k = 0; k < kTerms; ++k) light.parts[k] *= kWeights[k] / kDirections;
  return light;
}

BackgroundLight backgroundLight(const Scene& scene) {
  return backgroundLight(*backgroundRadiance(scene).at());
}

}  // namespace sdf
