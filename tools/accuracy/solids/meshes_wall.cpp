#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "accuracy/check_points.h"
#include "meshes.h"

namespace sdf::accuracy {
namespace {

/// The solid wave <= level over a lattice of tetrahedra (Kuhn's six to a cube), closed where the lattice
/// ends.
class Level {
 public:
  /// `end`: where an edge to the lattice's last layer is cut, as a share of it.
  Level(const Wave& wave, double level, int periods, int cellsAPeriod, double end)
      : wave_(wave), level_(level), end_(end), count_(periods * cellsAPeriod + 1) {
    step_ = 2.0 * kPi / cellsAPeriod;
    for (int i = 0; i < count_ * count_ * count_; ++i) values_.push_back(wave.value(place(i)) - level);
  }

  std::vector<Triangle> triangles() {
    for (int k = 0; k + 1 < count_; ++k)
      for (int j = 0; j + 1 < count_; ++j)
        for (int i = 0; i + 1 < count_; ++i) addCube({i, j, k});
    return std::move(triangles_);
  }
  /// Bound of the distance from the triangles to the wave's level set, radians.
  double chord() const { return chord_; }

 private:
  int index(const glm::ivec3& c) const { return (c.z * count_ + c.y) * count_ + c.x; }
  glm::ivec3 cell(int i) const { return {i % count_, i / count_ % count_, i / count_ / count_}; }
  // Off the wave's symmetry planes, so that no node is on the level.
  glm::dvec3 place(int i) const {
    return step_ * (glm::dvec3(cell(i)) - 0.5 * (count_ - 1) + glm::dvec3(0.137, 0.219, 0.331));
  }
  bool last(int i) const {
    const glm::ivec3 c = cell(i);
    return std::min(c.x, std::min(c.y, c.z)) == 0 || std::max(c.x, std::max(c.y, c.z)) == count_ - 1;
  }
  bool inside(int i) const { return !last(i) && values_[i] <= 0.0; }

  void addCube(const glm::ivec3& c) {
    constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : kOrders) {
      glm::ivec3 at = c;
      std::array<int, 4> corners{index(at)};
      for (int k = 0; k < 3; ++k) ++at[order[k]], corners[k + 1] = index(at);
      addTetrahedron(corners);
    }
  }

  void addTetrahedron(const std::array<int, 4>& corners) {
    std::vector<int> in, out;
    for (const int c : corners) (inside(c) ? in : out).push_back(c);
    if (in.empty() || out.empty()) return;
    if (in.size() == 2) {
      add(in, out, {in[0], out[0], in[0], out[1], in[1], out[1]});
      add(in, out, {in[0], out[0], in[1], out[1], in[1], out[0]});
    } else if (in.size() == 1) {
      add(in, out, {in[0], out[0], in[0], out[1], in[0], out[2]});
    } else {
      add(in, out, {in[0], out[0], in[1], out[0], in[2], out[0]});
    }
  }

  // The triangle through three edges; its plane has the inner corners on one side.
  void add(const std::vector<int>& in, const std::vector<int>& out, const std::array<int, 6>& edges) {
    Triangle t;
    bool ends = false;
    for (int k = 0; k < 3; ++k) {
      const int a = edges[2 * k], b = edges[2 * k + 1];
      ends = ends || last(a) || last(b);
      t[k] = crossing(std::min(a, b), std::max(a, b));
    }
    if (!ends) chord_ = std::max(chord_, distanceBound(t));
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (glm::dot(normal, place(out[0]) - place(in[0])) < 0.0) std::swap(t[1], t[2]);
    triangles_.push_back(t);
  }

