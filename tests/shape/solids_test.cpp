#include "sdf/shape/solids/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "shape/cases.h"

namespace sdf {
namespace solids_test {

using glm::dvec3;
using test::Evaluator;
using test::Sampler;

constexpr unsigned kSeed = 20240612;
constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

// Results of some tens of roundings on numbers below 10.
constexpr double kRounding = 1e-13;

double at(const Shape& s, const dvec3& p) { return Evaluator(s.distance)(p); }

TEST(Solids, HaveTheDistancesWorkedOutByHand) {
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0);
  const struct {
    const char* what;
    Shape shape;
    dvec3 point;
    double distance;
  } table[] = {
      {"sphere", sphere(1.5), {0, 3, 4}, 3.5},
      {"box, corner", box({1.0, 2.0, 3.0}), {4, 6, 15}, 13},
      {"box, face from inside", box({1.0, 2.0, 3.0}), {0.25, 0, 0}, -0.75},
      {"round_box keeps its size", roundBox({1.0, 2.0, 3.0}, 0.5), {2, 0, 0}, 1},
      {"round_box, corner", roundBox(Vec3E(1.0), 0.5), {1, 1, 1}, 0.5 * r3 - 0.5},
      {"box_frame, middle of a face", boxFrame(Vec3E(1.0), 0.25), {0, 0, 1}, 0.75},
      {"box_frame, middle of a beam", boxFrame(Vec3E(1.0), 0.25), {0.875, 0, 0.875}, -0.125},
      {"box_frame, where two thick beams meet", boxFrame({1.0, 2.0, 0.5}, 0.5), {0.75, 1.75, 0}, -0.25},
      {"torus, centre", torus(2.0, 0.5), {0, 0, 0}, 1.5},
      {"torus, over the tube", torus(2.0, 0.5), {0, 3, 2}, 2.5},
      {"capped_torus, along the gap", cappedTorus(90 * kDegree, 2.0, 0.5), {0, 0, -3}, std::sqrt(13.0) - 0.5},
      {"capped_torus, on the arc", cappedTorus(90 * kDegree, 2.0, 0.5), {0, 0, 2}, -0.5},
      {"link, end", link(1.0, 0.5, 0.25), {0, 3, 0}, 1.25},
      {"link, side", link(1.0, 0.5, 0.25), {1.5, 0.3, 0}, 0.75},
      {"cylinder, rim", cylinder(1.0, 2.0), {4, 6, 0}, 5},
      {"cylinder, inside", cylinder(1.0, 2.0), {0, 1.5, 0}, -0.5},
      {"infinite_cylinder", infiniteCylinder(1.0), {3, 1e4, 4}, 4},
      {"capsule, side", capsule({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 0.5), {2, 3, 4}, 4.5},
      {"capsule, end", capsule({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 0.5), {7, 0, 4}, 4.5},
      {"cone, above the tip", cone(1.0, 2.0), {0, 5, 0}, 3},
      {"cone, under the base", cone(1.0, 2.0), {0.5, -3, 0}, 1},
      {"cone, beside the side", cone(3.0, 2.0), {3, 2, 0}, 3 * 4 / 5.0},
      {"capped_cone, over the top", cappedCone(2.0, 1.0, 1.0), {0.5, 4, 0}, 3},
      {"capped_cone as a cylinder", cappedCone(1.0, 1.0, 1.0), {4, 5, 0}, 5},
      {"round_cone, top ball", roundCone(1.0, 0.5, 1.0), {0, 3, 0}, 1.5},
      {"round_cone, bottom ball", roundCone(1.0, 0.5, 1.0), {0, -3, 0}, 1},
      // The side of radii 2 and 1 at distance 2 slopes by 30 degrees.
      {"round_cone, side", roundCone(2.0, 1.0, 1.0), {2 * r3, -1 + 2, 0}, 4 - 2},
      {"plane", plane({0.0, 3.0, 4.0}, 1.0), {7, 3, 4}, 4},
      {"ellipsoid, axis", ellipsoid({1.0, 2.0, 3.0}), {0, 0, 5}, 2},
      {"hex_prism, flat side", hexPrism(2.0, 1.0), {2, 0, 0}, 2 - r3},
      {"hex_prism, corner", hexPrism(2.0, 1.0), {0, 0, 3}, 1},
      {"tri_prism, flat side", triPrism(2.0, 1.0), {0, 0, -3}, 2},
      {"tri_prism, top", triPrism(2.0, 1.0), {0.1, 4, 0.2}, 3},
      {"octahedron, face", octahedron(1.0), {1, 1, 1}, 2 / r3},
      {"octahedron, edge", octahedron(1.0), {2, 2, 0}, 1.5 * r2},
      {"octahedron, centre", octahedron(1.0), {0, 0, 0}, -1 / r3},
      {"tetrahedron, centre", tetrahedron(3.0), {0, 0, 0}, -1},
      {"tetrahedron, corner", tetrahedron(r3), {2, -2, -2}, r3},
      {"tetrahedron, face", tetrahedron(3.0), {-2, -2, -2}, 2 * r3 - 1},
      {"pyramid, tip", pyramid(1.0, 2.0), {0, 4, 0}, 2},
      {"pyramid, base corner", pyramid(1.0, 2.0), {2, -3, 2}, r3},
      {"pyramid, base", pyramid(1.0, 2.0), {0.5, -5, -0.9}, 3},
      {"solid_angle, under the tip", solidAngle(45 * kDegree, 1.0), {0, -2, 0}, 2},
      {"solid_angle, side", solidAngle(45 * kDegree, 4.0), {2, 0, 0}, r2},
      {"solid_angle, ball", solidAngle(45 * kDegree, 4.0), {0, 7, 0}, 3},
      {"cut_sphere, under the cut", cutSphere(1.0, 0.5), {0.1, 0, 0.1}, 0.5},
      {"cut_sphere, ball", cutSphere(1.0, -0.5), {3, 0, 4}, 4},
      {"cut_sphere, rim", cutSphere(5.0, 3.0), {4, 1, 0}, 2},
  };
  for (const auto& row : table) {
    ASSERT_TRUE(row.shape.ok()) << row.what << ": " << *row.shape.error;
    EXPECT_NEAR(at(row.shape, row.point), row.distance,
                row.what[0] == 'e' ? 5e-7 * 3.0 : kRounding)  // the ellipsoid's own accuracy
        << row.what;
  }
}

// Which points each solid is made of, said without any distance.
struct Membership {
  const char* name;
  Shape shape;
  std::function<bool(dvec3)> inside;
};

double rho(const dvec3& p) { return std::hypot(p.x, p.z); }

bool inRegularPolygon(double x, double z, int sides, double radius) {
  for (int i = 0; i < sides; ++i) {
    const double normal = 2 * kPi * (i + 0.5) / sides;
    if (x * std::sin(normal) + z * std::cos(normal) > radius * std::cos(kPi / sides)) return false;
  }
  return true;
}

bool inTetrahedron(const dvec3& p, double radius) {
  for (const dvec3& n : {dvec3(-1, -1, -1), dvec3(-1, 1, 1), dvec3(1, -1, 1), dvec3(1, 1, -1)})
    if (glm::dot(p, glm::normalize(n)) > radius / 3.0) return false;
  return true;
}

std::vector<Membership> memberships() {
  const auto within = [](const dvec3& p, const dvec3& half) {
    return std::abs(p.x) <= half.x && std::abs(p.y) <= half.y && std::abs(p.z) <= half.z;
  };
  return {
      {"box_frame", boxFrame({1.0, 0.8, 1.2}, 0.3),
       [=](dvec3 p) {
         const dvec3 half(1.0, 0.8, 1.2);
         if (!within(p, half)) return false;
         int near = 0;
         for (int i = 0; i < 3; ++i) near += std::abs(p[i]) >= half[i] - 0.3;
         return near >= 2;
       }},
      {"round_cone", roundCone(1.0, 0.4, 0.8),
       [](dvec3 p) {
         for (int i = 0; i <= 2000; ++i) {
           const double t = i / 2000.0;
           if (std::hypot(rho(p), p.y - (-0.8 + 1.6 * t)) <= 1.0 - 0.6 * t) return true;
         }
         return false;
       }},
      {"capped_torus", cappedTorus(130 * kDegree, 1.0, 0.3),
       [](dvec3 p) {
         for (int i = -2000; i <= 2000; ++i) {
           const double a = 130 * kDegree * i / 2000.0;
           if (glm::distance(p, {std::sin(a), 0, std::cos(a)}) <= 0.3) return true;
         }
         return false;
       }},
      {"capped_cone", cappedCone(1.0, 0.4, 0.7),
       [](dvec3 p) { return std::abs(p.y) <= 0.7 && rho(p) <= 0.7 - 0.3 * p.y / 0.7; }},
      {"cone", cone(1.2, 0.5),
       [](dvec3 p) { return std::abs(p.y) <= 0.5 && rho(p) <= 0.6 * (1.0 - p.y / 0.5); }},
      {"ellipsoid", ellipsoid({1.0, 0.4, 0.7}),
       [](dvec3 p) { return glm::length(p / dvec3(1.0, 0.4, 0.7)) <= 1.0; }},
      {"ellipsoid_bound", ellipsoidBound({1.0, 0.4, 0.7}),
       [](dvec3 p) { return glm::length(p / dvec3(1.0, 0.4, 0.7)) <= 1.0; }},
      {"hex_prism", hexPrism(1.0, 0.4),
       [](dvec3 p) { return std::abs(p.y) <= 0.4 && inRegularPolygon(p.x, p.z, 6, 1.0); }},
      {"tri_prism", triPrism(1.0, 0.4),
       [](dvec3 p) { return std::abs(p.y) <= 0.4 && inRegularPolygon(p.x, p.z, 3, 1.0); }},
      {"octahedron", octahedron(1.1),
       [](dvec3 p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) <= 1.1; }},
      {"tetrahedron", tetrahedron(1.2), [](dvec3 p) { return inTetrahedron(p, 1.2); }},
      {"pyramid", pyramid(0.9, 0.6),
       [](dvec3 p) {
         const double side = 0.45 * (1.0 - p.y / 0.6);
         return std::abs(p.y) <= 0.6 && std::max(std::abs(p.x), std::abs(p.z)) <= side;
       }},
      {"spring", spring(1.0, 0.6, 2.25, 0.2),
       [](dvec3 p) {
         for (int i = -4000; i <= 4000; ++i) {
           const double t = 2.25 * kPi * i / 4000.0;
           if (glm::distance(p, {std::cos(t), 0.3 * t / kPi, -std::sin(t)}) <= 0.2) return true;
         }
         return false;
       }},
      {"left-handed thread", thread(2.0, 0.5, 1.6, 2, 0.03, Hand::Left),
       [](dvec3 p) {
         const double root = 1.0 - 0.5 * 0.541266, up = p.y - 2 * 0.5 * std::atan2(p.z, p.x) / (2 * kPi);
         const double off = std::abs(std::remainder(up, 0.5));
         // Out of the flank that passes (1, 0.5 / 16), 30 degrees from level.
         const double flank =
             (rho(p) - 1.0) * std::sin(30 * kDegree) + (off - 0.03125) * std::cos(30 * kDegree);
         const bool inTurn = rho(p) <= 1.03 && flank <= 0.03;
         return std::abs(p.y) <= 0.8 && rho(p) - root - 0.03 <= 0.8 - std::abs(p.y) &&
                (rho(p) <= root + 0.03 || inTurn);
       }},
      {"solid_angle", solidAngle(40 * kDegree, 1.0),
       [](dvec3 p) { return glm::length(p) <= 1.0 && std::atan2(rho(p), p.y) <= 40 * kDegree; }},
      {"wide solid_angle", solidAngle(150 * kDegree, 1.0),
       [](dvec3 p) { return glm::length(p) <= 1.0 && std::atan2(rho(p), p.y) <= 150 * kDegree; }},
      {"cut_sphere", cutSphere(1.0, 0.3), [](dvec3 p) { return glm::length(p) <= 1.0 && p.y >= 0.3; }},
      {"deep cut_sphere", cutSphere(1.0, -0.7), [](dvec3 p) { return glm::length(p) <= 1.0 && p.y >= -0.7; }},
      {"gyroid", gyroid(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         const double g =
             std::sin(p.x) * std::cos(p.y) + std::sin(p.y) * std::cos(p.z) + std::sin(p.z) * std::cos(p.x);
         return std::abs(g) <= 0.1 * kPi * std::sqrt(3.0);
       }},
      {"schwarz_p", schwarzP(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         return std::abs(std::cos(p.x) + std::cos(p.y) + std::cos(p.z)) <= 0.1 * kPi * std::sqrt(3.0);
       }},
      {"schwarz_d", schwarzD(2.0, 0.2),
       [](dvec3 p) {
         // The surface's other usual form, moved by an eighth of a cell.
         p = p * kPi - kPi / 4;
         const double g =
             std::sin(p.x) * std::sin(p.y) * std::sin(p.z) + std::sin(p.x) * std::cos(p.y) * std::cos(p.z) +
             std::cos(p.x) * std::sin(p.y) * std::cos(p.z) + std::cos(p.x) * std::cos(p.y) * std::sin(p.z);
         return std::abs(g) <= 0.1 * kPi * std::sqrt(3.0);
       }},
      {"iwp", iwp(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         const double g = 2.0 * (std::cos(p.x) * std::cos(p.y) + std::cos(p.y) * std::cos(p.z) +
                                 std::cos(p.z) * std::cos(p.x)) -
                          std::cos(2.0 * p.x) - std::cos(2.0 * p.y) - std::cos(2.0 * p.z);
         return std::abs(g) <= 0.1 * kPi * std::sqrt(27.0);
       }},
      {"neovius", neovius(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         return std::abs(3.0 * (std::cos(p.x) + std::cos(p.y) + std::cos(p.z)) +
                         4.0 * std::cos(p.x) * std::cos(p.y) * std::cos(p.z)) <= 0.1 * kPi * 7.0;
       }},
      {"lidinoid", lidinoid(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         const double g =
             0.5 * (std::sin(2.0 * p.x) * std::cos(p.y) * std::sin(p.z) +
                    std::sin(2.0 * p.y) * std::cos(p.z) * std::sin(p.x) +
                    std::sin(2.0 * p.z) * std::cos(p.x) * std::sin(p.y)) -
             0.5 * (std::cos(2.0 * p.x) * std::cos(2.0 * p.y) + std::cos(2.0 * p.y) * std::cos(2.0 * p.z) +
                    std::cos(2.0 * p.z) * std::cos(2.0 * p.x)) +
             0.15;
         return std::abs(g) <= 0.1 * kPi * std::sqrt(6.75);
       }},
      {"fischer_koch_s", fischerKochS(2.0, 0.2),
       [](dvec3 p) {
         p *= kPi;
         return std::abs(std::cos(2.0 * p.x) * std::sin(p.y) * std::cos(p.z) +
                         std::cos(p.x) * std::cos(2.0 * p.y) * std::sin(p.z) +
                         std::sin(p.x) * std::cos(p.y) * std::cos(2.0 * p.z)) <= 0.1 * kPi * 2.443973;
       }},
  };
}

// A wave of period 2 pi, as high as its wall is thick, and the length of the highest frequency in it.
struct Wave {
  const char* name;
  Shape shape;
  double frequency;
};

std::vector<Wave> waves() {
  const Expr cell = 2.0 * kPi, thickness = 0.1;
  return {{"gyroid", gyroid(cell, thickness), std::sqrt(2.0)},
          {"schwarz_p", schwarzP(cell, thickness), 1.0},
          {"schwarz_d", schwarzD(cell, thickness), std::sqrt(3.0)},
          {"iwp", iwp(cell, thickness), 2.0},
          {"neovius", neovius(cell, thickness), std::sqrt(3.0)},
          {"lidinoid", lidinoid(cell, thickness), std::sqrt(8.0)},
          {"fischer_koch_s", fischerKochS(cell, thickness), std::sqrt(6.0)}};
}

// The squared slope has frequencies up to 2 f. Along any line its second derivative is no more than (2 f)^2
// times its largest value (Bernstein 1912). At that value its first one is 0; so where a cell of this radius
// has the largest value, its middle is below it by no more than half of (2 f radius)^2 of it. Cells whose
// middle is lower are done, and others are halved.
TEST(Lattices, AreNoSteeperThanOne) {
  constexpr double kRounding = 1e-6;
  for (const Wave& w : waves()) {
    const Tape tape(w.shape.distance);
    struct Cell {
      dvec3 middle;
      double half;
    };
    // From a place at which no wave is 0, where a wall's two sides meet.
    std::vector<Cell> cells{{dvec3(0.1, 0.2, 0.35) + kPi, kPi}};
    double steepest = 0.0;
    std::size_t looked = 0;
    while (!cells.empty() && ++looked < 20'000'000) {
      const Cell c = cells.back();
      cells.pop_back();
      const ValueAndGradient at = evaluateGradient(tape, c.middle);
      const double squared = glm::dot(at.gradient, at.gradient),
                   reach = 2.0 * w.frequency * std::sqrt(3.0) * c.half;
      steepest = std::max(steepest, squared);
      const double lower = 0.5 * reach * reach;
      if (lower < 1.0 && squared <= (1.0 - lower) * (1.0 + kRounding)) continue;
      for (int k = 0; k < 8; ++k)
        cells.push_back(
            {c.middle + 0.5 * c.half * dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), 0.5 * c.half});
    }
    EXPECT_TRUE(cells.empty()) << w.name;
    EXPECT_GT(steepest, 1.0 - 1e-4) << w.name;  // and there is no smaller slope to claim
  }
}

TEST(Solids, AreMadeOfThePointsThatTheirNamesSay) {
  for (const Membership& m : memberships()) {
    ASSERT_TRUE(m.shape.ok()) << *m.shape.error;
    const Evaluator f(m.shape.distance);
    Sampler sampler(Box::centred(dvec3(1.5)), kSeed);
    // Swept balls are told from 2000 of them, 1.2e-3 apart, which hides at most 1e-6 of their surface.
    constexpr double kUndecided = 1e-6;
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
      const dvec3 p = sampler.orOnAnAxis();
      const double value = f(p);
      if (std::abs(value) < kUndecided) continue;
      ASSERT_EQ(value < 0.0, m.inside(p)) << m.name << " at " << test::text(p) << ", seed " << kSeed;
      inside += value < 0.0;
    }
    EXPECT_GT(inside, 40) << m.name;
  }
}

