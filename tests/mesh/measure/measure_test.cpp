#include <gtest/gtest.h>

#include "mesh/scenes.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "sdf/triangles/incidence.h"

namespace sdf::test {
namespace measure_test {

using Triangles = std::vector<glm::uvec3>;

const Triangles kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// The same with its vertices renamed.
Triangles tetrahedron(unsigned a, unsigned b, unsigned c, unsigned d) {
  const unsigned name[] = {a, b, c, d};
  Triangles t = kTetrahedron;
  for (glm::uvec3& v : t) v = {name[v.x], name[v.y], name[v.z]};
  return t;
}

Triangles operator+(Triangles a, const Triangles& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A grid of quads, cut in two, that closes on itself both ways.
Triangles torusGrid(unsigned n, unsigned m) {
  Triangles t;
  auto at = [&](unsigned i, unsigned j) { return i % n * m + j % m; };
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < m; ++j) {
      t.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      t.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return t;
}

Triangles cube() {
  Triangles t;
  const unsigned quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    t.emplace_back(q[0], q[1], q[2]);
    t.emplace_back(q[0], q[2], q[3]);
  }
  return t;
}

struct TopologyCase {
  const char* name;
  Triangles triangles;
  std::size_t vertices;
  bool watertight, manifold;
  int components, euler;
  std::size_t used;
};

TEST(MeasureTopology, TellsHandMadeMeshesApart) {
  Triangles turned = kTetrahedron;
  std::swap(turned[2].x, turned[2].y);
  const TopologyCase cases[] = {
      {"tetrahedron", kTetrahedron, 4, true, true, 1, 2, 4},
      {"cube", cube(), 8, true, true, 1, 2, 8},
      {"torus", torusGrid(5, 7), 35, true, true, 1, 0, 35},
      {"two apart", kTetrahedron + tetrahedron(4, 5, 6, 7), 8, true, true, 2, 4, 8},
      {"two that share a vertex", kTetrahedron + tetrahedron(3, 4, 5, 6), 7, true, false, 1, 3, 7},
      {"two that share an edge", kTetrahedron + tetrahedron(0, 1, 4, 5), 6, true, false, 1, 2 + 2 - 2 + 1, 6},
      {"open", {kTetrahedron.begin(), kTetrahedron.end() - 1}, 4, false, false, 1, 1, 4},
      {"one triangle turned round", turned, 4, false, false, 1, 2, 4},
      {"the same triangle twice, as a flat pocket", {{0, 1, 2}, {0, 2, 1}}, 3, true, true, 1, 2, 3},
      {"with vertices that nothing uses", tetrahedron(2, 5, 7, 9), 12, true, true, 1, 2, 4},
      {"nothing", {}, 0, false, false, 0, 0, 0},
  };
  for (const TopologyCase& c : cases) {
    SCOPED_TRACE(c.name);
    MeshStats s;
    measureTopology(c.triangles, c.vertices, s);
    EXPECT_EQ(s.watertight, c.watertight);
    EXPECT_EQ(s.manifold, c.manifold);
    EXPECT_EQ(s.components, c.components);
    EXPECT_EQ(s.eulerCharacteristic, c.euler);
    EXPECT_EQ(s.vertices, c.used);
    EXPECT_EQ(s.triangles, c.triangles.size());
  }
}

TEST(OpenVertex, LiesWhereATriangleIsMissing) {
  const Triangles open{{4, 6, 5}, {4, 5, 7}, {5, 6, 7}};  // the tetrahedron without its last one, {6, 4, 7}
  EXPECT_EQ(openVertex(open, 8), 4u);
  EXPECT_EQ(openVertex(kTetrahedron + open, 8), 4u);
}

// The regular octahedron with corners at this distance from the origin.
struct Octahedron {
  std::vector<glm::vec3> positions;
  Triangles triangles;

