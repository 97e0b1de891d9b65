// The codecs of EXT_meshopt_compression (Kapoulkine 2020), through meshoptimizer.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sdf {

/// An encoded buffer view: its bytes, and the facts that decode them.
struct Encoded {
  std::string_view mode, filter;  ///< as the extension names them
  std::size_t count, stride;      ///< elements once decoded, and bytes of each
  std::vector<unsigned char> bytes;
};

/// Bits of each of a normal's two octahedral coordinates (Meyer et al. 2010, On Floating-Point Normal
/// Vectors), decoded to 16: off by at most 0.062 degrees.
inline constexpr int kNormalBits = 12;

/// Whole numbers of a point in steps of 2^exponent reach from -kMostSteps to kMostSteps.
inline constexpr std::int32_t kMostSteps = (1 << 23) - 1;

/// Puts triangles, three indices into `vertices` each, into an order in which neighbours follow each other,
/// and the vertices into that in which the triangles first use them: what the encoders compress best, and
/// GPUs draw best.
void orderForEncoding(std::vector<std::uint32_t>& indices, std::vector<std::uint32_t>& vertices);

/// Triangles over vertices in order of first use. `stride` is 2 or 4. Decoding may turn a triangle, so that
/// another of its corners is the first; `indices` are as decoded afterwards.
Encoded encodeTriangles(std::vector<std::uint32_t>& indices, std::size_t vertexCount, std::size_t stride);

/// Elements of any kind, bit by bit. The stride is a multiple of 4.
Encoded encodeElements(std::span<const unsigned char> bytes, std::size_t stride);

/// Unit vectors as three normalised 16-bit numbers each, and a fourth, of no meaning.
Encoded encodeUnitVectors(std::span<const glm::vec3> vectors);

/// Points, exactly, as three floats. Each coordinate is a whole number of steps of 2^exponent, up to
/// kMostSteps; -126 <= exponent <= 127.
Encoded encodePoints(std::span<const glm::vec3> points, int exponent);

/// The elements again, or none where the bytes are broken or the mode or filter is unknown. Filters of the
/// extension are applied. Precondition: count * stride bytes fit into memory.
std::optional<std::vector<unsigned char>> decode(const Encoded& encoded);

}  // namespace sdf
