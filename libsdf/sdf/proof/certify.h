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
  double finest;  ///< voxel size: offsets begin with it, and cells are divided down to 1/32 of it
  double limit;   ///< a bound above this counts as none
};

/// What was proven of a mesh.
struct Certificate {
  double toSurface = 0.0;      ///< every proven point of the mesh is within this of the surface, scene units
  double toMesh = 0.0;         ///< every proven point of the surface is within this of the mesh
  glm::dvec3 widest{0.0};      ///< centre of the triangle with the larger of these
  std::uint64_t cells = 0;     ///< triangles and cells of space that were looked at
  std::uint64_t unproven = 0;  ///< those of which nothing was proven; where there are any, there is no bound
  glm::dvec3 firstUnproven{0.0};
  double unprovenSize = 0.0;  ///< its longest side

  bool proven() const { return unproven == 0; }
  double bound() const { return toSurface > toMesh ? toSurface : toMesh; }
};

/// Proves how far a closed mesh and the zero set of the model in the bounds are from each other, both ways.
///
/// On each triangle stands a prism: its points are m + t o, |t| <= 1, where the offset o is interpolated from
/// the vertices like m, so that neighbours share their walls and all prisms are a shell around the mesh.
///
/// Along each line (one m, all t) the field is shown to rise by g > 0 at least, by intervals; a minimum or
/// maximum rises as its branches do that can win there, creases included. Where |f| <= F < g on the triangle
/// the line has one zero, within |o| F / g of m. F comes from the values at the corners and the curvature
/// (after Waldron 1998), branch by branch. So each point of the mesh has the surface, and each point of the
/// surface in the shell the mesh, within that. Triangles are quartered where it helps, prisms made flatter,
/// once the zero is known to be low in them, and smaller where they reach into what belongs to another part
/// of the surface. Where a continuous field is not seen to rise, or the bound that follows is not good
/// enough, it is shown to be positive above some height and negative below as much, which bounds its zeros,
/// too.
///
/// Outside the shell there is none: space is divided into cells. In some intervals show that f is not 0. In
/// all others |f| is smaller than on the outer and inner sides of all prisms that may be there, so that these
/// do not pass them. How often the shell covers a point, counted with sign, is the degree of the map (m, t)
/// to space (Brouwer 1911) and changes at these sides only: it is one number in cells that touch. It is
/// looked at in one of them, by a ray; where it is not 0, all of them lie in prisms.
///
/// What is claimed of the model's operands, bounds and slopes, is relied on. `triangles` are closed (each
/// edge as often one way as the other) and counter-clockwise from outside; an open mesh is not proven. Runs
/// on the calling thread's oneTBB arena; the result does not depend on the number of threads. Once progress
/// is stopped it means nothing.
Certificate certify(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const ModelTapes& model, const CertifyOptions& options, Progress& progress);

}  // namespace sdf
