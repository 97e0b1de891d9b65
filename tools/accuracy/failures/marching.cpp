// Failures of marching rays: steps too long, too short, too many, or lost in rounding.
#include "marching.h"

#include <glm/trigonometric.hpp>

#include "sdf/eval/batch.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

constexpr double kTwist = 3.0;  // radians a unit of y
const glm::dvec3 kTwistedHalf(0.53, 1.0, 0.53);

double boxDistance(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, 0.0)) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

double twistedBox(const glm::dvec3& p) {
  const double c = std::cos(kTwist * p.y), s = std::sin(kTwist * p.y);
  return boxDistance({c * p.x - s * p.z, p.y, s * p.x + c * p.z}, kTwistedHalf);
}

struct NaiveMarch {
  double relaxation = 1.0;
  bool checked = false;  // go back where the balls of a relaxed step do not overlap
  int maxSteps = 2000;
};

// Sphere tracing that believes |f| to be a distance: t of the hit, infinite where there is none. A step that
// was taken back is repeated without relaxation, and the next one is relaxed again.
template <class F>
double marchNaively(const F& f, const glm::dvec3& from, const glm::dvec3& along, const NaiveMarch& march) {
  double t = 0.0, before = 0.0, step = 0.0;
  for (int i = 0; i < march.maxSteps && t < kReach; ++i) {
    const double distance = f(from + t * along);
    if (march.checked && step > before && std::abs(distance) + before < step) {
      t += before - step;
      step = before;
      continue;
    }
    if (distance < kEpsilon) return t;
    before = distance;
    step = march.relaxation * distance;
    t += step;
  }
  return kInfinity;
}

template <class F>
std::vector<double> marchAllNaively(const F& f, const Rays& rays, const NaiveMarch& march = {}) {
  std::vector<double> t;
  for (std::size_t i = 0; i < rays.size(); ++i)
    t.push_back(marchNaively(f, rays.origin[i], rays.direction[i], march));
  return t;
}

std::vector<double> hitsOf(const Shape& shape, const Rays& rays, MarchMethod method, int maxSteps = 2000) {
  return timesOf(trace(shape, rays, {.method = method, .epsilon = kEpsilon, .maxSteps = maxSteps}));
}

// Percent of the n rays for which bad(i) holds.
template <class Bad>
double percent(std::size_t n, const Bad& bad) {
  double count = 0.0;
  for (std::size_t i = 0; i < n; ++i) count += bad(i);
  return 100.0 * count / static_cast<double>(n);
}

double percentLost(const std::vector<double>& t) {
  return percent(t.size(), [&](std::size_t i) { return t[i] == kInfinity; });
}

// Percent of the camera's rays that end more than ten epsilons of f within the solid: by f itself, and by the
// shape.
template <class F>
Figures percentDeep(const F& f, const Shape& shape, const glm::dvec3& camera, const NaiveMarch& naive = {},
                    MarchMethod ours = MarchMethod::Plain) {
  const Rays rays = cameraRays(camera, 0.5);
  const auto deep = [&](const std::vector<double>& t) {
    return percent(t.size(),
                   [&](std::size_t i) { return t[i] < kInfinity && f(rays.at(i, t[i])) < -10.0 * kEpsilon; });
  };
  return {deep(marchAllNaively(f, rays, naive)), deep(hitsOf(shape, rays, ours))};
}

Figures twistFigures(const NaiveMarch& naive, MarchMethod ours) {
  const Shape shape = twist(box(Vec3E(kTwistedHalf)), kTwist);
  return percentDeep(twistedBox, shape, {1.5, 1.2, 2.6}, naive, ours);
}

// White and Nylander's power 8 (2009), with the distance estimate of Hart, Sandin and Kauffman (1989), whose
// slope is not proven.
Shape mandelbulb() {
  Vec3E c = position(), z = c;
  Expr derivative = 1.0;
  for (int i = 0; i < 8; ++i) {
    const Expr r = max(length(z), 1e-9), theta = 8.0 * acos(clamp(z.y / r, -1.0, 1.0)),
               phi = 8.0 * atan2(z.x, z.z);
    const Expr power = min(pow(r, 8.0), 1e9);
    derivative = min(8.0 * pow(r, 7.0) * derivative + 1.0, 1e18);
    z = Vec3E(sin(theta) * sin(phi), cos(theta), sin(theta) * cos(phi)) * power + c;
  }
  const Expr r = length(z);
  return field(0.5 * log(r) * r / derivative, Box::centred(glm::dvec3(1.3)));
}

