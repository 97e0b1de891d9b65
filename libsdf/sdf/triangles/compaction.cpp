#include "sdf/triangles/compaction.h"

namespace sdf {

Compaction dropUnusedVertices(std::vector<glm::uvec3>& triangles, std::size_t vertices) {
  Compaction c;
  c.after.assign(vertices, Compaction::kNone);
  for (const glm::uvec3& t : triangles) c.after[t.x] = c.after[t.y] = c.after[t.z] = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (c.after[v] == Compaction::kNone) continue;
    c.after[v] = static_cast<std::uint32_t>(c.before.size());
    c.before.push_back(v);
  }
  for (glm::uvec3& t : triangles) t = {c.after[t.x], c.after[t.y], c.after[t.z]};
  return c;
}

}  // namespace sdf
