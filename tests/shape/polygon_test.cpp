// Polygons of many sides against all of their sides read one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/polygon_field.h"
#include "support/polygons.h"

namespace sdf {
namespace polygon_test {

using glm::dvec2;
using Points = std::vector<dvec2>;

constexpr double kPi = std::numbers::pi;

/// Counter-clockwise about the origin, with radii from 0.2 to 1: corners of all angles, of both kinds.
Points jagged(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  Points corners;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * kPi * i / n, r = radius(random);
    corners.push_back(r * dvec2(std::cos(a), std::sin(a)));
  }
  return corners;
}

Points round(int n) {
  Points corners;
  for (int i = 0; i < n; ++i) corners.push_back({std::cos(2.0 * kPi * i / n), std::sin(2.0 * kPi * i / n)});
  return corners;
}

/// A comb whose teeth are as wide as the gaps between them; four corners each.
Points comb(int teeth) {
  Points corners{{0.0, -1.0}, {1.0, -1.0}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double a = (2 * i + 1) / (2.0 * teeth), b = i / static_cast<double>(teeth);
    if (i + 1 == teeth) corners.push_back({a + 0.5 / teeth, 0.0});
    corners.insert(corners.end(), {{a, 0.0}, {a, 1.0}, {b, 1.0}, {b, 0.0}});
  }
  corners.pop_back();
  return corners;
}

/// A band of two turns and more, whose outline runs in and out again.
Points spiral(int n) {
  Points in, out;
  for (int i = 0; i < n / 2; ++i) {
    const double a = 5.0 * kPi * i / (n / 2), r = 0.1 + 0.15 * a / kPi;
    out.push_back((r + 0.1) * dvec2(std::cos(a), std::sin(a)));
    in.push_back(r * dvec2(std::cos(a), std::sin(a)));
  }
  out.insert(out.end(), in.rbegin(), in.rend());
  return out;
}

struct Named {
  std::string name;
  Points corners;
};

std::vector<Named> manyPolygons() {
  std::vector<Named> all{{"round", round(1000)}, {"comb", comb(60)}, {"spiral", spiral(600)}};
  for (const unsigned seed : {1u, 2u, 3u})
    all.push_back({"jagged " + std::to_string(seed), jagged(150, seed)});
  return all;
}

/// Points all around, beside corners and sides, and exactly on their heights.
Points placesAround(const Points& corners, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-2.0, 2.0), near(-1e-3, 1e-3), share(0.0, 1.0);
  Points places;
  for (int i = 0; i < count; ++i) {
    const dvec2 a = corners[random() % corners.size()], b = corners[random() % corners.size()];
    const std::size_t side = random() % corners.size();
    const dvec2 on = glm::mix(corners[side], corners[(side + 1) % corners.size()], share(random));
    places.push_back({any(random), any(random)});
    places.push_back({a.x, b.y});
    places.push_back(a + dvec2(near(random), near(random)));
    places.push_back(on + dvec2(near(random), near(random)));
  }
  return places;
}

TEST(PolygonOfManySides, HasTheDistanceToAllOfThem) {
  for (const auto& [name, corners] : manyPolygons()) {
    SCOPED_TRACE(name);
    const PolygonDistance distance(corners);
    std::uint32_t hint = 0;
    for (const dvec2& p : placesAround(corners, 500, 5)) {
      const PolygonDistance::Read read = distance.read(p, hint);
      const double expected = test::outlineDistance(corners, p);
      hint = read.side;
      ASSERT_NEAR(std::abs(read.distance), expected, 1e-14) << p.x << ", " << p.y;
      ASSERT_NEAR(glm::length(read.gradient), 1.0, 1e-12);
      if (expected < 1e-14) continue;
      ASSERT_EQ(read.distance < 0.0, test::inPolygon(corners, p)) << p.x << ", " << p.y;
      ASSERT_NEAR(test::outlineDistance(corners, p - read.distance * read.gradient), 0.0, 1e-13);
    }
  }
}

TEST(PolygonOfManySides, IsZeroAtItsCornersWithAGradient) {
  for (const auto& [name, corners] : manyPolygons()) {
    const PolygonDistance distance(corners);
    for (const dvec2& p : corners) {
      const PolygonDistance::Read read = distance.read(p);
      ASSERT_NEAR(read.distance, 0.0, 1e-16) << name;
      ASSERT_NEAR(glm::length(read.gradient), 1.0, 1e-12) << name;
    }
  }
}

TEST(PolygonOfManySides, HasItsValuesInItsRanges) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.5, 1.5), size(0.0, 0.5);
  for (const auto& [name, corners] : manyPolygons()) {
    const auto field = PolygonField::of(corners);
    for (int i = 0; i < 200; ++i) {
      const dvec2 lo(any(random), any(random)), sides(size(random), size(random));
      const Interval range =
          field->range({Interval{lo.x, lo.x + sides.x}, {lo.y, lo.y + sides.y}, {0.0, 1.0}});
      for (int k = 0; k < 20; ++k) {
        const dvec2 p = lo + sides * dvec2((k % 5) / 4.0, (k / 5) / 3.0);
        const double f = field->value({p, 0.0});
        ASSERT_TRUE(range.lo <= f && f <= range.hi) << name;
      }
    }
  }
}

