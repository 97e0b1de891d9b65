#include "sdf/model/region_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "sdf/base/parallel.h"
#include "sdf/expr/payload.h"
#include "sdf/model/case_reading.h"

namespace sdf {
namespace {

// A table of one number for each cube, which is read at the point's place in it, in cubes. Beyond its edge
// the edge goes on.
class CubeTable : public Payload {
 public:
  CubeTable(const glm::ivec3& size, std::vector<float> values)
      : volumes_{{{"Cubes", size, 1, false, std::move(values)}}} {
    const auto [least, most] = std::ranges::minmax(volumes_[0].values);
    range_ = {least, most};
  }

  double value(const glm::dvec3& p) const override {
    const glm::ivec3& size = volumes_[0].size;
    glm::ivec3 at(0);
    for (int k = 0; k < 3; ++k)
      if (p[k] > 0.0) at[k] = static_cast<int>(std::min(p[k], size[k] - 0.5));
    return volumes_[0].values[(static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x];
  }
  ValueAndGradient gradient(const glm::dvec3& p) const override { return {value(p), glm::dvec3(0.0)}; }
  Interval range(const std::array<Interval, 3>&) const override { return range_; }
  double lipschitz() const override { return HUGE_VAL; }
  double rounding(const glm::dvec3&) const override { return 0.0; }
  std::string glsl(const std::string& name) const override {
    return "uniform sampler3D " + name + "Cubes;\nfloat " + name +
           "(vec3 p) {\n"
           "  vec3 last = vec3(textureSize(" +
           name +
           "Cubes, 0)) - 0.5;\n"
           "  return texelFetch(" +
           name +
           "Cubes, ivec3(min(max(p, vec3(0.0)), last)), 0).r;\n"
           "}\n"
           "vec3 " +
           name + "Slopes(vec3 p) { return vec3(0.0); }\n";
  }
  std::span<const PayloadVolume> volumes() const override { return volumes_; }
  std::string_view kind() const override { return "table of cubes"; }

 private:
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
    read(std::vector<char>(count(), true));
    divide();
  }

  double side() const { return side_; }

  // By how much faster one is at the surface than by the slope of all: the median of its cubes. Where there
  // is no surface nothing bounds it.
  double gain() const {
    std::vector<double> gains;
    for (std::size_t i = 0; i < count(); ++i)
      if (isMixed(i)) gains.push_back(slope_ / around(i));
    if (gains.empty()) return kInfinity;
    const auto median = gains.begin() + static_cast<std::ptrdiff_t>(gains.size() / 2);
    std::ranges::nth_element(gains, median);
    return *median;
  }

