// Where sheets of a mesh lie close to one another, and what would make them cross.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sdf/mesh/refine/ring.h"
#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {

/// The triangles of a mesh that have another sheet beside them, and what is made of them, in a tree of boxes
/// (an R-tree; Guttman 1984). Two sheets that come to cross while both keep to their surface within a
/// distance are of these.
class CrowdedTriangles {
 public:
  using Index = SampledMesh::Index;

  /// Those at vertices that have one with about the opposite normal within some `reach`. Cost: linear.
  CrowdedTriangles(const SampledMesh& sampled, float reach);
  ~CrowdedTriangles();

  /// Would the ring's triangles, with the centre there, cross others that are crowded, if they are? Exact.
  /// Cost: log n, nothing where they are not.
  bool wouldCross(const Ring& ring, const glm::vec3& centre) const;
  /// Once the ring's triangles have become those of the mesh.
  void replaced(const Ring& ring);
  /// The same of the two triangles that a flip of h would make, and once it has.
  bool wouldCross(Index h) const;
  void flipped(Index h);

 private:
  struct Tree;
  bool areCrowded(std::span<const Index> triangles) const;  // any of them
  bool crosses(const glm::uvec3& own, const Corners& at, std::span<const Index> but) const;
  void put(std::span<const Index> triangles);
  void put(Index triangle);

  const HalfEdgeMesh& mesh_;
  std::vector<char> crowded_;  // by triangle
  std::unique_ptr<Tree> tree_;
};

}  // namespace sdf
