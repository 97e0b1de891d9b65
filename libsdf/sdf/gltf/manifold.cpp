#include "sdf/gltf/manifold.h"

#include <limits>

namespace sdf {

Merges mergesOf(const Mesh& mesh, const std::vector<std::uint32_t>& vertices,
                const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> firstAt(mesh.welded, kNone);  // by the mesh's points
  std::vector<std::uint32_t> sameAs(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t v = vertices[i];
    std::uint32_t& first = firstAt[mesh.pointOf(v)];
    if (first == kNone) first = i;
    sameAs[i] = first;
  }
  Merges merges;
  for (std::uint32_t place = 0; place < indices.size(); ++place) {
    const std::uint32_t merged = sameAs[indices[place]];
    if (merged == indices[place]) continue;
    merges.places.push_back(place);
    merges.vertices.push_back(merged);
  }
  return merges;
}

}  // namespace sdf
