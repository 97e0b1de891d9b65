// The views of meshes: pictures against the marched ones, and errors against geometry.
#include "viewer/render/mesh_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "support/folder.h"
#include "support/triangle_meshes.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/legend.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"
#include "viewer/shaders/error_colors.h"

namespace sdf::test {
namespace mesh_view_test {

using viewer::ErrorFigures;
using viewer::MeshErrors;
using viewer::MeshSettings;
using viewer::MeshView;
using viewer::View;

/// A ball and a box over a floor, under lights that cast shadows, in fog.
Scene furnished() {
  Scene scene;
  scene.add("ball", translate(sphere(0.7), Vec3E(Expr(0.9), Expr(0.1), Expr(0.0)))
                        .paint({.color = Vec3E(Expr(0.8), Expr(0.2), Expr(0.1)),
                                .specular = Vec3E(Expr(0.4)),
                                .shininess = 40.0}));
  scene.add("box", translate(box(Vec3E(glm::dvec3(0.5))), Vec3E(Expr(-0.7), Expr(-0.1), Expr(0.1)))
                       .paint({.color = Vec3E(Expr(0.1), Expr(0.4), Expr(0.8))}));
  scene.add("floor",
            translate(box(Vec3E(glm::dvec3(2.0, 0.1, 2.0))), Vec3E(Expr(0.0), Expr(-0.7), Expr(0.0))));
  scene.camera.from = Vec3E(Expr(1.5), Expr(2.0), Expr(4.5));
  scene.lights = standardLights();
  scene.shadow = standardShadow();
  scene.fog = {Vec3E(Expr(0.3)), Expr(0.05)};
  scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
  return scene;
}

MeshView meshOf(const Scene& scene, const MeshSettings& settings, bool errors = false) {
  Progress progress;
  auto view = viewer::makeMeshView(scene, {settings, {}, errors}, progress);
  if (!view) throw std::runtime_error(view.error().message);
  return std::move(*view);
}

GpuRenderOptions options(View view, const viewer::ShownMesh* mesh = nullptr) {
  GpuRenderOptions options;
  options.shader.view = view;
  options.mesh = mesh;
  return options;
}

// Blue beyond what anything in the scene is.
const glm::dvec3 kSky(0.0, 0.0, 1.0);
bool isBackground(const glm::vec4& c) { return glm::distance(glm::vec3(c), glm::vec3(kSky)) < 0.01f; }

TEST(MeshView, LooksLikeTheMarchedPicture) {
  Scene scene = furnished();
  scene.gamma = 1.0;
  scene.fog = {};
  scene.background = Vec3E(kSky);
  const MeshView mesh = meshOf(scene, {.tolerance = 1e-3});
  const auto marched = renderOnGpu(scene, options(View::Picture)),
             meshed = renderOnGpu(scene, options(View::Mesh, &mesh.shown));
  std::size_t apart = 0, hits = 0;
  for (std::size_t i = 0; i < marched.size(); ++i) {
    hits += !isBackground(marched[i]);
    apart += isBackground(marched[i]) != isBackground(meshed[i]);
  }
  EXPECT_GT(hits, marched.size() / 5);
  EXPECT_LE(apart, marched.size() / 500);  // pixels of the silhouette that a tolerance may decide
  EXPECT_GE(psnr(colors(marched), colors(meshed)), 35.0);
}

TEST(MeshView, IsLitByTheSceneInEveryRespect) {
  for (const int bounces : {0, 2}) {
    Scene scene = furnished();
    scene.reflectionBounces = bounces;
    if (bounces > 0)
      scene.add("mirror",
                translate(sphere(0.4), Vec3E(Expr(0.1), Expr(0.0), Expr(1.0))).paint({.reflectivity = 0.6}));
    const MeshView mesh = meshOf(scene, {.tolerance = 5e-4});
    EXPECT_GE(psnr(colors(renderOnGpu(scene, options(View::Picture))),
                   colors(renderOnGpu(scene, options(View::Mesh, &mesh.shown)))),
              33.0)
        << bounces;
  }
}

// Triangles of a coarse mesh lie under the surface: its own shadow must not fall on them.
TEST(MeshView, DoesNotShadowItself) {
  Scene scene;
  scene.add("ball", sphere(1.0).paint({.color = Vec3E(Expr(0.8))}));
  scene.camera.from = Vec3E(Expr(0.0), Expr(0.0), Expr(5.0));
  scene.lights = {sunTowards({0.0, 0.0, 1.0})};
  scene.shadow.kind = Shadow::Kind::Hard;
  scene.gamma = 1.0;
  const MeshView mesh = meshOf(scene, {.voxelSize = 0.4});
  const auto lit = renderOnGpu(scene, options(View::Mesh, &mesh.shown));
  scene.shadow.kind = Shadow::Kind::None;
  const auto without = renderOnGpu(scene, options(View::Mesh, &mesh.shown));
  EXPECT_LE(shareApart(colors(lit), colors(without), 0.02), 0.01);
}

TEST(MeshView, WithoutAMeshIsBackground) {
  Scene scene = darkScene();
  scene.add("ball", sphere(1.0));
  for (const View view : {View::Mesh, View::Wire, View::Error})
    for (const glm::vec4& c : renderOnGpu(scene, options(view)))
      ASSERT_LE(glm::distance(glm::vec3(c), view == View::Error ? glm::vec3(0.1f) : glm::vec3(0.0f)), 1e-6f);
}

TEST(SplitView, IsThePictureAndTheMeshBesideEachOther) {
  const Scene scene = furnished();
  const MeshView mesh = meshOf(scene, {.voxelSize = 0.1});
  for (const int samples : {1, 2})
    for (const double at : {0.5, 0.3}) {
      const auto draw = [&](View view) {
        GpuRenderOptions o = options(view, viewer::showsMesh(view) ? &mesh.shown : nullptr);
        o.samples = samples;
        o.split = at;
        return renderOnGpu(scene, o);
      };
      const auto picture = draw(View::Picture), meshed = draw(View::Mesh), split = draw(View::Split);
      const GpuRenderOptions o;
      const int divider = static_cast<int>(std::lround(at * o.width));
      for (std::size_t i = 0; i < split.size(); ++i) {
        const bool isLeft = static_cast<int>(i) % o.width < divider;
        ASSERT_EQ(split[i], (isLeft ? picture : meshed)[i])
            << "pixel " << i << " of " << at << ", " << samples;
      }
    }
}

TEST(WireView, DrawsEdgesOverTheMesh) {
  const Scene scene = furnished();
  const MeshView mesh = meshOf(scene, {.tolerance = 0.02});
  const auto plain = renderOnGpu(scene, options(View::Mesh, &mesh.shown)),
             wire = renderOnGpu(scene, options(View::Wire, &mesh.shown));
  const double share = shareApart(colors(plain), colors(wire), 0.02);
  EXPECT_GT(share, 0.03);
  EXPECT_LT(share, 0.5);
}

// Where triangles are smaller than pixels the surface is still seen, a little darker.
TEST(WireView, LeavesTheSurfaceVisibleWhereTrianglesAreTiny) {
  Scene scene;
  scene.add("ball", sphere(1.0).paint({.color = Vec3E(Expr(0.6))}));
  scene.camera.from = Vec3E(Expr(0.0), Expr(0.0), Expr(5.0));
  scene.lights = {sunTowards({0.0, 0.0, 1.0})};
  scene.gamma = 1.0;
  const MeshView mesh = meshOf(scene, {.voxelSize = 0.01});
  const auto plain = renderOnGpu(scene, options(View::Mesh, &mesh.shown)),
             wire = renderOnGpu(scene, options(View::Wire, &mesh.shown));
  const GpuRenderOptions o;
  const std::size_t middle = static_cast<std::size_t>(o.height / 2 * o.width + o.width / 2);
  EXPECT_LT(wire[middle].x, plain[middle].x);
  EXPECT_GT(wire[middle].x, 0.7f * plain[middle].x);
}

/// An octahedron whose sides are halved so many times, its corners on the unit sphere.
TriangleMesh coarseBall(int halvings) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (; halvings > 0; --halvings) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (isNew) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return place->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : mesh.triangles) {
      const auto a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
      finer.insert(finer.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
    }
    mesh.triangles = std::move(finer);
  }
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  return mesh;
}

