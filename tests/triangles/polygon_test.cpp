// Polygons cut into triangles.
#include "sdf/triangles/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "sdf/triangles/closed.h"
#include "sdf/triangles/orientation.h"
#include "support/triangle_meshes.h"

namespace sdf::test {
namespace polygon_test {

using Outline = std::vector<glm::dvec2>;

/// A polygon in space, cut.
struct Cut {
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> corners;
  std::vector<glm::uvec3> triangles;
  bool whole = false;
};

Cut cutOf(const std::vector<glm::vec3>& points, const std::vector<std::uint32_t>& corners) {
  Cut cut{points, corners, {}};
  cut.whole = cutPolygon(cut.points, cut.corners, cut.triangles);
  return cut;
}
Cut cutOf(const std::vector<glm::vec3>& points) {
  std::vector<std::uint32_t> corners(points.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  return cutOf(points, corners);
}

std::vector<glm::vec3> turned(const Outline& outline, const glm::dmat3& by = glm::dmat3(1.0)) {
  std::vector<glm::vec3> points;
  for (const glm::dvec2& p : outline) points.emplace_back(by * glm::dvec3(p, 0.0));
  return points;
}

glm::dmat3 randomTurn(std::mt19937& random) {
  const glm::dvec3 z = glm::normalize(randomIn(random, 1.0)),
                   x = glm::normalize(glm::cross(z, randomIn(random, 1.0)));
  return {x, glm::cross(z, x), z};
}

glm::dvec3 areaOf(const Cut& cut, const glm::uvec3& t) {
  const glm::dvec3 a(cut.points[t.x]), b(cut.points[t.y]), c(cut.points[t.z]);
  return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 areaOf(const Cut& cut) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i + 1 < cut.corners.size(); ++i)
    sum += areaOf(cut, {cut.corners[0], cut.corners[i], cut.corners[i + 1]});
  return sum;
}

/// Two triangles less than corners; each edge of the outline once, each other one once there and once back.
void expectEdges(const Cut& cut) {
  const std::size_t count = cut.corners.size();
  ASSERT_EQ(cut.triangles.size(), count - 2);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> times;
  for (const glm::uvec3& t : cut.triangles)
    for (int k = 0; k < 3; ++k) ++times[{t[k], t[(k + 1) % 3]}], --times[{t[(k + 1) % 3], t[k]}];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = cut.corners[i], b = cut.corners[(i + 1) % count];
    --times[{a, b}], ++times[{b, a}];
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](const auto& edge) { return edge.second == 0; }));
}

/// The triangles fill the polygon and nothing else: each faces as it does, and their areas add up to its own.
void expectFilled(const Cut& cut) {
  EXPECT_TRUE(cut.whole);
  expectEdges(cut);
  const glm::dvec3 area = areaOf(cut), normal = glm::normalize(area);
  double sum = 0.0;
  std::size_t away = 0;
  for (const glm::uvec3& t : cut.triangles) {
    const glm::dvec3 one = areaOf(cut, t);
    sum += glm::length(one);
    away += !(glm::dot(one, normal) >= 0.9 * glm::length(one));
  }
  EXPECT_EQ(away, 0u);
  EXPECT_NEAR(sum, glm::length(area), 1e-5 * sum);
}

Outline starShaped(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> radius(0.1, 1.0);
  Outline out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners, r = radius(random);
    out.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return out;
}

/// Teeth of any lengths on a bar.
Outline comb(std::mt19937& random, int teeth) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Outline out{{2.0 * teeth, -1.0 - part(random)}};
  for (int i = teeth; i-- > 0;)
    for (const double x : {0.9, 0.6, 0.4, 0.1})
      out.emplace_back(2.0 * (i + x), x == 0.6 || x == 0.4 ? 1.0 + 9.0 * part(random) : 0.5 * part(random));
  out.emplace_back(0.0, -1.0 - part(random));
  return out;
}

