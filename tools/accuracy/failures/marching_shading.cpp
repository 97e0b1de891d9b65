// Failures of what is shown at a hit: normals, soft shadows, detail finer than a pixel.
#include <random>

#include "marching.h"
#include "sdf/eval/batch.h"
#include "sdf/march/normals.h"
#include "sdf/march/shadow.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

// Points of the unit sphere around a centre, with their normals.
struct SpherePoints {
  explicit SpherePoints(const glm::dvec3& centre) {
    constexpr int kPoints = 1000;
    constexpr double kGoldenAngle = 2.399963229728653;
    for (int i = 0; i < kPoints; ++i) {
      const double y = 1.0 - (2.0 * i + 1.0) / kPoints, r = std::sqrt(1.0 - y * y);
      normals.add({r * std::cos(kGoldenAngle * i), y, r * std::sin(kGoldenAngle * i)});
      points.add(centre + normals[i]);
    }
  }
  Vectors points, normals;
};

double worstDegrees(const Vectors& found, const Vectors& right) {
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double half = std::min(1.0, 0.5 * glm::length(found[i] - right[i]));
    worst = std::max(worst, 2.0 * std::asin(half) * 180.0 / kPi);
  }
  return worst;
}

// Central differences in float, taken as they come.
Vectors naiveNormals(const Shape& shape, const Vectors& points, float h) {
  const Tape tape(shape.distance);
  BatchEvaluator batch;
  Vectors found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 p(points[i]);
    glm::dvec3 g(0.0);
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {1.0f, -1.0f}) {
        glm::vec3 q = p;
        q[axis] += side * h;
        float f = 0.0f;
        batch.evaluate(tape, {&q.x, &q.y, &q.z}, 1, &f);
        g[axis] += side * f;
      }
    found.add(glm::normalize(g));
  }
  return found;
}

Figures normalFigures(const glm::dvec3& centre, float h) {
  const Shape ball = translate(sphere(1.0), Vec3E(centre));
  const SpherePoints at(centre);
  const Vectors ours = take(normals(take(marchField(ball)), at.points, at.points, {}));
  return {worstDegrees(naiveNormals(ball, at.points, h), at.normals), worstDegrees(ours, at.normals)};
}

std::vector<double> lightOf(const Shape& solid, const Rays& rays, const ShadowOptions& options) {
  return take(shadows(take(marchField(solid)), rays, options)).light;
}

// Shadow rays past a box towards a light overhead.
const glm::dvec3 kBoxHalf(0.8, 0.5, 0.3);
Rays raysPastBox(int count) {
  std::mt19937 random(1);
  Rays rays;
  const auto near = [&] { return 2.4 * (static_cast<double>(random()) * 0x1p-32 - 0.5); };
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from(near(), -3.0, near());
    rays.add(from, glm::normalize(glm::dvec3(near(), 3.0, near()) - from), 0.5, 6.0);
  }
  return rays;
}

constexpr double kSharpness = 8.0;

// Aaltonen's shadow with the steps held to [0.01, 0.1], as shaders do: then the step is not the last
// distance.
template <class F>
double clampedShadow(const F& f, const Rays& rays, std::size_t i) {
  double light = 1.0, before = 1e20;
  for (double t = rays.tMin[i]; t < rays.tMax[i];) {
    const double g = f(rays.at(i, t));
    if (g < kEpsilon) return 0.0;
    const double y = g * g / (2.0 * before), d = std::sqrt(g * g - y * y);
    light = std::min(light, kSharpness * d / std::max(0.0, t - y));
    if (std::isnan(d)) return d;
    before = g;
    t += std::clamp(g, 0.01, 0.1);
  }
  return light;
}

// Quilez's shadow of 2010, which knows nothing but its readings.
template <class F>
double shadowOfReadings(const F& f, const Rays& rays, std::size_t i) {
  double light = 1.0;
  for (double t = rays.tMin[i]; t < rays.tMax[i];) {
    const double g = f(rays.at(i, t));
    if (g < kEpsilon) return 0.0;
    light = std::min(light, kSharpness * g / t);
    t += g;
  }
  return light;
}

// Menger's sponge in the cube from -1 to 1: the cube less crosses, each a third as large as the one before.
// Each fold moves as fast as the position.
Shape menger(int levels) {
  const Vec3E p = position();
  Expr distance = box(Vec3E(1.0)).distance;
  double scale = 1.0;
  for (int i = 0; i < levels; ++i) {
    const auto fold = [&](const Expr& x) { return abs(1.0 - 3.0 * abs(mod(x * scale, Expr(2.0)) - 1.0)); };
    const Expr x = fold(p.x), y = fold(p.y), z = fold(p.z);
    scale *= 3.0;
    distance = max(distance, (min(min(max(x, y), max(y, z)), max(z, x)) - 1.0) / scale);
  }
  return field(distance, Box::centred(glm::dvec3(1.0)), 1.0);
}

// Mean of 1 - |mean normal| over the pixels of 2 x 2 rays whose four rays hit: 0 where each shows one plane.
double normalVariance(const Vectors& n, const std::vector<double>& t) {
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < 200; y += 2)
    for (int x = 0; x < 320; x += 2) {
      const int block[] = {y * 320 + x, y * 320 + x + 1, (y + 1) * 320 + x, (y + 1) * 320 + x + 1};
      if (!std::all_of(std::begin(block), std::end(block), [&](int i) { return t[i] < kInfinity; })) continue;
      glm::dvec3 mean(0.0);
      for (const int i : block) mean += 0.25 * n[i];
      sum += 1.0 - glm::length(mean);
      count += 1.0;
    }
  return sum / count;
}

}  // namespace

