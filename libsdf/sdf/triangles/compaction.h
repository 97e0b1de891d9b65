// Dropping the vertices that no triangle has.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// How the vertices that are left were numbered, and are.
struct Compaction {
  static constexpr std::uint32_t kNone = ~0u;

  std::vector<std::uint32_t> before;  ///< by new number; in rising order
  std::vector<std::uint32_t> after;   ///< by old number; kNone where the vertex went

  /// Leaves of what vertices have what those have that are left. An empty list stays so; one of fewer entries
  /// than there were vertices is of the first ones.
  template <class T>
  void apply(std::vector<T>& values) const {
    std::size_t count = 0;
    for (; count < before.size() && before[count] < values.size(); ++count)
      values[count] = values[before[count]];
    values.resize(count);
  }
};

/// Numbers the vertices that triangles have, out of so many, in the order that they had; the triangles'
/// corners have the new numbers then. Cost: linear.
Compaction dropUnusedVertices(std::vector<glm::uvec3>& triangles, std::size_t vertices);

}  // namespace sdf