  explicit Octahedron(float radius) {
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {radius, -radius}) {
        glm::vec3 p(0.0f);
        p[axis] = side;
        positions.push_back(p);
      }
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned a = i & 1, b = 2 + (i >> 1 & 1), c = 4 + (i >> 2 & 1);
      const bool odd = (i ^ i >> 1 ^ i >> 2) & 1;
      triangles.push_back(odd ? glm::uvec3(a, c, b) : glm::uvec3(a, b, c));
    }
  }
};

MeshStats distanceTo(const Shape& shape, double h, const std::vector<glm::vec3>& positions,
                     const Triangles& triangles) {
  const NarrowBand band = bandOf(shape, shape.bounds, h);
  MeshStats stats;
  Progress progress;
  measureDistance(positions, triangles, BandField(band, wholeTapes(tapeOf(shape))), progress, stats);
  return stats;
}

TEST(MeasureDistance, KnowsHowFarTheChordsOfASphereSag) {
  // In an octahedron with corners at R, faces lie at R / sqrt(3); halfway to a corner at half R.
  const double r = 1.0, rounding = 16.0 * kRoundoff;
  // Found exactly by first order (coarse voxels), or doubted and looked for along the gradient (fine ones),
  // which bisects a step of 2/16 voxel twenty times.
  for (const double h : {1.0, 0.25}) {
    const double precision = rounding + 2.0 * h / 16.0 * 0x1p-20;
    for (const double corners : {1.0, 1.25}) {
      SCOPED_TRACE(testing::Message() << "voxel " << h << ", corners at " << corners);
      const Octahedron mesh(static_cast<float>(corners));
      const double face = corners / std::sqrt(3.0), middle = r - face;
      const MeshStats s = distanceTo(sphere(r), h, mesh.positions, mesh.triangles);
      EXPECT_NEAR(s.maxDistance, std::max(middle, corners - r), precision);
    }
  }
}

// A triangle in the plane y = 0 below the surface y = height * quadratic(x, z).
double meanSquareAbove(const Triangles& triangles, const std::vector<glm::vec3>& p,
                       double (*quadratic)(double, double)) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; i + j < kSteps; ++j)
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
        if (third > 0.5 && i + j + 1 == kSteps) continue;
        const double u = (i + third) / kSteps, v = (j + third) / kSteps;
        const glm::dvec3 at = (1.0 - u - v) * glm::dvec3(p[triangles[0].x]) +
                              u * glm::dvec3(p[triangles[0].y]) + v * glm::dvec3(p[triangles[0].z]);
        const double d = quadratic(at.x, at.z);
        sum += d * d;
        ++count;
      }
  return sum / count;
}

TEST(MeasureDistance, AveragesQuadraticDistancesExactly) {
  constexpr double kHeight = 1.0 / 256;
  struct Quadratic {
    double (*value)(double, double);
    Expr (*formula)(const Expr&, const Expr&);
    double slope;  // at most, over the triangles
  };
  // A bowl and a trough, both of either sign as below a balanced triangle, a saddle, and a slope.
  const Quadratic quadratics[] = {{[](double x, double z) { return x * x + z * z - 0.2; },
                                   [](const Expr& x, const Expr& z) { return x * x + z * z - 0.2; }, 3.0},
                                  {[](double x, double) { return x * x - 0.1; },
                                   [](const Expr& x, const Expr&) { return x * x - 0.1; }, 2.0},
                                  {[](double x, double z) { return x * z + 0.01; },
                                   [](const Expr& x, const Expr& z) { return x * z + 0.01; }, 1.5},
                                  {[](double x, double z) { return x - 0.5 * z; },
                                   [](const Expr& x, const Expr& z) { return x - 0.5 * z; }, 1.2}};
  const std::vector<glm::vec3> shapes[] = {{{-0.5f, 0, -0.3f}, {0, 0, 0.6f}, {0.5f, 0, -0.3f}},
                                           {{-1, 0, 0}, {-1, 0, 0.1f}, {1, 0, 0.2f}},
                                           {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}};
  const Triangles triangle{{0, 1, 2}};
  for (std::size_t i = 0; i < std::size(quadratics); ++i)
    for (std::size_t k = 0; k < std::size(shapes); ++k) {
      SCOPED_TRACE(testing::Message() << "quadratic " << i << ", triangle " << k);
      const Quadratic& q = quadratics[i];
      const Vec3E p = position();
      const Shape surface = field(p.y - kHeight * q.formula(p.x, p.z), region(1.25), 1.1);
      const double rms = distanceTo(surface, 0.125, shapes[k], triangle).rmsDistance;
      const double expected = kHeight * std::sqrt(meanSquareAbove(triangle, shapes[k], q.value));
      // First-order distances divide by the slope, sqrt(1 + g^2); the grid of 200 steps is right to a
      // 200th^2; and floats of some products of numbers about 1 are rounded.
      const double steep = kHeight * q.slope;
      EXPECT_NEAR(rms, expected, expected * (0.5 * steep * steep + 1.0 / (200.0 * 200.0)) + 8.0 * kRoundoff);
    }
}