// The edges of the grids, listed by their ends in the cubes around the origin.
std::vector<std::pair<dvec3, dvec3>> strutsOf(Struts kind) {
  std::vector<dvec3> nodes;
  const auto near = [](const dvec3& a, const dvec3& b, double length) {
    return std::abs(glm::distance(a, b) - length) < 1e-9;
  };
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      for (int z = -8; z <= 8; ++z) {
        const dvec3 p = 0.25 * dvec3(x, y, z);
        const bool isCorner = x % 4 == 0 && y % 4 == 0 && z % 4 == 0;
        const bool isMiddle =
            x % 4 != 0 && y % 4 != 0 && z % 4 != 0 && x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
        const bool isFace = x % 2 == 0 && y % 2 == 0 && z % 2 == 0 && (x + y + z) % 4 == 0;
        // Nearest to a corner as much as to three more of the corners and middles.
        int at[3] = {std::abs(x % 4), std::abs(y % 4), std::abs(z % 4)};
        for (int& i : at) i = std::min(i, 4 - i);
        std::ranges::sort(at);
        const bool isHole = at[0] == 0 && at[1] == 1 && at[2] == 2;
        if (kind == Struts::Cubic         ? isCorner
            : kind == Struts::BodyCentred ? isCorner || isMiddle
            : kind == Struts::Octet       ? isFace
                                          : isHole)
          nodes.push_back(p);
      }
  const double length = kind == Struts::Cubic         ? 1.0
                        : kind == Struts::BodyCentred ? std::sqrt(0.75)
                        : kind == Struts::Octet       ? std::sqrt(0.5)
                                                      : std::sqrt(0.125);
  std::vector<std::pair<dvec3, dvec3>> struts;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (near(nodes[i], nodes[k], length)) struts.emplace_back(nodes[i], nodes[k]);
  return struts;
}

