// Failures of marching rays: steps too long, too short, too many, or lost in rounding.
#include "marching.h"

#include <glm/trigonometric.hpp>

#include "sdf/eval/batch.h"
#include "sdf/shape/operators.h"
#include "sdf/shape/solids.h"

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

Figures twistFigures(const NaiveMarch& naive, MarchMethod ours) {
  const Rays rays = cameraRays({1.5, 1.2, 2.6}, {0, 0, 0}, 0.5);
  const Shape shape = twist(box(Vec3E(kTwistedHalf)), kTwist);
  return {percentDeep(twistedBox, rays, marchAllNaively(twistedBox, rays, naive)),
          percentDeep(twistedBox, rays, hitsOf(shape, rays, ours))};
}

FailureCase twistCase() {
  return {"sphere tracing a twisted box",
          "% of rays that end in the solid",
          "f of the turned position as a distance",
          "twist(): f / L",
          1.0,
          0.0,
          "at the edges f is 1.9 times as steep as a distance; f / L never passes the surface",
          [] { return twistFigures({}, MarchMethod::Plain); }};
}

FailureCase relaxedTwistCase() {
  return {"over-relaxation of a twisted box",
          "% of rays that end in the solid",
          "steps of 1.6 f, taken back where the balls do not overlap",
          "the same with f / L",
          1.0,
          0.0,
          "balls that overlap prove nothing where f is no bound",
          [] {
            return twistFigures({1.6, true}, MarchMethod::OverRelaxed);
          }};
}

FailureCase displacedCase() {
  return {"sphere tracing a displaced sphere",
          "% of rays that end in the solid",
          "f + a sin(wx) sin(wy) sin(wz) as a distance",
          "displace(): divided by 1 + a w",
          1.0,
          0.0,
          "a w = 2, so f falls up to 3 times as fast as a ray moves; divided, at most as fast",
          [] {
            const auto naive = [](const glm::dvec3& p) {
              return glm::length(p) - 1.0 +
                     0.1 * std::sin(20.0 * p.x) * std::sin(20.0 * p.y) * std::sin(20.0 * p.z);
            };
            const Rays rays = cameraRays({0.5, 0.8, 2.6}, {0, 0, 0}, 0.5);
            const Shape ours = displace(sphere(1.0), 0.1, 20.0);
            return Figures{percentDeep(naive, rays, marchAllNaively(naive, rays)),
                           percentDeep(naive, rays, hitsOf(ours, rays, MarchMethod::Plain))};
          }};
}

