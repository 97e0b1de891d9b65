// Halving the sides of triangles.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// Appends the pieces of a triangle whose side k, from its corner k to the next, has the vertex middles[k] in
/// it; a side without one has ~0. One of them has a vertex.
inline void divide(const glm::uvec3& t, const std::array<std::uint32_t, 3>& middles,
                   std::vector<glm::uvec3>& out) {
  constexpr std::uint32_t kNone = ~0u;
  const int count = (middles[0] != kNone) + (middles[1] != kNone) + (middles[2] != kNone);
  int k = 0;  // turned so that the first side is halved, and of two the last, too
  while (middles[k] == kNone || (count == 2 && middles[(k + 2) % 3] == kNone)) ++k;
  const std::uint32_t a = t[k % 3], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
  const std::uint32_t ab = middles[k % 3], bc = middles[(k + 1) % 3], ca = middles[(k + 2) % 3];
  if (count == 1) out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
  if (count == 2) out.insert(out.end(), {{a, ab, ca}, {ab, b, ca}, {b, c, ca}});
  if (count == 3) out.insert(out.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
}

}  // namespace sdf