TEST(StrutLattice, IsTheDistanceToItsStruts) {
  constexpr double kCell = 0.7, kRadius = 0.06;
  for (const Struts kind : {Struts::Cubic, Struts::BodyCentred, Struts::Octet, Struts::Kelvin}) {
    const std::vector<std::pair<dvec3, dvec3>> struts = strutsOf(kind);
    const Evaluator f(strutLattice(kind, kCell, kRadius).distance);
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution coordinate(-0.75, 0.75);
    for (int i = 0; i < 500; ++i) {
      const dvec3 p(coordinate(random), coordinate(random), coordinate(random));
      double least = kInfinity;
      for (const auto& [a, b] : struts) {
        const dvec3 way = b - a;
        const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
        least = std::min(least, glm::distance(p, a + t * way));
      }
      ASSERT_NEAR(f(kCell * p), kCell * least - kRadius, kRounding)
          << static_cast<int>(kind) << " at " << test::text(p);
    }
  }
}

// Springs flat and steep, of many turns and of a part of one, near the wire, near the axis and beyond the
// ends.
TEST(Spring, IsExactBesideAnyHelix) {
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int i = 0; i < 60; ++i) {
    const double radius = std::exp(uniform(-1.5, 1.5)), rise = std::exp(uniform(-5.0, 2.0)),
                 turns = std::exp(uniform(-1.5, 2.0)), last = kPi * turns, wire = 0.01 * radius;
    const bool left = i % 2 == 1;
    const Evaluator f(
        spring(radius, 2.0 * kPi * rise, turns, wire, left ? Hand::Left : Hand::Right).distance);
    const auto on = [&](double t) {
      return dvec3(radius * std::cos(t), rise * t, (left ? 1.0 : -1.0) * radius * std::sin(t));
    };
    for (int k = 0; k < 60; ++k) {
      const double far = k % 3 == 0 ? 0.05 : 1.5, t = uniform(-1.2, 1.2) * last;
      dvec3 p = on(t) + radius * far * dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (k % 5 == 0) p.x *= 1e-3, p.z *= 1e-3;
      constexpr int kSteps = 4000;
      const double step = 2.0 * last / kSteps;
      double least = kInfinity, at = 0.0;
      for (int j = 0; j <= kSteps; ++j)
        if (const double d = glm::distance(p, on(-last + j * step)); d < least)
          least = d, at = -last + j * step;
      for (double by = step; by > 1e-12 * last; by *= 0.5)
        for (const double next : {at - by, at + by})
          if (const double d = glm::distance(p, on(std::clamp(next, -last, last))); d < least)
            least = d, at = std::clamp(next, -last, last);
      const double size = std::hypot(radius, rise);
      ASSERT_NEAR(f(p), least - wire, 2e-6 * size)
          << "radius " << radius << ", rise " << rise << ", turns " << turns << " at " << test::text(p);
    }
  }
}

