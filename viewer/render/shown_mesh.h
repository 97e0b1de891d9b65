// Triangles as they are handed to the graphics card, wherever they come from.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "sdf/export/export.h"
#include "sdf/triangles/triangle_mesh.h"
#include "viewer/gpu/mesh_buffer.h"

namespace sdf::viewer {

/// A ShownMesh is triangles with all that is drawn of them.
struct ShownMesh {
  /// Triangles of one material.
  struct Range {
    int first, count;
    glm::vec4 look, glow;                         ///< uniforms of parts::kTriangles
    int colorTexture = -1, emissionTexture = -1;  ///< of images; -1: white
  };
  std::vector<BufferVertex> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<Range> ranges;  ///< of all triangles
  std::vector<TextureImage> images;
  /// Phong's numbers, three texels a material as parts::kTakeMeshLook has them, which Range::look.a counts;
  /// none where triangles look as files say (parts::kTakeLook).
  std::vector<glm::vec4> materials;
};

/// The triangles of a file.
ShownMesh shownMesh(const TriangleMesh& mesh);
/// What is to be exported of a scene.
ShownMesh shownMesh(const std::vector<ExportPart>& parts);
/// The same triangles, which share no vertices: what edges are drawn of.
ShownMesh unshared(const ShownMesh& mesh);

}  // namespace sdf::viewer