// No number stays none, and what is infinitely far has such a distance.
TEST(PolygonOfManySides, KnowsNumbersThatAreNone) {
  const auto field = PolygonField::of(round(100));
  EXPECT_TRUE(std::isnan(field->value({NAN, 0.0, 0.0})));
  EXPECT_EQ(field->value({HUGE_VAL, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(field->value({0.0, -HUGE_VAL, NAN}), HUGE_VAL);
  EXPECT_TRUE(field->range({Interval{0.0, 1.0, true}, {0.0, 1.0}, {0.0, 1.0}}).nan);
  EXPECT_EQ(field->range({Interval{-HUGE_VAL, HUGE_VAL}, {0.0, 1.0}, {0.0, 1.0}}).hi, HUGE_VAL);
}

// Scripts that run again, and the moments of an animation, have the same nodes.
TEST(PolygonOfManySides, IsTheSameNodeWhereItsCornersAre) {
  const Shape a = polygon(jagged(500, 1)), b = polygon(jagged(500, 1)), c = polygon(jagged(500, 2));
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_NE(a.distance, c.distance);
}

// The same in both directions, with any corner first, and with the first one once more.
TEST(PolygonOfManySides, IsReadFromAnyOrderOfItsCorners) {
  const Points corners = jagged(300, 4);
  Points turned = corners, back(corners.rbegin(), corners.rend()), closed = corners;
  std::rotate(turned.begin(), turned.begin() + 70, turned.end());
  closed.push_back(corners[0]);
  const Tape tape(polygon(corners).distance);
  for (const Points& other : {turned, back, closed}) {
    const Tape same(polygon(other).distance);
    for (const dvec2& p : placesAround(corners, 50, 6))
      ASSERT_NEAR(evaluate(same, {p, 0.3}), evaluate(tape, {p, -2.0}), 1e-15);
  }
}

// Far from the origin the corners are kept about the polygon's middle.
TEST(PolygonOfManySides, IsAsExactFarAway) {
  const dvec2 far(5'000'000.0, -300'000.0);
  Points corners = jagged(200, 3);
  for (dvec2& p : corners) p += far;
  const Shape shape = polygon(corners);
  const Tape tape(shape.distance);
  for (const dvec2& p : placesAround(jagged(200, 3), 50, 6))
    ASSERT_NEAR(std::abs(evaluate(tape, {p + far, 0.0})), test::outlineDistance(corners, p + far), 2e-9);
  EXPECT_EQ(shape.bounds.min.x, std::ranges::min(corners, {}, &dvec2::x).x);
}

// The first two sides that touch, as a search through all pairs has them.
std::string firstFault(const Points& p) {
  const auto turn = [](const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (j + 1 - i == n) continue;
      const dvec2 &a = p[i], &b = p[(i + 1) % n], &c = p[j], &d = p[(j + 1) % n];
      if (turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0)
        return "polygon: edges " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
               " touch or cross";
    }
  return "";
}

TEST(PolygonOfManySides, NamesTheFirstSidesThatCross) {
  std::mt19937 random(8);
  int crossed = 0;
  for (int i = 0; i < 60; ++i) {
    Points corners = jagged(40 + 5 * i, 100 + i);
    std::swap(corners[random() % corners.size()], corners[random() % corners.size()]);
    const std::string fault = firstFault(corners);
    EXPECT_EQ(polygon(corners).error.value_or(""), fault);
    crossed += !fault.empty();
  }
  EXPECT_GT(crossed, 40);
}

// A search through all pairs would take minutes.
TEST(PolygonOfManySides, IsCheckedInLittleTime) {
  Points corners = round(200'000);
  EXPECT_TRUE(polygon(corners).ok());
  std::swap(corners[150'000], corners[150'010]);
  EXPECT_EQ(polygon(corners).error.value_or(""), "polygon: edges 150000 and 150011 touch or cross");
  EXPECT_TRUE(polygon(jagged(20'000, 1)).ok());
}

// What shaders read: lists where the polygon is near, patches elsewhere, and no more of them than are stated.
TEST(PolygonCellsTest, AreFew) {
  for (const Points& corners : {round(40), spiral(5000), jagged(1000, 1), comb(500)}) {
    const PolygonCells cells{PolygonDistance(corners)};
    const glm::ivec3& size = cells.volume.size;
    EXPECT_GT(cells.lists, 0);
    EXPECT_LE(cells.lists + cells.patches, 200'000);
    EXPECT_EQ(cells.volume.values.size(), 4u * static_cast<std::size_t>(size.x) * size.y * size.z);
    EXPECT_LE(cells.longest, 32);
  }
}

}  // namespace polygon_test
}  // namespace sdf
