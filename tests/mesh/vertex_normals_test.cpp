// Every shape of the catalog, meshed: normals at smooth places are those of the mesh.
#include <gtest/gtest.h>

#include <set>

#include "sdf/mesh/mesher.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/deform.h"
#include "sdf/shape/flats.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"
#include "shape/cases.h"
#include "support/smooth_normals.h"

namespace sdf::test {
namespace {

// Were there smooth places to look at? In a mesh of some ten thousand vertices.
bool hasSmoothNormals(const std::string& name, const Shape& shape) {
  const Shape solid = shape.bounds.finite() ? shape : shape & box(Vec3E(1.5));
  const glm::dvec3 size = solid.bounds.size();
  const double least = std::min({size.x, size.y, size.z}), most = solid.bounds.longestSide();
  Progress progress;
  const MeshOptions options{.voxelSize = std::max(std::min(least / 10.0, most / 40.0), most / 300.0)};
  const Result<MeshedShape> meshed = meshShape(solid, name, options, progress);
  // Of the extreme arguments some make sheets thinner than a voxel, whose vertices may lie on either side.
  const bool isExtreme = name.find('#') != std::string::npos;
  if (!meshed || (isExtreme && meshed->stats.unresolved > 0)) return false;
  const Mesh& mesh = meshed->mesh;
  // Sides of a hundredth of a voxel are still a hundred roundings of their ends long.
  const SmoothNormals found =
      smoothNormals(mesh.positions, mesh.normals, mesh.triangles, 3, 0.01 * options.voxelSize);
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

}  // namespace
}  // namespace sdf::test