TEST(CutPolygon, FillsWhatIsStarShaped) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    expectFilled(cutOf(turned(starShaped(random, 3 + static_cast<int>(seed)), randomTurn(random))));
  }
}

TEST(CutPolygon, FillsCombs) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    expectFilled(cutOf(turned(comb(random, 1 + static_cast<int>(seed) / 2), randomTurn(random))));
  }
}

TEST(CutPolygon, FillsALongSpiral) {
  constexpr int kCorners = 4000;
  Outline outline;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < kCorners; ++i) {
      const int at = side == 0 ? i : kCorners - 1 - i;
      const double angle = 40.0 * std::numbers::pi * at / kCorners,
                   r = 1.0 + 0.1 * angle + (side == 0 ? 0.4 : 0.0);
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  expectFilled(cutOf(turned(outline)));
}

// Two of four corners on each side are in the middle of it: a triangle of three on a side would have no area.
TEST(CutPolygon, MakesNoFlatTriangleOfCornersOnOneSide) {
  std::mt19937 random(1);
  for (const glm::dmat3& turn : {glm::dmat3(1.0), randomTurn(random)}) {
    for (const int parts : {2, 3, 10, 25}) {
      const Outline corners{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
      Outline outline;
      for (std::size_t i = 0; i < corners.size(); ++i)
        for (int k = 0; k < parts; ++k)
          outline.push_back(glm::mix(corners[i], corners[(i + 1) % corners.size()], 1.0 * k / parts));
      const Cut cut = cutOf(turned(outline, turn));
      expectFilled(cut);
      for (const glm::uvec3& t : cut.triangles) EXPECT_GT(glm::length(areaOf(cut, t)), 1e-4);
    }
  }
}

// The shortest diagonal of all runs along the lower side, where the others lie.
TEST(CutPolygon, DoesNotCutOffCornersAlongOthers) {
  const Cut cut = cutOf(turned({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 9}}));
  expectFilled(cut);
  for (const glm::uvec3& t : cut.triangles) EXPECT_GT(glm::length(areaOf(cut, t)), 1.0);
}

// An edge leads to the hole and back: its ends are corners twice.
TEST(CutPolygon, FillsARingWhoseHoleAnEdgeLeadsTo) {
  for (const std::uint32_t count : {3u, 4u, 50u, 1000u}) {
    Outline outline;
    std::vector<std::uint32_t> corners;
    for (const double r : {1.0, 0.3})
      for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
      }
    for (std::uint32_t i = 0; i <= count; ++i) corners.push_back(i % count);
    for (std::uint32_t i = 0; i <= count; ++i) corners.push_back(count + (count - i) % count);
    std::mt19937 random(count);
    for (int i = 0; i < 5; ++i) {
      expectFilled(cutOf(turned(outline, randomTurn(random)), corners));
      std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count / 2), corners.end());
    }
  }
}

TEST(CutPolygon, FillsWhatTouchesItselfInACorner) {
  const Outline points{{0, 0}, {2, -1}, {2, 1}, {-2, 1}, {-2, -1}, {-1, 3}, {1, 3}};
  expectFilled(cutOf(turned(points), {0, 1, 2, 0, 3, 4}));
  expectFilled(cutOf(turned(points), {0, 1, 2, 0, 6, 5, 0, 3, 4}));
  // From inside: a square with a notch that reaches the other side.
  const Outline square{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1.5, 2}, {0.5, 2}, {0, 2}};
  expectFilled(cutOf(turned(square), {0, 1, 2, 3, 4, 1, 5, 6}));
}

std::vector<glm::vec3> circle(std::uint32_t count) {
  std::vector<glm::vec3> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return points;
}

