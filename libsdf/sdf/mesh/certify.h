// The proof of a mesh's two-sided distance to the zero set of a field. Nothing is sampled: all that is said
// of the field are intervals, rounded outward.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/progress.h"
#include "sdf/model/model.h"

namespace sdf {

struct CertifyOptions {
  Box bounds;     ///< finite; all of the surface that counts lies in it
  double goal;    ///< a bound that suffices, scene units: more effort is made where a bound is above it
  double finest;  ///< cells are divided down to this side, scene units
  double limit;   ///< a bound above this counts as none
};

/// What was proven of a mesh.
struct Certificate {
  double toSurface = 0.0;      ///< every proven point of the mesh is within this of the surface, scene units
  double toMesh = 0.0;         ///< every proven point of the surface is within this of the mesh
  glm::dvec3 widest{0.0};      ///< centre of the cell with the larger of these
  std::uint64_t cells = 0;     ///< cells that were looked at for a proof
  std::uint64_t unproven = 0;  ///< cells in which nothing was proven; where there are any, there is no bound
  glm::dvec3 firstUnproven{0.0};
  double unprovenSize = 0.0;  ///< side of the first of them

  bool proven() const { return unproven == 0; }
  double bound() const { return toSurface > toMesh ? toSurface : toMesh; }
};

/// Proves how far a closed mesh and the zero set of the model in the bounds are from each other, both ways.
///
/// Space is divided into cells (an octree). Where an interval or the slope excludes the surface, and the mesh
/// is not there either, nothing is left to say. Else a box around the cell stands upright on the mesh there:
/// where the field's slope along its axis n is at least g > 0 all over, each line along n meets the surface
/// at most once. Where the mesh enters the box through its walls only and covers one point of its base, where
/// its sheets counted with sign are not 0, it covers every point (the degree of a map is constant). So a
/// point of the surface has a point m of the mesh on its line, |f(m)| / g from it at most, and a point of the
/// mesh likewise the surface, if that is in the box. |f| is bounded over triangles by its values at the
/// corners and its curvature (Waldron 1998), or by the mean value form in the triangle's own coordinates.
/// Where slopes show nothing, cells are divided down to the finest, in which a change of sign and the nearest
/// triangle say what they can.
///
/// What is claimed of the model's operands, bounds and slopes, is relied on. `triangles` are closed (each
/// edge as often one way as the other) and counter-clockwise from outside; an open mesh is not proven. Runs
/// on the calling thread's oneTBB arena; the result does not depend on the number of threads. Once progress
/// is stopped it means nothing.
Certificate certify(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const ModelTapes& model, const CertifyOptions& options, Progress& progress);

}  // namespace sdf
