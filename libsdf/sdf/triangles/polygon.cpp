#include "sdf/triangles/polygon.h"

#include <glm/geometric.hpp>
#include <queue>

namespace sdf {

void cutPolygon(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> polygon,
                std::vector<glm::uvec3>& triangles) {
  const std::size_t count = polygon.size();
  std::vector<std::size_t> before(count), after(count), age(count, 0);
  for (std::size_t i = 0; i < count; ++i) before[i] = (i + count - 1) % count, after[i] = (i + 1) % count;
  struct Corner {
    float diagonal;
    std::uint32_t point;
    std::size_t place, age;
    bool operator>(const Corner& other) const {
      if (diagonal != other.diagonal) return diagonal > other.diagonal;
      return point != other.point ? point > other.point : place > other.place;
    }
  };
  std::priority_queue<Corner, std::vector<Corner>, std::greater<>> corners;
  const auto offer = [&](std::size_t i) {
    const float diagonal = glm::distance(points[polygon[before[i]]], points[polygon[after[i]]]);
    corners.push({diagonal == diagonal ? diagonal : 0.0f, polygon[i], i, ++age[i]});  // NaN has no order
  };
  for (std::size_t i = 0; i < count; ++i) offer(i);
  for (std::size_t left = count; left > 2; --left) {
    while (corners.top().age != age[corners.top().place]) corners.pop();
    const std::size_t i = corners.top().place, a = before[i], b = after[i];
    triangles.emplace_back(polygon[a], polygon[i], polygon[b]);
    age[i] = 0;
    after[a] = b;
    before[b] = a;
    if (left > 4) offer(a), offer(b);
  }
}

}  // namespace sdf