// Closest point on a dense sampling of the surface: at most `spacing` farther than the true one.
double nearest(const std::vector<dvec3>& surface, const dvec3& p) {
  double best = kInfinity;
  for (const dvec3& q : surface) best = std::min(best, glm::distance(p, q));
  return best;
}

// A surface of revolution from its profile, for points in the half-plane z = 0, x >= 0 alone.
std::vector<dvec3> sampledProfile(const std::vector<dvec3>& corners, double spacing) {
  std::vector<dvec3> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const int n = static_cast<int>(glm::distance(corners[i], corners[i + 1]) / spacing) + 1;
    for (int k = 0; k <= n; ++k) points.push_back(glm::mix(corners[i], corners[i + 1], double(k) / n));
  }
  return points;
}

std::vector<dvec3> sampledArc(double from, double to, double radius, double spacing) {
  std::vector<dvec3> points;
  const int n = static_cast<int>((to - from) * radius / spacing) + 1;
  for (int k = 0; k <= n; ++k) {
    const double a = from + (to - from) * k / n;
    points.push_back(radius * dvec3(std::sin(a), std::cos(a), 0));
  }
  return points;
}

TEST(Solids, AreAsFarAsTheNearestOfDenselySampledSurfacePoints) {
  constexpr double kSpacing = 1e-3;
  const auto joined = [](std::vector<dvec3> a, const std::vector<dvec3>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const double rim = std::sqrt(1.0 - 0.09);
  const struct {
    const char* name;
    Shape shape;
    std::vector<dvec3> profile;
  } table[] = {
      {"capped_cone", cappedCone(1.0, 0.4, 0.7),
       sampledProfile({{0, -0.7, 0}, {1, -0.7, 0}, {0.4, 0.7, 0}, {0, 0.7, 0}}, kSpacing)},
      {"wide capped_cone", cappedCone(0.2, 1.4, 0.1),
       sampledProfile({{0, -0.1, 0}, {0.2, -0.1, 0}, {1.4, 0.1, 0}, {0, 0.1, 0}}, kSpacing)},
      {"solid_angle", solidAngle(0.6, 1.0),
       joined(sampledProfile({{0, 0, 0}, {std::sin(0.6), std::cos(0.6), 0}}, kSpacing),
              sampledArc(0, 0.6, 1.0, kSpacing))},
      {"wide solid_angle", solidAngle(2.5, 1.0),
       joined(sampledProfile({{0, 0, 0}, {std::sin(2.5), std::cos(2.5), 0}}, kSpacing),
              sampledArc(0, 2.5, 1.0, kSpacing))},
      {"cut_sphere", cutSphere(1.0, 0.3),
       joined(sampledProfile({{0, 0.3, 0}, {rim, 0.3, 0}}, kSpacing),
              sampledArc(0, std::acos(0.3), 1.0, kSpacing))},
      {"deep cut_sphere", cutSphere(1.0, -0.3),
       joined(sampledProfile({{0, -0.3, 0}, {rim, -0.3, 0}}, kSpacing),
              sampledArc(0, std::acos(-0.3), 1.0, kSpacing))},
  };
  for (const auto& row : table) {
    const Evaluator f(row.shape.distance);
    Sampler sampler({{0, -1.7, 0}, {1.7, 1.7, 0}}, kSeed);
    for (int i = 0; i < 500; ++i) {
      const dvec3 p = sampler.anywhere();
      const double sampled = nearest(row.profile, p), value = std::abs(f(p));
      ASSERT_LE(value, sampled + kRounding) << row.name << " at " << test::text(p) << ", seed " << kSeed;
      ASSERT_GE(value, sampled - kSpacing) << row.name << " at " << test::text(p) << ", seed " << kSeed;
    }
  }
}

std::vector<dvec3> sampledTriangle(const dvec3& a, const dvec3& b, const dvec3& c, int n) {
  std::vector<dvec3> points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      points.push_back(a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n));
  return points;
}