std::vector<FailureCase> shadingFailures() {
  return {{"normals of a ball 1e5 from the origin",
           "worst angle, degrees",
           {"central differences in float, h = 2^-10", 45.0},
           {"exact derivatives in float", 1.1e5 * 0x1p-24 * 180.0 / kPi},
           "h along x is an eighth of a rounding there; derivatives feel only that x is rounded",
           [] {
             return normalFigures({1e5, 0, 0}, 0x1p-10f);
           }},
          {"normals by too small a step",
           "worst angle, degrees",
           {"central differences in float, h = 1e-6", 3.0},
           {"exact derivatives in float", 8.0 * 0x1p-24 * 180.0 / kPi},
           "two values near 1 differ by some roundings of 6e-8, against 2e-6; derivatives by eight roundings",
           [] {
             return normalFigures({0, 0, 0}, 1e-6f);
           }},
          {"improved soft shadow with clamped steps",
           "rays of 20000 that are NaN",
           {"sqrt(g^2 - y^2) with the last g for the step", 10.0},
           {"the true step, and max(0, ...)", 0.0},
           "y > g where g is over twice the g before, which a step of g before cannot reach, but 0.01 can",
           [] {
             const Shape solid = box(Vec3E(kBoxHalf));
             const Distance f(solid);
             const Rays rays = raysPastBox(20000);
             const auto ours = lightOf(solid, rays, {ShadowMethod::Improved, kSharpness});
             Figures count;
             for (std::size_t i = 0; i < rays.size(); ++i) {
               count.naive += std::isnan(clampedShadow(f, rays, i));
               count.ours += std::isnan(ours[i]);
             }
             return count;
           }},
          {"bands in a soft shadow",
           "how much too light",
           {"least k g / t of the readings (Quilez 2010)", 0.05},
           {"closest approach between readings (Aaltonen 2018)", 0.02},
           "a ray past an edge of the box is nearest to it between two readings; the dense march that both "
           "are held to reads every 2e-3, worth k 1e-3 / t = 0.016 at most",
           [] {
             const Shape solid = box(Vec3E(kBoxHalf));
             const Distance f(solid);
             const Rays rays = raysPastBox(400);
             const auto improved = lightOf(solid, rays, {ShadowMethod::Improved, kSharpness});
             return worstOf(0, 399, 1, [&](double k) {
               const auto i = static_cast<std::size_t>(k);
               double least = 1.0;
               for (double t = rays.tMin[i]; t < rays.tMax[i]; t += 2e-3)
                 least = std::clamp(kSharpness * f(rays.at(i, t)) / t, 0.0, least);
               return Figures{shadowOfReadings(f, rays, i) - least, improved[i] - least};
             });
           }},
          // Points under the edge of a bar, across the penumbra of a lamp of 5 degrees, and the share of it
          // that each sees past a straight edge.
          {"penumbra of a lamp",
           "mean error of the light",
           {"least k g / t, down to 0", 0.2},
           {"least k g / t, down to -1 in the solid", 0.045 + 0.044},
           "shadows by k g / t put all of the penumbra outside: 1/4; the smooth curve is at most 0.045 off a "
           "disc's, and the bar bulges by 0.044 of the penumbra",
           [] {
             constexpr double kHeight = 2.0;
             const double slope = std::tan(5.0 * kPi / 180.0);
             const Shape bar = capsule(Vec3E(-2.0, kHeight, -20.0), Vec3E(-2.0, kHeight, 20.0), 2.0);
             Vectors points;
             for (int i = -100; i <= 100; ++i) points.add({0.01 * i * kHeight * slope, 0.0, 0.0});
             const Rays rays = raysTowards(points, {0, 1, 0}, 0.05, 10.0);
             const auto meanError = [&](ShadowMethod method) {
               const auto light = lightOf(bar, rays, {method, 1.0 / slope});
               double sum = 0.0;
               for (int i = -100; i <= 100; ++i) {
                 const double x = 0.01 * i, disc = 1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / kPi;
                 sum += std::abs(light[i + 100] - disc) / 201.0;
               }
               return sum;
             };
             return Figures{meanError(ShadowMethod::Soft), meanError(ShadowMethod::Signed)};
           }},
          {"Menger sponge of eight levels, far away",
           "mean variance of the normals in a pixel",
           {"hits within 1e-4, exact normals", 0.2},
           {"hits within a pixel's cone, normals over its width", 0.05},
           "of normals along the axes, a pixel that shows two has 0.2 to 0.3 and one that shows three 0.4; "
           "differences over the pixel leave a fifth at most",
           [] {
             const Shape sponge = menger(8);
             const Rays rays = cameraRays({2.0, 3.0, 6.0}, 0.25);
             const MarchField field = take(marchField(sponge));
             const auto variance = [&](double footprint, const NormalOptions& options) {
               const Hits hits = trace(sponge, rays, {.footprint = footprint, .maxSteps = 4000});
               Vectors at, back;
               for (std::size_t i = 0; i < rays.size(); ++i) {
                 at.add(rays.at(i, hits.t[i]));
                 back.add(-rays.direction[i]);
               }
               return normalVariance(take(normals(field, at, back, options)), timesOf(hits));
             };
             const double pixel = 0.25 / 50.0;  // width at distance 1; the sponge is 7 away
             return Figures{variance(0.0, {}), variance(0.5 * pixel, {NormalMethod::Central, 7.0 * pixel})};
           }}};
}

}  // namespace sdf::accuracy
