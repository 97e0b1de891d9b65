// Compressed files hold what plain ones do, to within what is said of them.
#include "sdf/export/compress.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "gltf/decoded.h"
#include "gltf/manifold_read.h"
#include "gltf/synthetic.h"
#include "sdf/base/srgb.h"
#include "sdf/gltf/animation.h"
#include "sdf/meshfile/meshopt.h"

namespace sdf {
namespace compress_test {

/// Half a cell's diagonal where cells have a side of 1.
const double kHalfDiagonal = std::sqrt(3.0) / 2.0;

ExportPart compressed(const std::string& name, Mesh mesh) {
  ExportPart out = part(name, std::move(mesh));
  out.stats.rmsDistance = 1e-3;  // whose grid keeps the points of all spheres here apart
  compress(out);
  return out;
}

using Short4 = glm::vec<4, std::int16_t>;

/// A vertex as the file has it.
struct Vertex {
  glm::vec3 position, normal;
};

using Triangle = std::array<Vertex, 3>;

auto key(const Vertex& v) { return std::tuple(v.position.x, v.position.y, v.position.z); }
auto keys(const Triangle& t) { return std::tuple(key(t[0]), key(t[1]), key(t[2])); }

/// Each turned so that its corners' order is the least of three, and all of them sorted.
std::vector<Triangle> canonical(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles)
    t = std::ranges::min(std::array{t, Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[0], t[1]}}, {}, keys);
  std::ranges::sort(triangles, {}, keys);
  return triangles;
}

glm::vec3 vectorOf(const Short4& v) { return glm::vec3(v.x, v.y, v.z) / 32767.0f; }

std::vector<Triangle> trianglesOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto positions = elements<glm::vec3>(model, primitive.attributes.at("POSITION"));
  const int normalIndex = primitive.attributes.at("NORMAL");
  EXPECT_TRUE(model.accessors.at(normalIndex).normalized);
  EXPECT_EQ(model.accessors.at(normalIndex).componentType, TINYGLTF_COMPONENT_TYPE_SHORT);
  const auto normals = elements<Short4>(model, normalIndex);
  const std::vector<std::uint32_t> all = indices(model, primitive);
  std::vector<Triangle> out(all.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i)
    out[i / 3][i % 3] = {positions.at(all[i]), vectorOf(normals.at(all[i]))};
  return out;
}

std::vector<Triangle> trianglesOf(const Mesh& mesh, std::uint32_t material) {
  std::vector<Triangle> out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangleMaterial[t] != material) continue;
    Triangle& triangle = out.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      triangle[k] = {mesh.positions[v], mesh.normals[v]};
    }
  }
  return out;
}

double angle(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 p(a), q(b);
  return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));
}

/// An octahedral coordinate of n bits has steps of 1 / (2^(n-1) - 1); half of one, h, in both of them moves a
/// point of the octahedron by at most sqrt(6) h, where it is at least 1 / sqrt(3) from the middle. Decoding
/// rounds each component to 16 bits.
const double kNormalError = std::sqrt(18.0) * 0.5 / ((1 << (kNormalBits - 1)) - 1) + kHalfDiagonal / 32767.0;

class CompressedFile : public ::testing::Test {
 protected:
  tinygltf::Model decoded(const std::vector<ExportPart>& parts, const Scene& scene = {},
                          const std::string& name = "a.glb") {
    EXPECT_TRUE(writeMeshes(folder_ / name, scene, parts));
    writeDecoded(folder_ / name, folder_ / "decoded.glb");
    return load(folder_ / "decoded.glb");
  }

  Folder folder_;
};

TEST_F(CompressedFile, HoldsTheTrianglesOfEveryPartAndMaterial) {
  for (const char* name : {"a.glb", "a.gltf"}) {
    const std::vector<ExportPart> parts{compressed("one", twoColoredSphere(25, 30)),
                                        compressed("two", sphere(4, 6, {3.0f, 0.0f, 0.0f})),
                                        compressed("large", sphere(300, 300))};
    const tinygltf::Model model = decoded(parts, {}, name);
    ASSERT_EQ(model.meshes.size(), parts.size());
    for (std::size_t m = 0; m < parts.size(); ++m) {
      const Mesh& mesh = parts[m].mesh;
      ASSERT_EQ(model.meshes[m].primitives.size(), mesh.materials.size());
      for (std::uint32_t p = 0; p < mesh.materials.size(); ++p) {
        const auto found = canonical(trianglesOf(model, model.meshes[m].primitives[p]));
        const auto meant = canonical(trianglesOf(mesh, p));
        ASSERT_EQ(found.size(), meant.size());
        for (std::size_t t = 0; t < found.size(); ++t) {
          ASSERT_EQ(keys(found[t]), keys(meant[t])) << t;
          for (int k = 0; k < 3; ++k) ASSERT_LE(angle(found[t][k].normal, meant[t][k].normal), kNormalError);
        }
      }
    }
  }
}