TEST(Solids, WithFlatFacesAreAsFarAsTheNearestPointOfTheirFaces) {
  constexpr int kRows = 60;
  const auto faces = [](const std::vector<std::array<dvec3, 3>>& triangles) {
    std::vector<dvec3> all;
    for (const auto& t : triangles) {
      const auto some = sampledTriangle(t[0], t[1], t[2], kRows);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  };
  std::vector<std::array<dvec3, 3>> octahedral;
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0})
      for (double z : {-1.0, 1.0}) octahedral.push_back({dvec3(x, 0, 0), dvec3(0, y, 0), dvec3(0, 0, z)});
  const dvec3 t0(1, 1, 1), t1(1, -1, -1), t2(-1, 1, -1), t3(-1, -1, 1);
  const dvec3 tip(0, 0.5, 0), b0(1, -0.5, 1), b1(1, -0.5, -1), b2(-1, -0.5, -1), b3(-1, -0.5, 1);
  const struct {
    const char* name;
    Shape shape;
    std::vector<dvec3> surface;
    double longestEdge;
  } table[] = {
      {"octahedron", octahedron(1.0), faces(octahedral), std::sqrt(2.0)},
      {"tetrahedron", tetrahedron(std::sqrt(3.0)),
       faces({{t0, t1, t2}, {t0, t1, t3}, {t0, t2, t3}, {t1, t2, t3}}), std::sqrt(8.0)},
      {"pyramid", pyramid(1.0, 0.5),
       faces({{tip, b0, b1}, {tip, b1, b2}, {tip, b2, b3}, {tip, b3, b0}, {b0, b1, b2}, {b0, b2, b3}}),
       std::sqrt(8.0)},
  };
  for (const auto& row : table) {
    const Evaluator f(row.shape.distance);
    Sampler sampler(Box::centred(dvec3(1.8)), kSeed);
    for (int i = 0; i < 1000; ++i) {
      const dvec3 p = sampler.anywhere();
      const double sampled = nearest(row.surface, p), value = std::abs(f(p));
      ASSERT_LE(value, sampled + kRounding) << row.name << " at " << test::text(p) << ", seed " << kSeed;
      ASSERT_GE(value, sampled - row.longestEdge / kRows)
          << row.name << " at " << test::text(p) << ", seed " << kSeed;
    }
  }
}

