// Files with baked light held to the light itself, at their vertices and pixel by pixel.
#include "sdf/export/bake.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "gltf/read_back.h"
#include "sdf/base/srgb.h"
#include "sdf/mesh/mesher.h"
#include "sdf/scene/fit.h"
#include "sdf/script/script.h"
#include "support/evaluate.h"
#include "support/folder.h"
#include "viewer/reference/cpu_camera.h"
#include "viewer/reference/cpu_render.h"

namespace sdf {
namespace bake_test {

using glm::vec3;

constexpr double kVoxel = 0.03;
/// What a scene's colours are written to within: half a step of a byte of sRGB, of 1 where the curve is
/// steepest in light, and half a step of a 16-bit coordinate between texels half a texture apart, along u and
/// v.
constexpr double kWritten = 0.5 / 255.0 * 2.4 / 1.055 + 2.0 / 65535.0;

/// A ball in the corner of a stage, and two balls of which one blends into the other.
constexpr const char* kStage = R"(
camera { from = {3, 2.2, 4}, to = {0, 0.4, 0}, fov = 40 }
ambient({0.4, 0.5, 0.6})
ambient_occlusion { kind = "taps" }
part("stage", (box(2, 0.1, 2):translate(0, -0.1, 0) | box(0.1, 0.6, 2):translate(-1, 0.5, 0)):paint { color = {0.8, 0.6, 0.4} })
part("ball", sphere(0.5):translate(-0.38, 0.48, 0):paint { color = {0.9, 0.1, 0.1}, ambient = {0.5, 0.5, 1} })
part("pair", union({sphere(0.4):translate(0.8, 0.4, 0):paint { color = {0.9, 0.3, 0.1} },
                    sphere(0.3):translate(0.8, 0.4, 0.55):paint { color = {0.1, 0.3, 0.9} }}, 0.3))
)";

Scene sceneOf(const std::string& text) { return runScene(text, "test.lua", {.fixed = true}).value(); }

std::vector<ExportPart> meshedParts(const Scene& scene, const std::optional<Box>& clip = {}) {
  Progress progress;
  std::vector<ExportPart> parts;
  for (const Part& part : scene.parts) {
    MeshedShape meshed =
        meshShape(part.shape, part.name, {.voxelSize = kVoxel, .bounds = clip}, progress).value();
    parts.push_back({part.name, std::move(meshed.mesh), meshed.stats, {}});
  }
  return parts;
}

std::vector<ExportPart> bakedParts(const Scene& scene, const std::optional<Box>& clip = {}) {
  Progress progress;
  std::vector<ExportPart> parts = meshedParts(scene, clip);
  const Status status = bakeAmbient(scene, clip, parts, progress);
  EXPECT_TRUE(status) << status.error().message;
  return parts;
}

/// The triangles of a file with what they emit, as a reader computes it.
struct Emitter {
  tinygltf::Model model;
  struct Piece {
    std::vector<vec3> positions, normals;
    std::vector<glm::vec<2, std::uint16_t>> coordinates;
    std::vector<std::uint32_t> indices;
    const tinygltf::Material* material;
  };
  std::vector<Piece> pieces;

  explicit Emitter(const std::filesystem::path& file) : model(load(file)) {
    for (const tinygltf::Mesh& mesh : model.meshes)
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        Piece& piece = pieces.emplace_back();
        piece.positions = elements<vec3>(model, primitive.attributes.at("POSITION"));
        piece.normals = elements<vec3>(model, primitive.attributes.at("NORMAL"));
        if (const auto it = primitive.attributes.find("TEXCOORD_0"); it != primitive.attributes.end())
          piece.coordinates = elements<glm::vec<2, std::uint16_t>>(model, it->second);
        piece.indices = indices(model, primitive);
        piece.material = &model.materials.at(primitive.material);
      }
  }