TEST_F(CompressedFile, SaysWhatAReaderHasToKnow) {
  ASSERT_TRUE(writeMeshes(folder_ / "a.glb", Scene{}, {compressed("p", sphere(9, 9))}));
  const GltfJson json = readGltf(folder_ / "a.glb").json;
  EXPECT_EQ(json["extensionsRequired"], (GltfJson{"EXT_meshopt_compression", "KHR_mesh_quantization"}));
  EXPECT_EQ(json["extensionsUsed"],
            (GltfJson{"EXT_meshopt_compression", "KHR_mesh_quantization", "EXT_mesh_manifold"}));
}

TEST_F(CompressedFile, IsASmallPartOfThePlainOne) {
  const auto sizeOf = [&](const ExportPart& part) {
    EXPECT_TRUE(writeMeshes(folder_ / "a.glb", Scene{}, {part}));
    return std::filesystem::file_size(folder_ / "a.glb");
  };
  EXPECT_LT(4 * sizeOf(compressed("p", sphere(100, 200))), sizeOf(part("p", sphere(100, 200))));
}

TEST_F(CompressedFile, IsClosedWhereMaterialsMeet) {
  const tinygltf::Model model = decoded({compressed("p", twoColoredSphere(21, 33))});
  const tinygltf::Mesh& mesh = model.meshes[0];
  std::vector<std::uint32_t> split;
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    for (const std::uint32_t i : indices(model, primitive)) split.push_back(i);
  const std::vector<std::uint32_t> merged = manifoldIndices(model, mesh);
  EXPECT_GT(openEdges(split), 0u);
  EXPECT_EQ(openEdges(merged), 0u);
  const auto positions = elements<glm::vec3>(model, mesh.primitives[0].attributes.at("POSITION"));
  ASSERT_EQ(merged.size(), split.size());
  for (std::size_t i = 0; i < merged.size(); ++i) ASSERT_EQ(positions[merged[i]], positions[split[i]]);
}

