// From a closed mesh that knows its creases to one with few triangles that keeps a tolerance.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/witnesses.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

struct RemeshOptions {
  double tolerance;  ///< distance between mesh and surface, scene units; positive
  /// Does what is seen on the surface change from place to place? Then borders of materials and colours are
  /// held, too (remesh_paint.h).
  bool painted = false;
  /// Is the tolerance to be kept even where that makes needles or folds?
  bool force = true;
  /// Points of the surface that the mesh is to come as near to, if there are any.
  const Witnesses* witnesses = nullptr;
};

/// What was measured of the mesh that remesh left.
struct RemeshResult {
  double maxDistance = 0.0;  ///< scene units
  bool kept = false;         ///< maxDistance is within the tolerance that was asked for
  /// Corners of the triangles beyond the tolerance: what would mend them would make needles or fold the mesh.
  std::vector<glm::vec3> exceeding;
};

/// Changes the mesh, by collapsing, flipping and splitting edges and by moving vertices, into one with few
/// triangles that is nowhere farther than the tolerance from the field's zero set.
///
/// Vertices of smooth pieces lie on either side of the surface, so that the error is as large outside as
/// inside: of triangles that are equilateral in the curvature's metric, 0.1925 * integral of sqrt|K| / E are
/// needed then (after Nadler 1986). Vertices on creases slide along them; corners stay where they are.
///
/// Distances are first-order, f / |grad f| (Taubin 1994), at points of the mesh. While it is changed they are
/// taken at each triangle's corners, centroid and edges' midpoints, and at the extrema that their gradients
/// foretell: between them the distance is a quadratic function up to terms of third order in the triangle's
/// size. At the end they are taken all over the triangles, thrice as closely as the field resolves
/// features (LocalField::Local::voxel), and what exceeds the tolerance is split. Along creases the points are
/// read from both sides, and their distance is that to the line where both sides' tangent planes meet.
///
/// The other direction, from the surface to the mesh, follows: no triangle's normal is ever 60 degrees or
/// more from the gradient under it, none is turned over, and collapses keep the link condition (Dey,
/// Edelsbrunner, Guha, Nekhayev 1999), so that the projection along the gradient stays one to one from mesh
/// to surface, as long as solids and gaps are thicker than twice the tolerance. Thinner ones may come to
/// cross.
///
/// Preconditions: the mesh is closed, manifold, without folds, and near the surface: within the field's
/// resolution. It may be both finer and coarser than needed. Positions are exact to float rounding only: a
/// tolerance below 2^-20 of the mesh's size cannot be kept. The result does not depend on the number of
/// threads. Once progress is stopped the mesh is closed and manifold still, but unfinished. Cost: n log n;
/// some 200 microseconds for each triangle that is left, if the mesh was coarsened before.
RemeshResult remesh(FeatureMesh& mesh, const LocalField& field, const RemeshOptions& options,
                    Progress& progress);

}  // namespace sdf
