#include "sdf/gltf/pbr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sdf {
namespace pbr_test {

/// Single-precision arithmetic of a handful of operations on numbers up to 1.
constexpr float kRounding = 8 * std::numeric_limits<float>::epsilon();

MeshMaterial plastic(float shininess) {
  MeshMaterial material;
  material.specular = glm::vec3(0.5f);
  material.shininess = shininess;
  return material;
}

TEST(MetallicRoughness, MatteSurfacesAreRoughDielectrics) {
  const PbrMaterial pbr = toMetallicRoughness(MeshMaterial{});
  EXPECT_EQ(pbr.metallic, 0.0f);
  EXPECT_EQ(pbr.roughness, 1.0f);
  EXPECT_EQ(pbr.baseColor({0.1f, 0.2f, 0.3f}), glm::vec3(0.1f, 0.2f, 0.3f));
}

TEST(MetallicRoughness, RoughnessGivesTheHighlightItsPhongWidth) {
  // Near the mirror direction, cos^n of the angle between mirror and eye, 2h, falls as exp(-2 n h^2);
  // Beckmann's distribution of width alpha falls as exp(-h^2 / alpha^2). Equal curvature at h = 0 needs
  // alpha^2 = 1 / (2 n), which the formula must approach as n grows: alpha^2 = 1 / (2 n + 1) is off by the
  // share 1 / (2 n + 1).
  for (const float n : {50.0f, 500.0f, 5000.0f}) {
    const float roughness = toMetallicRoughness(plastic(n)).roughness;
    const float alphaSquared = std::pow(roughness, 4.0f);
    EXPECT_NEAR(alphaSquared * 2 * n, 1.0f, 1.0f / (2 * n + 1) + 4 * kRounding) << "n = " << n;
  }
}

TEST(MetallicRoughness, ShinierIsSmootherFromFullyRoughOn) {
  EXPECT_EQ(toMetallicRoughness(plastic(0.0f)).roughness, 1.0f);
  float previous = 1.0f;
  for (float n = 1.0f; n < 1e6f; n *= 2.0f) {
    const float roughness = toMetallicRoughness(plastic(n)).roughness;
    EXPECT_LT(roughness, previous);
    EXPECT_GT(roughness, 0.0f);
    previous = roughness;
  }
}

TEST(MetallicRoughness, GreyHighlightsMakePlasticAndColouredOnesMetal) {
  MeshMaterial material = plastic(32.0f);
  EXPECT_EQ(toMetallicRoughness(material).metallic, 0.0f);
  material.specular = {1.0f, 0.8f, 0.25f};
  const PbrMaterial gold = toMetallicRoughness(material);
  EXPECT_NEAR(gold.metallic, 0.75f, kRounding);
  // Three quarters of the base colour come from the highlight, which is all that a black-bodied metal shows.
  EXPECT_NEAR(gold.baseColor(glm::vec3(0.0f)).x, 0.75f, kRounding);
  EXPECT_NEAR(gold.baseColor(glm::vec3(0.0f)).z, 0.75f * 0.25f, kRounding);
}

TEST(MetallicRoughness, MirrorsAreMetalAboveTheDielectricsFourPercent) {
  MeshMaterial material;
  material.reflectivity = 0.04f;
  EXPECT_NEAR(toMetallicRoughness(material).metallic, 0.0f, kRounding);
  material.reflectivity = 0.52f;
  EXPECT_NEAR(toMetallicRoughness(material).metallic, 0.5f, kRounding);
  material.reflectivity = 1.0f;
  EXPECT_EQ(toMetallicRoughness(material).metallic, 1.0f);
}

TEST(MetallicRoughness, WhatMirrorsAtGrazingAnglesOnlyIsASmoothDielectric) {
  MeshMaterial varnish;
  varnish.reflectivity = 0.45f;
  varnish.shininess = 60.0f;
  const PbrMaterial mirror = toMetallicRoughness(varnish);
  varnish.fresnelPower = 5.0f;
  EXPECT_GT(mirror.metallic, 0.4f);
  EXPECT_EQ(toMetallicRoughness(varnish).metallic, 0.0f);
  EXPECT_EQ(toMetallicRoughness(varnish).roughness, mirror.roughness);
  varnish.fresnelBias = 1.0f;  // head on now 0.45
  EXPECT_NEAR(toMetallicRoughness(varnish).metallic, mirror.metallic, kRounding);
}

TEST(MetallicRoughness, BrightEmissionIsSplitIntoColourAndStrength) {
  MeshMaterial material;
  material.emission = {4.0f, 2.0f, 0.0f};
  const PbrMaterial pbr = toMetallicRoughness(material);
  EXPECT_EQ(pbr.emissiveStrength, 4.0f);
  EXPECT_EQ(pbr.emissiveFactor, glm::vec3(1.0f, 0.5f, 0.0f));
  material.emission = glm::vec3(0.5f);
  EXPECT_EQ(toMetallicRoughness(material).emissiveStrength, 1.0f);
  EXPECT_EQ(toMetallicRoughness(material).emissiveFactor, glm::vec3(0.5f));
}

TEST(MetallicRoughness, StaysInRangeForHostileNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::max();
  for (const float v : {nan, -1.0f, huge, std::numeric_limits<float>::infinity(), 0.0f, 1e-38f}) {
    MeshMaterial material;
    material.specular = {v, 0.0f, 1.0f};
    material.shininess = material.reflectivity = material.fresnelPower = material.fresnelBias = v;
    material.emission = {v, 0.0f, 0.0f};
    const PbrMaterial pbr = toMetallicRoughness(material);
    for (const float share :
         {pbr.metallic, pbr.roughness, pbr.emissiveFactor.x, pbr.baseColor(glm::vec3(v)).x}) {
      EXPECT_GE(share, 0.0f) << "from " << v;
      EXPECT_LE(share, 1.0f) << "from " << v;
    }
    EXPECT_TRUE(std::isfinite(pbr.emissiveStrength)) << "from " << v;
  }
}

}  // namespace pbr_test
}  // namespace sdf
