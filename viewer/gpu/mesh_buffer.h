// Triangles and pictures on the graphics card. All of it works in the current context, which must be the same
// for one object's whole life.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"

namespace sdf::viewer {

/// A corner of triangles, as a vertex shader's inputs 0 to 5 have it.
struct BufferVertex {
  glm::vec3 position, normal{0.0f}, color{1.0f};
  glm::vec2 textureAt{0.0f};
  glm::vec3 ambient{1.0f};  ///< the answer to ambient light
  float distance = 0.0f;    ///< to the scene's surface
};

/// A MeshBuffer is triangles by their corners.
class MeshBuffer {
 public:
  /// Errors: Limits where memory runs out.
  static Result<MeshBuffer> make(const std::vector<BufferVertex>& vertices,
                                 const std::vector<glm::uvec3>& triangles);
  /// Makes it what glDrawElements draws.
  void bind() const;

 private:
  MeshBuffer() = default;
  Handle vertexArray_, vertices_, triangles_;
};

/// An ImageTexture is a picture of bytes in sRGB, repeated, filtered over what a pixel covers.
class ImageTexture {
 public:
  /// Takes width * height pixels of red, green, blue and alpha, rows from the top. Errors: Limits where it is
  /// larger than the driver's textures, or memory runs out.
  static Result<ImageTexture> make(int width, int height, const std::vector<unsigned char>& pixels);
  /// Makes it what samplers of this unit read.
  void bind(int unit) const;

 private:
  ImageTexture() = default;
  Handle texture_;
};

}  // namespace sdf::viewer
