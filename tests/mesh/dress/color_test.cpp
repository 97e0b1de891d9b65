#include "sdf/mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/scenes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"

namespace sdf::test {
namespace color_test {

Mesh meshed(const Shape& shape, double h) {
  Progress progress;
  return meshShape(shape, "part", {.voxelSize = h}, progress).value().mesh;
}

const MaterialPtr& red() {
  static const MaterialPtr m = makeMaterial({.name = "red", .color = {1.0, 0.0, 0.0}});
  return m;
}
const MaterialPtr& blue() {
  static const MaterialPtr m = makeMaterial({.name = "blue", .color = {0.0, 0.0, 1.0}});
  return m;
}

// Two balls that bite into each other; the crease lies askew to the lattice.
Shape pair(const Blend& blend = {}) {
  return rotate(unite(translate(sphere(0.5), {-0.3, 0.0, 0.0}).paint(red()),
                      translate(sphere(0.4), {0.3, 0.1, 0.0}).paint(blue()), blend),
                {0.3, 0.5, 0.7});
}

TEST(ColorMesh, EachSideOfABorderHasVerticesInItsOwnColour) {
  for (const double h : {1.0 / 16, 1.0 / 37}) {
    const Mesh mesh = meshed(pair(), h);
    ASSERT_EQ(mesh.materials.size(), 2u);
    EXPECT_EQ(mesh.materials[0].name, "red");
    EXPECT_EQ(mesh.materials[1].name, "blue");
    EXPECT_TRUE(std::is_sorted(mesh.triangleMaterial.begin(), mesh.triangleMaterial.end()));
    std::set<std::uint32_t> used[2];
    std::size_t wrong = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangles[t][k], m = mesh.triangleMaterial[t];
        used[m].insert(v);
        wrong += mesh.colors[v] != mesh.materials[m].color;
      }
    EXPECT_EQ(wrong, 0u) << "of " << 3 * mesh.triangles.size() << " corners, voxel " << h;
    EXPECT_EQ(mesh.materials[0].color, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.materials[1].color, glm::vec3(0, 0, 1));
    std::vector<std::uint32_t> both;
    std::set_intersection(used[0].begin(), used[0].end(), used[1].begin(), used[1].end(),
                          std::back_inserter(both));
    EXPECT_TRUE(both.empty()) << both.size() << " vertices serve both materials";
  }
}

TEST(ColorMesh, BorderVerticesAreRepeatedWhereTheyAre) {
  const Mesh mesh = meshed(pair(), 1.0 / 24);
  ASSERT_GT(mesh.copyOf.size(), 20u);
  ASSERT_EQ(mesh.positions.size(), mesh.welded + mesh.copyOf.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i) {
    ASSERT_LT(mesh.copyOf[i], mesh.welded);
    ASSERT_EQ(mesh.positions[mesh.welded + i], mesh.positions[mesh.copyOf[i]]);
    ASSERT_NE(std::pair(mesh.colors[mesh.welded + i].x, mesh.normals[mesh.welded + i].x),
              std::pair(mesh.colors[mesh.copyOf[i]].x, mesh.normals[mesh.copyOf[i]].x));
  }
}

TEST(ColorMesh, OneMaterialNeedsCopiesAtCreasesAlone) {
  const Material gold{.name = "gold",
                      .color = {0.9, 0.7, 0.2},
                      .specular = {0.5, 0.25, 0.125},
                      .shininess = 77.0,
                      .reflectivity = 0.25,
                      .fresnelPower = 5.0,
                      .fresnelBias = 0.125,
                      .emission = {2.0, 0.0, 1.0}};
  const Mesh mesh = meshed(boredBox().paint(gold), 1.0 / 16);
  ASSERT_EQ(mesh.materials.size(), 1u);
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i)
    ASSERT_NE(mesh.normals[mesh.welded + i], mesh.normals[mesh.copyOf[i]]) << "a crease needs them";
  for (const glm::vec3& c : mesh.colors) ASSERT_EQ(c, glm::vec3(0.9f, 0.7f, 0.2f));
  // Means of up to some hundred equal numbers, summed in double.
  const MeshMaterial& m = mesh.materials[0];
  EXPECT_EQ(m.name, "gold");
  EXPECT_FLOAT_EQ(m.color.y, 0.7f);
  EXPECT_EQ(m.specular, glm::vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(m.shininess, 77.0f);
  EXPECT_EQ(m.reflectivity, 0.25f);
  EXPECT_EQ(m.fresnelPower, 5.0f);
  EXPECT_EQ(m.fresnelBias, 0.125f);
  EXPECT_EQ(m.emission, glm::vec3(2.0f, 0.0f, 1.0f));
}

TEST(ColorMesh, AMaterialWithoutANameIsNamedAfterItsPlace) {
  const Shape left = translate(sphere(0.3), {-0.5, 0.0, 0.0}),
              right = translate(sphere(0.3), {0.5, 0.0, 0.0});
  for (int i = 0; i < 2; ++i) {  // whatever was made before
    const Shape three =
        unite({left.paint(red()), sphere(0.1).paint({.color = {0.0, 1.0, 0.0}}), right.paint(Material{})});
    const Mesh mesh = meshed(three, 1.0 / 24);
    ASSERT_EQ(mesh.materials.size(), 3u);
    EXPECT_EQ(mesh.materials[0].name, "red");
    EXPECT_EQ(mesh.materials[1].name, "material 2");
    EXPECT_EQ(mesh.materials[1].color, glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.materials[2].name, "material 3");
  }
}

TEST(ColorMesh, MaterialsThatAreNowhereSeenAreLeftOut) {
  const Shape hidden = translate(sphere(0.2), {0.1, 0.0, 0.0}).paint(blue());
  const Mesh mesh = meshed(sphere(0.5).paint(red()) | hidden, 1.0 / 16);
  ASSERT_EQ(mesh.materials.size(), 1u);
  EXPECT_EQ(mesh.materials[0].name, "red");
  EXPECT_TRUE(mesh.copyOf.empty());
}

TEST(ColorMesh, ASmoothUnionMixesItsColours) {
  const double k = 0.3, h = 1.0 / 24;
  const Shape shape = pair(Blend::quadratic(k));
  const Mesh mesh = meshed(shape, h);
  const TapePtr tape = Model(shape).at().whole();
  // The weight's slope is at most |grad a - grad b| / (2k) <= 1/k. Border vertices look into their triangles,
  // whose corners are no more than 3h apart.
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 c = mesh.colors[i];
    const auto exact = evaluateAll(*tape, glm::dvec3(mesh.positions[i]), glm::dvec3(mesh.normals[i]));
    ASSERT_NEAR(c.x, exact[1], 3.0 * h / k);
    ASSERT_NEAR(c.z, exact[3], 3.0 * h / k);
    ASSERT_NEAR(c.x + c.z, 1.0, 4.0 * kRoundoff);
    ASSERT_EQ(c.y, 0.0f);
    mixed += c.x > 0.25f && c.x < 0.75f;
  }
  EXPECT_GT(mixed, mesh.positions.size() / 50);
}