TEST(MeasureDistance, SeesASphereThatIsTooLargeByTheDifference) {
  const double r = 1.0, h = 1.0 / 32, moved = 0.01;
  NarrowBand band = bandOf(sphere(r), region(r), h);
  RawSurface s = band.extract();
  for (glm::vec3& p : s.points) p *= static_cast<float>(r + moved) / glm::length(p);
  const MeshStats stats = distanceTo(sphere(r), h, s.points, s.triangles);
  // Triangles sag to the inside by up to 3/2 h² / r (see dualMeshError), towards the true sphere.
  const double sag = 1.5 * h * h / r, rounding = 16.0 * kRoundoff;
  EXPECT_NEAR(stats.maxDistance, moved, rounding);
  EXPECT_LE(stats.rmsDistance, moved + rounding);
  EXPECT_GE(stats.rmsDistance, moved - sag);
}

TEST(MeasureDistance, WeighsTrianglesByTheirArea) {
  // A large triangle on the plane and one of a hundredth of its area, one unit above.
  const Shape ground = plane({0.0, 1.0, 0.0}, 0.0) & box(Vec3E(20.0));
  std::vector<glm::vec3> p{{0, 0, 0}, {0, 0, 10}, {10, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 0}};
  const MeshStats s = distanceTo(ground, 2.0, p, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_NEAR(s.maxDistance, 1.0, 4.0 * kRoundoff);
  EXPECT_NEAR(s.rmsDistance, std::sqrt(0.5 / 50.5), 4.0 * kRoundoff);
}

TEST(MeasureDistance, LooksForTheSurfaceWhereTheSlopeSaysLittle) {
  // |p|² - 1 is nearly level around the origin: at 0.1 its first-order distance is 4.95.
  const Vec3E p = position();
  const Shape shape = field(dot(p, p) - 1.0, region(1.0), kInfinity);
  const double h = 0.5, at = 0.1;
  const float a = static_cast<float>(at);
  const std::vector<glm::vec3> dot{{a, 0, 0}, {a, 0x1p-20f, 0}, {a, 0, 0x1p-20f}};
  const MeshStats s = distanceTo(shape, h, dot, {{0, 1, 2}});
  EXPECT_NEAR(s.maxDistance, 1.0 - at, 2.0 * h / 16.0 * 0x1p-20 + 8.0 * kRoundoff);
}

// What is measured of a triangle that is hardly larger than a point, across x.
MeshStats distanceOfPoint(const Expr& formula, double h, const glm::vec3& p) {
  return distanceTo(field(formula, region(1.0), kInfinity), h,
                    {p, p + glm::vec3(0, 0x1p-20f, 0), p + glm::vec3(0, 0, 0x1p-20f)}, {{0, 1, 2}});
}

TEST(MeasureDistance, LooksAroundWhereTheGradientLeadsNowhere) {
  // Half a ball, by a jump and by a root of negative numbers: the gradient beside its flat face runs along
  // it.
  const Expr ball = length(position()) - 1.0, x = position().x;
  const double h = 1.0 / 16, precision = kFarthestVoxels * h / 16.0 * 0x1p-20 + 8.0 * kRoundoff;
  for (const float at : {-0.03125f, 0.03125f}) {
    const glm::vec3 p(at, 0.3125f, 0.0f);
    const MeshStats jump = distanceOfPoint(select(less(x, 0.0), ball, 1.0), h, p);
    EXPECT_NEAR(jump.maxDistance, std::abs(at), precision);
    EXPECT_LE(glm::distance(jump.farthest, p), 0x1p-19f);
    const MeshStats root = distanceOfPoint(ball + 0.0 * sqrt(x), h, p);
    EXPECT_NEAR(root.maxDistance, std::abs(at), precision);
    EXPECT_NEAR(root.rmsDistance, std::abs(at), precision);
  }
}

TEST(MeasureDistance, KeepsTheFirstOrderFigureBeyondTheFarthestOfARightMesh) {
  const Expr ball = length(position()) - 1.0;
  const double h = 1.0 / 16, away = kFarthestVoxels * h;
  for (const double d : {1.5 * away, 0.5 * away}) {
    const MeshStats s = distanceOfPoint(ball, h, {0.0f, 1.0f - static_cast<float>(d), 0.0f});
    EXPECT_NEAR(s.maxDistance, d, 8.0 * kRoundoff);
  }
}

// By first order u^3 is u / 3 from its zero, and however steep the bound says that it is, the zero stays
// where it is.
TEST(MeasureDistance, OfAFieldThatIsFlatOnItsSurfaceIsNotItsFirstOrder) {
  const double h = 1.0 / 16, off = 0.02;
  const Expr u = length(position()) - 1.0;
  for (const double bound : {1.0, 1e2, 1e6})
    for (const double side : {1.0 - off, 1.0 + off}) {
      const float x = static_cast<float>(side);
      const MeshStats s = distanceTo(field(u * u * u, region(1.5), bound), h,
                                     {{x, 0, 0}, {x, 0x1p-20f, 0}, {x, 0, 0x1p-20f}}, {{0, 1, 2}});
      EXPECT_NEAR(s.maxDistance, off, 1e-3 * off) << bound << ", " << side;
    }
}

// Beyond a rim the nearest point is on the rim; either face's plane is much nearer where they meet at an
// acute angle.
TEST(MeasureDistance, BeyondAThinRimIsThatToTheRim) {
  const double h = 1.0 / 100, r = 0.6, apart = 0.2, rim = std::sqrt(r * r - apart * apart / 4.0);
  const Shape crescent = subtract(sphere(r), translate(sphere(r), {apart, 0.0, 0.0}));
  for (const double off : {0.1 * h, 0.5 * h, h})
    for (const double turn : {0.3, 1.0, 2.0}) {
      const glm::vec3 p(0.5 * apart + off, rim * std::cos(turn), rim * std::sin(turn));
      const MeshStats s = distanceTo(
          crescent, h, {p, p + glm::vec3(0x1p-20f, 0, 0), p + glm::vec3(0, 0x1p-20f, 0)}, {{0, 1, 2}});
      EXPECT_GE(s.maxDistance, 0.999 * off);
      EXPECT_LE(s.maxDistance, 1.1 * off);  // planes for balls
    }
}

// Inside of two balls, two voxels from the circle in which they meet: nothing of them is nearer.
TEST(MeasureDistance, FromWithinAUnionIsThatToWhereItsPartsMeet) {
  const Vec3E p = position(), apart(0.8, 0.0, 0.0), a = p - apart, b = p + apart;
  const Expr formula = min(dot(a, a) - 1.0, dot(b, b) - 1.0);
  const double h = 0.15;
  for (const double turn : {0.2, 0.9, 2.0, 3.5, 5.1})
    for (const double x : {-0.07, 0.0, 0.04})
      for (const double radius : {0.3, 0.4}) {
        const glm::dvec3 from(x, radius * std::cos(turn), radius * std::sin(turn));
        const double truth = std::hypot(x, 0.6 - radius);
        EXPECT_NEAR(distanceOfPoint(formula, h, from).maxDistance, truth, 0.01 * truth)
            << turn << ", " << x << ", " << radius;
      }
}

}  // namespace measure_test
}  // namespace sdf::test