TEST(Solids, AnswerFromAHundredThousandUnitsAwayAsTheDistanceToTheirCentre) {
  const dvec3 direction = glm::normalize(dvec3(1, 2, -3));
  for (const test::ShapeCase& c : test::primitiveCases()) {
    if (!c.shape.bounds.finite() || c.shape.claim.kind >= ClaimKind::Bound) continue;
    const double size = glm::length(c.shape.bounds.size()) + glm::length(c.shape.bounds.centre());
    EXPECT_NEAR(at(c.shape, direction * 1e5), 1e5, size) << c.name;
  }
}

TEST(Solids, TellOfABadArgumentInOneLine) {
  EXPECT_EQ(sphere(-1.0).error.value_or(""), "sphere: radius must be positive, got -1");
  EXPECT_EQ(sphere(position().x).error.value_or(""), "sphere: radius must not depend on position");
  EXPECT_EQ(solidAngle(kPi, 1.0).error.value_or(""),
            "solid_angle: angle must be above 0 and below 180 degrees, got 180");
  EXPECT_EQ(cutSphere(1.0, -2.0).error.value_or(""),
            "cut_sphere: height must lie between -radius and radius, 1, got -2");
  EXPECT_EQ(capsule({0.0, 0.0, 0.0}, {0.0, std::nan(""), 0.0}, 1.0).error.value_or(""),
            "capsule: to.y must be a finite number, got nan");
}