// Paint is read eight floats inside of a ball of the radius 0.4.
constexpr double kInside = 8.0 * 0.4 * 0x1p-23;

TEST(ColorMesh, ColourFollowsPositionAndNormal) {
  const Vec3E n = normal();
  const Material m{.color = {n.x * 0.5 + 0.5, n.y * 0.5 + 0.5, position().z + 0.5}};
  const Mesh mesh = meshed(sphere(0.4).paint(m), 1.0 / 16);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_NEAR(mesh.colors[i].x, mesh.normals[i].x * 0.5f + 0.5f, 2.0 * kRoundoff);
    ASSERT_NEAR(mesh.colors[i].y, mesh.normals[i].y * 0.5f + 0.5f, 2.0 * kRoundoff);
    ASSERT_NEAR(mesh.colors[i].z, mesh.positions[i].z + 0.5f, 2.0 * kRoundoff + kInside);
  }
}

TEST(ColorMesh, AnswersTheAmbientLightInAColourOfItsOwn) {
  const Material plain{.color = {0.5, 0.25, 0.0}};
  const Mesh same = meshed(sphere(0.4).paint(plain), 1.0 / 8);
  EXPECT_EQ(same.ambient, same.colors);
  const Material dark{.color = {1.0, 1.0, 1.0}, .ambient = Vec3E(position().x, 2.0, sqrt(position().x))};
  const Mesh mesh = meshed(sphere(0.4).paint(dark), 1.0 / 8);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_EQ(mesh.ambient[i].y, 2.0f);
    // Next to 0 a root is as steep as a border, where a vertex looks into its triangles, a voxel wide.
    if (std::abs(mesh.positions[i].x) < 1.0f / 8) continue;
    ASSERT_NEAR(mesh.ambient[i].x, std::max(mesh.positions[i].x, 0.0f), kInside) << "light is not negative";
    if (mesh.positions[i].x < 0.0f) {
      ASSERT_EQ(mesh.ambient[i].z, 0.0f) << "not a number";
    }
  }
}

TEST(ColorMesh, EachSideOfABorderAnswersTheAmbientLightAsItsOwnMaterialDoes) {
  const Shape dim = translate(sphere(0.5), {-0.3, 0.0, 0.0}).paint({.ambient = Vec3E(0.25)}),
              bright = translate(sphere(0.4), {0.3, 0.1, 0.0}).paint({.ambient = Vec3E(0.75)});
  const Mesh mesh = meshed(unite(dim, bright), 1.0 / 16);
  ASSERT_EQ(mesh.materials.size(), 2u);
  ASSERT_EQ(mesh.ambient.size(), mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(mesh.ambient[mesh.triangles[t][k]], glm::vec3(mesh.triangleMaterial[t] == 0 ? 0.25f : 0.75f));
}

TEST(ColorMesh, ColoursOutsideTheUnitCubeAreHeldInIt) {
  const Mesh mesh = meshed(sphere(0.4).paint({.color = {2.0, -1.0, sqrt(position().x)}}), 1.0 / 8);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_EQ(mesh.colors[i].x, 1.0f);
    ASSERT_EQ(mesh.colors[i].y, 0.0f);
    if (mesh.positions[i].x < -1.0f / 8) {  // next to 0 there is a border, a voxel wide

      ASSERT_EQ(mesh.colors[i].z, 0.0f) << "not a number";
    }
  }
}

}  // namespace color_test
}  // namespace sdf::test