MeshErrors errorsOf(const TriangleMesh& mesh, const Shape& shape, double tolerance = 0.0) {
  Progress progress;
  auto errors = viewer::measureErrors(mesh, shape, tolerance, progress);
  if (!errors) throw std::runtime_error(errors.error().message);
  return std::move(*errors);
}

constexpr double kFloat = 0x1p-22;  // of points near the unit sphere

TEST(MeshErrors, AreTheDistancesOfACoarseBallToASphere) {
  for (const int halvings : {0, 2}) {
    const TriangleMesh mesh = coarseBall(halvings);
    const MeshErrors errors = errorsOf(mesh, sphere(1.0));
    EXPECT_GT(errors.shown.vertices.size(), 3 * mesh.triangles.size());
    double deepest = 0.0;
    for (const viewer::BufferVertex& v : errors.shown.vertices) {
      EXPECT_NEAR(v.distance, glm::length(glm::dvec3(v.position)) - 1.0, kFloat);
      deepest = std::min(deepest, glm::length(glm::dvec3(v.position)) - 1.0);
    }
    EXPECT_NEAR(errors.figures.least, deepest, kFloat);
    EXPECT_NEAR(errors.figures.most, 0.0, kFloat);
    EXPECT_EQ(errors.figures.triangles, mesh.triangles.size());
    if (halvings == 0) {
      EXPECT_NEAR(deepest, 1.0 / std::sqrt(3.0) - 1.0, 2e-4);  // a 64th of a side from the middle of one
    }
  }
}

