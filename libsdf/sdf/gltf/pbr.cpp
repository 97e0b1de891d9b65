#include "sdf/gltf/pbr.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace sdf {
namespace {

/// glTF 2.0, appendix B: what a dielectric reflects head on.
constexpr float kDielectricReflectance = 0.04f;

/// NaN counts as the lower end.
float clamped(float v, float low, float high) { return v > low ? std::min(v, high) : low; }

glm::vec3 clamped(const glm::vec3& v, float low, float high) {
  return {clamped(v.x, low, high), clamped(v.y, low, high), clamped(v.z, low, high)};
}

float smallest(const glm::vec3& v) { return std::min({v.x, v.y, v.z}); }

// The mirror weight where (1 - cos)^power is this.
float mirrorWeight(const MeshMaterial& material, float grazing) {
  const float most = std::numeric_limits<float>::max();
  const float bias = clamped(material.fresnelBias, 0.0f, most);
  return clamped(clamped(material.reflectivity, 0.0f, most) * (bias + grazing), 0.0f, 1.0f);
}

}  // namespace

glm::vec3 PbrMaterial::baseColor(const glm::vec3& diffuse) const {
  return glm::mix(clamped(diffuse, 0.0f, 1.0f), metalColor, metalShare);
}

PbrMaterial toMetallicRoughness(const MeshMaterial& material) {
  const float most = std::numeric_limits<float>::max();
  const glm::vec3 specular = clamped(material.specular, 0.0f, most);
  const float peak = largest(specular);
  const float headOn = mirrorWeight(material, material.fresnelPower > 0.0f ? 0.0f : 1.0f);
  const float grazing = mirrorWeight(material, 1.0f);
  const float shininess = clamped(material.shininess, 0.0f, most);

  PbrMaterial pbr;
  if (peak > 0.0f) {
    pbr.metalColor = specular / peak;
    pbr.metalShare = (1.0f - smallest(specular) / peak) * std::min(1.0f, peak);
  }
  pbr.metallic =
      std::max(pbr.metalShare,
               clamped((headOn - kDielectricReflectance) / (1.0f - kDielectricReflectance), 0.0f, 1.0f));

  const float lobe = std::pow(1.0f / (2.0f * shininess + 1.0f), 0.25f);
  pbr.roughness = glm::mix(1.0f, lobe, std::min(1.0f, std::max(peak, grazing) / kDielectricReflectance));

  const glm::vec3 emission = clamped(material.emission, 0.0f, most);
  pbr.emissiveStrength = std::max(1.0f, largest(emission));
  pbr.emissiveFactor = emission / pbr.emissiveStrength;
  return pbr;
}

}  // namespace sdf
