// What samples have missed: read from the field all over a mesh.
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/refine/sampled_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// A place on a triangle that is too far from the surface. The surface's next point may be within the
/// tolerance from the triangle all the same, as where an edge sticks out of a rounding.
struct OffSurface {
  SampledMesh::Index triangle;  ///< its first half-edge
  Corners corners;              ///< its own
  glm::vec3 at, next;
  float distance() const { return glm::distance(at, next); }
};

/// Looks at a mesh with the field, and adds samples where it is farther off than the tolerance.
class MissedSamples {
 public:
  /// `surface` are points of the surface that the mesh is to come near to.
  MissedSamples(SampledMesh& sampled, const LocalField& field, const std::vector<glm::vec3>& surface,
                float tolerance, Progress& progress)
      : sampled_(sampled), field_(field), surface_(surface), tolerance_(tolerance), progress_(progress) {}

  /// Adds the surface's points next to places all over the triangles and next to the middles of creases'
  /// edges, and points next to the mesh on the surface, that are too far off; where there are none, those
  /// that are climbed to from them (farthestOfSurface). Returns the triangles, by their first
  /// half-edges, that have more samples now. Cost: 10 to 46 points a triangle, a few readings each.
  std::vector<SampledMesh::Index> add();
  /// Adds the points of the surface next to these places to the triangles that are nearest to them. Returns
  /// these.
  std::vector<SampledMesh::Index> addNextTo(const std::vector<glm::vec3>& places);
  /// What these have found on the mesh: the farthest of each triangle, once.
  std::vector<OffSurface> takeOff() { return std::exchange(off_, {}); }

 private:
  using Index = SampledMesh::Index;
  std::vector<Index> alive() const;
  void take(Index triangle, const glm::vec3& place, const SurfaceSample& sample);
  std::vector<Index> changed(const std::vector<Index>& triangles);
  void addAt(const std::vector<Index>& triangles, int steps, std::vector<Index>* close);
  void addOfCreases();
  void addOfSurface(const std::vector<Index>& triangles);
  void addClimbed(const std::vector<Index>& triangles);
  std::vector<glm::uvec3> cornersOf(const std::vector<Index>& triangles) const;

  SampledMesh& sampled_;
  const LocalField& field_;
  std::vector<glm::vec3> surface_;  // points that may come to be too far
  float tolerance_;
  Progress& progress_;
  std::vector<Index> added_;
  std::vector<OffSurface> off_;
  std::vector<Corners> looked_;  // by triangle: where its corners were when nothing was missed
};

}  // namespace sdf
