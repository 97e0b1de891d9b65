// Distances to triangles that need not be closed, nor a manifold: meshes as they come from any mesher.
#pragma once
#include <glm/vec3.hpp>
#include <memory>

#include "reference.h"

namespace sdf::accuracy {

/// An AABB tree of CGAL's over triangles.
class TriangleSoup {
 public:
  /// Precondition: at least one triangle. Cost: n log n.
  explicit TriangleSoup(const TriangleMesh& mesh);
  ~TriangleSoup();
  TriangleSoup(TriangleSoup&&) noexcept;

  /// The point of the triangles that is nearest to p, and the number of its triangle. Safe to call from many
  /// threads. Off by some roundings of the coordinates' size in double. Cost: about log n.
  struct Nearest {
    glm::dvec3 point;
    std::size_t triangle;
  };
  Nearest nearest(const glm::dvec3& p) const;
  double distance(const glm::dvec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sdf::accuracy
