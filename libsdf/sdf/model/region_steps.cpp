#include "sdf/model/region_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "sdf/expr/payload.h"
#include "sdf/model/case_reading.h"

namespace sdf {
namespace {

// A table of one number for each cube, which is read at the point's place in it, in cubes. Outside of the
// table it is another number.
class CubeTable : public Payload {
 public:
  CubeTable(const glm::ivec3& size, std::vector<float> values, float outside)
      : outside_(outside), volumes_{{{"Cubes", size, 1, false, std::move(values)}}} {
    const auto [least, most] = std::ranges::minmax(volumes_[0].values);
    range_ = {std::min(least, outside), std::max(most, outside)};
  }

  double value(const glm::dvec3& p) const override {
    const glm::dvec3 cube = glm::floor(p);
    const glm::ivec3& size = volumes_[0].size;
    for (int k = 0; k < 3; ++k)
      if (!(cube[k] >= 0.0 && cube[k] < size[k])) return outside_;
    const glm::ivec3 at(cube);
    return volumes_[0].values[(static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x];
  }
  ValueAndGradient gradient(const glm::dvec3& p) const override { return {value(p), glm::dvec3(0.0)}; }
  Interval range(const std::array<Interval, 3>&) const override { return range_; }
  double lipschitz() const override { return HUGE_VAL; }
  double rounding(const glm::dvec3&) const override { return 0.0; }
  std::string glsl(const std::string& name) const override {
    return "uniform sampler3D " + name + "Cubes;\nfloat " + name +
           "(vec3 p) {\n"
           "  ivec3 size = textureSize(" +
           name +
           "Cubes, 0);\n"
           "  bool within = all(greaterThanEqual(p, vec3(0.0))) && all(lessThan(p, vec3(size)));\n"
           "  return within ? texelFetch(" +
           name + "Cubes, ivec3(p), 0).r : " + shown(outside_) +
           ";\n"
           "}\n"
           "vec3 " +
           name + "Slopes(vec3 p) { return vec3(0.0); }\n";
  }
  std::span<const PayloadVolume> volumes() const override { return volumes_; }

 private:
  static std::string shown(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9e", value);
    return text;
  }

  float outside_;
  std::array<PayloadVolume, 1> volumes_;
  Interval range_;
};

// What intervals know of a cube.
struct Cube {
  enum class Side { Outside, Mixed, Inside } side = Side::Mixed;
  double slope = kInfinity;
};

// The cubes of a box, halved where they may hold the surface.
class Cubes {
 public:
  Cubes(const Expr& distance, const Box& box, double slope)
      : distance_(std::make_shared<CaseReading>(distance)), slope_(slope) {
    const double side = box.longestSide() / kFirst;
    size_ = glm::max(glm::ivec3(glm::ceil(box.size() / side)), 1) + 2;
    side_ = side;
    origin_ = box.centre() - 0.5 * side * glm::dvec3(size_);
    cubes_.assign(count(), {});
    for (std::size_t i = 0; i < count(); ++i) cubes_[i] = read(i);
    divide();
  }

  double side() const { return side_; }
  const glm::dvec3& origin() const { return origin_; }

  // By how much faster one is at the surface than by the slope of all: the median of its cubes.
  double gain() const {
    std::vector<double> gains;
    for (std::size_t i = 0; i < count(); ++i)
      if (isMixed(i)) gains.push_back(slope_ / around(i));
    if (gains.empty()) return 0.0;
    const auto median = gains.begin() + static_cast<std::ptrdiff_t>(gains.size() / 2);
    std::ranges::nth_element(gains, median);
    return *median;
  }

  // For each cube how far one may go from anywhere in it, in scene units; where that is less than a cube's
  // side, the speed 1 / slope, negative.
  std::vector<float> table() const {
    constexpr double kLess = 1.0 - 1e-5;  // than is proven, for what is rounded
    const std::vector<double> free = freeAround();
    std::vector<float> values(count());
    for (std::size_t i = 0; i < count(); ++i)
      values[i] = static_cast<float>(kLess * (free[i] >= 1.0 ? free[i] * side_ : -1.0 / around(i)));
    return values;
  }
  const glm::ivec3& size() const { return size_; }

