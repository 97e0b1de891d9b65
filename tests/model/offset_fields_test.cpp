// Seeded fields whose value is no distance, at any scale: a wall around one has the thickness that is asked
// for, or is found to have not. The distances here are those to a dense set of points of the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/model/offset_check.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::offset_fields_test {

class Fields {
 public:
  explicit Fields(unsigned seed) : random_(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }

  // A formula around the origin that is solid within about 1.
  Expr any(const Vec3E& p, int depth) {
    switch (std::uniform_int_distribution<>(0, depth > 0 ? 7 : 3)(random_)) {
      case 0:
        return square(p.x / near()) + square(p.y / near()) + square(p.z / near()) - 1.0;
      case 1:
        return square(square(p.x / near())) + square(square(p.y / near())) + square(square(p.z / near())) -
               1.0;
      case 2:
        return pow(abs(p.x) / near(), 3.0) + pow(abs(p.y) / near(), 3.0) + pow(abs(p.z) / near(), 3.0) - 1.0;
      case 3:
        return (p.x * uniform(-1.0, 1.0) + p.y * uniform(-1.0, 1.0) + p.z - 0.3) * uniform(0.2, 5.0);
      case 4:
        return any(p, depth - 1) * (square(p.x) + square(p.y) + uniform(0.5, 2.0));
      case 5: {
        const Expr f = any(p, depth - 1);
        return f * square(f);
      }
      case 6:
        return min(any(p, depth - 1), any(p, depth - 1));
      default:
        return max(any(p, depth - 1), any(p, depth - 1));
    }
  }

 private:
  double near() { return uniform(0.6, 1.1); }
  std::mt19937 random_;
};

// Zeros of f on the edges of a grid.
std::vector<glm::dvec3> zerosOf(const Tape& f, double half, int cells) {
  const auto at = [&](const glm::ivec3& i) { return glm::dvec3(i) * (2.0 * half / cells) - half; };
  std::vector<double> values;
  const int n = cells + 1;
  for (int i = 0; i < n * n * n; ++i) values.push_back(evaluate(f, at({i % n, i / n % n, i / (n * n)})));
  const int steps[] = {1, n, n * n};
  std::vector<glm::dvec3> zeros;
  for (int i = 0; i < n * n * n; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const glm::ivec3 from(i % n, i / n % n, i / (n * n));
      if (from[axis] == cells || (values[i] > 0.0) == (values[i + steps[axis]] > 0.0)) continue;
      glm::ivec3 to = from;
      ++to[axis];
      glm::dvec3 lo = at(from), hi = at(to);
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 mid = 0.5 * (lo + hi);
        ((evaluate(f, mid) > 0.0) == (values[i] > 0.0) ? lo : hi) = mid;
      }
      zeros.push_back(lo);
    }
  return zeros;
}

// How far the wall's two sides are from the surface, in amounts, each the nearest of its points.
std::vector<double> distancesOf(const Tape& f, const Tape& wall, double half, double amount) {
  constexpr int kCells = 40, kCoarse = 16;
  const std::vector<glm::dvec3> surface = zerosOf(f, half, kCells);
  std::vector<double> all;
  for (const glm::dvec3& q : zerosOf(wall, half, kCoarse)) {
    double least = kInfinity;
    for (const glm::dvec3& p : surface) least = std::min(least, glm::distance(p, q));
    // Farther than this the surface may be nearer beyond the grid.
    const glm::dvec3 out = glm::abs(q) + amount * 1.5;
    if (std::max({out.x, out.y, out.z}) < half) all.push_back(least / amount);
  }
  return all;
}

TEST(OffsetFields, AreRightOrFoundToBeWrong) {
  constexpr int kSeeds = 24;
  // The nearest point of the grid's edges is at most so much farther than the nearest of the surface, in
  // amounts: the edges are 0.5 apart.
  constexpr double kGrid = 0.12, kOff = 0.1;
  int right = 0, wrong = 0, plainlyRight = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Fields fields(seed);
    const double size = std::pow(10.0, fields.uniform(-3.0, 3.0)), amount = 0.14 * size, half = 1.4 * size;
    const Vec3E p = position() * (1.0 / size);
    const Box bounds = Box::centred(glm::dvec3(1.1 * size));
    // Within the bounds whatever it is.
    const Expr f = max(fields.any(p, 2), max(abs(p.x), max(abs(p.y), abs(p.z))) - 1.1);
    const Shape s = field(f, bounds), skin = shell(s, 2.0 * amount);
    ASSERT_TRUE(skin.ok());
    const auto found = checkOffset({f, skin.distance, amount, bounds, true, true});
    const auto plain = checkOffset({f, abs(s.distance) - amount, amount, bounds, true, true});
    if (!found || !plain) continue;
    plainlyRight += !plain->wrong();
    const std::vector<double> all = distancesOf(Tape(f), Tape(skin.distance), half, amount);
    if (all.size() < 20) continue;  // hardly any of it is within the bounds
    const auto isOff = [&](double d) { return d < 1.0 - kOff || d > 1.0 + kOff + kGrid; };
    // The check looks at some dozens of points: what is off at one of twenty it must not miss.
    const auto off = static_cast<std::size_t>(std::ranges::count_if(all, isOff));
    if (20 * off > all.size()) {
      EXPECT_TRUE(found->wrong()) << off << " of " << all.size() << " are off, found "
                                  << found->least / amount << " to " << found->most / amount;
    }
    (found->wrong() ? wrong : right) += 1;
  }
  // Which fields these are hangs on the order in which a compiler draws numbers: 8 of GCC's, 7 of clang's
  // are.
  EXPECT_GE(right, kSeeds / 4);
  EXPECT_LE(plainlyRight, kSeeds / 12);
  EXPECT_GE(right + wrong, kSeeds * 3 / 4);
}

}  // namespace sdf::offset_fields_test
