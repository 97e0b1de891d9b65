// Meshes from files among marched shapes, drawn as triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "sdf/shape/solids/triangle_solid.h"
#include "support/triangle_meshes.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"

namespace sdf::test {
namespace drawn_mesh_test {

using viewer::View;

const glm::vec3 kHalf(0.8f, 0.5f, 0.6f);

Shape meshOf(TriangleMesh mesh, int voxels = 64) {
  auto field = MeshField::make(std::move(mesh), voxels);
  if (!field) ADD_FAILURE() << field.error().message;
  return triangleSolid(*field);
}

/// A box of triangles, each side with corners of its own, so that they have no normals to share.
Shape drawnBox() { return meshOf(apart(boxOf(-kHalf, kHalf))); }
Shape marchedBox() { return box(Vec3E(glm::dvec3(kHalf))); }

Shape turned(const Shape& s) {
  return translate(rotate(s, {0.3, 0.5, 0.1}), Vec3E(Expr(0.2), Expr(0.3), Expr(0.1)));
}

const Material kPaint{.color = Vec3E(Expr(0.7), Expr(0.3), Expr(0.1)), .specular = Vec3E(Expr(0.5))};

/// The shape through a ball, over a floor, under two lights.
Scene among(const Shape& shape) {
  Scene scene;
  scene.add("shape", shape.paint(kPaint));
  scene.add("ball", translate(sphere(0.7), Vec3E(Expr(0.9), Expr(0.2), Expr(0.5)))
                        .paint({.color = Vec3E(Expr(0.2), Expr(0.4), Expr(0.8))}));
  scene.add("floor", plane({0.0, 1.0, 0.0}, 0.6));
  scene.camera.from = Vec3E(Expr(1.0), Expr(1.8), Expr(4.0));
  scene.lights = standardLights();
  return scene;
}

double rms(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 off = glm::dvec3(a[i]) - glm::dvec3(b[i]);
    sum += glm::dot(off, off) / 3.0;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

GpuRenderOptions views(View view, int samples = 1) {
  GpuRenderOptions options;
  options.shader.view = view;
  options.samples = samples;
  options.format = viewer::PixelFormat::Rgba32f;
  return options;
}

// Pixels that differ at all lie on edges: there rays that pass by at a hair may be decided either way.
double shareThatDiffers(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
  return shareApart(colors(a), colors(b), 0.02);
}

TEST(DrawnMesh, IsDrawnWhereTheShapeIsMarched) {
  const viewer::ShaderOptions drawing;
  EXPECT_EQ(viewer::planOf(among(turned(drawnBox())), drawing)->drawn.size(), 1u);
  EXPECT_TRUE(viewer::planOf(among(round(turned(drawnBox()), 0.1)), drawing)->drawn.empty());
  EXPECT_TRUE(viewer::planOf(among(turned(drawnBox()) - sphere(0.2)), drawing)->drawn.empty());
  viewer::ShaderOptions marching;
  marching.drawing = false;
  EXPECT_TRUE(viewer::planOf(among(turned(drawnBox())), marching)->drawn.empty());
  EXPECT_EQ(viewer::planOf(among(scale(turned(drawnBox()), 0.5) | turned(drawnBox())), drawing)->drawn.size(),
            2u);
}

// The same geometry, so the same hits and normals: at each pixel, through the ball and into the floor.
TEST(DrawnMesh, MeetsMarchedShapesWhereItShould) {
  for (const int samples : {1, 3})
    for (const View view : {View::Normals, View::Material}) {
      const auto drawn = renderOnGpu(among(turned(drawnBox())), views(view, samples));
      const auto marched = renderOnGpu(among(turned(marchedBox())), views(view, samples));
      EXPECT_LE(shareThatDiffers(drawn, marched), 2e-3) << static_cast<int>(view) << " " << samples;
    }
}

TEST(DrawnMesh, IsLitLikeAMarchedShape) {
  Scene drawn = among(turned(drawnBox())), marched = among(turned(marchedBox()));
  for (Scene* scene : {&drawn, &marched}) {
    scene->fog = {Vec3E(Expr(0.3)), Expr(0.1)};
    scene->reflectionBounces = 0;
  }
  EXPECT_LE(
      shareThatDiffers(renderOnGpu(drawn, views(View::Picture)), renderOnGpu(marched, views(View::Picture))),
      2e-4);
}

// Its shadow and the occlusion beside it come from samples of its distance.
TEST(DrawnMesh, CastsShadowsAndOccludes) {
  for (const Shadow::Kind kind : {Shadow::Kind::Hard, Shadow::Kind::Soft}) {
    Scene drawn = among(turned(drawnBox())), marched = among(turned(marchedBox()));
    for (Scene* scene : {&drawn, &marched}) {
      scene->shadow.kind = kind;
      scene->ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
    }
    const auto a = renderOnGpu(drawn, views(View::Picture, 2)),
               b = renderOnGpu(marched, views(View::Picture, 2));
    EXPECT_LE(rms(a, b), 0.02);
    EXPECT_LE(shareThatDiffers(a, b), 0.02);
  }
}

TEST(DrawnMesh, LooksAsItsFileSays) {
  TriangleMesh quad;
  quad.positions = {{-1.0f, -1.0f, 0.0f}, {1.0f, -1.0f, 0.0f}, {-1.0f, 1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}};
  quad.textureAt = {{0.0f, 1.0f}, {1.0f, 1.0f}, {0.0f, 0.0f}, {1.0f, 0.0f}};
  quad.triangles = {{0, 1, 2}, {1, 3, 2}};
  quad.materialOf = {0, 0};
  quad.materials = {{.color = glm::vec3(0.5f), .colorTexture = 0}};
  quad.images = {{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}}};
  TriangleMesh closing = boxOf({-1.0f, -1.0f, -0.5f}, {1.0f, 1.0f, -0.1f});  // so that there is a solid
  closing.textureAt.resize(8);
  TriangleMesh both = together(quad, closing);
  both.textureAt = quad.textureAt;
  both.textureAt.resize(both.positions.size());
  both.materials = {quad.materials[0], {.color = glm::vec3(0.1f)}};
  both.images = quad.images;
  for (std::size_t i = 2; i < both.triangles.size(); ++i) both.materialOf[i] = 1;
  Scene scene;
  scene.add("quad", meshOf(both));
  scene.camera.from = Vec3E(Expr(0.0), Expr(0.0), Expr(4.0));
  scene.lights = standardLights();
  const GpuRenderOptions options = views(View::Material);
  const auto shown = renderOnGpu(scene, options);
  const auto at = [&](double x, double y) {
    const int column = static_cast<int>((0.5 + x) * options.width),
              row = static_cast<int>((0.5 - y) * options.height);
    return glm::vec3(shown[static_cast<std::size_t>(row) * options.width + column]);
  };
  const double off =
      0.5 / (8.0 * std::tan(glm::radians(22.5)));  // the middle of a texel, of the picture's height
  const float half = 0.7353569f;                   // 0.5 in sRGB
  const auto expectNear = [](const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LE(glm::distance(a, b), 0.05f);
  };
  expectNear(at(-off * options.height / options.width, off), {half, 0.0f, 0.0f});
  expectNear(at(off * options.height / options.width, off), {0.0f, half, 0.0f});
  expectNear(at(-off * options.height / options.width, -off), {0.0f, 0.0f, half});
  expectNear(at(off * options.height / options.width, -off), {half, half, half});
}

// Straight on a metal mirrors in its own colour, the less the rougher it is; drawn and marched alike.
TEST(DrawnMesh, OfMetalMirrorsInItsColour) {
  const glm::dvec3 gold(0.8, 0.4, 0.2);
  for (const float roughness : {0.0f, 0.25f}) {
    TriangleMesh mesh = boxOf(-kHalf, kHalf);
    mesh.materials = {{.color = glm::vec3(gold), .metallic = 1.0f, .roughness = roughness}};
    Scene scene;
    scene.add("", meshOf(mesh));
    scene.camera.from = Vec3E(Expr(0.0), Expr(0.0), Expr(4.0));
    scene.ambient = Vec3E(0.0);
    scene.background = Vec3E(1.0);
    scene.gamma = 1.0;
    for (const bool drawing : {true, false}) {
      GpuRenderOptions options = views(View::Picture);
      options.shader.drawing = drawing;
      const auto shown = renderOnGpu(scene, options);
      const glm::dvec3 middle(shown[(options.height / 2) * options.width + options.width / 2]);
      EXPECT_LE(glm::distance(middle, (1.0 - roughness) * gold), 0.01) << roughness << " " << drawing;
    }
  }
}

TEST(DrawnMesh, PaintTakesThePlaceOfItsOwnLook) {
  TriangleMesh mesh = boxOf(-kHalf, kHalf);
  mesh.materials = {{.color = glm::vec3(0.9f, 0.1f, 0.1f)}};
  EXPECT_TRUE(viewer::planOf(
                  [&] {
                    Scene s;
                    s.add("", meshOf(mesh));
                    return s;
                  }(),
                  {})
                  ->drawn.at(0)
                  .own);
  const auto drawn = renderOnGpu(among(meshOf(mesh)), views(View::Material));
  EXPECT_LE(rms(drawn, renderOnGpu(among(marchedBox()), views(View::Material))), 0.02);
}

// A camera within the box sees its inner sides, and one far from the origin is as sharp.
TEST(DrawnMesh, IsSeenFromWithinAndFarAway) {
  Scene inside = among(drawnBox());
  inside.camera.from = Vec3E(Expr(-0.6), Expr(0.2), Expr(0.3));
  inside.camera.to = Vec3E(Expr(0.0));
  for (const glm::vec4& pixel : renderOnGpu(inside, views(View::Normals)))
    EXPECT_GT(glm::distance(glm::vec3(pixel), glm::vec3(0.1f)), 0.01f);
  const Vec3E far(Expr(3000.0), Expr(-2000.0), Expr(1000.0));
  const auto moved = [&](const Shape& shape) {
    Scene scene;
    scene.add("", translate(turned(shape), far).paint(kPaint));
    scene.camera.from = far + Vec3E(Expr(1.0), Expr(1.8), Expr(4.0));
    scene.camera.to = far;
    return renderOnGpu(scene, views(View::Normals));
  };
  EXPECT_LE(shareThatDiffers(moved(drawnBox()), moved(marchedBox())), 2e-3);
}

}  // namespace drawn_mesh_test
}  // namespace sdf::test
