// The ambient light of a primitive as an emission that glTF can hold.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/gltf/part.h"
#include "sdf/gltf/primitive.h"

namespace sdf {

/// An emission of `peak` times a texture of 2 x 2 texels, sRGB, by rows of v. The first coordinate, u, is the
/// occlusion and runs from the material's own emission to that and all of the ambient light; the second runs
/// between the two ambient colours that lie farthest apart. Coordinates of 0 and 1 stand for the texels'
/// centres, so that linear filtering is linear all the way.
struct BakedEmission {
  glm::vec3 peak{0.0f};                               ///< linear RGB, not negative
  std::array<glm::vec<3, std::uint8_t>, 4> texels{};  ///< (u, v) = (0, 0), (1, 0), (0, 1), (1, 1)
  /// By the primitive's vertices, as normalised 16-bit texture coordinates. Empty: `peak` everywhere, no
  /// texture.
  std::vector<glm::vec<2, std::uint16_t>> coordinates;
  /// Largest difference, linear, of a channel at a vertex from the emission that is meant: nothing but the
  /// rounding of texels where the ambient colours lie on a segment.
  float error = 0.0f;
};

/// The material's emission plus (light.color + light.around) * (the mesh's answer to ambient light) *
/// occlusion.
BakedEmission bakedEmission(const Mesh& mesh, const Primitive& primitive, const AmbientLight& light);

}  // namespace sdf