TEST_F(CompressedFile, ColoursAreBytesWhereNoneIsSeenToChange) {
  const auto colored = [](float darkest) {
    Mesh mesh = sphere(9, 9);
    for (std::size_t i = 0; i < mesh.colors.size(); ++i)
      mesh.colors[i] = {darkest + 0.9f * static_cast<float>(i) / 90.0f, 1.0f, 0.0f};
    return compressed("p", mesh);
  };
  const auto typeOf = [](const tinygltf::Model& model) {
    return model.accessors.at(model.meshes[0].primitives[0].attributes.at("COLOR_0")).componentType;
  };
  const tinygltf::Model bright = decoded({colored(0.1f)});
  ASSERT_EQ(typeOf(bright), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  std::vector<int> found, meant;
  for (const auto& c :
       elements<glm::vec<4, std::uint8_t>>(bright, bright.meshes[0].primitives[0].attributes.at("COLOR_0"))) {
    found.push_back(srgb(static_cast<float>(c.x) / 255.0f));
    EXPECT_EQ(glm::ivec2(c.y, c.z), glm::ivec2(255, 0));
  }
  for (const glm::vec3& c : colored(0.1f).mesh.colors) meant.push_back(srgb(c.x));
  std::ranges::sort(found);
  std::ranges::sort(meant);
  ASSERT_EQ(found.size(), meant.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LE(std::abs(found[i] - meant[i]), 1);

  // 0.002 is 7 of 255, shown; 0 and 1 / 255 are 0 and 13.
  EXPECT_EQ(typeOf(decoded({colored(0.002f)})), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

TEST_F(CompressedFile, BakedLightIsTheSame) {
  ExportPart lit = part("lit", sphere(9, 12));
  lit.ambient.emplace(AmbientLight{glm::vec3(0.5f), {}, 0.0f});
  for (const glm::vec3& p : lit.mesh.positions) {
    lit.mesh.ambient.push_back(glm::vec3(1.0f));
    lit.ambient->occlusion.push_back(0.5f + 0.5f * p.y);
  }
  const auto coordinates = [](const tinygltf::Model& model) {
    const int index = model.meshes[0].primitives[0].attributes.at("TEXCOORD_0");
    std::vector<std::pair<int, int>> out;
    for (const auto& c : elements<glm::vec<2, std::uint16_t>>(model, index)) out.emplace_back(c.x, c.y);
    std::ranges::sort(out);
    return out;
  };
  ASSERT_TRUE(writeMeshes(folder_ / "plain.glb", Scene{}, {lit}));
  const auto plain = coordinates(load(folder_ / "plain.glb"));
  compress(lit);
  EXPECT_EQ(coordinates(decoded({lit})), plain);
}

TEST_F(CompressedFile, AnimationsMoveTheSameWay) {
  const auto animated = [](const ExportPart& part) {
    const RigidMotion moved{glm::angleAxis(1.0, glm::dvec3(0.0, 1.0, 0.0)), {1.0, 2.0, 3.0}};
    return Animation{{0.0, 0.5}, {Scene{}, Scene{}}, {{"p", {{part, {RigidMotion{}, moved}}}}}};
  };
  const Mesh mesh = sphere(5, 6, {2.0f, 0.0f, 0.0f});
  ASSERT_TRUE(writeAnimation(folder_ / "plain.glb", animated(part("p", mesh))));
  ASSERT_TRUE(writeAnimation(folder_ / "a.glb", animated(compressed("p", mesh))));
  writeDecoded(folder_ / "a.glb", folder_ / "decoded.glb");
  const tinygltf::Model plain = load(folder_ / "plain.glb"), model = load(folder_ / "decoded.glb");
  ASSERT_EQ(model.nodes.size(), plain.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    EXPECT_EQ(model.nodes[i].translation, plain.nodes[i].translation);
    EXPECT_EQ(model.nodes[i].rotation, plain.nodes[i].rotation);
    EXPECT_TRUE(model.nodes[i].scale.empty());
  }
  ASSERT_EQ(model.animations.size(), 1u);
  ASSERT_EQ(model.animations[0].samplers.size(), plain.animations[0].samplers.size());
  for (std::size_t i = 0; i < model.animations[0].samplers.size(); ++i) {
    const int keys = model.animations[0].samplers[i].output,
              plainKeys = plain.animations[0].samplers[i].output;
    const auto bytesOf = [](const tinygltf::Model& m, int index) {
      return m.accessors[index].type == TINYGLTF_TYPE_VEC3
                 ? elements<std::array<float, 3>>(m, index).back()[0]
                 : elements<std::array<float, 4>>(m, index).back()[0];
    };
    EXPECT_EQ(bytesOf(model, keys), bytesOf(plain, plainKeys));
  }
}

TEST_F(CompressedFile, NamesAreNotTakenForItsOwnWords) {
  const std::string name = "\"extras\":{\"EXT_meshopt_compression\":\"buffers\":[}]";
  for (const char* file : {"a.glb", "a.gltf"})
    EXPECT_EQ(decoded({compressed(name, sphere(3, 4))}, {}, file).nodes[0].name, name);
}

TEST_F(CompressedFile, APartWithoutTrianglesIsANodeAlone) {
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(writeMeshes(folder_ / name, Scene{}, {compressed("empty", Mesh{})}));
    EXPECT_EQ(load(folder_ / name).nodes.at(0).mesh, -1);
  }
}

TEST_F(CompressedFile, HasTheSameBytesEachTime) {
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(writeMeshes(folder_ / name, Scene{}, {compressed("p", twoColoredSphere(30, 30))}));
    const std::string first = contents(folder_ / name);
    ASSERT_TRUE(writeMeshes(folder_ / name, Scene{}, {compressed("p", twoColoredSphere(30, 30))}));
    EXPECT_TRUE(first == contents(folder_ / name)) << name;
  }
}

TEST(Compress, RoundsToTheCoarsestGridThatAddsATenthOfTheError) {
  for (const double rms : {1e-2, 3e-4, 1e-5}) {
    ExportPart p = part("p", sphere(20, 30, {0.3f, -0.7f, 0.1f}));
    const Mesh before = p.mesh;
    p.stats.rmsDistance = rms;
    p.stats.maxDistance = 3.0 * rms;
    compress(p);
    ASSERT_TRUE(p.grid);
    const double step = std::ldexp(1.0, *p.grid);
    EXPECT_LE(kHalfDiagonal * step, 0.1 * rms);
    EXPECT_GT(2.0 * kHalfDiagonal * step, 0.1 * rms);
    EXPECT_DOUBLE_EQ(p.stats.rmsDistance, rms + kHalfDiagonal * step);
    EXPECT_DOUBLE_EQ(p.stats.maxDistance, 3.0 * rms + kHalfDiagonal * step);
    for (std::size_t i = 0; i < before.positions.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double meant = before.positions[i][k], found = p.mesh.positions[i][k];
        EXPECT_LE(std::abs(found - meant), 0.5 * step);
        EXPECT_EQ(found / step, std::round(found / step));
      }
  }
}

TEST(Compress, CopiesOfAPointStayInOnePlace) {
  const ExportPart p = compressed("p", twoColoredSphere(20, 31));
  for (std::size_t i = 0; i < p.mesh.copyOf.size(); ++i)
    EXPECT_EQ(p.mesh.positions[p.mesh.welded + i], p.mesh.positions[p.mesh.copyOf[i]]);
}

/// The finest grid has 22 bits below the power of two above the largest coordinate.
TEST(Compress, AnErrorBelowWhatFloatsHoldTakesTheFinestGrid) {
  const Folder folder;
  const float largest = std::nextafter(2.0f, 0.0f);
  for (const float size : {1.0f, 1e6f, 1e-30f, 1e-38f, largest}) {
    for (const double rms : {0.0, 1e-45}) {
      ExportPart p = part("p", sphere(7, 8));
      for (glm::vec3& v : p.mesh.positions) v *= size;
      p.mesh.positions[0].y = size;  // the pole, where the sine of a right angle is 1
      p.stats.rmsDistance = p.stats.maxDistance = rms;
      const Mesh before = p.mesh;
      compress(p);
      const double step = std::ldexp(1.0, *p.grid);
      EXPECT_LE(step, std::max(size * std::ldexp(1.0, -21), std::ldexp(1.0, -126)));
      for (std::size_t i = 0; i < before.positions.size(); ++i)
        EXPECT_LE(glm::distance(glm::dvec3(before.positions[i]), glm::dvec3(p.mesh.positions[i])),
                  kHalfDiagonal * step);
      ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {p}));
      writeDecoded(folder / "a.glb", folder / "decoded.glb");
      const tinygltf::Model model = load(folder / "decoded.glb");
      const auto found = canonical(trianglesOf(model, model.meshes[0].primitives[0]));
      const auto meant = canonical(trianglesOf(p.mesh, 0));
      ASSERT_EQ(found.size(), meant.size());
      for (std::size_t t = 0; t < meant.size(); ++t) ASSERT_EQ(keys(found[t]), keys(meant[t])) << size;
    }
  }
}

