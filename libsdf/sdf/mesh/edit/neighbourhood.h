// The triangles of a mesh around some of them.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/tiles.h"

namespace sdf {

/// The triangles that have a vertex whose mark is not 0, and are not gone.
std::vector<std::uint32_t> trianglesWith(const std::vector<char>& marked, const FeatureMesh& mesh);

/// Marks the corners of triangles.
void markCorners(std::vector<char>& marked, const FeatureMesh& mesh,
                 const std::vector<std::uint32_t>& triangles);

/// The box of a mesh in tiles that are about ten edges long.
Tiles tilesOf(const FeatureMesh& mesh);

/// Lets one look around some triangles again and again without passing over the whole mesh. Of a mesh all of
/// whose edges are shorter than a tile, as those are that come from voxels.
class Neighbourhood {
 public:
  /// Holds all triangles that have a corner in a tile of those some, or in one beside it: all that may meet
  /// them. Cost: a pass over the mesh.
  Neighbourhood(const FeatureMesh& mesh, const Tiles& tiles, const std::vector<std::uint32_t>& some);

  /// Is a point in those tiles?
  bool contains(const glm::vec3& p) const { return inside_[tiles_.at(p)] != 0; }
  void add(const std::vector<std::uint32_t>& triangles);
  /// In their order.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  /// Those with a marked vertex.
  std::vector<std::uint32_t> trianglesAt(const std::vector<char>& marked) const;

 private:
  const FeatureMesh& mesh_;
  const Tiles& tiles_;
  std::vector<char> inside_;  // by tile
  std::vector<std::uint32_t> triangles_;
};

}  // namespace sdf
