// Points that a mesh of a surface has, and that another one is to meet.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/to_mesh.h"

namespace sdf {

/// A mesh's vertices and points that were found on the surface, and the vertices of its creases, which
/// borders of paint are among.
class Witnesses {
 public:
  /// All of these points. `withBorders`: are borders looked at, too?
  Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, bool withBorders);
  /// Points that are farther from the mesh than the limit are left out: it lacks something there, which
  /// another mesh cannot be asked for. Cost: log n of the triangles for each point.
  Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, double limit, bool withBorders,
            Progress& progress);

  /// Points of the surface, that were found since.
  void add(const std::vector<glm::vec3>& surface);

  /// Points of the surface.
  const std::vector<glm::vec3>& surface() const { return surface_; }

  /// The largest distance from a point on the surface to the mesh, of all of them; 0 where there was no
  /// limit.
  double lacking() const { return lacking_; }

  /// The largest distance from a witness to another mesh's triangles, at least one.
  SurfaceDistance toSurface(const FeatureMesh& mesh, Progress& progress) const;
  /// The same from a vertex on a crease to another mesh's creases; infinite if that has none, 0 if there are
  /// no such vertices.
  double toBorders(const FeatureMesh& mesh, Progress& progress) const;

  /// The triangles, by number and in order, that are nearest to a witness which is farther than the limit
  /// from all of them; and the largest distance. At least one triangle.
  struct Missed {
    double max = 0.0;
    std::vector<std::uint32_t> triangles;
  };
  Missed missedBy(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                  double limit, Progress& progress) const;

 private:
  void addBorders(const FeatureMesh& mesh);
  double lacking_ = 0.0;
  std::vector<glm::vec3> surface_, borders_;
};

}  // namespace sdf
