// Failures of warped and repeated space.
#include <cmath>
#include <glm/trigonometric.hpp>

#include "probe.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

constexpr double kColumnTwist = 3.0, kHalf = 0.53;  // of a box about y: radians a unit, and half its width

// Into the cell of 2 about 0.
double inCell(double x) { return x - 2.0 * std::round(x / 2.0); }

}  // namespace

std::vector<FailureCase> warpFailures() {
  return {
      {"sphere flattened to a tenth",
       "greatest step f / L over d on the short axis, less 1",
       {"f(p / s), of which L = 1 is believed", 9.0 - kRounding},
       {"scale(): with its proven constant", kRounding},
       "p / s moves ten times as fast as p",
       [] {
         const auto naive = [](double z) { return z / 0.1 - 1.0; };
         const Shape flat = scale(sphere(1.0), {1, 1, 0.1});
         const Distance ours(flat);
         return worstOf(0.2, 3.0, 0.1, [&](double z) {
           return Figures{naive(z) / (z - 0.1) - 1.0, ours(0, 0, z) / slopeOf(flat) / (z - 0.1) - 1.0};
         });
       }},
      {"slope of a twisted box",
       "steepest difference quotient over the constant that is believed, less 1",
       {"f of the turned position", 0.9 * (std::hypot(1.0, kColumnTwist * kHalf) - 1.0)},
       {"calibrated, with a proven constant", 1e-9},
       "at a face's edge, half = 0.53 off its middle, the face also moves by rate half along y: slope sqrt(1 "
       "+ (3 * 0.53)^2), of which the lattice finds nine tenths; quotients over 1e-4 round by 1e-12",
       [] {
         const Shape column = box(Vec3E(kHalf, 1.0, kHalf));
         const Shape twisted = twist(column, kColumnTwist);
         const Distance straight(column), ours(twisted);
         const auto naive = [&](const glm::dvec3& p) {
           const double c = std::cos(kColumnTwist * p.y), s = std::sin(kColumnTwist * p.y);
           return straight(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
         };
         return Figures{steepest(naive, 0.75, 41) - 1.0, steepest(ours, 0.75, 41) / slopeOf(twisted) - 1.0};
       }},
      {"slope of a bent bar",
       "steepest difference quotient over the constant that is believed, less 1",
       {"f of the turned position (Quilez 2008)", 1.0},
       {"lengths along the bar kept, calibrated, with a proven constant", 1e-9},
       "the turn by k x, k = 2, shears by k r, which is 1 + k r - 1 = 1 or more at the bar's end",
       [] {
         const Shape bar = box(Vec3E(1.0, 0.2, 0.2));
         const Shape bent = bend(bar, 1.0);
         const Distance straight(bar), ours(bent);
         const auto naive = [&](const glm::dvec3& p) {
           const double c = std::cos(2.0 * p.x), s = std::sin(2.0 * p.x);
           return straight(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
         };
         return Figures{steepest(naive, 1.0, 41) - 1.0, steepest(ours, 1.0, 41) / slopeOf(bent) - 1.0};
       }},
      {"a bend that folds space",
       "points above the fold that count as solid, of 1",
       {"f of the position in the bent frame", 1.0},
       {"refused, with the curvature that would do", 0.0},
       "material at y = 0.6 > 1 / 2 passes the centre of curvature",
       [] {
         // In the bent frame the centre of curvature is (any x, 1/2): one point stands for a whole line.
         const Distance bar(box(Vec3E(1.0, 0.6, 0.2)));
         const double naive = bar(0.0, 0.5, 0.0) < 0.0 && bar(0.9, 0.5, 0.0) < 0.0 ? 1.0 : 0.0;
         return Figures{naive, bend(box(Vec3E(1.0, 0.6, 0.2)), 2.0).ok() ? 1.0 : 0.0};
       }},
      {"slope of a displaced sphere",
       "steepest difference quotient over the constant that is believed, less 1",
       {"sphere + 0.1 sin 20x sin 20y sin 20z", 1.6},
       {"displace(): with the constant 1 + amplitude w", 1e-9},
       "the gradient's length reaches 1 + 0.1 * 20 = 3 where wave and sphere climb together, of which the "
       "lattice finds 2.6 or more",
       [] {
         const auto naive = [](const glm::dvec3& p) {
           const glm::dvec3 s = glm::sin(20.0 * p);
           return glm::length(p) - 1.0 + 0.1 * s.x * s.y * s.z;
         };
         const Shape bumpy = displace(sphere(1.0), 0.1, 20.0);
         const Distance ours(bumpy);
         return Figures{steepest(naive, 1.2, 61) - 1.0, steepest(ours, 1.2, 61) / slopeOf(bumpy) - 1.0};
       }},
      {"sphere near the wall of its cell",
       "greatest excess over the distance",
       {"one look into the point's own cell", 0.8 - kRounding},
       {"neighbouring cells looked at where the shape can be nearest", kRounding},
       "cell 2, radius 0.5, offset 0.4: at the wall 0.9 where the next copy is 0.1 away",
       [] {
         const Shape ball = translate(sphere(0.5), {0.4, 0, 0});
         const Distance one(ball), ours(repeatGrid(ball, {2, 0, 0}));
         return worstOf(-1.0, 1.0, 1.0 / 64, [&](double x) {
           const double d = std::min({std::abs(x - 0.4), std::abs(x + 1.6), std::abs(x - 2.4)}) - 0.5;
           return Figures{one(inCell(x), 0, 0) - d, std::abs(ours(x, 0, 0) - d)};
         });
       }},
      {"turned box that pokes through its cell's walls",
       "greatest jump across a wall",
       {"one look into the point's own cell", 0.1},
       {"neighbouring cells looked at", 1e-6 + kRounding},
       "half length 1.5 in cells of 2 turned by 30 degrees sticks out; a slope of at most 1 over a step of "
       "1e-6",
       [] {
         const Shape bar = rotate(box(Vec3E(1.5, 0.2, 0.2)), {0, 0, kPi / 6});
         const Distance one(bar), ours(repeatGrid(bar, {2, 2, 0}));
         return worstOf(-0.99, 1.0, 0.01, [&](double y) {
           const double before = 1.0 - 1e-6 / 2, beyond = 1.0 + 1e-6 / 2;
           return Figures{std::abs(one(inCell(before), inCell(y), 0) - one(inCell(beyond), inCell(y), 0)),
                          std::abs(ours(before, y, 0) - ours(beyond, y, 0))};
         });
       }},
      {"mirror of a ball that crosses the plane",
       "depth of solid that is lost",
       {"f(|x|, y, z)", 0.4 - kRounding},
       {"both halves looked at where the bounds cross the plane", kRounding},
       "centre -0.3, radius 0.5: folding leaves of the ball what lies at x > 0; at its old centre the copy's "
       "surface is 0.1 away, where the ball is 0.5 deep",
       [] {
         const Shape ball = translate(sphere(0.5), {-0.3, 0, 0});
         const Distance one(ball), ours(mirror(ball, {1, 0, 0}));
         return Figures{0.5 + one(0.3, 0, 0), std::abs(0.5 + ours(-0.3, 0, 0))};
       }},
      {"repetition at negative coordinates",
       "greatest excess over the distance",
       {"C's fmod, whose remainder takes the dividend's sign", 1.0 - kRounding},
       {"nearest multiple of the cell", kRounding},
       "cell 2: left of -1 the lookup is a whole cell off, so that a ball's centre passes for its cell's "
       "corner",
       [] {
         const Distance one(sphere(0.5)), ours(repeatGrid(sphere(0.5), {2, 0, 0}));
         return worstOf(-4.0, 4.0, 1.0 / 16, [&](double x) {
           const double d = std::abs(inCell(x)) - 0.5;
           return Figures{one(std::fmod(x + 1.0, 2.0) - 1.0, 0, 0) - d, std::abs(ours(x, 0, 0) - d)};
         });
       }},
      {"ball near the wall of its sector",
       "greatest excess over the distance",
       {"one look into the point's own sector", 0.2},
       {"neighbouring sectors looked at where the shape can be nearest", kRounding},
       "six balls of 0.2 at radius 1, turned by 25 degrees: across the wall at 30 the next is 5 degrees "
       "away, 0.09, and the own one 55, 0.92",
       [] {
         const double at = 25.0 * kPi / 180.0;
         const Shape ball = translate(sphere(0.2), {std::cos(at), 0, -std::sin(at)});
         const Distance one(ball), ours(polarRepeat(ball, 6));
         return worstOf(0, 719, 1, [&](double i) {
           const double a = i * kPi / 360.0, sector = a - kPi / 3.0 * std::round(a / (kPi / 3.0));
           double d = kInfinity;
           for (int k = 0; k < 6; ++k)
             d = std::min(d, 2.0 * std::abs(std::sin((a - at - k * kPi / 3.0) / 2.0)) - 0.2);
           return Figures{one(std::cos(sector), 0, -std::sin(sector)) - d,
                          std::abs(ours(std::cos(a), 0, -std::sin(a)) - d)};
         });
       }}};
}

}  // namespace sdf::accuracy