  /// Emission at texture coordinates; Khronos, glTF 2.0 Specification (2021), 3.8.4.
  glm::dvec3 at(const Piece& piece, const glm::dvec2& uv) const {
    const tinygltf::Material& material = *piece.material;
    glm::dvec3 emission(material.emissiveFactor[0], material.emissiveFactor[1], material.emissiveFactor[2]);
    if (const auto it = material.extensions.find("KHR_materials_emissive_strength");
        it != material.extensions.end())
      emission *= it->second.Get("emissiveStrength").GetNumberAsDouble();
    if (material.emissiveTexture.index < 0) return emission;
    const tinygltf::Texture& texture = model.textures.at(material.emissiveTexture.index);
    const tinygltf::Image& image = model.images.at(texture.source);
    const auto texel = [&](int x, int y) {
      const unsigned char* t = &image.image.at(image.component * (y * image.width + x));
      return glm::dvec3(linearOf(t[0]), linearOf(t[1]), linearOf(t[2]));
    };
    const double u = std::clamp(2.0 * uv.x - 0.5, 0.0, 1.0), v = std::clamp(2.0 * uv.y - 0.5, 0.0, 1.0);
    return emission *
           glm::mix(glm::mix(texel(0, 0), texel(1, 0), u), glm::mix(texel(0, 1), texel(1, 1), u), v);
  }

  glm::dvec2 coordinates(const Piece& piece, std::uint32_t vertex) const {
    return piece.coordinates.empty() ? glm::dvec2(0.0) : glm::dvec2(piece.coordinates[vertex]) / 65535.0;
  }
};

Emitter written(const Scene& scene, const std::vector<ExportPart>& parts) {
  const Folder folder;
  EXPECT_TRUE(writeMeshes(folder / "a.glb", scene, parts));
  return Emitter(folder / "a.glb");
}

/// docs: 1 - strength * sum of (h - f(p + h n)) / h over the taps, by the graph itself, in double.
double occlusionByHand(const test::Evaluator& distance, const AmbientOcclusion& o, const glm::dvec3& p,
                       const glm::dvec3& n) {
  double hidden = 0.0;
  for (int i = 1; i <= o.count; ++i) {
    const double h = 0.08 * i;  // where the scene has a camera and says nothing else
    hidden += (h - std::min(h, distance(p + h * n))) / h;
  }
  return std::clamp(1.0 - uniformValue(o.strength) * hidden, 0.0, 1.0);
}

TEST(Bake, VerticesEmitTheAmbientLightThatReachesThem) {
  const Scene scene = sceneOf(kStage);
  const Emitter file = written(scene, bakedParts(scene));
  ASSERT_EQ(file.pieces.size(), 4u);  // the pair is two materials
  const test::Evaluator distance(scene.whole().distance);
  const glm::dvec3 answers[] = {{0.8, 0.6, 0.4}, {0.5, 0.5, 1.0}};
  double least = 1.0, most = 0.0;
  std::size_t all = 0, compared = 0;
  for (int k = 0; k < 2; ++k) {
    const Emitter::Piece& piece = file.pieces[k];
    for (std::uint32_t v = 0; v < piece.positions.size(); ++v) {
      const glm::dvec3 n = glm::normalize(glm::dvec3(piece.normals[v]));
      // On an edge the differences are of neither face.
      ++all;
      if (glm::distance(n, distance.gradient(glm::dvec3(piece.positions[v]), 1e-4)) > 1e-3) continue;
      ++compared;
      const double open =
          occlusionByHand(distance, scene.ambientOcclusion, glm::dvec3(piece.positions[v]), n);
      least = std::min(least, open);
      most = std::max(most, open);
      const glm::dvec3 meant = glm::dvec3(0.4, 0.5, 0.6) * answers[k] * open;
      const glm::dvec3 emitted = file.at(piece, file.coordinates(piece, v));
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(emitted[c], meant[c], kWritten) << "vertex " << v;
    }
  }
  EXPECT_GT(compared, all * 4 / 5);
  EXPECT_LT(least, 0.3) << "the corner is dark";
  EXPECT_EQ(most, 1.0);
}

/// Where a ray meets the file's triangles first.
struct Met {
  double t = kInfinity;
  const Emitter::Piece* piece = nullptr;
  glm::uvec3 corners{};
  glm::dvec3 weights{};
};