TEST(CutPolygon, LetsFewTrianglesMeetInACornerOfARoundOne) {
  for (const std::uint32_t count : {64u, 5000u, 100'000u}) {
    const Cut cut = cutOf(circle(count));
    EXPECT_TRUE(cut.whole);
    EXPECT_EQ(cut.triangles.size(), count - 2);
    EXPECT_NEAR(glm::length(areaOf(cut)), 0.5 * count * std::sin(2.0 * std::numbers::pi / count), 1e-5);
    std::vector<int> around(count, 0);
    for (const glm::uvec3& t : cut.triangles)
      for (int k = 0; k < 3; ++k) ++around[t[k]];
    EXPECT_LE(*std::ranges::max_element(around), 120);  // a fan's are count - 2
  }
}

// So what is before a polygon and what is behind it cancel out.
TEST(CutPolygon, CutsThePolygonAlikeFromBehind) {
  std::mt19937 random(3);
  for (const auto& points : {circle(3000), turned(starShaped(random, 500), randomTurn(random))}) {
    Cut cut = cutOf(points);
    std::ranges::reverse(cut.corners);
    std::rotate(cut.corners.begin(), cut.corners.begin() + static_cast<std::ptrdiff_t>(points.size() / 3),
                cut.corners.end());
    EXPECT_TRUE(cutPolygon(cut.points, cut.corners, cut.triangles));
    TriangleMesh both;
    both.positions = cut.points;
    both.triangles = cut.triangles;
    EXPECT_TRUE(closed(both).triangles.empty());
  }
}

using Diagonal = std::pair<std::uint32_t, std::uint32_t>;
Diagonal diagonalOf(const Cut& cut) {
  std::vector<std::uint32_t> shared;
  for (const std::uint32_t corner : cut.corners)
    if (std::ranges::all_of(cut.triangles, [&](const glm::uvec3& t) {
          return t.x == corner || t.y == corner || t.z == corner;
        }))
      shared.push_back(corner);
  EXPECT_EQ(shared.size(), 2u);
  return shared.size() == 2 ? Diagonal(std::minmax(shared[0], shared[1])) : Diagonal();
}

TEST(CutPolygon, CutsQuadsAlongTheSameDiagonalWhereverTheyBegin) {
  const glm::vec3 bent(1, 1, 0.5f), long_(2, 2, 0.5f);
  const std::vector<std::pair<std::vector<glm::vec3>, Diagonal>> quads{
      {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 2}},  // as long: that with the first point
      {{{0, 0, 0}, {1, 0, 0}, bent, {0, 1, 0}}, {1, 3}},       // the shorter one
      {{{0, 0, 0}, {1, 0, 0}, long_, {0, 1, 0}}, {1, 3}},
      {{{0, 0, 0}, {4, 1, 0}, {0.5f, 0.5f, 0}, {1, 4, 0}}, {0, 2}},  // the inner one
      {{{0, 0, 0}, {2, -4, 0}, {4, 0, 0}, {2, -1, 0}}, {1, 3}},
      {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 9, 0}}, {1, 3}},  // the shorter one would cut nothing off
      {{{0, 0, 0}, {1, -1e-7f, 0}, {2, 0, 0}, {1, 9, 0}}, {1, 3}},
  };
  for (const auto& [points, diagonal] : quads) {
    std::vector<std::uint32_t> corners{0, 1, 2, 3};
    for (int i = 0; i < 8; ++i) {
      const Cut cut = cutOf(points, corners);
      EXPECT_TRUE(cut.whole);
      expectEdges(cut);
      EXPECT_EQ(diagonalOf(cut), diagonal) << "quad " << &points - &quads[0].first << ", " << i;
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (i == 3) std::ranges::reverse(corners);
    }
  }
}

