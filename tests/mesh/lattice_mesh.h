// A shape's mesh as it comes from the band.
#pragma once
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "mesh/scenes.h"
#include "sdf/mesh/creases/borders.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/project.h"

namespace sdf::test {

/// With its creases, and the borders of what it is painted with.
struct LatticeMesh {
  LatticeMesh(const Shape& shape, double voxel)
      : band(bandOf(shape, shape.bounds, voxel)), field(band, wholeTapes(tapeOf(shape))) {
    RawSurface raw = band.extract();
    const std::vector<glm::vec3> extracted = raw.points;
    std::vector<glm::vec3> normals;
    Progress progress;
    refineVertices(raw.points, normals, field, progress);
    mesh = sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, field, progress).mesh;
    if (!shape.surface[static_cast<int>(Attribute::Red)].isConstant()) cutAtBorders(mesh, field, progress);
  }
  NarrowBand band;
  BandField field;
  FeatureMesh mesh;
};

/// Is it closed, manifold, without crossings, of so many components and with this Euler characteristic?
inline void expectTopology(const FeatureMesh& mesh, int components, int euler) {
  MeshStats stats;
  measureTopology(mesh.triangles, mesh.positions.size(), stats);
  EXPECT_TRUE(stats.watertight && stats.manifold);
  EXPECT_EQ(stats.components, components);
  EXPECT_EQ(stats.eulerCharacteristic, euler);
  EXPECT_TRUE(crossingTriangles(mesh.positions, mesh.triangles).empty());
}

}  // namespace sdf::test
