#include "sdf/gltf/emission.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gltf/synthetic.h"
#include "sdf/base/srgb.h"

namespace sdf {
namespace emission_test {

using glm::vec3;
using Texel = glm::vec<3, std::uint8_t>;

constexpr std::uint16_t kFirstCentre = 16384, kSecondCentre = 49151;  // 1/4 and 3/4 of 65535
/// Half a step of a coordinate, in the share of the way between the texels' centres, which are half apart.
constexpr float kCoordinate = 2.0f * 0.5f / 65535.0f;
/// Half a step of an sRGB byte of 1, where the curve is steepest in light: its slope there is 2.4 / 1.055.
constexpr float kTexel = 0.5f / 255.0f * 2.4f / 1.055f;
/// Some roundings of float, of numbers up to 1.
constexpr float kRounding = 8.0f * 0x1p-24f;

/// A sphere that answers ambient light as a function of the vertex says.
template <class Answer>
Mesh answering(const Answer& answer) {
  Mesh mesh = sphere(9, 12);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.ambient.push_back(answer(mesh.positions[i]));
  return mesh;
}

/// From 0 at the south pole to 1 at the north.
float height(const vec3& p) { return 0.5f + 0.5f * p.y; }

template <class Share>
AmbientLight lightWith(const Mesh& mesh, const vec3& color, const Share& share) {
  AmbientLight light{color, {}, 0.0f};
  for (const vec3& p : mesh.positions) light.occlusion.push_back(share(p));
  return light;
}

BakedEmission baked(const Mesh& mesh, const AmbientLight& light) {
  const std::vector<Primitive> primitives = splitByMaterial(mesh);
  EXPECT_EQ(primitives.size(), 1u);
  return bakedEmission(mesh, primitives[0], light);
}

TEST(BakedEmission, IsOneColourWhereNothingIsHidden) {
  const Mesh mesh = answering([](const vec3&) { return vec3(0.5f, 1.0f, 0.25f); });
  const BakedEmission e = baked(mesh, {vec3(0.5f, 0.25f, 0.0f), {}, 0.0f});
  EXPECT_EQ(e.peak, vec3(0.25f, 0.25f, 0.0f));
  EXPECT_TRUE(e.coordinates.empty());
  EXPECT_EQ(e.error, 0.0f);
}

TEST(BakedEmission, IsOneColourWhereAllIsHiddenAlike) {
  const Mesh mesh = answering([](const vec3&) { return vec3(1.0f); });
  const BakedEmission e = baked(mesh, lightWith(mesh, vec3(0.5f), [](const vec3&) { return 0.75f; }));
  EXPECT_EQ(e.peak, vec3(0.375f));
  EXPECT_TRUE(e.coordinates.empty());
}

TEST(BakedEmission, IsNothingWithoutLight) {
  const Mesh mesh = answering([](const vec3&) { return vec3(1.0f); });
  const BakedEmission e = baked(mesh, lightWith(mesh, vec3(0.0f), height));
  EXPECT_EQ(e.peak, vec3(0.0f));
  EXPECT_TRUE(e.coordinates.empty());
}

TEST(BakedEmission, RunsFromBlackToTheColourBetweenTheTexelsCentres) {
  const Mesh mesh = answering([](const vec3&) { return vec3(1.0f, 0.5f, 0.0f); });
  const BakedEmission e = baked(mesh, lightWith(mesh, vec3(0.5f), height));
  EXPECT_EQ(e.peak, vec3(0.5f, 0.25f, 0.0f));
  for (const int unlit : {0, 2}) EXPECT_EQ(e.texels[unlit], Texel(0));
  // Of the third channel nothing is to be seen either way.
  for (const int lit : {1, 3}) EXPECT_EQ(Texel(e.texels[lit].x, e.texels[lit].y, 0), Texel(255, 255, 0));
  const std::vector<std::uint32_t> order = splitByMaterial(mesh)[0].vertices;
  ASSERT_EQ(e.coordinates.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const float share = height(mesh.positions[order[i]]), u = e.coordinates[i].x / 65535.0f;
    EXPECT_NEAR((u - 0.25f) / 0.5f, share, kCoordinate + kRounding);
    EXPECT_EQ(e.coordinates[i].y, kFirstCentre);
  }
  const auto coordinateOf = [&](const vec3& p) {
    const auto vertex = std::ranges::find(mesh.positions, p) - mesh.positions.begin();
    return e.coordinates[std::ranges::find(order, vertex) - order.begin()].x;
  };
  EXPECT_EQ(coordinateOf({0, 1, 0}), kSecondCentre);
  EXPECT_EQ(coordinateOf({0, -1, 0}), kFirstCentre);
  EXPECT_LE(e.error, 0.5f * kCoordinate + kRounding);
}

TEST(BakedEmission, KeepsTheMaterialsOwnWhereNoAmbientLightArrives) {
  Mesh mesh = answering([](const vec3&) { return vec3(1.0f); });
  mesh.materials[0].emission = {0.0f, 0.5f, 3.0f};
  const BakedEmission e = baked(mesh, lightWith(mesh, vec3(1.0f), height));
  EXPECT_EQ(e.peak, vec3(1.0f, 1.5f, 4.0f));
  EXPECT_EQ(e.texels[1], Texel(255));
  for (int k = 0; k < 3; ++k) {
    const float own = e.peak[k] * linearOf(e.texels[0][k]);
    EXPECT_NEAR(own, mesh.materials[0].emission[k], kTexel * e.peak[k]);
  }
  EXPECT_GT(e.error, 0.0f);
  EXPECT_LE(e.error, (kTexel + kCoordinate) * 4.0f);
}

TEST(BakedEmission, IsExactWhereTwoColoursBlend) {
  const vec3 red(1.0f, 0.125f, 0.0f), blue(0.0f, 0.25f, 1.0f);
  const Mesh mesh = answering([&](const vec3& p) { return glm::mix(red, blue, 0.5f + 0.5f * p.x); });
  const BakedEmission e = baked(mesh, lightWith(mesh, vec3(1.0f), height));
  EXPECT_EQ(e.peak, vec3(1.0f, 0.25f, 1.0f));
  // The ends of the second coordinate are the two colours, in either order.
  for (const vec3& color : {red, blue}) {
    const Texel texel(srgb(color.x), srgb(color.y / 0.25f), srgb(color.z));
    EXPECT_TRUE(e.texels[1] == texel || e.texels[3] == texel);
  }
  EXPECT_LE(e.error, kTexel + 2.0f * kCoordinate + kRounding);
}

TEST(BakedEmission, SaysHowFarOffItIsWhereThreeColoursMeet) {
  // A red and a green half, and a blue pole that is no mixture of theirs: nearest to it on their segment is
  // the middle, from which it is half of red and of green and all of blue away.
  const Mesh mesh = answering([](const vec3& p) {
    if (p.y == 1.0f) return vec3(0.0f, 0.0f, 0.5f);
    return p.x < 0.0f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
  });
  const BakedEmission e = baked(mesh, {vec3(1.0f), {}, 0.0f});
  EXPECT_NEAR(e.error, 0.5f, kTexel + kCoordinate + kRounding);
}

TEST(BakedEmission, ReadsBackEveryByteOfTheCurve) {
  for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(srgb(linearOf(static_cast<std::uint8_t>(byte))), byte);
}

}  // namespace emission_test
}  // namespace sdf