TEST(Compress, ErrorsThatAreNoneOfThisMeshLeaveItsShape) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double rms : {1e3, infinite, std::numeric_limits<double>::quiet_NaN()}) {
    ExportPart p = part("p", sphere(9, 9));
    p.stats.rmsDistance = rms;
    compress(p);
    EXPECT_LE(*p.grid, -5);  // six digits below the power of two above 1
  }
}

TEST(Compress, NormalsOfAllDirectionsKeepTheirPromise) {
  constexpr unsigned kSeed = 5;
  std::mt19937 random(kSeed);
  std::normal_distribution<float> component;
  std::vector<glm::vec3> normals;
  for (int i = 0; i < 100'000; ++i)
    normals.push_back(glm::normalize(glm::vec3{component(random), component(random), component(random)}));
  for (const float x : {-1.0f, 0.0f, 1.0f})
    for (const float y : {-1.0f, 0.0f, 1.0f})
      for (const float z : {-1.0f, 0.0f, 1.0f})
        if (x != 0.0f || y != 0.0f || z != 0.0f) normals.push_back(glm::normalize(glm::vec3(x, y, z)));
  const Encoded encoded = encodeUnitVectors(normals);
  std::vector<Short4> stored(normals.size());
  ASSERT_EQ(meshopt_decodeVertexBuffer(stored.data(), stored.size(), sizeof(Short4), encoded.bytes.data(),
                                       encoded.bytes.size()),
            0);
  meshopt_decodeFilterOct(stored.data(), stored.size(), sizeof(Short4));
  double worst = 0.0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    worst = std::max(worst, angle(vectorOf(stored[i]), normals[i]));
  EXPECT_LE(worst, kNormalError);
  EXPECT_GT(worst, 0.5 * kNormalError) << "the bound is not idle";
  // As docs/export.md says.
  EXPECT_LE(kNormalError * 180.0 / std::numbers::pi, 0.062);
}

}  // namespace compress_test
}  // namespace sdf
