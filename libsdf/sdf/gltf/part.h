// One part of a scene as it is written: its mesh, its figures, and the form that they take.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sdf/mesh/mesh.h"

namespace sdf {

/// The ambient light that a part receives, to be written as emission. bakeAmbient (export/bake.h) makes it.
struct AmbientLight {
  glm::vec3 color{0.0f};         ///< linear RGB
  std::vector<float> occlusion;  ///< by vertex, the share of it that arrives, 0 to 1; empty: all of it
  float error = 0.0f;            ///< largest difference of the written emission from it at a vertex, linear
  std::vector<glm::vec3> around{};  ///< by vertex, the background's addition to the colour; empty: none
};

struct ExportPart {
  std::string name;
  Mesh mesh;
  MeshStats stats;
  std::optional<AmbientLight> ambient{};  ///< for .glb and .gltf; the other formats have no place for it
  /// Set: .glb and .gltf files are compressed, and each coordinate is a whole number of steps of 2^grid.
  /// compress (export/compress.h) does both.
  std::optional<int> grid{};
};

/// Figures of all meshes together: sums; the largest voxel size and distance; the RMS weighted by triangles.
MeshStats combined(const std::vector<MeshStats>& meshes);
MeshStats combined(const std::vector<ExportPart>& parts);

}  // namespace sdf