/// Moeller, Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
void meet(const glm::dvec3& from, const glm::dvec3& way, const Emitter::Piece& piece, Met& met) {
  for (std::size_t i = 0; i < piece.indices.size(); i += 3) {
    const glm::uvec3 t(piece.indices[i], piece.indices[i + 1], piece.indices[i + 2]);
    const glm::dvec3 a(piece.positions[t.x]), ab = glm::dvec3(piece.positions[t.y]) - a,
                                              ac = glm::dvec3(piece.positions[t.z]) - a, s = from - a;
    const glm::dvec3 h = glm::cross(way, ac), q = glm::cross(s, ab);
    const double det = glm::dot(ab, h), v = glm::dot(s, h) / det, w = glm::dot(way, q) / det;
    const double along = glm::dot(ac, q) / det;
    if (det > 0.0 && v >= 0.0 && w >= 0.0 && v + w <= 1.0 && along > 0.0 && along < met.t)
      met = {along, &piece, t, {1.0 - v - w, v, w}};
  }
}

/// Holds each pixel that a reader shows of the file, under no other light, to the picture; returns the root
/// mean square of their differences and their median.
std::array<double, 2> compareWithPicture(const Scene& scene, const Emitter& file) {
  const test::CpuRenderOptions options{.width = 64, .height = 48};
  const test::Picture picture = test::renderOnCpu(scene, options);
  const test::Pinhole camera(scene.camera, options.width, options.height);
  const AmbientOcclusion& o = scene.ambientOcclusion;
  const double strength = uniformValue(o.strength);
  double heights = 0.0;
  for (int i = 1; i <= o.count; ++i) heights += 1.0 / (0.08 * i);
  std::size_t hits = 0;
  std::vector<double> errors;
  for (int row = 0; row < options.height; ++row)
    for (int column = 0; column < options.width; ++column) {
      if (!picture.hit(column, row)) continue;
      ++hits;
      const glm::dvec3 way = camera.through(column + 0.5, row + 0.5);
      const std::size_t pixel = picture.at(column, row);
      Met met;
      for (const Emitter::Piece& piece : file.pieces) meet(camera.from(), way, piece, met);
      // An outline of the mesh is up to a voxel from the surface's: another surface may show.
      if (std::abs(met.t - picture.depth[pixel]) > 2.0 * kVoxel) continue;
      const glm::dvec3 p = camera.from() + picture.depth[pixel] * way, n = picture.normal[pixel];
      double away = 0.0, turned = 0.0;
      glm::dvec2 uv(0.0);
      for (int k = 0; k < 3; ++k) {
        away = std::max(away, glm::distance(p, glm::dvec3(met.piece->positions[met.corners[k]])));
        turned = std::max(turned, glm::distance(n, glm::dvec3(met.piece->normals[met.corners[k]])));
        uv += met.weights[k] * file.coordinates(*met.piece, met.corners[k]);
      }
      // A tap at height h changes by no more than its point moves: by what the surface's point does, and by h
      // times what the normal does. Of the blend's colours the weight changes by 1 / 0.3 a unit at most, by
      // 0.8 in all.
      const double bound = strength * (away * heights + turned * o.count) + 0.8 * away / 0.3 + kWritten;
      const glm::dvec3 off = glm::abs(file.at(*met.piece, uv) - picture.color[pixel]);
      const double error = std::max({off.x, off.y, off.z});
      EXPECT_LE(error, bound) << column << ", " << row;
      errors.push_back(error);
    }
  EXPECT_GT(hits, 1000u);
  EXPECT_GT(errors.size(), hits - hits / 20);
  std::ranges::sort(errors);
  const double squares = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
  return {std::sqrt(squares / static_cast<double>(errors.size())), errors[errors.size() / 2]};
}

TEST(Bake, AReaderShowsTheAmbientLightThatTheViewerShows) {
  Scene scene = sceneOf(kStage);
  scene.lights.clear();
  const auto [rms, median] = compareWithPicture(scene, written(scene, bakedParts(scene)));
  RecordProperty("rms", std::to_string(rms));
  RecordProperty("median", std::to_string(median));
  // Where nothing bends within a triangle the file is as good as its numbers.
  EXPECT_LT(median, kWritten);
}

TEST(Bake, WithoutOcclusionAllOfTheAmbientLightArrives) {
  const Scene scene =
      sceneOf("ambient(0.5) return box(1):paint { color = {0.5, 0.25, 0}, emission = {0, 1, 0} }");
  const std::vector<ExportPart> parts = bakedParts(scene);
  EXPECT_TRUE(parts[0].ambient->occlusion.empty());
  const Emitter file = written(scene, parts);
  EXPECT_EQ(file.model.textures.size(), 0u);
  const glm::dvec3 emitted = file.at(file.pieces[0], {});
  // The factor times the strength, in float.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(emitted[c], glm::dvec3(0.25, 1.125, 0.0)[c], 0x1p-23);
  EXPECT_EQ(parts[0].ambient->error, 0.0f);
}