  // For each cube how far one may go from anywhere in it, in scene units; where that is less than a cube's
  // side, the speed 1 / slope, negative. A layer of cubes around them stands for all of space beyond.
  std::shared_ptr<const Payload> table() const {
    constexpr double kLess = 1.0 - 1e-5;  // than is proven, for what is rounded
    const std::vector<double> free = freeAround();
    const glm::ivec3 size = size_ + 2;
    std::vector<float> values(static_cast<std::size_t>(size.x) * size.y * size.z,
                              static_cast<float>(-kLess / slope_));
    for (std::size_t i = 0; i < count(); ++i) {
      const glm::ivec3 at = placeOf(i) + 1;
      values[(static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x] =
          static_cast<float>(kLess * (free[i] >= 1.0 ? free[i] * side_ : -1.0 / around(i)));
    }
    return std::make_shared<CubeTable>(size, std::move(values));
  }
  glm::dvec3 cornerOfTable() const { return origin_ - side_; }

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

  // Reads some of the cubes. So many parts whatever the cores are: a reading keeps tapes of its own.
  void read(const std::vector<char>& which) {
    constexpr std::size_t kParts = 16;
    inParallel(kParts, [&](std::size_t part) {
      CaseReading distance = *distance_;
      for (std::size_t i = part * count() / kParts; i < (part + 1) * count() / kParts; ++i)
        if (which[i]) cubes_[i] = cubeAt(i, distance);
    });
  }

  // A little larger than it is: places in it are rounded.
  Cube cubeAt(std::size_t i, CaseReading& distance) const {
    const glm::dvec3 low = origin_ + side_ * glm::dvec3(placeOf(i));
    const Box box = Box{low, low + side_}.grown(1e-4 * side_);
    const auto [value, slope] = distance.read(box);
    const auto side = value.nan        ? Cube::Side::Mixed
                      : value.lo > 0.0 ? Cube::Side::Outside
                      : value.hi < 0.0 ? Cube::Side::Inside
                                       : Cube::Side::Mixed;
    return {side, std::min(slope_, slope)};
  }

  // Those that may hold the surface, and those that touch them.
  std::vector<char> nearMixed() const {
    std::vector<char> are(count(), false);
    for (std::size_t i = 0; i < count(); ++i)
      if (isMixed(i))
        forAround(i, [&](const Cube* cube) {
          if (cube) are[static_cast<std::size_t>(cube - cubes_.data())] = true;
        });
    return are;
  }

  // Some hundredths of a second's worth, as long as more cubes may help; some tenths where rays would run out
  // of steps else.
  void divide() {
    constexpr double kPromising = 1.25;
    // One halving more: of copies about an axis, stretched, a tenth as many pixels run out of steps.
    constexpr std::size_t kMore = 8;
    const std::size_t most =
        std::clamp<std::size_t>(kMostOperations / distance_->operations(), 1000, kMostCubes);
    bool isFirst = true;  // copies of a shape are told from one another by cubes that are small beside them
    while (2 * std::max({size_.x, size_.y, size_.z}) <= kMostAlong) {
      const double by = gain();
      if (by == kInfinity) return;
      const bool isTooSteep = slope_ / by > kTooSteep;
      if (!isFirst && by <= kPromising && !isTooSteep) return;
      if (8 * mixed() > (isTooSteep ? kMore : 1) * most) return;
      halve();
      isFirst = false;
    }
  }

  // Cubes whose parts have no use for more are copied.
  void halve() {
    const Cubes coarse = *this;
    size_ *= 2;
    side_ *= 0.5;
    cubes_.assign(count(), {});
    const std::vector<char> near = coarse.nearMixed();
    std::vector<char> isRead(count(), false);
    const auto around = [&](std::size_t i) { return coarse.numberOf(placeOf(i) / 2); };
    for (std::size_t i = 0; i < count(); ++i) isRead[i] = near[around(i)];
    read(isRead);
    for (std::size_t i = 0; i < count(); ++i) {
      const Cube& whole = coarse.cubes_[around(i)];
      if (!isRead[i]) cubes_[i] = whole;
      if (whole.side != Cube::Side::Mixed) cubes_[i].side = whole.side;
      cubes_[i].slope = std::min(cubes_[i].slope, whole.slope);
    }
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

  template <class Visit>
  void forSlice(int axis, int slice, const Visit& visit) const {
    glm::ivec3 from(0), to = size_;
    from[axis] = slice;
    to[axis] = slice + 1;
    for (int z = from.z; z < to.z; ++z)
      for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) visit(numberOf({x, y, z}), {x, y, z});
  }

  // The least of the squares along a row, each with that of the cubes between.
  static double leastAlong(const double* own, std::size_t stride, int place, int size) {
    double least = *own;
    for (int k = 1; k <= kMostFree && (k - 1) * (k - 1) < least; ++k) {
      const double between = (k - 1) * (k - 1);
      if (place >= k) least = std::min(least, *(own - k * stride) + between);
      if (place + k < size) least = std::min(least, own[k * stride] + between);
    }
    return least;
  }

  // For each cube how many sides away the nearest cube is that is not outside, kMostFree at most: along one
  // axis after the other (Saito and Toriwaki 1994).
  std::vector<double> freeAround() const {
    std::vector<double> squares(count());
    for (std::size_t i = 0; i < count(); ++i)
      squares[i] = cubes_[i].side == Cube::Side::Outside ? kInfinity : 0.0;
    const std::size_t strides[] = {1, static_cast<std::size_t>(size_.x),
                                   static_cast<std::size_t>(size_.x) * size_.y};
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> next(count());
      const int slices = axis == 2 ? 1 : 2;  // along an axis that is not walked
      inParallel(static_cast<std::size_t>(size_[slices]), [&](std::size_t slice) {
        forSlice(slices, static_cast<int>(slice), [&](std::size_t i, const glm::ivec3& at) {
          next[i] = leastAlong(&squares[i], strides[axis], at[axis], size_[axis]);
        });
      });
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

RegionStep made(const Expr& distance, const Box& box, double slope) {
  const Cubes cubes(distance, box, slope);
  const std::vector<Expr> order = topologicalOrder({&distance, 1});
  // Of what hangs on an input they are formulas of it: shaders have such as uniforms, whatever they are.
  const auto input = std::ranges::find(order, Op::Parameter, &Expr::op);
  const auto number = [&](double v) { return input == order.end() ? Expr(v) : v + 0.0 * *input; };
  const glm::dvec3 corner = cubes.cornerOfTable();
  const Vec3E o(number(corner.x), number(corner.y), number(corner.z)), p = position();
  const Expr perSide = number(1.0 / cubes.side());
  const Expr known = Expr::payload({cubes.table(), 0},
                                   {(p.x - o.x) * perSide, (p.y - o.y) * perSide, (p.z - o.z) * perSide});
  return RegionStep{select(less(0.0, known), known, min(distance * -known, number(cubes.side()))),
                    cubes.gain()};
}

struct Kept {
  Expr distance;
  Box box;
  double slope;
  RegionStep step;
};

}  // namespace

std::optional<RegionStep> stepByRegion(const Expr& distance, const Box& box, double slope) {
  constexpr std::size_t kMostKept = 16;
  static std::mutex lock;
  static std::deque<Kept> kept;
  if (!box.finite() || box.empty() || !(slope < kInfinity)) return {};
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
