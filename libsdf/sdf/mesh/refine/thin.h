// From the mesh of a lattice to the mesh that a tolerance asks for.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/witnesses.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

struct ThinOptions {
  double tolerance;      ///< distance between mesh and surface, both ways, scene units; positive
  double voxel;          ///< the lattice's, scene units
  bool painted = false;  ///< RemeshOptions::painted
  /// Otherwise what exceeds the tolerance is left as it is where nothing helps.
  bool strict = true;
  /// Is some of the mesh farther off than remeshing can mend?
  bool broken = false;
  /// Is what fails at the first try left to others? The mesh is of no use then.
  bool once = false;
};

/// Points of the mesh, of four in each triangle, that are farther from the surface than the limit, but for
/// what is within five voxels of a tip: around it a lattice leaves rings of four vertices, however fine it
/// is, and remeshing mends them.
std::vector<glm::vec3> placesBeyond(double limit, const FeatureMesh& mesh, const LocalField& field,
                                    double voxel, Progress& progress);

/// Remeshes with few triangles (remesh.h). Where the result misses the tolerance or crosses itself, which it
/// does where walls, gaps and steps are about as thin as the tolerance, the mesh is left as it was and the
/// rest is remeshed again. How far the surface is from the mesh is told by `witnesses`. Returns whether the
/// tolerance is kept, but for what is left as it is; the mesh may cross itself even then, where nothing
/// helped. If it is not, the mesh is the best of what was tried. Cost: once to some times what remeshing
/// costs.
bool thin(FeatureMesh& mesh, const LocalField& field, const Witnesses& witnesses, const ThinOptions& options,
          Progress& progress);

}  // namespace sdf
