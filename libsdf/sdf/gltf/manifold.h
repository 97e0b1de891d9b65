// How a file's vertices, split where materials meet, make one closed surface again (EXT_mesh_manifold).
#pragma once
#include <cstdint>
#include <vector>

#include "sdf/mesh/mesh.h"

namespace sdf {

/// Places in a list of indices, ascending, and the vertices to stand there instead. After that every index
/// names the first of all vertices that are one point of the mesh, and each edge of a manifold mesh has its
/// other half (Lalish 2023, EXT_mesh_manifold).
struct Merges {
  std::vector<std::uint32_t> places;
  std::vector<std::uint32_t> vertices;
};

/// `vertices` are the file's, as indices into the mesh's vertex arrays; `indices` go into `vertices`.
Merges mergesOf(const Mesh& mesh, const std::vector<std::uint32_t>& vertices,
                const std::vector<std::uint32_t>& indices);

}  // namespace sdf
