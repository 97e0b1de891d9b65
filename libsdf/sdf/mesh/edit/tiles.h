// A box cut into equal cubes.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace sdf {

/// Numbers the cubes, so many along the longest side of a box. What is outside counts to the nearest cube.
class Tiles {
 public:
  Tiles() = default;
  Tiles(const glm::vec3& low, const glm::vec3& high, int along) : low_(low) {
    const glm::vec3 size = high - low;
    const float longest = std::max({size.x, size.y, size.z});
    scale_ = longest > 0.0f ? static_cast<float>(along) / longest : 0.0f;
    counts_ = glm::min(glm::ivec3(size * scale_), along - 1) + 1;
  }

  /// So many that one holds about a hundred of a surface's triangles: it passes about 3 n² of n³ tiles.
  static Tiles ofTriangles(const glm::vec3& low, const glm::vec3& high, std::size_t triangles) {
    constexpr double kTriangles = 100.0;
    constexpr int kMost = 160;  // along a side
    const double along = std::sqrt(static_cast<double>(triangles) / (3.0 * kTriangles));
    return {low, high, std::clamp(static_cast<int>(along), 1, kMost)};
  }

  std::size_t count() const { return static_cast<std::size_t>(counts_.x) * counts_.y * counts_.z; }

  std::uint32_t at(const glm::vec3& p) const { return number(tileOf(p)); }

  /// Calls visit(number) for the tiles that a box meets, and those so many tiles around them.
  template <class Visit>
  void forEach(const glm::vec3& low, const glm::vec3& high, const Visit& visit, int around = 0) const {
    const glm::ivec3 first = glm::max(tileOf(low) - around, 0),
                     last = glm::min(tileOf(high) + around, counts_ - 1);
    glm::ivec3 at;
    for (at.x = first.x; at.x <= last.x; ++at.x)
      for (at.y = first.y; at.y <= last.y; ++at.y)
        for (at.z = first.z; at.z <= last.z; ++at.z) visit(number(at));
  }

 private:
  glm::ivec3 tileOf(const glm::vec3& p) const {
    return glm::clamp(glm::ivec3((p - low_) * scale_), glm::ivec3(0), counts_ - 1);
  }
  std::uint32_t number(const glm::ivec3& tile) const {
    return static_cast<std::uint32_t>((tile.x * counts_.y + tile.y) * counts_.z + tile.z);
  }

  glm::vec3 low_{0.0f};
  float scale_ = 0.0f;  // tiles to a unit of length
  glm::ivec3 counts_{1};
};

}  // namespace sdf