FailureCase gyroidCase() {
  return {"sphere tracing a gyroid",
          "% of rays that end in the solid",
          "wall of g / w, w being the frequency",
          "gyroid(): divided by sqrt(3) w",
          1.0,
          0.0,
          "the gradient of g is up to sqrt(3) w long",
          [] {
            constexpr double kWave = 2.0 * kPi, kThickness = 0.1;
            const auto naive = [](const glm::dvec3& p) {
              const glm::dvec3 s = glm::sin(kWave * p), c = glm::cos(kWave * p);
              const double wall = std::abs(s.x * c.y + s.y * c.z + s.z * c.x) / kWave - 0.5 * kThickness;
              return std::max(wall, glm::length(p) - 1.0);
            };
            const Rays rays = cameraRays({0.5, 0.8, 2.6}, {0, 0, 0}, 0.5);
            const Shape ours = gyroid(1.0, kThickness / std::sqrt(3.0)) & sphere(1.0);
            return Figures{percentDeep(naive, rays, marchAllNaively(naive, rays)),
                           percentDeep(naive, rays, hitsOf(ours, rays, MarchMethod::Plain))};
          }};
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

FailureCase mandelbulbCase() {
  return {"distance estimate of a Mandelbulb",
          "marched as if it were a bound: steepest quotient, less 1",
          "believed",
          "refused: no slope is known",
          1.0,
          0.0,
          "the estimate is right in the limit of many iterations, not for eight; 0 stands for refused",
          [] {
            const Shape shape = mandelbulb();
            const Distance f(shape);
            const bool refused = !Marcher::make(shape, {});
            const double naive = steepest(f, 1.25, 17) - 1.0;
            return Figures{naive, refused ? 0.0 : naive};
          }};
}

constexpr double kPlate = 0.02;  // thickness of a plate from -1 to 1 in x and y
const glm::dvec3 kPlateHalf(1.0, 1.0, 0.5 * kPlate);

double plateDistance(const glm::dvec3& p) { return boxDistance(p, kPlateHalf); }

Rays raysToPlate() { return cameraRays({0.6, 0.4, 2.6}, {0, 0, 0}, 0.25); }

// Of the rays that meet the plate's front, those that end without a hit, in percent.
double percentThrough(const Rays& rays, const std::vector<double>& t) {
  return percent(rays, [&](std::size_t i) {
    const glm::dvec3 front = rays.at(i, (kPlateHalf.z - rays.origin.z[i]) / rays.direction.z[i]);
    return std::abs(front.x) < 1.0 && std::abs(front.y) < 1.0 && t[i] == kInf;
  });
}

FailureCase plateCase() {
  return {
      "thin plate by over-relaxation",
      "% of rays that pass through it",
      "steps of 1.6 f",
      "taken back where the balls do not overlap",
      1.0,
      0.0,
      "the last step before a plate goes up to 0.6 f beyond its front, past the back where f > 0.02 / 0.6",
      [] {
        const Rays rays = raysToPlate();
        const auto ours = hitsOf(box(Vec3E(kPlateHalf)), rays, MarchMethod::OverRelaxed);
        return Figures{percentThrough(rays, marchAllNaively(plateDistance, rays, {1.6, false})),
                       percentThrough(rays, ours)};
      }};
}

FailureCase fixedStepCase() {
  return {"thin plate by steps of one length",
          "% of rays that pass through it",
          "steps of 0.05, a hit where f < 0",
          "intervals along the ray, halved until they prove it free",
          1.0,
          0.0,
          "a plate 0.02 thick lies between two samples for three of five rays",
          [] {
            const Rays rays = raysToPlate();
            std::vector<double> naive;
            for (std::size_t i = 0; i < rays.size(); ++i) {
              double t = 0.0;
              while (t < 5.0 && plateDistance(rays.at(i, t)) >= 0.0) t += 0.05;
              naive.push_back(t < 5.0 ? t : kInf);
            }
            const auto ours = hitsOf(box(Vec3E(kPlateHalf)), rays, MarchMethod::Bisection);
            return Figures{percentThrough(rays, naive), percentThrough(rays, ours)};
          }};
}

FailureCase headOnCase() {
  constexpr double kStep = 1.6;
  return {"over-relaxation straight at a wall",
          "depth of the hit, scene units",
          "balls of radius |f| overlap",
          "f with its sign: what is in the wall proves nothing",
          0.6,
          kEpsilon,
          "1.6 f is as far as |f| of both ends together, so the check passes 0.6 deep",
          [] {
            const glm::dvec3 from(0, 1, 0), down(0, -1, 0);
            Rays rays;
            rays.add(from, down, 0.0, kReach);
            const auto height = [](const glm::dvec3& p) { return p.y; };
            const double naive = marchNaively(height, from, down, {kStep, true});
            const double ours = hitsOf(plane(Vec3E(0, 1, 0), 0.0), rays, MarchMethod::OverRelaxed)[0];
            return Figures{naive - 1.0, ours - 1.0};
          }};
}

// Rays that fall by 3 to 23 degrees.
FailureCase horizonCase() {
  return {"ground near the horizon in 100 steps",
          "% of the ground's rays that show the sky",
          "a ray that runs out of steps has missed",
          "segments along the ray, and Budget where steps run out",
          10.0,
          0.0,
          "at an angle a each step leaves 1 - sin a of the height: below 5.1 degrees, 10.5 % of the rays, "
          "more than 1e-4 after 99",
          [] {
            const Shape ground = plane(Vec3E(0, 1, 0), 0.0);
            Rays rays;
            for (int i = 0; i < 1000; ++i) {
              const double angle = (3.0 + 0.02 * i) * kPi / 180.0;
              rays.add({0, 1, 0}, {std::cos(angle), -std::sin(angle), 0}, 0.0, kReach);
            }
            const auto height = [](const glm::dvec3& p) { return p.y; };
            const auto naive = marchAllNaively(height, rays, {1.0, false, 100});
            const auto ours = hitsOf(ground, rays, MarchMethod::Segment, 100);
            const auto lost = [&](const std::vector<double>& t) {
              return percent(rays, [&](std::size_t i) { return t[i] == kInf; });
            };
            return Figures{lost(naive), lost(ours)};
          }};
}

FailureCase skimmingCase() {
  return {"ray along a plane, 1e-3 above it",
          "readings over a length of 10",
          "steps of f",
          "steps of f / its slope along the ray",
          9990.0,
          4.0,
          "10 / 1e-3 but for rounding; a segment's slope along the plane is 0",
          [] {
            Rays rays;
            rays.add({0, 1e-3, 0}, {1, 0, 0}, 0.0, 10.0);
            MarchOptions options;
            options.maxSteps = 100000;
            const auto steps = [&](MarchMethod method) {
              options.method = method;
              return static_cast<double>(trace(plane(Vec3E(0, 1, 0), 0.0), rays, options).steps[0]);
            };
            return Figures{steps(MarchMethod::Plain), steps(MarchMethod::Segment)};
          }};
}

// Percent of the rays whose t, in float, stands still before the hit.
double percentStalled(const Rays& rays, const Shape& shape) {
  const Tape tape(shape.distance);
  BatchEvaluator batch;
  return percent(rays, [&](std::size_t i) {
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

FailureCase stallCase() {
  return {"ball seen from 1e5 away",
          "% of rays that come to a stand before it",
          "t in float",
          "t in double, positions rounded to float near the ball",
          1.0,
          0.0,
          "a float near 1e5 moves by 0.008: t + f = t once f < 0.004",
          [] {
            Rays rays;
            for (int i = 0; i < 500; ++i) {
              const glm::dvec3 from(1e5, 0.0, 0.0), to(0.0, 0.0015 * i, 0.001 * (i % 17));
              rays.add(from, glm::normalize(to - from), 0.0, 2e5);
            }
            const auto ours = hitsOf(sphere(1.0), rays, MarchMethod::Plain);
            return Figures{percentStalled(rays, sphere(1.0)),
                           percent(rays, [&](std::size_t i) { return ours[i] == kInf; })};
          }};
}

}  // namespace

std::vector<FailureCase> marchingFailures() {
  std::vector<FailureCase> all{twistCase(),      relaxedTwistCase(), displacedCase(), gyroidCase(),
                               mandelbulbCase(), plateCase(),        headOnCase(),    horizonCase(),
                               skimmingCase(),   stallCase(),        fixedStepCase()};
  for (FailureCase& c : shadingFailures()) all.push_back(std::move(c));
  return all;
}

}  // namespace sdf::accuracy
