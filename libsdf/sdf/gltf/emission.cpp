#include "sdf/gltf/emission.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/base/srgb.h"
#include "sdf/gltf/pbr.h"

namespace sdf {
namespace {

struct Segment {
  glm::vec3 from, to;

  /// Where the point is nearest, 0 to 1.
  float at(const glm::vec3& p) const {
    const glm::vec3 way = to - from;
    const float square = glm::dot(way, way);
    return square > 0.0f ? std::clamp(glm::dot(p - from, way) / square, 0.0f, 1.0f) : 0.0f;
  }
};

/// From a point to the one farthest from it, which is the farthest from any: two ends of what lies on a
/// segment.
Segment acrossAll(const std::vector<glm::vec3>& points) {
  const auto farthestFrom = [&](const glm::vec3& p) {
    return *std::ranges::max_element(points, {}, [&](const glm::vec3& q) { return glm::dot(q - p, q - p); });
  };
  const glm::vec3 from = farthestFrom(points[0]);
  return {from, farthestFrom(from)};
}

/// The middle of the first texel is a quarter into a texture of two, that of the second three quarters.
constexpr float kFirstCentre = 0.25f, kBetweenCentres = 0.5f, kMost = 65535.0f;

std::uint16_t coordinate(float share) {
  return static_cast<std::uint16_t>(std::lround((kFirstCentre + kBetweenCentres * share) * kMost));
}

/// What a reader makes of a coordinate.
float shareAt(std::uint16_t coordinate) {
  return (static_cast<float>(coordinate) / kMost - kFirstCentre) / kBetweenCentres;
}

/// The texture's value at a vertex, filtered as a reader does.
glm::vec3 filtered(const BakedEmission& e, std::size_t vertex) {
  const auto linear = [&](int k) {
    return glm::vec3(linearOf(e.texels[k].x), linearOf(e.texels[k].y), linearOf(e.texels[k].z));
  };
  const float u = shareAt(e.coordinates[vertex].x), v = shareAt(e.coordinates[vertex].y);
  return glm::mix(glm::mix(linear(0), linear(1), u), glm::mix(linear(2), linear(3), u), v);
}

}  // namespace

BakedEmission bakedEmission(const Mesh& mesh, const Primitive& primitive, const AmbientLight& light) {
  const glm::vec3 own = glm::max(mesh.materials[primitive.material].emission, glm::vec3(0.0f));
  const auto occlusion = [&](std::uint32_t v) { return light.occlusion.empty() ? 1.0f : light.occlusion[v]; };
  std::vector<glm::vec3> answers, meant;
  for (const std::uint32_t v : primitive.vertices) {
    answers.push_back((light.around.empty() ? light.color : light.color + light.around[v]) * mesh.ambient[v]);
    meant.push_back(own + occlusion(v) * answers.back());
  }
  BakedEmission baked;
  // Less than a step of what a coordinate could say.
  const Segment all = acrossAll(meant);
  if (largest(glm::abs(all.to - all.from)) * kMost <= largest(all.to)) {
    baked.peak = all.to;
    return baked;
  }
  const Segment answer = acrossAll(answers);
  baked.peak = own + glm::max(answer.from, answer.to);
  const auto texel = [&](const glm::vec3& emission) {
    const glm::vec3 share = emission / glm::max(baked.peak, std::numeric_limits<float>::min());
    return glm::vec<3, std::uint8_t>(srgb(share.x), srgb(share.y), srgb(share.z));
  };
  baked.texels = {texel(own), texel(own + answer.from), texel(own), texel(own + answer.to)};
  for (std::size_t i = 0; i < meant.size(); ++i) {
    baked.coordinates.emplace_back(coordinate(occlusion(primitive.vertices[i])),
                                   coordinate(answer.at(answers[i])));
    const glm::vec3 off = glm::abs(baked.peak * filtered(baked, i) - meant[i]);
    baked.error = std::max(baked.error, largest(off));
  }
  return baked;
}

}  // namespace sdf