  // Where the wave has the level between two nodes, by regula falsi (the Illinois variant) to a few
  // roundings.
  glm::dvec3 crossing(int a, int b) const {
    constexpr double kRounding = 1e-15;
    const glm::dvec3 from = place(a), way = place(b) - from;
    if (last(a) || last(b)) return from + way * (inside(a) ? end_ : 1.0 - end_);
    double lo = 0.0, hi = 1.0, atLo = values_[a], atHi = values_[b], t = 0.5;
    for (int step = 0; step < 20; ++step) {
      t = (lo * atHi - hi * atLo) / (atHi - atLo);
      const double at = wave_.value(from + t * way) - level_;
      if (std::abs(at) < kRounding) break;
      if ((at > 0.0) == (atHi > 0.0)) {
        hi = t, atHi = at, atLo *= 0.5;
      } else {
        lo = t, atLo = at, atHi *= 0.5;
      }
    }
    return from + t * way;
  }

  // The wave keeps its level at the corners, and its Hessian is at most c = curvature. By Taylor's formula at
  // a point q with weights w_i it is off by at most c / 2 sum w_i |v_i - q|^2 <= c / 2 r^2, the triangle
  // lying in a ball of radius r. There the slope G is at least that in the middle less r c; along it the wave
  // is back on its level after at most t with c / 2 t^2 - G t + c / 2 r^2 = 0. Where that has no root, the
  // level set still passes through the triangle's own tetrahedron.
  double distanceBound(const Triangle& t) const {
    const double c = wave_.curvature;
    const glm::dvec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    double r = 0.0;
    for (const glm::dvec3& p : t) r = std::max(r, glm::length(p - middle));
    const auto [x, y, z] = derivatives(wave_.value, middle, 1e-5);
    const double diameter = std::numbers::sqrt3 * step_;
    if (std::isinf(c)) return diameter;
    const double slope = glm::length(glm::dvec3(x, y, z)) - r * c, root = slope * slope - c * c * r * r;
    return slope > 0.0 && root >= 0.0 ? std::min(diameter, (slope - std::sqrt(root)) / c) : diameter;
  }

  const Wave& wave_;
  double level_, end_, step_, chord_ = 0.0;
  int count_;
  std::vector<double> values_;
  std::vector<Triangle> triangles_;
};

}  // namespace

// The wall is wave <= level without wave <= -level: the mesh is both surfaces, the inner one turned inside
// out, so that a ray to the outside crosses it once from within the wall. Two periods are meshed and one is
// tried; where the solids are cut off the two surfaces cross, half a period from any tried point, which is
// farther than the walls are.
Tessellation wall(const Wave& wave, double cell, double thickness, int cellsAPeriod) {
  constexpr int kPeriods = 2;
  const double radians = 2.0 * kPi / cell, level = 0.5 * thickness * radians * wave.steepest;
  Level outer(wave, level, kPeriods, cellsAPeriod, 0.5), inner(wave, -level, kPeriods, cellsAPeriod, 0.25);
  std::vector<Triangle> triangles = outer.triangles();
  for (Triangle& t : inner.triangles()) triangles.push_back({t[0], t[2], t[1]});
  for (Triangle& t : triangles)
    for (glm::dvec3& p : t) p /= radians;
  Tessellation t{welded(triangles), std::max(outer.chord(), inner.chord()) / radians};
  t.region = Box::centred(glm::dvec3(0.5 * cell));
  for (int k = 0; k < 64; ++k)
    t.special.push_back(cell * (glm::dvec3(k % 4, k / 4 % 4, k / 16) * 0.25 - 0.5));
  return t;
}

Tessellation filled(const Wave& wave, double cell, double level, int cellsAPeriod) {
  const double radians = 2.0 * kPi / cell;
  Level solid(wave, level, 2, cellsAPeriod, 0.5);
  std::vector<Triangle> triangles = solid.triangles();
  for (Triangle& t : triangles)
    for (glm::dvec3& p : t) p /= radians;
  Tessellation t{welded(triangles), solid.chord() / radians};
  t.region = Box::centred(glm::dvec3(0.5 * cell));
  return t;
}

}  // namespace sdf::accuracy