const glm::dvec3 kPlateHalf(1.0, 1.0, 0.01);

double plateDistance(const glm::dvec3& p) { return boxDistance(p, kPlateHalf); }

double heightOf(const glm::dvec3& p) { return p.y; }

Rays raysToPlate() { return cameraRays({0.6, 0.4, 2.6}, 0.25); }

// Of the rays that meet the plate's front, those that end without a hit, in percent.
double percentThrough(const Rays& rays, const std::vector<double>& t) {
  return percent(t.size(), [&](std::size_t i) {
    const glm::dvec3 front = rays.at(i, (kPlateHalf.z - rays.origin.z[i]) / rays.direction.z[i]);
    return std::abs(front.x) < 1.0 && std::abs(front.y) < 1.0 && t[i] == kInfinity;
  });
}

// Percent of the rays whose t, in float, stands still before the hit.
double percentStalled(const Rays& rays, const Shape& shape) {
  const Tape tape(shape.distance);
  BatchEvaluator batch;
  return percent(rays.size(), [&](std::size_t i) {
    const glm::vec3 o(rays.origin[i]), d(rays.direction[i]);
    float t = 0.0f, f = 1.0f;
    for (int step = 0; step < 200; ++step) {
      const glm::vec3 p = o + t * d;
      batch.evaluate(tape, {&p.x, &p.y, &p.z}, 1, &f);
      if (f < static_cast<float>(kEpsilon)) return false;
      if (t + f == t) return true;
      t += f;
    }
    return false;
  });
}

}  // namespace

