// Where sheets of a mesh lie close to one another, and what would make them cross.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sdf/mesh/refine/blocks.h"
#include "sdf/mesh/refine/ring.h"
#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {

/// By vertex: is there one within the reach, and not next to it, whose normal is 120 degrees or more from its
/// own? `normals` are unit, by vertex; in a crevice, where that is any side's, those of all triangles count.
/// Cost: linear.
std::vector<char> crowdedVertices(const HalfEdgeMesh& mesh, const std::vector<glm::vec3>& normals,
                                  float reach);

/// The triangles of a mesh that have another sheet beside them, and what is made of them, in trees of boxes
/// (R-trees; Guttman 1984), one for each block of the mesh and one for what is of none. Two sheets that come
/// to cross while both keep to their surface within a distance are of these. Where a block is named all that
/// is replaced and looked at is of it, or of none; so different blocks may be changed at the same time.
class CrowdedTriangles {
 public:
  using Index = SampledMesh::Index;

  /// Those that have one that faces about the other way within some `reach`, and some that are farther. Cost:
  /// n log n.
  CrowdedTriangles(const SampledMesh& sampled, const MeshBlocks& blocks, float reach);
  ~CrowdedTriangles();

  /// Would the ring's triangles, with the centre there, cross others that are crowded, if they are? Exact.
  /// Cost: log n, nothing where they are not.
  bool wouldCross(const Ring& ring, const glm::vec3& centre, std::uint8_t block = MeshBlocks::kNone) const;
  /// Once the ring's triangles have become those of the mesh.
  void replaced(const Ring& ring);
  /// The same of the two triangles that a flip of h would make, and once it has.
  bool wouldCross(Index h, std::uint8_t block = MeshBlocks::kNone) const;
  void flipped(Index h);

 private:
  struct Trees;
  void findCrowded(float reach);
  bool areCrowded(std::span<const Index> triangles) const;  // any of them
  bool crosses(const glm::uvec3& own, const Corners& at, std::span<const Index> but,
               std::uint8_t block) const;
  void put(std::span<const Index> triangles);
  void put(Index triangle);

  std::uint8_t blockOf(Index triangle) const;

  const HalfEdgeMesh& mesh_;
  const MeshBlocks& blocks_;
  std::vector<char> crowded_;  // by triangle
  bool any_ = false;           // of them
  std::unique_ptr<Trees> trees_;
};

}  // namespace sdf
