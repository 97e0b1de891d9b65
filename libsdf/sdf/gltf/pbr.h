// Phong numbers as glTF's metallic-roughness material.
#pragma once
#include <algorithm>
#include <glm/vec3.hpp>

#include "sdf/mesh/mesh.h"

namespace sdf {

/// The largest component.
inline float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

/// One material in glTF's metallic-roughness model, without the diffuse colour, which may vary over it.
struct PbrMaterial {
  float metallic = 0.0f;           ///< 0 to 1
  float roughness = 1.0f;          ///< perceptual, 0 to 1: the GGX width is its square
  glm::vec3 emissiveFactor{0.0f};  ///< 0 to 1
  float emissiveStrength = 1.0f;   ///< KHR_materials_emissive_strength; 1 unless the emission exceeds 1
  glm::vec3 metalColor{0.0f};      ///< a metal's reflectance, from its coloured highlight
  float metalShare = 0.0f;         ///< how much of metalColor the base colour takes, 0 to 1

  /// Linear base colour in [0, 1] where the diffuse colour is `diffuse`.
  glm::vec3 baseColor(const glm::vec3& diffuse) const;
};

/// The metallic-roughness material that looks most like a Phong material; numbers out of range are clamped
/// first. With exponent n, highlight colour s of peak s* = max(s), and mirror weights r0 head on and r1 at
/// grazing angles (reflectivity * (bias + (1 - cos)^power), at most 1: r1 = r0 where the power is 0):
/// - Phong's lobe about the mirror direction is Blinn's about the half vector with exponent 4n, as the half
///   vector turns half as fast (cos^n 2h ~ cos^4n h for small h);
/// - Blinn's exponent m is a microfacet width of alpha^2 = 2 / (m + 2) (Walter et al. 2007, Microfacet Models
///   for Refraction, section 5.2), and glTF's roughness is sqrt(alpha): roughness = (1 / (2n + 1))^(1/4);
/// - glTF's dielectrics always reflect 4 %, so below that the highlight is spread out:
///   roughness = mix(1, the above, min(1, max(s*, r1) / 0.04));
/// - only metals tint their highlight: with saturation t = (s* - min(s)) / s* and weight min(1, s*),
///   metalShare is their product; and only metals mirror more than 4 % head on:
///   metallic = max(metalShare, (r0 - 0.04) / 0.96);
/// - base colour = mix(diffuse, s / s*, metalShare).
PbrMaterial toMetallicRoughness(const MeshMaterial& material);

}  // namespace sdf
