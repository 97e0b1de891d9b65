// From a fine mesh to one with few triangles that keeps a tolerance.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Changes a closed mesh, whose vertices lie on the surface and which knows its creases, into one with few
/// triangles that has samples of the surface (sampled_mesh.h) within the tolerance. Each sample belongs to
/// one triangle and is handed on when that changes (after Cohen, Olano, Manocha 1998). Edges are collapsed
/// and flipped and vertices moved, to either side of the surface, only where all samples stay near; what the
/// last moves leave too far is split. Then the field is read all over the mesh, and where it is off there are
/// more samples. No triangle is a needle or turned by more than 60 degrees from those that it replaces, or
/// where these are bent from the surface at its samples.
///
/// `surface` are points of the surface that the mesh is to come as near to. `exceeding` is asked for places
/// on the mesh or the surface that are farther from the other than the tolerance, in a mesh that is done so
/// far; those that it has are looked at again, as long as that changes anything there. If it is `painted` the
/// mesh gets colours of its own, which samples hold to the surface's (tints.h). Returns whether nothing
/// exceeds the tolerance. Once progress is stopped the mesh is closed and manifold still, but unfinished.
/// Does not depend on the number of threads. Cost: linear; some microseconds for each triangle that there
/// was.
bool simplify(FeatureMesh& mesh, const LocalField& field, double tolerance,
              const std::vector<glm::vec3>& surface,
              const std::function<std::vector<glm::vec3>(const FeatureMesh&)>& exceeding, bool painted,
              Progress& progress);

/// The same of a mesh that lacks something, or is too far from the surface somewhere: there it stays as it
/// is, and nobody else is asked what exceeds the tolerance.
void simplifyUnresolved(FeatureMesh& mesh, const LocalField& field, double tolerance, bool painted,
                        Progress& progress);

}  // namespace sdf