// Of the octahedron: the share of its area that is as far from the sphere as that. A side's points at a
// distance r from its middle are sqrt(1/3 + r^2) from the origin, and all rings up to 1/sqrt(6) are whole.
TEST(MeshErrors, HistogramIsTheShareOfTheArea) {
  const ErrorFigures figures = errorsOf(coarseBall(0), sphere(1.0), 0.5).figures;
  EXPECT_EQ(figures.limit, 0.5);
  EXPECT_EQ(figures.beyond(), 0.0);
  const double side = std::sqrt(3.0) / 2.0;
  double below = 0.0;
  int compared = 0;
  for (std::size_t bin = 0; bin < ErrorFigures::kBins; ++bin) {
    below += figures.histogram[bin + 1];
    const double distance = -0.5 + (static_cast<double>(bin) + 1.0) / ErrorFigures::kBins;
    const double squared = (1.0 + distance) * (1.0 + distance) - 1.0 / 3.0;
    if (squared > 1.0 / 6.0) break;
    const double expected = squared > 0.0 ? std::numbers::pi * squared / side : 0.0;
    // A piece's mean is up to its share of the side off: 64 to a side of sqrt(2).
    EXPECT_NEAR(below, expected, 0.02) << distance;
    ++compared;
  }
  EXPECT_GE(compared, 8);
  double sum = 0.0;
  for (const double share : figures.histogram) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(MeshErrors, CountWhatIsBeyondTheTolerance) {
  // A sphere that lies between the octahedron's points.
  const ErrorFigures figures = errorsOf(coarseBall(0), sphere(0.8), 0.1).figures;
  EXPECT_EQ(figures.limit, 0.1);
  EXPECT_GT(figures.histogram.front(), 0.1);
  EXPECT_GT(figures.histogram.back(), 0.001);
  EXPECT_NEAR(figures.most, 0.2, kFloat);
}

TEST(MeshErrors, WithoutAToleranceTheColoursReachToARoundNumber) {
  const ErrorFigures figures = errorsOf(coarseBall(2), sphere(1.0)).figures;
  EXPECT_EQ(figures.tolerance, 0.0);
  EXPECT_LE(figures.beyond(), 0.01);
  const double power = std::pow(10.0, std::floor(std::log10(figures.limit) + 1e-9));
  const double first = figures.limit / power;
  EXPECT_LE(std::min({std::abs(first - 1.0), std::abs(first - 2.0), std::abs(first - 5.0)}), 1e-9) << first;
  double beyondNext = 0.0;  // the next lower one is at 2/5 of the limit at least
  for (std::size_t bin = 0; bin < ErrorFigures::kBins; ++bin)
    if (std::abs(2.0 * (static_cast<double>(bin) + 0.5) / ErrorFigures::kBins - 1.0) > 0.4)
      beyondNext += figures.histogram[bin + 1];
  EXPECT_GT(beyondNext, 0.01);
}

// Half as steep, and twice: a distance that is none is divided by its slope.
TEST(MeshErrors, DivideWhatIsNoDistanceByItsSlope) {
  for (const double factor : {0.5, 2.0}) {
    Shape steep = sphere(1.0);
    steep.distance = factor * steep.distance;
    steep.claim = {ClaimKind::Field, 2.0};
    const MeshErrors errors = errorsOf(coarseBall(2), steep);
    for (const viewer::BufferVertex& v : errors.shown.vertices)
      EXPECT_NEAR(v.distance, glm::length(glm::dvec3(v.position)) - 1.0, kFloat) << factor;
  }
}

// Its slope goes to 0 in the middle, where the first order knows no end.
TEST(MeshErrors, OfASlopeThatVanishesAreTheWayOut) {
  Shape round = sphere(1.0);
  const Vec3E p = position();
  round.distance = 0.5 * (dot(p, p) - 1.0);
  round.claim = {ClaimKind::Field, 2.0};
  TriangleMesh small = coarseBall(1);
  for (glm::vec3& at : small.positions) at *= 0.2f;
  const MeshErrors errors = errorsOf(small, round);
  for (const viewer::BufferVertex& v : errors.shown.vertices)
    EXPECT_NEAR(v.distance, glm::length(glm::dvec3(v.position)) - 1.0, 1e-6);
}

// The parts of a scene overlap; what lies within another is still on its own part's surface.
TEST(MeshErrors, OfASceneAreThoseOfEachPartAndKeepItsTolerance) {
  Scene scene;
  scene.add("a", sphere(1.0));
  scene.add("b", translate(sphere(1.0), Vec3E(Expr(0.8), Expr(0.0), Expr(0.0))));
  const MeshView mesh = meshOf(scene, {.tolerance = 0.01}, true);
  const ErrorFigures& figures = mesh.errors->figures;
  EXPECT_EQ(figures.limit, 0.01);
  EXPECT_EQ(figures.beyond(), 0.0);
  const double most = std::max(-figures.least, figures.most);
  EXPECT_LE(most, 0.01);
  const MeshStats stats = combined(mesh.own->parts);
  EXPECT_NEAR(most, stats.maxDistance, 0.2 * stats.maxDistance);
  EXPECT_NEAR(figures.rms, stats.rmsDistance, 0.2 * stats.rmsDistance);
}

TEST(MeshErrors, OfABoundedSceneAreThoseOfWhatIsCut) {
  Scene scene;
  scene.add("floor", plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), 0.0));
  scene.bounds = Box::centred(glm::dvec3(1.0));
  const MeshView mesh = meshOf(scene, {.voxelSize = 0.1}, true);
  EXPECT_LE(std::max(-mesh.errors->figures.least, mesh.errors->figures.most), 1e-5);
}

