// How far the surface is from a mesh: what a mesh lacks cannot be seen from the mesh.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/progress.h"
#include "sdf/mesh/measure/climb.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/model/model.h"
#include "sdf/triangles/tree.h"

namespace sdf {

/// Of points of the surface, the farthest from a mesh.
struct SurfaceDistance {
  double max = 0.0;          ///< scene units
  glm::vec3 farthest{0.0f};  ///< the point
  std::uint64_t points = 0;  ///< how many were looked at
  std::uint64_t beyond = 0;  ///< how many of them are farther than was asked about
};

/// Cells in which the surface of a shape is looked for, and for one of many pieces of a shape at least.
inline constexpr std::size_t kSurfaceCells = 2048, kFewestSurfaceCells = 256;

/// Points of the model's surface, found from the function alone: the bounds, and those of each operand of a
/// union, are halved into about so many cells in which intervals do not tell that there is no surface, and
/// lines through each cell are followed to where the sign changes (cell_roots.h). So points are as dense as
/// the operand is small. Cells in which no point is found are halved on until the slope or intervals tell
/// that there is none, or a multiple of the cells was looked into: a small piece of the surface far from the
/// rest is not passed over. Does not depend on the number of threads.
std::vector<glm::vec3> surfacePoints(const ModelTapes& model, const Box& bounds, Progress& progress,
                                     std::size_t cells = kSurfaceCells);

/// The nearest of the triangles, at least one, to each point; or any of them that is no farther than
/// `within`. Cost: log n of the triangles for each point; less where most are near.
std::vector<NearestPoint> nearestTriangles(const std::vector<glm::vec3>& points,
                                           const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::uvec3>& triangles, Progress& progress,
                                           double within = -1.0);

/// The largest of these points' distances, and how many are larger than `limit`.
SurfaceDistance distanceToMesh(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& positions,
                               const std::vector<glm::uvec3>& triangles, Progress& progress,
                               double limit = kInfinity);

/// Points of the surface of a shape as large as that, and how far they are from a mesh: those that are known,
/// and what is reached by climbing (climb.h) from so many of the farthest all over the shape, no more than
/// there are triangles. Fewer miss some.
std::vector<FarPoint> farthestOfSurface(const std::vector<glm::vec3>& points, const LocalField& field,
                                        double size, const std::vector<glm::vec3>& positions,
                                        const std::vector<glm::uvec3>& triangles, Progress& progress,
                                        std::size_t climbers = 256);

/// The largest of these distances, and how many are larger than `limit`.
SurfaceDistance farthestOf(const std::vector<FarPoint>& points, double limit = kInfinity);

}  // namespace sdf
