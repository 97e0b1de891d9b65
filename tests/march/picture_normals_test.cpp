// Every shape of the catalog in a picture: normals at smooth places are those of the surface around a pixel.
#include "march/scenes.h"
#include "sdf/march/normals.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "shape/cases.h"
#include "support/smooth_normals.h"

namespace sdf {
namespace picture_normals_test {

constexpr int kPixels = 32;  // along each side
constexpr int kRays = 5;     // of a pixel: its own and four around it

// What a picture shows: the points that its rays meet, and four facets around each pixel.
struct Seen {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::uvec3> triangles;
};

struct Camera {
  glm::dvec3 centre, to, right;
  double radius, beside;  // of the view; from a pixel's ray to those around it
};

// Parallel, so that the lattices of pixels and of faces meet as they do in pictures from the front.
Rays raysOf(const Camera& c) {
  const glm::dvec3 up = glm::cross(c.right, c.to);
  const double pixel = 2.0 * c.radius / kPixels;
  const glm::dvec2 around[kRays] = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Rays rays;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x)
      for (const glm::dvec2& o : around) {
        const double a = (x - 0.5 * kPixels) * pixel + o.x * c.beside;
        const double b = (y - 0.5 * kPixels) * pixel + o.y * c.beside;
        rays.add(c.centre + a * c.right + b * up - 2.0 * c.radius * c.to, c.to, 0.0, 4.0 * c.radius);
      }
  return rays;
}

Seen pictureOf(const Shape& solid, const Camera& camera) {
  const Rays rays = raysOf(camera);
  const MarchField field = marchField(solid).value();
  MarchOptions options;
  options.method = MarchMethod::AutoRelaxed;
  options.epsilon = 1e-3 * camera.beside;
  options.refinements = 1;
  options.maxSteps = 1000000;
  const Hits hits = test::trace(field, rays, options);
  Vectors points, back;
  for (std::size_t i = 0; i < rays.size(); ++i)
    points.add(rays.at(i, hits.t[i])), back.add(-rays.direction[i]);
  const Vectors found = normals(field, points, back, {}).value();
  Seen seen;
  for (std::size_t i = 0; i < rays.size(); ++i)
    seen.positions.emplace_back(points[i]), seen.normals.emplace_back(found[i]);
  for (unsigned p = 0; p < rays.size(); p += kRays) {
    const auto hit = [&](unsigned i) { return hits.status[p + i] == RayStatus::Hit; };
    if (!hit(0) || !hit(1) || !hit(2) || !hit(3) || !hit(4)) continue;
    for (unsigned i = 0; i < 4; ++i) seen.triangles.emplace_back(p, p + 1 + i, p + 1 + (i + 1) % 4);
  }
  return seen;
}

// Seen from the front, from above and askew.
void expectSmoothNormals(const std::string& name, const Shape& shape) {
  const Shape solid = shape.bounds.finite() ? shape : shape & box(Vec3E(1.5));
  const double radius = 0.5 * glm::length(solid.bounds.size());
  const glm::dvec3 askew = glm::normalize(glm::dvec3(-3, -2, -4)),
                   right = glm::normalize(glm::dvec3(4, 0, -3));
  const std::pair<glm::dvec3, glm::dvec3> ways[] = {
      {{0, 0, -1}, {1, 0, 0}}, {{0, -1, 0}, {1, 0, 0}}, {askew, right}};
  std::size_t smooth = 0;
  for (const auto& [to, right] : ways) {
    const Camera camera{solid.bounds.centre(), to, right, radius, 1e-3 * radius};
    const Seen seen = pictureOf(solid, camera);
    const test::SmoothNormals found =
        test::smoothNormals(seen.positions, seen.normals, seen.triangles, 4, 0.1 * camera.beside);
    EXPECT_EQ(found.wrong, 0u) << name << ": of " << found.smooth << "; " << found.firstWrong;
    smooth += found.smooth;
  }
  EXPECT_GT(smooth, 0u) << name;
}

TEST(PictureNormals, AreThoseOfTheSurfaceWhereAnyShapeOfTheCatalogIsSmooth) {
  for (const test::ShapeCase& c : test::primitiveCases()) {
    const Shape& s = c.shape;
    expectSmoothNormals(c.name, s.dimension == 3 ? s : extrude(s, 0.3));
    if (s.dimension == 3) continue;
    const double size = std::max(s.bounds.max.x, -s.bounds.min.x);
    expectSmoothNormals(c.name + ", revolved", revolve(s, 1.25 * size));
  }
}

}  // namespace picture_normals_test
}  // namespace sdf