// A gradient from below to above gives each normal a blend of two colours, which a file can hold.
TEST(Bake, TheBackgroundsLightFollowsTheNormals) {
  const Scene scene = sceneOf(
      "background_light(0.5) background(vertical_gradient({0.2, 0.4, 0.6}, {1, 0.8, 0.6}))"
      "return sphere(1):paint { color = {0.8, 0.5, 0.4} }");
  const Emitter file = written(scene, bakedParts(scene));
  const Emitter::Piece& piece = file.pieces[0];
  for (std::uint32_t v = 0; v < piece.positions.size(); ++v) {
    // Of what is linear in the direction a cosine leaves 2/3.
    const double up = 0.5 + 1.0 / 3.0 * static_cast<double>(piece.normals[v].y);
    const glm::dvec3 light = glm::mix(glm::dvec3(0.2, 0.4, 0.6), glm::dvec3(1.0, 0.8, 0.6), up);
    const glm::dvec3 emitted = file.at(piece, file.coordinates(piece, v));
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(emitted[c], 0.5 * light[c] * glm::dvec3(0.8, 0.5, 0.4)[c], kWritten) << "vertex " << v;
  }
}

TEST(Bake, OfTheBackgroundAReaderShowsWhatTheViewerShows) {
  Scene scene = sceneOf(kStage);
  scene.lights.clear();
  scene.ambient = Vec3E(0.1);
  scene.background = Vec3E(0.3, 0.4, 0.5);
  scene.backgroundLight = 1.0;
  const auto [rms, median] = compareWithPicture(scene, written(scene, bakedParts(scene)));
  EXPECT_LT(median, kWritten);
}

TEST(Bake, WithoutAmbientLightNothingIsRead) {
  const Scene scene = sceneOf("ambient(0) ambient_occlusion { kind = 'taps' } return box(1)");
  const std::vector<ExportPart> parts = bakedParts(scene);
  EXPECT_TRUE(parts[0].ambient->occlusion.empty());
}

TEST(Bake, OcclusionByStepsDependsOnWhoLooksAndIsLeftOut) {
  const Scene scene = sceneOf("ambient(0.5) ambient_occlusion { kind = 'steps' } return box(1)");
  EXPECT_TRUE(bakedParts(scene)[0].ambient->occlusion.empty());
}

TEST(Bake, TheFacesOfACutAreOutsideToo) {
  const Scene scene = sceneOf("ambient(0.5) ambient_occlusion { kind = 'taps' } return plane()");
  const Box clip{{-1.0, -0.5, -1.0}, {1.0, 0.5, 1.0}};
  const std::vector<ExportPart> parts = bakedParts(scene, clip);
  // A box alone hides nothing from its faces; float positions are off by an ulp.
  for (const float open : parts[0].ambient->occlusion) ASSERT_NEAR(open, 1.0f, 1e-5f);
}

TEST(Bake, OcclusionNeedsAKnownSlope) {
  const Scene scene = sceneOf(
      "ambient(0.5) ambient_occlusion { kind = 'taps' } bounds({-1, -1, -1}, {1, 1, 1})"
      "return field(function(x, y, z) return x * x * x + y * y * z + z * x end)");
  Progress progress;
  std::vector<ExportPart> parts = meshedParts(scene, Box{glm::dvec3(-1.0), glm::dvec3(1.0)});
  const Status status = bakeAmbient(scene, std::nullopt, parts, progress);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Scene);
  EXPECT_NE(status.error().message.find("slope of the scene's distance is not known"), std::string::npos);
  EXPECT_NE(status.error().message.find("lipschitz"), std::string::npos);
}

TEST(Bake, StopsWhenTold) {
  const Scene scene = sceneOf(kStage);
  std::vector<ExportPart> parts = meshedParts(scene);
  Progress progress;
  progress.stop();
  const Status status = bakeAmbient(scene, std::nullopt, parts, progress);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Interrupted);
}

}  // namespace bake_test
}  // namespace sdf
