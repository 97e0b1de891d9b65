// Every shape of the catalog, meshed: normals at smooth places are those of the mesh.
#include <gtest/gtest.h>

#include <set>

#include "mesh/scenes.h"
#include "sdf/mesh/dress/fit_normals.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"
#include "shape/cases.h"
#include "support/smooth_normals.h"

namespace sdf::test {
namespace vertex_normals_test {

// Were there smooth places to look at? In a mesh of some ten thousand vertices.
bool hasSmoothNormals(const std::string& name, const Shape& shape) {
  const Shape solid = shape.bounds.finite() ? shape : shape & box(Vec3E(1.5));
  const glm::dvec3 size = solid.bounds.size();
  const double least = std::min({size.x, size.y, size.z}), most = solid.bounds.longestSide();
  Progress progress;
  const MeshOptions options{.voxelSize = std::max(std::min(least / 10.0, most / 40.0), most / 150.0)};
  const Result<MeshedShape> meshed = meshShape(solid, name, options, progress);
  if (!meshed || meshed->stats.unresolved > meshed->stats.vertices) return false;  // most of it too thin
  const Mesh& mesh = meshed->mesh;
  // Sides of a thousandth of a voxel are still ten roundings of their ends long.
  const SmoothNormals found =
      smoothNormals(mesh.positions, mesh.normals, mesh.triangles, 3, 0.001 * options.voxelSize);
  EXPECT_EQ(found.wrong, 0u) << name << ": of " << found.smooth << "; " << found.firstWrong;
  return found.smooth > 0;
}

TEST(VertexNormals, AreThoseOfTheMeshWhereAnyShapeOfTheCatalogIsSmooth) {
  std::set<std::string> entries, seen;
  for (const ShapeCase& c : primitiveCases()) {
    const std::string entry = c.name.substr(0, c.name.find(' '));
    entries.insert(entry);
    const Shape& s = c.shape;
    if (hasSmoothNormals(c.name, s.dimension == 3 ? s : extrude(s, 0.3))) seen.insert(entry);
    if (s.dimension == 3) continue;
    entries.insert(entry + ", revolved");
    const double size = std::max(s.bounds.max.x, -s.bounds.min.x);
    if (hasSmoothNormals(c.name + ", revolved", revolve(s, 1.25 * size))) seen.insert(entry + ", revolved");
  }
  EXPECT_EQ(seen, entries);
}

TEST(VertexNormals, AreThoseOfTheMeshWhereOperatorsMeetFlatFaces) {
  const Shape p = pyramid(1.0, 1.0), s = extrude(star(5, 1.0, 0.45), 0.5);
  const Shape smooth = unite(box(Vec3E(1.0)), translate(p, Vec3E(0.0, 1.5, 0.0)), Blend::quadratic(0.2));
  EXPECT_TRUE(hasSmoothNormals("smooth union", smooth));
  EXPECT_TRUE(hasSmoothNormals("rotated", rotate(p, Vec3E(0.3, 0.5, 0.0))));
  EXPECT_TRUE(hasSmoothNormals("rounded pyramid", round(p, 0.1)));
  EXPECT_TRUE(hasSmoothNormals("rounded octahedron", round(octahedron(1.0), 0.1)));
  EXPECT_TRUE(hasSmoothNormals("rounded tetrahedron", round(tetrahedron(1.0), 0.1)));
  EXPECT_TRUE(hasSmoothNormals("rounded star", round(s, 0.05)));
  EXPECT_TRUE(hasSmoothNormals("shell", shell(p, 0.1)));
  EXPECT_TRUE(hasSmoothNormals("twisted", twist(s, 1.0)));
  EXPECT_TRUE(hasSmoothNormals("scaled", scale(s, Vec3E(1.0, 2.0, 1.0))));
}

// The normals of a shape's vertices before and after they are fitted to the mesh.
struct Fitted {
  std::vector<glm::vec3> positions, exact, normals;
  std::vector<glm::uvec3> triangles;

  Fitted(const Shape& shape, double h) {
    NarrowBand band = bandOf(shape, shape.bounds, h);
    Progress progress;
    RawSurface raw = band.extract();
    positions = std::move(raw.points), triangles = std::move(raw.triangles);
    refineVertices(positions, exact, BandField(band, wholeTapes(tapeOf(shape))), progress);
    normals = exact;
    fitNormals(positions, triangles, normals);
  }
  // Vertices whose normals are farther than the fitting angle from the mean of the facets around them, those
  // of less than a hundredth of the largest left out.
  std::size_t unfit(const std::vector<glm::vec3>& given) const {
    std::vector<std::vector<std::pair<glm::dvec3, double>>> fans(positions.size());  // areas and angles
    for (const glm::uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p(positions[t[k]]), a(positions[t[(k + 1) % 3]]), b(positions[t[(k + 2) % 3]]);
        const double cosine = glm::dot(glm::normalize(a - p), glm::normalize(b - p));
        fans[t[k]].emplace_back(glm::cross(a - p, b - p), std::acos(std::clamp(cosine, -1.0, 1.0)));
      }
    constexpr double kRounding = 1e-6;  // of normals in float
    std::size_t count = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      double largest = 0.0;
      for (const auto& [area, angle] : fans[i]) largest = std::max(largest, glm::length(area));
      glm::dvec3 sum(0.0);
      for (const auto& [area, angle] : fans[i])
        if (glm::length(area) > 0.01 * largest) sum += glm::normalize(area) * angle;
      count += glm::dot(glm::normalize(sum), glm::dvec3(given[i])) < std::cos(kFittingAngle) - kRounding;
    }
    return count;
  }
  std::size_t changed() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) count += normals[i] != exact[i];
    return count;
  }
};

TEST(FitNormals, KeepsEveryGradientOfWhatIsSmooth) {
  for (const Shape& s : {sphere(1.0), torus(1.0, 0.3), capsule({0, 0, 0}, {0, 1, 0}, 0.4), melt()})
    EXPECT_EQ(Fitted(s, 1.0 / 32).changed(), 0u);
}

TEST(FitNormals, TakesTheFacetsWhereTheGradientTellsOfDetailBelowAVoxel) {
  const Vec3E p = position() * 300.0;
  const Expr grain = sin(p.x) * sin(p.y) * sin(p.z);
  const Fitted rough(field(length(position()) - 1.0 + 0.01 * grain, region(1.1), 4.0), 1.0 / 16);
  EXPECT_GT(rough.unfit(rough.exact), rough.normals.size() / 2);
  EXPECT_EQ(rough.unfit(rough.normals), 0u);
}

TEST(FitNormals, MakesEdgesAsTheMeshHasThem) {
  const Fitted part(rotate(box(Vec3E(0.8)), Vec3E(0.2, 0.3, 0.1)) - infiniteCylinder(0.4), 1.0 / 16);
  EXPECT_GT(part.unfit(part.exact), 0u);
  EXPECT_EQ(part.unfit(part.normals), 0u);
  EXPECT_LT(part.changed(), part.normals.size() / 5) << "only along edges";
}

}  // namespace vertex_normals_test
}  // namespace sdf::test