TEST(Solids, BoundsFollowTheUpperEndOfAParameter) {
  const Expr radius = Expr::parameter({"radius", 0.5, 0.1, 2.0});
  EXPECT_EQ(sphere(radius).bounds.max.x, 2.0);
  EXPECT_EQ(cylinder(1.0, radius).bounds.min.y, -2.0);
  EXPECT_EQ(plane({0.0, 2.0, 0.0}, radius).bounds.max.y, 2.0);
  EXPECT_EQ(plane({0.0, 2.0, 0.0}, radius).bounds.min.y, -kInfinity);
}

TEST(Solids, ClaimOnlyToBeExactOutsideWhereATubeMayRunIntoItself) {
  EXPECT_EQ(torus(1.0, 1.0).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(torus(1.0, 1.1).claim.kind, ClaimKind::ExactOutside);
  EXPECT_EQ(torus(1.0, Expr::parameter({"minor", 0.5, 0.0, 1.5})).claim.kind, ClaimKind::ExactOutside);
  EXPECT_EQ(cappedTorus(170 * kDegree, 1.0, 0.1).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(cappedTorus(170 * kDegree, 1.0, 0.2).claim.kind, ClaimKind::ExactOutside);
}

TEST(Field, TakesTheFormulaAsItIsAndClaimsOnlyItsSign) {
  const Vec3E p = position();
  const Expr formula = sin(3.0 * p.x) + p.y;
  const Shape s = field(formula);
  ASSERT_TRUE(s.ok());
  EXPECT_EQ(s.distance, formula);
  EXPECT_EQ(s.claim.kind, ClaimKind::Field);
  EXPECT_EQ(s.claim.lipschitz, formula.lipschitz());
  EXPECT_NEAR(s.claim.lipschitz, std::sqrt(3.0 * 3.0 + 1.0), 1e-12);
}

TEST(Field, TrustsABoundThatIsGivenWhereTheGraphProvesNone) {
  const Expr formula = square(position().x) - 7.0;
  EXPECT_EQ(field(formula).claim.lipschitz, kInfinity);
  const Box bounds = Box::centred(dvec3(5.0));
  const Shape s = field(formula, bounds, 10.0);
  EXPECT_EQ(s.claim.lipschitz, 10.0);
  EXPECT_TRUE(bounds.contains(s.bounds) && s.bounds.contains(bounds));
}

// Of a formula that is ever steeper, its bounds are where its slope counts, grown by half their side.
TEST(Field, HasASlopeWhereItsFormulaHasOneWithinItsBounds) {
  const Vec3E p = position();
  const Expr formula = dot(p, p) - 0.5;
  const Shape s = field(formula, Box::centred(dvec3(1.0)));
  const double steepest = 2.0 * 2.0 * std::sqrt(3.0);  // at a corner of the box of half size 2
  EXPECT_GE(slopeOf(s), steepest);
  EXPECT_LE(slopeOf(s), 1.01 * steepest);
  const test::Evaluator f(s.distance), g(formula);
  test::Sampler sampler(Box::centred(dvec3(5.0)), 3);
  for (int i = 0; i < 2000; ++i) {
    const dvec3 a = sampler.orOnAnAxis(), b = sampler.near(a, 0.5), far = glm::abs(a);
    ASSERT_LE(std::abs(f(a) - f(b)), slopeOf(s) * glm::length(a - b) + 1e-12) << test::text(a);
    const double outside = std::max({far.x, far.y, far.z}) - 2.0;
    if (outside <= 0.0) {
      ASSERT_EQ(f(a), g(a)) << test::text(a);
    } else {
      ASSERT_GE(f(a), outside) << test::text(a);
    }
  }
}

// A slope that is stated holds within the bounds: by the formula's own values from outside a march would step
// over the solid.
TEST(Field, NeverPromisesMoreThanTheWayToItsSolidOutsideOfWhereItsSlopeIsStated) {
  const Vec3E p = position();
  const Expr formula = square(dot(p, p)) - 0.25;
  const double radius = std::sqrt(0.5), slope = 4.0 * std::pow(3.0, 1.5);  // at a corner of the bounds
  const Box bounds = Box::centred(dvec3(1.0));
  const Shape s = field(formula, bounds, slope);
  ASSERT_TRUE(s.ok());
  EXPECT_EQ(slopeOf(s), slope);
  const test::Evaluator f(s.distance), g(formula);
  test::Sampler sampler(Box::centred(dvec3(8.0)), 5);
  for (int i = 0; i < 4000; ++i) {
    const dvec3 a = (i % 2 == 0 ? 1.0 : 0.125) * sampler.orOnAnAxis(),
                b = glm::clamp(sampler.near(a, 0.5), dvec3(-1.0), dvec3(1.0));
    ASSERT_LE(std::abs(f(a) - f(b)), slope * glm::length(a - b) * (1.0 + 1e-12) + 1e-12) << test::text(a);
    ASSERT_LE(f(a) / slope, std::abs(glm::length(a) - radius) + 1e-12) << test::text(a);
    ASSERT_LE(f(a), g(a)) << test::text(a);
    if (bounds.contains({a, a})) {
      ASSERT_EQ(f(a), g(a)) << test::text(a);
    }
  }
}

TEST(Field, OperatorsKeepTheSlopeThatItsBoundsGiveIt) {
  const Vec3E p = position();
  const Shape ball = field(dot(p, p) - 0.5, Box::centred(dvec3(1.0))), block = box(Vec3E(0.5));
  for (const Shape& s : {intersect(ball, block), subtract(ball, block), subtract(block, ball),
                         unite(ball, block, Blend::quadratic(0.1)), twist(ball, 1.0), round(ball, 0.1)})
    EXPECT_LT(slopeOf(s), 1e3);
}

TEST(Field, HasNoSlopeWhereItsFormulaJumps) {
  const Expr steps = position().y - floor(position().x);
  EXPECT_EQ(slopeOf(field(steps, Box::centred(dvec3(1.0)))), kInfinity);
  EXPECT_EQ(field(steps, Box::centred(dvec3(1.0))).distance, steps);
}

TEST(Field, RefusesTheNormalAndBoundsThatHoldNothing) {
  EXPECT_EQ(field(normal().x).error.value_or(""), "field: distance must not depend on the normal");
  EXPECT_EQ(field(position().x, Box{}).error.value_or(""), "field: bounds must not be empty");
  EXPECT_EQ(field(position().x, Box::everything(), 0.0).error.value_or(""),
            "field: lipschitz must be positive, got 0");
}

}  // namespace solids_test
}  // namespace sdf