TEST(MeshErrors, StopWhenTheyAreTold) {
  Progress progress;
  progress.stop();
  const auto errors = viewer::measureErrors(coarseBall(2), sphere(1.0), 0.0, progress);
  ASSERT_FALSE(errors);
  EXPECT_EQ(errors.error().kind, ErrorKind::Interrupted);
}

// Each pixel in the middle of what it sees: the colour of that point's distance.
TEST(ErrorView, ShowsTheColoursOfTheDistances) {
  const TriangleMesh mesh = coarseBall(2);
  const MeshErrors errors = errorsOf(mesh, sphere(1.0));
  Scene scene = darkScene();
  scene.add("ball", sphere(1.0));
  GpuRenderOptions o = options(View::Error, &errors.shown);
  o.width = kWidth, o.height = kHeight;
  o.errorLimit = errors.figures.limit;
  const auto shown = renderOnGpu(scene, o);
  int compared = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 d = rayThrough(column, row);
      // The nearest triangle that the ray meets; the mesh is convex.
      double t = 1e9;
      glm::dvec3 normal(0.0);
      for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
            c(mesh.positions[triangle.z]);
        const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        const double slope = glm::dot(n, d), here = glm::dot(a - kEye, n) / slope;
        if (!(slope < 0.0)) continue;
        const glm::dvec3 p = kEye + here * d;
        const auto within = [&](const glm::dvec3& u, const glm::dvec3& v) {
          return glm::dot(glm::cross(v - u, p - u), n) > 1e-3;
        };
        if (within(a, b) && within(b, c) && within(c, a)) t = here, normal = n;
      }
      if (t == 1e9) continue;
      const double off = glm::length(kEye + t * d) - 1.0;
      const glm::dvec3 color = glm::dvec3(viewer::errorColor(off / errors.figures.limit)) *
                               (0.55 + 0.45 * std::abs(glm::dot(normal, d)));
      const glm::dvec3 is(shown[static_cast<std::size_t>(row) * kWidth + column]);
      // Distances are interpolated between points 1/86 apart, which is 2e-5 of 0.05; a colour changes by 2
      // over the limits.
      ASSERT_LE(farthest(is, color), 5e-3) << "pixel " << column << ", " << row;
      ++compared;
    }
  EXPECT_GT(compared, 500);
}