TEST(CutPolygon, KeepsTheOutlineOfWhatCrossesItselfAndSaysSo) {
  const Outline bowTie{{0, 0}, {1, 1}, {1, 0}, {0, 1}},
      larger{{0, 0}, {2, 2}, {2, 1}, {2, 0}, {0, 2}, {0, 1}}, flag{{0, 0}, {3, 0}, {3, 1}, {1, -1}, {0, 1}};
  const glm::dmat3 upright(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
  for (const Outline& outline : {bowTie, larger, flag})
    for (const glm::dmat3& turn : {glm::dmat3(1.0), upright}) {
      const Cut cut = cutOf(turned(outline, turn));
      EXPECT_FALSE(cut.whole) << outline.size();
      expectEdges(cut);
    }
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> points;
    for (unsigned i = 0; i < 30 + seed; ++i) points.emplace_back(randomIn(random, 1.0));
    const Cut cut = cutOf(points);
    EXPECT_FALSE(cut.whole);
    expectEdges(cut);
  }
}

TEST(CutPolygon, TakesEdgesThatGoBackAndCornersThatAreTwice) {
  const Outline points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {3, 3}, {1, 1}};
  for (const std::vector<std::uint32_t>& corners :
       std::vector<std::vector<std::uint32_t>>{{0, 1, 1, 2, 3},
                                               {0, 1, 2, 4, 2, 3},
                                               {0, 1, 2, 5, 2, 3},
                                               {0, 0, 0, 1, 2, 3, 3},
                                               {0, 1, 0, 1, 0, 1}}) {
    const Cut cut = cutOf(turned(points), corners);
    EXPECT_TRUE(cut.whole);
    expectEdges(cut);
    double sum = 0.0;
    for (const glm::uvec3& t : cut.triangles) sum += glm::length(areaOf(cut, t));
    EXPECT_NEAR(sum, glm::length(areaOf(cut)), 1e-9);
  }
}

TEST(CutPolygon, EndsWhateverTheCoordinatesAre) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const float values[] = {0.0f,   1.0f,   -1.0f,     0.1f,
                          1e-45f, 3e38f,  -3e38f,    std::numeric_limits<float>::quiet_NaN(),
                          -0.0f,  1e-30f, kInfinite, -kInfinite};
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> points;
    const unsigned kinds = seed % 2 == 0 ? 5u : 12u;
    for (unsigned i = 0; i < 3 + seed % 40; ++i) {
      const float x = values[random() % kinds], y = values[random() % kinds], z = values[random() % kinds];
      points.emplace_back(x, y, seed % 3 == 0 ? 0.0f : z);
    }
    expectEdges(cutOf(points));
  }
}

TEST(Orientation, IsExact) {
  std::mt19937 random(1);
  // Whole numbers, of which 64 bits hold the determinant, next to one line; scaled by powers of two.
  std::uniform_int_distribution<std::int64_t> far(-(1 << 23), 1 << 23), near(-1, 1);
  int zeros = 0;
  for (int i = 0; i < 100'000; ++i) {
    const std::int64_t ax = far(random), ay = far(random), bx = far(random), by = far(random);
    const std::int64_t cx = (ax + bx) / 2 + near(random), cy = (ay + by) / 2 + near(random);
    const std::int64_t exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    const float scale = std::ldexp(1.0f, i % 100 - 80);
    const auto at = [&](std::int64_t x, std::int64_t y) {
      return scale * glm::vec2(static_cast<float>(x), static_cast<float>(y));
    };
    ASSERT_EQ(orientation(at(ax, ay), at(bx, by), at(cx, cy)), (exact > 0) - (exact < 0));
    zeros += exact == 0;
  }
  EXPECT_GT(zeros, 1000);
  // Differences that a double rounds.
  const glm::vec2 tiny(1e-30f, 1e-30f), one(1.0f, 1.0f), large(1e15f, 1e15f);
  EXPECT_EQ(orientation(tiny, one, large), 0);
  EXPECT_EQ(orientation({1e-30f, 2e-30f}, one, large), 1);
  EXPECT_EQ(orientation({2e-30f, 1e-30f}, one, large), -1);
}

}  // namespace polygon_test
}  // namespace sdf::test