std::vector<FailureCase> marchingFailures() {
  return {
      {"sphere tracing a twisted box",
       "% of rays that end in the solid",
       {"f of the turned position as a distance", 1.0},
       {"twist(): f / L", 0.0},
       "at the edges f is 1.9 times as steep as a distance; f / L never passes the surface",
       [] { return twistFigures({}, MarchMethod::Plain); }},
      {"over-relaxation of a twisted box",
       "% of rays that end in the solid",
       {"steps of 1.6 f, taken back where the balls do not overlap", 1.0},
       {"the same with f / L", 0.0},
       "balls that overlap prove nothing where f is no bound",
       [] {
         return twistFigures({1.6, true}, MarchMethod::OverRelaxed);
       }},
      {"sphere tracing a displaced sphere",
       "% of rays that end in the solid",
       {"f + a sin(wx) sin(wy) sin(wz) as a distance", 1.0},
       {"displace(): divided by 1 + a w", 0.0},
       "a w = 2, so f falls up to 3 times as fast as a ray moves; divided, at most as fast",
       [] {
         const auto naive = [](const glm::dvec3& p) {
           return glm::length(p) - 1.0 +
                  0.1 * std::sin(20.0 * p.x) * std::sin(20.0 * p.y) * std::sin(20.0 * p.z);
         };
         return percentDeep(naive, displace(sphere(1.0), 0.1, 20.0), {0.5, 0.8, 2.6});
       }},
      {"sphere tracing a gyroid",
       "% of rays that end in the solid",
       {"wall of g / w, w being the frequency", 1.0},
       {"gyroid(): divided by sqrt(3) w", 0.0},
       "the gradient of g is up to sqrt(3) w long",
       [] {
         constexpr double kWave = 2.0 * kPi, kThickness = 0.1;
         const auto naive = [](const glm::dvec3& p) {
           const glm::dvec3 s = glm::sin(kWave * p), c = glm::cos(kWave * p);
           const double wall = std::abs(s.x * c.y + s.y * c.z + s.z * c.x) / kWave - 0.5 * kThickness;
           return std::max(wall, glm::length(p) - 1.0);
         };
         const Shape ours = gyroid(1.0, kThickness / std::sqrt(3.0)) & sphere(1.0);
         return percentDeep(naive, ours, {0.5, 0.8, 2.6});
       }},
      {"distance estimate of a Mandelbulb",
       "marched as if it were a bound: steepest quotient, less 1",
       {"believed", 1.0},
       {"refused: no slope is known", 0.0},
       "the estimate is right in the limit of many iterations, not for eight; 0 stands for refused",
       [] {
         const Shape shape = mandelbulb();
         const Distance f(shape);
         const bool refused = !Marcher::make(shape, {});
         const double naive = steepest(f, 1.25, 17) - 1.0;
         return Figures{naive, refused ? 0.0 : naive};
       }},
      {"thin plate by over-relaxation",
       "% of rays that pass through it",
       {"steps of 1.6 f", 1.0},
       {"taken back where the balls do not overlap", 0.0},
       "the last step before a plate goes up to 0.6 f beyond its front, past the back where f > 0.02 / 0.6",
       [] {
         const Rays rays = raysToPlate();
         const auto ours = hitsOf(box(Vec3E(kPlateHalf)), rays, MarchMethod::OverRelaxed);
         return Figures{percentThrough(rays, marchAllNaively(plateDistance, rays, {1.6, false})),
                        percentThrough(rays, ours)};
       }},
      {"over-relaxation straight at a wall",
       "depth of the hit, scene units",
       {"balls of radius |f| overlap", 0.6},
       {"f with its sign: what is in the wall proves nothing", kEpsilon},
       "1.6 f is as far as |f| of both ends together, so the check passes 0.6 deep",
       [] {
         const glm::dvec3 from(0, 1, 0), down(0, -1, 0);
         Rays rays;
         rays.add(from, down, 0.0, kReach);
         const double naive = marchNaively(heightOf, from, down, {1.6, true});
         const double ours = hitsOf(plane({0, 1, 0}, 0.0), rays, MarchMethod::OverRelaxed)[0];
         return Figures{naive - 1.0, ours - 1.0};
       }},
      // Rays that fall by 3 to 23 degrees.
      {"ground near the horizon in 100 steps",
       "% of the ground's rays that show the sky",
       {"a ray that runs out of steps has missed", 10.0},
       {"segments along the ray, and Budget where steps run out", 0.0},
       "at an angle a each step leaves 1 - sin a of the height: below 5.1 degrees, 10.5 % of the rays, more "
       "than 1e-4 after 99",
       [] {
         Rays rays;
         for (int i = 0; i < 1000; ++i) {
           const double angle = (3.0 + 0.02 * i) * kPi / 180.0;
           rays.add({0, 1, 0}, {std::cos(angle), -std::sin(angle), 0}, 0.0, kReach);
         }
         const auto naive = marchAllNaively(heightOf, rays, {1.0, false, 100});
         const auto ours = hitsOf(plane({0, 1, 0}, 0.0), rays, MarchMethod::Segment, 100);
         return Figures{percentLost(naive), percentLost(ours)};
       }},
      {"ray along a plane, 1e-3 above it",
       "readings over a length of 10",
       {"steps of f", 9990.0},
       {"steps of f / its slope along the ray", 4.0},
       "10 / 1e-3 but for rounding; a segment's slope along the plane is 0",
       [] {
         Rays rays;
         rays.add({0, 1e-3, 0}, {1, 0, 0}, 0.0, 10.0);
         const auto steps = [&](MarchMethod method) {
           const MarchOptions options{.method = method, .maxSteps = 100'000};
           return static_cast<double>(trace(plane({0, 1, 0}, 0.0), rays, options).steps[0]);
         };
         return Figures{steps(MarchMethod::Plain), steps(MarchMethod::Segment)};
       }},
      {"ball seen from 1e5 away",
       "% of rays that come to a stand before it",
       {"t in float", 1.0},
       {"t in double, positions rounded to float near the ball", 0.0},
       "a float near 1e5 moves by 0.008: t + f = t once f < 0.004",
       [] {
         Rays rays;
         for (int i = 0; i < 500; ++i) {
           const glm::dvec3 from(1e5, 0.0, 0.0), to(0.0, 0.0015 * i, 0.001 * (i % 17));
           rays.add(from, glm::normalize(to - from), 0.0, 2e5);
         }
         const auto ours = hitsOf(sphere(1.0), rays, MarchMethod::Plain);
         return Figures{percentStalled(rays, sphere(1.0)), percentLost(ours)};
       }},
      {"thin plate by steps of one length",
       "% of rays that pass through it",
       {"steps of 0.05, a hit where f < 0", 1.0},
       {"intervals along the ray, halved until they prove it free", 0.0},
       "a plate 0.02 thick lies between two samples for three of five rays",
       [] {
         const Rays rays = raysToPlate();
         std::vector<double> naive;
         for (std::size_t i = 0; i < rays.size(); ++i) {
           double t = 0.0;
           while (t < 5.0 && plateDistance(rays.at(i, t)) >= 0.0) t += 0.05;
           naive.push_back(t < 5.0 ? t : kInfinity);
         }
         const auto ours = hitsOf(box(Vec3E(kPlateHalf)), rays, MarchMethod::Bisection);
         return Figures{percentThrough(rays, naive), percentThrough(rays, ours)};
       }}};
}

}  // namespace sdf::accuracy