TEST(ErrorView, HasColoursOfItsOwnBeyondTheLimit) {
  for (const double radius : {0.5, 2.0}) {
    const MeshErrors errors = errorsOf(coarseBall(2), sphere(radius), 0.1);
    Scene scene = darkScene();
    scene.add("ball", sphere(1.0));
    GpuRenderOptions o = options(View::Error, &errors.shown);
    o.errorLimit = 0.1;
    const auto shown = renderOnGpu(scene, o);
    const glm::vec3 middle(shown[static_cast<std::size_t>(o.height / 2 * o.width + o.width / 2)]);
    const glm::vec3 expected = radius < 1.0 ? viewer::kErrorColors.back() : viewer::kErrorColors.front();
    EXPECT_LE(glm::distance(glm::normalize(middle), glm::normalize(expected)), 1e-3f) << radius;
  }
}

TEST(ErrorColors, AreTheTablesAndInBetween) {
  EXPECT_EQ(viewer::errorColor(0.0), viewer::kErrorColors[5]);
  EXPECT_EQ(viewer::errorColor(-1.0), viewer::kErrorColors[1]);
  EXPECT_EQ(viewer::errorColor(1.0), viewer::kErrorColors[9]);
  EXPECT_EQ(viewer::errorColor(1.01), viewer::kErrorColors[10]);
  EXPECT_EQ(viewer::errorColor(-1.01), viewer::kErrorColors[0]);
  const glm::vec3 between = 0.5f * (viewer::kErrorColors[5] + viewer::kErrorColors[6]);
  EXPECT_LE(glm::distance(viewer::errorColor(0.125), between), 1e-6f);
}

glm::ivec3 pixel(const viewer::Picture& p, int x, int y) {
  const std::uint8_t* at = &p.bytes[static_cast<std::size_t>(p.channels * (y * p.width + x))];
  return {at[0], at[1], at[2]};
}

TEST(Legend, ShowsEveryColourAndBarsAsHighAsTheirShares) {
  ErrorFigures figures;
  figures.limit = 0.5;
  figures.histogram.assign(ErrorFigures::kBins + 2, 0.0);
  figures.histogram[1] = 0.25;
  figures.histogram[ErrorFigures::kBins] = 1.0;
  const viewer::Picture legend = viewer::legendOf(figures, 1);
  const auto rgb = [](const glm::vec3& c) { return glm::ivec3(glm::round(255.0f * c)); };
  int red = -1;
  for (int y = 0; y < legend.height && red < 0; ++y)
    for (int x = 0; x < legend.width; ++x)
      if (pixel(legend, x, y) == rgb(viewer::kErrorColors.back())) red = y;
  ASSERT_GE(red, 0) << "no colour of what is beyond";
  const auto barAbove = [&](double share) {
    for (int x = 0; x < legend.width; ++x) {
      if (pixel(legend, x, red) != rgb(viewer::errorColor(share))) continue;
      int height = 0;
      while (pixel(legend, x, red - 3 - height) == glm::ivec3(242)) ++height;
      return height;
    }
    return -1;
  };
  const double last = 1.0 - 1.0 / ErrorFigures::kBins;
  EXPECT_EQ(barAbove(0.0 - 1.0 / ErrorFigures::kBins), 0);
  EXPECT_GT(barAbove(last), 20);
  EXPECT_NEAR(barAbove(-last), 0.5 * barAbove(last), 1.0);
}