 private:
  // Tried: with 160 cubes along and ten times the operations a gyroid is read a third as often, but the start
  // takes seconds. kMostFree bounds what the search for free cubes costs, and is chosen.
  static constexpr int kFirst = 16, kMostAlong = 128, kMostFree = 16;
  static constexpr std::size_t kMostOperations = 4'000'000, kMostCubes = 50'000;

  std::size_t count() const { return static_cast<std::size_t>(size_.x) * size_.y * size_.z; }
  glm::ivec3 placeOf(std::size_t i) const {
    const auto n = static_cast<int>(i);
    return {n % size_.x, n / size_.x % size_.y, n / (size_.x * size_.y)};
  }
  std::size_t numberOf(const glm::ivec3& at) const {
    return (static_cast<std::size_t>(at.z) * size_.y + at.y) * size_.x + at.x;
  }
  bool isMixed(std::size_t i) const { return cubes_[i].side == Cube::Side::Mixed; }
  std::size_t mixed() const {
    return static_cast<std::size_t>(std::ranges::count(cubes_, Cube::Side::Mixed, &Cube::side));
  }

  // A little larger than it is: places in it are rounded.
  Cube read(std::size_t i) {
    const glm::dvec3 low = origin_ + side_ * glm::dvec3(placeOf(i));
    const Box box = Box{low, low + side_}.grown(1e-4 * side_);
    const auto [value, slope] = distance_->read(box);
    const auto side = value.nan        ? Cube::Side::Mixed
                      : value.lo > 0.0 ? Cube::Side::Outside
                      : value.hi < 0.0 ? Cube::Side::Inside
                                       : Cube::Side::Mixed;
    return {side, std::min(slope_, slope)};
  }

  bool isNearMixed(std::size_t i) const {
    bool is = false;
    forAround(i, [&](const Cube* cube) { is = is || (cube && cube->side == Cube::Side::Mixed); });
    return is;
  }

  // Some hundredths of a second's worth, as long as more cubes may help; some tenths where rays would run out
  // of steps else.
  void divide() {
    constexpr double kPromising = 1.25, kTooSteep = 64.0;
    // One halving more: of copies about an axis, stretched, a tenth as many pixels run out of steps.
    constexpr std::size_t kMore = 8;
    const std::size_t most =
        std::clamp<std::size_t>(kMostOperations / distance_->operations(), 1000, kMostCubes);
    bool isFirst = true;  // copies of a shape are told from one another by cubes that are small beside them
    while (2 * std::max({size_.x, size_.y, size_.z}) <= kMostAlong) {
      const double by = gain();
      const bool isTooSteep = by > 0.0 && slope_ / by > kTooSteep;
      if (!isFirst && by <= kPromising && !isTooSteep) return;
      if (8 * mixed() > (isTooSteep ? kMore : 1) * most) return;
      halve();
      isFirst = false;
    }
  }

  // Cubes whose parts have no use for more are copied.
  void halve() {
    Cubes finer = *this;
    finer.size_ = size_ * 2;
    finer.side_ = 0.5 * side_;
    finer.cubes_.assign(finer.count(), {});
    for (std::size_t i = 0; i < count(); ++i) {
      const bool isNear = isNearMixed(i);
      for (int part = 0; part < 8; ++part) {
        const std::size_t k = finer.numberOf(placeOf(i) * 2 + glm::ivec3(part & 1, part >> 1 & 1, part >> 2));
        finer.cubes_[k] = isNear ? finer.read(k) : cubes_[i];
        if (!isMixed(i)) finer.cubes_[k].side = cubes_[i].side;
        finer.cubes_[k].slope = std::min(finer.cubes_[k].slope, cubes_[i].slope);
      }
    }
    *this = std::move(finer);
  }

