#include "sdf/gltf/primitive.h"

#include <limits>

namespace sdf {

std::vector<Primitive> splitByMaterial(const Mesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<Primitive> primitives;
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t material = mesh.triangleMaterial[t];
    if (primitives.empty() || primitives.back().material != material) {
      if (!primitives.empty()) {
        for (const std::uint32_t vertex : primitives.back().vertices) place[vertex] = kUnused;
      }
      primitives.push_back({material, {}, {}});
    }
    Primitive& primitive = primitives.back();
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[t][corner];
      if (place[vertex] == kUnused) {
        place[vertex] = static_cast<std::uint32_t>(primitive.vertices.size());
        primitive.vertices.push_back(vertex);
      }
      primitive.indices.push_back(place[vertex]);
    }
  }
  return primitives;
}

}  // namespace sdf