TEST(Legend, IsLaidOverTheLowerRightAndLeavesTheRest) {
  const ErrorFigures figures = errorsOf(coarseBall(1), sphere(1.0), 0.1).figures;
  for (const int scale : {1, 2}) {
    const viewer::Picture legend = viewer::legendOf(figures, scale);
    viewer::Picture picture{800 * scale, 540 * scale, 3, {}};
    picture.bytes.assign(static_cast<std::size_t>(3 * picture.width * picture.height), 200);
    viewer::drawLegend(figures, picture);
    EXPECT_EQ(pixel(picture, 10, 10), glm::ivec3(200));
    EXPECT_EQ(pixel(picture, picture.width - legend.width - 11, picture.height - 20), glm::ivec3(200));
    EXPECT_LT(pixel(picture, picture.width - 11, picture.height - 11).x, 100);
  }
  viewer::Picture small{32, 24, 4, std::vector<std::uint8_t>(4 * 32 * 24, 7)};
  const auto before = small.bytes;
  viewer::drawLegend(figures, small);
  EXPECT_EQ(small.bytes, before);
}

std::string refusal(const Scene& scene, const viewer::MeshRequest& request) {
  Progress progress;
  const auto view = viewer::makeMeshView(scene, request, progress);
  return view ? "" : view.error().message;
}

TEST(MeshView, SaysWhatCannotBeMeshed) {
  Scene floor, nothing;
  floor.add("floor", plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), 0.0));
  EXPECT_NE(refusal(floor, {}).find("part 'floor': unbounded in x, y and z"), std::string::npos)
      << refusal(floor, {});
  nothing.add("gone", sphere(1.0) - sphere(2.0));
  EXPECT_NE(refusal(nothing, {}).find("part 'gone'"), std::string::npos) << refusal(nothing, {});
  EXPECT_NE(refusal(nothing, {}).find("surface"), std::string::npos) << refusal(nothing, {});
}

TEST(MeshView, ShowsAFileAgainstTheScene) {
  const Folder folder;
  std::ofstream(folder / "tip.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  Scene scene;
  scene.add("ball", sphere(0.5));
  Progress progress;
  const auto view = viewer::makeMeshView(scene, {{.tolerance = 0.25}, folder / "tip.obj", true}, progress);
  ASSERT_TRUE(view) << view.error().message;
  EXPECT_FALSE(view->own);
  EXPECT_EQ(view->shown.triangles.size(), 3u);
  EXPECT_NEAR(view->errors->figures.least, -0.5, kFloat);
  EXPECT_NEAR(view->errors->figures.most, 0.5, kFloat);
  EXPECT_EQ(view->errors->figures.limit, 0.25);
  EXPECT_NE(refusal(scene, {{}, folder / "none.obj", false}).find("none.obj"), std::string::npos);
}

// The exporter's defaults: a tolerance of 1/2000 of the diagonal, voxels of 1/200 of the longest side.
TEST(SceneMesh, IsWhatTheExporterMakes) {
  Scene scene;
  scene.add("box", box(Vec3E(glm::dvec3(0.5, 1.0, 0.25))));
  Progress progress;
  const auto fine = viewer::meshScene(scene, {}, progress);
  ASSERT_TRUE(fine) << fine.error().message;
  const double diagonal = 2.0 * std::sqrt(0.25 + 1.0 + 0.0625);
  EXPECT_NEAR(fine->diagonal, diagonal, 1e-9);
  EXPECT_NEAR(fine->tolerance, diagonal / 2000.0, 1e-12);
  EXPECT_NEAR(fine->parts.at(0).stats.voxelSize, 0.01, 1e-12);
  const auto uniform = viewer::meshScene(scene, {.voxelSize = 0.1}, progress);
  ASSERT_TRUE(uniform) << uniform.error().message;
  EXPECT_EQ(uniform->tolerance, 0.0);
  EXPECT_EQ(uniform->parts.at(0).stats.voxelSize, 0.1);
  EXPECT_GT(uniform->parts.at(0).stats.triangles, fine->parts.at(0).stats.triangles);
  const auto share = viewer::meshScene(scene, {.tolerance = 0.01, .toleranceOfDiagonal = true}, progress);
  ASSERT_TRUE(share) << share.error().message;
  EXPECT_NEAR(share->tolerance, 0.01 * diagonal, 1e-9);
}

}  // namespace mesh_view_test
}  // namespace sdf::test