  // Calls visit for the cube and those that touch it; with null for those outside of the box.
  template <class Visit>
  void forAround(std::size_t i, const Visit& visit) const {
    const glm::ivec3 at = placeOf(i);
    for (int n = 0; n < 27; ++n) {
      const glm::ivec3 next = at + glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
      const bool within =
          glm::all(glm::greaterThanEqual(next, glm::ivec3(0))) && glm::all(glm::lessThan(next, size_));
      visit(within ? &cubes_[numberOf(next)] : nullptr);
    }
  }

  // Bounds the slope as far from the cube as its side.
  double around(std::size_t i) const {
    double most = 0.0;
    forAround(i, [&](const Cube* cube) { most = std::max(most, cube ? cube->slope : slope_); });
    return std::max(most, slope_ * 1e-6);
  }

  // For each cube how many sides away the nearest cube is that is not outside, kMostFree at most: along one
  // axis after the other (Saito and Toriwaki 1994).
  std::vector<double> freeAround() const {
    std::vector<double> squares(count());
    for (std::size_t i = 0; i < count(); ++i)
      squares[i] = cubes_[i].side == Cube::Side::Outside ? kInfinity : 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> next(count(), kInfinity);
      for (std::size_t i = 0; i < count(); ++i) {
        glm::ivec3 at = placeOf(i);
        const int here = at[axis];
        const int last = std::min(size_[axis] - 1, here + kMostFree);
        for (at[axis] = std::max(0, here - kMostFree); at[axis] <= last; ++at[axis]) {
          const int between = std::max(0, std::abs(at[axis] - here) - 1);
          next[i] = std::min(next[i], squares[numberOf(at)] + between * between);
        }
      }
      squares = std::move(next);
    }
    for (double& s : squares) s = std::min(std::sqrt(s), static_cast<double>(kMostFree));
    return squares;
  }

  std::shared_ptr<CaseReading> distance_;  // of cubes of any size
  double slope_;
  glm::ivec3 size_;
  double side_;
  glm::dvec3 origin_;
  std::vector<Cube> cubes_;
};

bool hasInputs(const Expr& e) {
  return std::ranges::any_of(topologicalOrder({&e, 1}),
                             [](const Expr& node) { return node.op() == Op::Parameter; });
}

std::optional<Expr> made(const Expr& distance, const Box& box, double slope) {
  constexpr double kWorthwhile = 2.0;
  const Cubes cubes(distance, box, slope);
  if (!(cubes.gain() >= kWorthwhile)) return {};
  const auto table =
      std::make_shared<CubeTable>(cubes.size(), cubes.table(), static_cast<float>(-1.0 / slope));
  const glm::dvec3 o = cubes.origin();
  const double perSide = 1.0 / cubes.side();
  const Vec3E p = position();
  const Expr known =
      Expr::payload({table, 0}, {(p.x - o.x) * perSide, (p.y - o.y) * perSide, (p.z - o.z) * perSide});
  return select(less(0.0, known), known, min(distance * -known, cubes.side()));
}

struct Kept {
  Expr distance;
  Box box;
  double slope;
  std::optional<Expr> step;
};

}  // namespace

std::optional<Expr> stepByRegion(const Expr& distance, const Box& box, double slope) {
  constexpr std::size_t kMostKept = 16;
  static std::mutex lock;
  static std::deque<Kept> kept;
  if (!box.finite() || box.empty() || !(slope < kInfinity) || hasInputs(distance)) return {};
  const std::lock_guard guard(lock);
  const auto found = std::ranges::find_if(kept, [&](const Kept& k) {
    return k.distance == distance && k.box.min == box.min && k.box.max == box.max && k.slope == slope;
  });
  if (found != kept.end()) return found->step;
  kept.push_back({distance, box, slope, made(distance, box, slope)});
  if (kept.size() > kMostKept) kept.pop_front();
  return kept.back().step;
}

}  // namespace sdf
