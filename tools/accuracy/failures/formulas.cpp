// Failures of distance formulas: what they say of the distance, and of its slope.
#include <cmath>
#include <glm/trigonometric.hpp>

#include "probe.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

double ellipsoidByTheUsualFormula(const glm::dvec3& p, const glm::dvec3& r) {
  const double k0 = glm::length(p / r), k1 = glm::length(p / (r * r));
  return k0 * (k0 - 1.0) / k1;
}

// The angle between the faces of a wedge, its edge along z and its middle on -y.
const double kWedge = 20.0 * kPi / 180.0;
constexpr double kGyroid = 4.0;  // radians a unit

}  // namespace

std::vector<FailureCase> formulaFailures() {
  return {
      {"corner of two half spaces",
       "share of the distance that is missing at (1, 1)",
       {"maximum of the two distances", 1.0 - std::sqrt(0.5) - kRounding},
       {"exact outline (rectangle); the intersection itself is claimed as a bound only", kRounding},
       "max(1, 1) = 1 where the corner is sqrt 2 away",
       [] {
         const Shape both = intersect(plane({1, 0, 0}, 0.0), plane({0, 1, 0}, 0.0));
         if (both.claim.kind != ClaimKind::Bound) throw std::runtime_error("passes for exact");
         const Shape exact = translate(rectangle(5.0, 5.0), {-5, -5, 0});
         const auto missing = [](double f) { return 1.0 - f / std::sqrt(2.0); };
         return Figures{missing(Distance(both)(1, 1, 0)), std::abs(missing(Distance(exact)(1, 1, 0)))};
       }},
      {"wedge of 20 degrees",
       "share of the distance that is missing above the edge",
       {"maximum of the two distances", 1.0 - std::sin(kWedge / 2) - kRounding},
       {"exact outline (polygon)", kRounding},
       "the planes are sin(angle / 2) away",
       [] {
         const double c = std::cos(kWedge / 2), s = std::sin(kWedge / 2);
         const Shape bound = intersect(plane({c, s, 0.0}, 0.0), plane({-c, s, 0.0}, 0.0));
         if (bound.claim.kind != ClaimKind::Bound)
           throw std::runtime_error("an intersection passes for exact");
         const std::vector<glm::dvec2> corners{{0, 0}, {-10 * s, -10 * c}, {10 * s, -10 * c}};
         // Above the edge, the edge is nearest.
         const glm::dvec3 above(0.0, 1.0, 0.0);
         return Figures{1.0 - Distance(bound)(above), std::abs(1.0 - Distance(polygon(corners))(above))};
       }},
      {"walls inside a shell of two boxes that share a face",
       "thickness of the inner wall",
       {"|min(a, b)| - 0.05", 0.1 - kRounding},
       {"shell of the exact outline (polygon, extruded): nothing is inside", 0.0},
       "the minimum is 0 on the shared face, so the shell is 0.05 thick on both its sides",
       [] {
         const Shape a = translate(box({0.5, 1, 1}), {-0.5, 0, 0}),
                     b = translate(box({0.5, 1, 1}), {0.5, 0, 0});
         if (unite(a, b).claim.kind == ClaimKind::Exact) throw std::runtime_error("passes for exact inside");
         const Distance naive(shell(unite(a, b), 0.1)), ours(shell(extrude(rectangle(1.0, 1.0), 1.0), 0.1));
         // The wall's thickness is 2 |f| at its middle.
         return Figures{std::max(0.0, -2.0 * naive(0, 0, 0)), std::max(0.0, -2.0 * ours(0, 0, 0))};
       }},
      {"box less a thin ellipsoid (1, 0.1, 0.1)",
       "greatest |f| / d inside the ellipsoid, less 1",
       {"k0 (k0 - 1) / k1 (Quilez 2008)", 8.0},
       {"ellipsoid() by an unrolled iteration, and a guarded ellipsoid_bound()", 5e-7 / 0.05},
       "near the centre along x the formula says 1 where 0.1 is true, asked for points at least 0.05 deep; "
       "the iteration is within 5e-7 largest radii",
       [] {
         const glm::dvec3 r(1, 0.1, 0.1);
         const Distance exact(ellipsoid(Vec3E(1, 0.1, 0.1))), bound(ellipsoidBound(Vec3E(1, 0.1, 0.1)));
         return worstOf(1, 99, 1, [&](double i) {
           const glm::dvec3 p(0.008 * i, 0.0, 0.0);
           // On the axis, inside the evolute's reach, the foot lies off it: at cos t = x a / (a^2 - b^2).
           const double c = p.x / (1.0 - 0.01), d = std::hypot(c - p.x, 0.1 * std::sqrt(1 - c * c));
           if (d < 0.05) return Figures{};
           return Figures{std::abs(ellipsoidByTheUsualFormula(p, r)) / d - 1.0,
                          std::max(std::abs(exact(p)), std::abs(bound(p))) / d - 1.0};
         });
       }},
      {"centre of an ellipsoid",
       "values that are not numbers, of 1",
       {"k0 (k0 - 1) / k1 (Quilez 2008)", 1.0},
       {"both our ellipsoids", 0.0},
       "k1 is 0 at the centre",
       [] {
         const glm::dvec3 centre(0.0);
         const double naive = ellipsoidByTheUsualFormula(centre, {1, 0.1, 0.1});
         const double exact = Distance(ellipsoid(Vec3E(1, 0.1, 0.1)))(centre);
         const double bound = Distance(ellipsoidBound(Vec3E(1, 0.1, 0.1)))(centre);
         // Both must also be depths that the ellipsoid has.
         const bool sound =
             exact < 0.0 && bound < 0.0 && exact >= -0.1 - kRounding && bound >= -0.1 - kRounding;
         return Figures{std::isnan(naive) ? 1.0 : 0.0, sound ? 0.0 : 1.0};
       }},
      {"normal at the tip of a cone",
       "components that are not numbers, of 3",
       {"derivative of length(x, z) as x / length", 2.0},
       {"the slope of a square root at 0 is defined as 0", 0.0},
       "0 / 0 in x and z; a defined gradient no longer than L = 1 is what counts",
       [] {
         const glm::dvec3 tip(0.0, 1.0, 0.0);
         const double radius = std::hypot(tip.x, tip.z);
         const glm::dvec3 naive(tip.x / radius, 0.0, tip.z / radius),
             ours = Distance(cone(1.0, 1.0)).gradient(tip);
         const auto bad = [](const glm::dvec3& n) {
           return double(std::isnan(n.x) + std::isnan(n.y) + std::isnan(n.z));
         };
         return Figures{bad(naive), glm::length(ours) <= 1.0 + kRounding ? bad(ours) : 3.0};
       }},
      {"gradient inside a box",
       "gradients that are not numbers, share",
       {"dual numbers through length(max(q, 0)), slope of sqrt as 1 / (2 sqrt)", 0.9},
       {"dual numbers with a guarded square root; every component finite", 0.0},
       "inside, max(q, 0) is 0 in all components: 0 / 0 everywhere there",
       [] {
         const Distance ours(box(Vec3E(1.0)));
         int naive = 0, bad = 0, all = 0;
         worst(0.9, 9, [&](const glm::dvec3& p) {
           const glm::dvec3 q = glm::max(glm::abs(p) - 1.0, 0.0);
           const double slope = q.x / std::sqrt(glm::dot(q, q));
           const double length = glm::length(ours.gradient(p));
           naive += std::isnan(slope), bad += !(std::abs(length - 1.0) <= kRounding), ++all;
           return 0.0;
         });
         return Figures{double(naive) / all, double(bad) / all};
       }},
      {"slope of a gyroid",
       "steepest difference quotient, less 1",
       {"sin(wx) cos(wy) + sin(wy) cos(wz) + sin(wz) cos(wx), w = 4",
        0.95 * (std::sqrt(3.0) * kGyroid - 1.0)},
       {"gyroid(), divided by its proven slope", 1e-9},
       "the steepest slope is sqrt 3 w, of which the lattice finds 95 in 100",
       [] {
         const auto naive = [](const glm::dvec3& p) {
           const glm::dvec3 s = glm::sin(kGyroid * p), c = glm::cos(kGyroid * p);
           return s.x * c.y + s.y * c.z + s.z * c.x;
         };
         const Distance ours(gyroid(2.0 * kPi / kGyroid, 0.05));
         return Figures{steepest(naive, 1.0, 41) - 1.0, steepest(ours, 1.0, 41) - 1.0};
       }},
      {"rounding a box by its greatest coordinate",
       "distance between the surface and that of a ball rolled around the box",
       {"max(|x|, |y|, |z|) - 1 - 0.3", 0.3 * (std::sqrt(3.0) - 1.0) - kRounding},
       {"round() of the exact distance", kRounding},
       "levels of a bound are no offsets: its corner stays sharp, 0.3 sqrt 3 off the old one instead of 0.3",
       [] {
         const double corner = 1.0 + 0.3 / std::sqrt(3.0);  // of the rounded box, along the diagonal
         const double sharp = 1.3;                          // where max = 1.3 along the diagonal
         return Figures{(sharp - corner) * std::sqrt(3.0),
                        std::abs(Distance(round(box(Vec3E(1.0)), 0.3))(corner, corner, corner))};
       }}};
}

}  // namespace sdf::accuracy
