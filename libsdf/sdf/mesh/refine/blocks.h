// Parts of a mesh that can be changed at the same time.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/half_edges.h"

namespace sdf {

/// A MeshBlocks names the vertices of a mesh by boxes in space, the blocks. Boxes are apart, and what lies
/// between them belongs to no block. What changes only vertices and triangles around vertices that are
/// inside() one block neither meets nor reads what another block's changes do, and no triangle of the one
/// crosses one of the other. The blocks depend on the mesh alone. Vertices that are made later belong to
/// none.
class MeshBlocks {
 public:
  using Index = HalfEdgeMesh::Index;
  static constexpr std::uint8_t kNone = 0;

  /// The boxes are as far apart as this, and each has about as many vertices. A mesh that is small has none.
  /// Cost: linear.
  MeshBlocks(const HalfEdgeMesh& mesh, float apart);

  /// Blocks are numbered from 1 to this.
  std::size_t count() const { return boxes_.size(); }
  std::uint8_t of(Index v) const { return v < blocks_.size() ? blocks_[v] : kNone; }
  /// Are the vertex and its neighbours of this block?
  bool isInside(Index v, std::uint8_t block) const;
  /// The same of any block.
  bool isInside(Index v) const { return of(v) != kNone && isInside(v, of(v)); }
  bool contains(std::uint8_t block, const glm::vec3& p) const;
  /// A vertex that was put outside of its block's box belongs to none from now on.
  void moved(Index v);
  /// By block, from 1 on: the vertices that belong to it.
  std::vector<std::vector<Index>> vertices() const;
  /// The first half-edges of triangles, all of whose vertices do.
  std::vector<std::vector<Index>> triangles() const;

 private:
  struct Extent {
    glm::vec3 min, max;
  };
  void divide(std::vector<Index>& vertices, std::size_t begin, std::size_t end, Extent box, int depth,
              float apart);

  const HalfEdgeMesh& mesh_;
  std::vector<Extent> boxes_;
  std::vector<std::uint8_t> blocks_;
};

}  // namespace sdf
