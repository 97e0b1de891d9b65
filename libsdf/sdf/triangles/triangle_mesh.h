// Triangle meshes as they come from files.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sdf {

/// A picture, rows from the top, four bytes a pixel: red, green, blue in sRGB, and alpha.
struct TextureImage {
  int width = 0, height = 0;
  std::vector<unsigned char> pixels;
};

/// How triangles look, by glTF's metallic-roughness model.
struct TriangleMaterial {
  std::string name{};
  glm::vec3 color{0.8f};  ///< linear RGB, multiplied by colours of vertices and by the texture
  float metallic = 0.0f, roughness = 1.0f;
  glm::vec3 emission{0.0f};  ///< linear RGB
  int colorTexture = -1;     ///< of images; -1: none
  int emissionTexture = -1;
};

/// Triangles, counter-clockwise seen from outside, with what is known of their look. Vertices at one place
/// may be several, where normals, colours or texture coordinates differ.
struct TriangleMesh {
  std::vector<glm::vec3> positions;             ///< scene units; finite
  std::vector<glm::uvec3> triangles;            ///< indices of vertices, each less than their number
  std::vector<glm::vec3> normals;               ///< by vertex, unit; or none
  std::vector<glm::vec3> colors;                ///< by vertex, linear RGB; or none
  std::vector<glm::vec2> textureAt;             ///< by vertex, from the picture's upper left corner; or none
  std::vector<std::uint32_t> materialOf;        ///< by triangle, an index into materials
  std::vector<TriangleMaterial> materials{{}};  ///< at least one
  std::vector<TextureImage> images;
};

/// A mesh and warnings, a sentence each: what of its file was left out or taken otherwise than meant.
struct ReadMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};

}  // namespace sdf
