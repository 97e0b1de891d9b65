#include "sdf/gltf/primitive.h"

#include <algorithm>
#include <limits>

namespace sdf {
namespace {

/// How many equal values stand from `begin` on.
std::size_t runLength(const std::vector<std::uint32_t>& values, std::size_t begin) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
  return static_cast<std::size_t>(
      std::find_if(first, values.end(), [&](std::uint32_t v) { return v != *first; }) - first);
}

}  // namespace

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
      primitives.back().indices.reserve(3 * runLength(mesh.triangleMaterial, t));
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
