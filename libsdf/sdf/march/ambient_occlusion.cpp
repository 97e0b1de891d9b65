#include "sdf/march/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>

#include "sdf/march/sampler.h"

namespace sdf {
namespace {

Error wrongOcclusion(const std::string& what) { return {ErrorKind::Usage, "ambient occlusion: " + what}; }

Status checkRows(const Vectors& points, const Vectors& normals) {
  if (points.size() != normals.size())
    return wrongOcclusion("the rows of points and of normals differ in length");
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (!isUnit(normals[i])) return wrongOcclusion("normal " + std::to_string(i) + " must have length 1");
  return okStatus();
}

Status check(const OcclusionRayOptions& o) {
  if (o.count < 1) return wrongOcclusion("count must be at least 1");
  if (!isNotNegative(o.start)) return wrongOcclusion("start must be finite and at least 0");
  if (!(isPositive(o.cutoff) && o.cutoff > o.start))
    return wrongOcclusion("cutoff must be finite and above start");
  return okStatus();
}

// Uniform in [0, 1), the same from every standard library.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Cosine-weighted about the unit vector n: a point of the disc across n, lifted to the sphere (Malley). The
// frame is that of Duff et al., "Building an orthonormal basis, revisited", 2017.
glm::dvec3 cosineDirection(const glm::dvec3& n, std::mt19937_64& random) {
  const double radius = std::sqrt(uniform(random)), angle = 2.0 * std::numbers::pi * uniform(random);
  const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
  const glm::dvec3 u(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), v(b, sign + n.y * n.y * a, -n.y);
  const double height = std::sqrt(std::max(0.0, 1.0 - radius * radius));
  return glm::normalize(radius * (std::cos(angle) * u + std::sin(angle) * v) + height * n);
}

Rays raysAround(const glm::dvec3& p, const glm::dvec3& n, const OcclusionRayOptions& o, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Rays rays;
  for (int i = 0; i < o.count; ++i)
    rays.add(p + o.start * n, cosineDirection(n, random), 0.0, o.cutoff - o.start);
  return rays;
}

// A ray without an answer speaks for its point.
void addUp(const Hits& hits, double& light, RayStatus& status) {
  const auto free = std::count(hits.status.begin(), hits.status.end(), RayStatus::Miss);
  light = static_cast<double>(free) / static_cast<double>(hits.status.size());
  status = RayStatus::Miss;
  for (const RayStatus s : hits.status)
    if (s == RayStatus::Budget || s == RayStatus::Undefined) status = s;
}

}  // namespace

Result<std::vector<double>> occlusionBySteps(std::span<const int> steps, double strength) {
  if (!isNotNegative(strength)) return wrongOcclusion("strength must be finite and at least 0");
  std::vector<double> seen;
  for (const int n : steps) seen.push_back(std::max(0.0, 1.0 - strength * n));
  return seen;
}

Result<std::vector<double>> occlusionByTaps(const MarchField& field, const Vectors& points,
                                            const Vectors& normals, const TapOptions& options) {
  if (options.count < 1) return wrongOcclusion("count must be at least 1");
  if (!isPositive(options.spacing)) return wrongOcclusion("spacing must be positive and finite");
  if (!isNotNegative(options.strength)) return wrongOcclusion("strength must be finite and at least 0");
  if (const Status s = checkRows(points, normals); !s) return s.error();
  if (const Status s = checkSlope(field, "ambient occlusion"); !s) return s.error();
  Sampler sampler(field);
  std::vector<double> hidden(points.size(), 0.0);
  std::vector<Sample> samples;
  // Above a surface nothing is farther off than the surface, whatever a steeper distance says.
  const bool isSteep = field.lipschitz > 1.0;
  for (int tap = 1; tap <= options.count; ++tap) {
    const double height = tap * options.spacing;
    const double weight = options.weights == TapWeights::Halving ? std::ldexp(1.0, -tap) : 1.0 / height;
    Vectors at;
    for (std::size_t i = 0; i < points.size(); ++i) at.add(points[i] + height * normals[i]);
    sampler.sample(at, samples);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double f = samples[i].distance;
      hidden[i] += weight * (height - (isSteep && f > height ? height : f));
    }
  }
  for (double& h : hidden) h = std::isnan(h) ? 0.0 : std::clamp(1.0 - options.strength * h, 0.0, 1.0);
  return hidden;
}

Result<Shade> occlusionByRays(const MarchField& field, const Vectors& points, const Vectors& normals,
                              const OcclusionRayOptions& options) {
  if (const Status s = check(options); !s) return s.error();
  if (const Status s = checkRows(points, normals); !s) return s.error();
  Result<Marcher> marcher = Marcher::make(field, options.march);
  if (!marcher) return marcher.error();
  Shade shade{std::vector<double>(points.size()), std::vector<RayStatus>(points.size())};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Result<Hits> hits = marcher->trace(raysAround(points[i], normals[i], options, options.seed + i));
    if (!hits) return wrongOcclusion("point " + std::to_string(i) + ": " + hits.error().message);
    addUp(*hits, shade.light[i], shade.status[i]);
  }
  return shade;
}

}  // namespace sdf
