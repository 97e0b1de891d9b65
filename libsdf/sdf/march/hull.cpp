#include "sdf/march/hull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "sdf/march/sampler.h"

namespace sdf {
namespace {

/// Cubes in rows along x, then y, then z. The bounds end before those at the rims.
class Cubes {
 public:
  Cubes(const Box& bounds, int cells) : bounds_(bounds), side_(bounds.longestSide() / cells) {
    counts_ = glm::ivec3(glm::ceil(bounds.size() / side_)) + 3;
    origin_ = bounds.centre() - 0.5 * side_ * glm::dvec3(counts_);
    held_.resize(static_cast<std::size_t>(counts_.x) * counts_.y * counts_.z);
  }

  void holdWhereNotFree(Sampler& sampler);
  Hull border() const;

 private:
  bool isHeld(const glm::ivec3& c) const { return held_[placeOf(c)] != 0; }
  std::size_t placeOf(const glm::ivec3& c) const {
    return (static_cast<std::size_t>(c.z) * counts_.y + c.y) * counts_.x + c.x;
  }
  void hold(const glm::ivec3& from, int side) {
    const glm::ivec3 to = glm::min(from + side, counts_);
    for (int z = from.z; z < to.z; ++z)
      for (int y = from.y; y < to.y; ++y)
        std::fill_n(held_.begin() + static_cast<std::ptrdiff_t>(placeOf({from.x, y, z})), to.x - from.x, 1);
  }

  bool meetsBounds(const glm::ivec3& from, int side, double slack) const {
    const Box block{origin_ + side_ * glm::dvec3(from) - slack,
                    origin_ + side_ * glm::dvec3(from + side) + slack};
    return !intersect(block, bounds_).empty();
  }

  Box bounds_;
  double side_;
  glm::ivec3 counts_;
  glm::dvec3 origin_;
  std::vector<std::uint8_t> held_;
};

constexpr double kHalfDiagonal = 0.86602540378443865;  // of a cube
constexpr int kEight = 8;

glm::ivec3 octant(int i) { return {i & 1, i >> 1 & 1, i >> 2}; }

// Blocks of cubes by halves, larger ones first.
void Cubes::holdWhereNotFree(Sampler& sampler) {
  const double slack = 1e-4 * side_;
  const int most = std::max(counts_.x, std::max(counts_.y, counts_.z));
  std::vector<glm::ivec3> blocks{glm::ivec3(0)}, next;
  Vectors points;
  std::vector<Sample> samples;
  for (int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(most))); !blocks.empty(); side /= 2) {
    points.clear();
    for (const glm::ivec3& block : blocks) points.add(origin_ + side_ * (glm::dvec3(block) + 0.5 * side));
    sampler.sample(points, samples);
    next.clear();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const double radius = kHalfDiagonal * side * side_, step = samples[i].step;
      if (step > radius + slack) continue;
      if (side == 1 || step < -radius) {
        hold(blocks[i], side);
        continue;
      }
      for (int k = 0; k < kEight; ++k) {
        const glm::ivec3 half = blocks[i] + side / 2 * octant(k);
        if (glm::all(glm::lessThan(half, counts_)) && meetsBounds(half, side / 2, slack))
          next.push_back(half);
      }
    }
    std::swap(blocks, next);
  }
}

Hull Cubes::border() const {
  Hull hull{origin_, {}, {}};
  const glm::ivec3 corners = counts_ + 1;
  std::vector<std::uint32_t> known(static_cast<std::size_t>(corners.x) * corners.y *
                                   corners.z);  // and one more
  const auto corner = [&](const glm::ivec3& c) {
    std::uint32_t& place = known[(static_cast<std::size_t>(c.z) * corners.y + c.y) * corners.x + c.x];
    if (place == 0) {
      hull.corners.push_back(glm::vec3(side_ * glm::dvec3(c)));
      place = static_cast<std::uint32_t>(hull.corners.size());
    }
    return place - 1;
  };
  const auto face = [&](const glm::ivec3& cube, int axis, bool upper) {
    glm::ivec3 u(0), v(0), base = cube;
    u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
    if (upper) ++base[axis];
    const std::array quad{corner(base), corner(base + u), corner(base + u + v), corner(base + v)};
    const int second = upper ? 1 : 3, last = upper ? 3 : 1;
    hull.triangles.emplace_back(quad[0], quad[second], quad[2]);
    hull.triangles.emplace_back(quad[0], quad[2], quad[last]);
  };
  for (int z = 1; z + 1 < counts_.z; ++z)
    for (int y = 1; y + 1 < counts_.y; ++y)
      for (int x = 1; x + 1 < counts_.x; ++x) {
        const glm::ivec3 cube(x, y, z);
        if (!isHeld(cube)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 beside = cube;
          ++beside[axis];
          if (!isHeld(beside)) face(cube, axis, true);
          beside[axis] -= 2;
          if (!isHeld(beside)) face(cube, axis, false);
        }
      }
  return hull;
}

}  // namespace

Result<Hull> hullOf(const MarchField& field, const Box& bounds, int cells) {
  if (auto s = checkSlope(field, "a hull"); !s) return s.error();
  if (bounds.empty() || bounds.longestSide() <= 0.0) return Hull{};
  Sampler sampler(field);
  Cubes cubes(bounds, cells);
  cubes.holdWhereNotFree(sampler);
  return cubes.border();
}

}  // namespace sdf
