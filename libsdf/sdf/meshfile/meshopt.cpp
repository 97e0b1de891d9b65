#include "sdf/meshfile/meshopt.h"

#include <meshoptimizer.h>

#include <cassert>
#include <cmath>
#include <glm/vec4.hpp>

namespace sdf {
namespace {

constexpr std::string_view kAttributes = "ATTRIBUTES", kTriangles = "TRIANGLES", kIndices = "INDICES";

Encoded encodeVertices(const void* elements, std::size_t count, std::size_t stride, std::string_view filter) {
  meshopt_encodeVertexVersion(0);  // the extension's
  Encoded out{kAttributes, filter, count, stride, {}};
  out.bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
  out.bytes.resize(meshopt_encodeVertexBuffer(out.bytes.data(), out.bytes.size(), elements, count, stride));
  return out;
}

}  // namespace

void orderForEncoding(std::vector<std::uint32_t>& indices, std::vector<std::uint32_t>& vertices) {
  const std::size_t count = indices.size();
  const std::vector<std::uint32_t> before = vertices;
  std::vector<std::uint32_t> ordered(count), places(before.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), indices.data(), count, before.size());
  meshopt_optimizeVertexFetchRemap(places.data(), ordered.data(), count, before.size());
  meshopt_remapIndexBuffer(indices.data(), ordered.data(), count, places.data());
  for (std::size_t i = 0; i < before.size(); ++i) vertices[places[i]] = before[i];
}

Encoded encodeTriangles(std::vector<std::uint32_t>& indices, std::size_t vertexCount, std::size_t stride) {
  meshopt_encodeIndexVersion(1);  // the extension's
  Encoded out{kTriangles, "NONE", indices.size(), stride, {}};
  out.bytes.resize(meshopt_encodeIndexBufferBound(indices.size(), vertexCount));
  out.bytes.resize(
      meshopt_encodeIndexBuffer(out.bytes.data(), out.bytes.size(), indices.data(), indices.size()));
  [[maybe_unused]] const int failed = meshopt_decodeIndexBuffer(
      indices.data(), indices.size(), sizeof(std::uint32_t), out.bytes.data(), out.bytes.size());
  assert(failed == 0);
  return out;
}

Encoded encodeElements(std::span<const unsigned char> bytes, std::size_t stride) {
  return encodeVertices(bytes.data(), bytes.size() / stride, stride, "NONE");
}

Encoded encodeUnitVectors(std::span<const glm::vec3> vectors) {
  std::vector<glm::vec4> wide;
  wide.reserve(vectors.size());
  for (const glm::vec3& v : vectors) wide.emplace_back(v, 0.0f);
  using Stored = glm::vec<4, std::int16_t>;
  std::vector<Stored> stored(vectors.size());
  meshopt_encodeFilterOct(stored.data(), stored.size(), sizeof(Stored), kNormalBits, &wide.data()->x);
  return encodeVertices(stored.data(), stored.size(), sizeof(Stored), "OCTAHEDRAL");
}

// meshoptimizer's own filter gives each point an exponent by its size; here all have one, and no point moves.
Encoded encodePoints(std::span<const glm::vec3> points, int exponent) {
  using Stored = glm::vec<3, std::uint32_t>;
  std::vector<Stored> stored;
  stored.reserve(points.size());
  const auto coordinate = [&](float v) {
    const auto steps = static_cast<std::int32_t>(std::ldexp(v, -exponent));
    assert(std::abs(steps) <= kMostSteps && std::ldexp(static_cast<float>(steps), exponent) == v);
    return static_cast<std::uint32_t>(exponent) << 24 | (static_cast<std::uint32_t>(steps) & 0xFFFFFFu);
  };
  for (const glm::vec3& p : points) stored.emplace_back(coordinate(p.x), coordinate(p.y), coordinate(p.z));
  return encodeVertices(stored.data(), stored.size(), sizeof(Stored), "EXPONENTIAL");
}

std::optional<std::vector<unsigned char>> decode(const Encoded& encoded) {
  const std::size_t count = encoded.count, stride = encoded.stride;
  const bool isIndex = stride == 2 || stride == 4;
  std::vector<unsigned char> out(count * stride);
  int failed = -1;
  const auto from = encoded.bytes.data();
  if (encoded.mode == kAttributes && stride > 0 && stride <= 256 && stride % 4 == 0)
    failed = meshopt_decodeVertexBuffer(out.data(), count, stride, from, encoded.bytes.size());
  if (encoded.mode == kTriangles && isIndex && count % 3 == 0)
    failed = meshopt_decodeIndexBuffer(out.data(), count, stride, from, encoded.bytes.size());
  if (encoded.mode == kIndices && isIndex)
    failed = meshopt_decodeIndexSequence(out.data(), count, stride, from, encoded.bytes.size());
  if (failed != 0) return std::nullopt;
  if (encoded.filter.empty() || encoded.filter == "NONE") return out;
  if (encoded.mode != kAttributes) return std::nullopt;
  if (encoded.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(out.data(), count, stride);
  else if (encoded.filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(out.data(), count, stride);
  else if (encoded.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(out.data(), count, stride);
  else
    return std::nullopt;
  return out;
}

}  // namespace sdf
