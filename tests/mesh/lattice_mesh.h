// A shape's mesh as it comes from the band.
#pragma once
#include <utility>
#include <vector>

#include "mesh/scenes.h"
#include "sdf/mesh/creases/borders.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/edit/feature_mesh.h"
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

}  // namespace sdf::test
