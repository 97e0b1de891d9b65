// What remeshing holds of a surface besides its distance: the borders of its materials, and its colours.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/refine/remesh_fans.h"
#include "sdf/mesh/refine/tints.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Adds to the errors of fans what their triangles do to the paint: a triangle that shows another material
/// than its own farther than kBorderTolerances from its sides is not sound; and a colour that is as far off
/// as kColorTolerance counts as a distance as large as `tolerance`, on triangles with a side longer than a
/// voxel (LocalField::Local::voxel). Colours are those of the surface next to the triangle's corners,
/// centroid and sides' midpoints, all taken so far inside. Fans that are not sound, or far off, are left as
/// they are.
void addPaintErrors(const Fans& fans, float tolerance, const LocalField& field, Progress& progress,
                    std::vector<FanError>& errors);

struct ColorErrors {
  double largest = 0.0;                  ///< unit as kColorTolerance; of all triangles
  std::vector<std::uint32_t> exceeding;  ///< first half-edges of triangles with a side longer than a voxel
};

/// What was read of a triangle, for as long as its corners stay where they are.
struct TriangleColors {
  std::array<glm::vec3, 3> corners{};
  float largest = -1.0f;   ///< unit as kColorTolerance; negative before anything is read
  bool mayExceed = false;  ///< no side is longer than a voxel
};

/// Colours' errors at points all over each triangle, half a voxel apart at most. `tolerance` is the
/// distance's, and always the same for what is `known`: triangles that are as they were there, by number, are
/// not read again. Cost: the area of the others in voxels.
ColorErrors measureColors(const HalfEdgeMesh& mesh, float tolerance, const LocalField& field,
                          std::vector<TriangleColors>& known, Progress& progress);

/// Do all triangles with a side longer than a voxel show the colours of the surface, within kColorTolerance?
bool keepsColors(const FeatureMesh& mesh, double tolerance, const LocalField& field, Progress& progress);

}  // namespace sdf
