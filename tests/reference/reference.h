// Geometry computed another way: distances to triangle meshes by CGAL, against which the distance functions
// are held.
#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

namespace sdf::accuracy {

inline constexpr double kPi = std::numbers::pi;

/// A closed triangle mesh, counter-clockwise seen from outside, scene units.
struct TriangleMesh {
  std::vector<glm::dvec3> points;
  std::vector<glm::ivec3> triangles;
};

/// A mesh as a distance: an AABB tree of its triangles, and exact predicates for the side.
class Reference {
 public:
  /// The mesh must be closed and must not cross itself; throws std::invalid_argument where it is not closed.
  /// Cost: n log n.
  explicit Reference(const TriangleMesh& mesh);
  ~Reference();
  Reference(Reference&&) noexcept;

  /// Distance from p to the nearest point of the mesh, not signed. Safe to call from many threads. Off by
  /// some roundings of the coordinates' size in double. Cost: about log n.
  double distance(const glm::dvec3& p) const;
  /// -1 inside, 1 outside, 0 on the mesh (exact predicates). Safe to call from many threads.
  int side(const glm::dvec3& p) const;
  /// distance() with the sign of side().
  double signedDistance(const glm::dvec3& p) const { return side(p) * distance(p); }

 private:
  struct Trees;
  std::unique_ptr<Trees> trees_;
};

/// The inside of a simple polygon as triangles of its corners (constrained Delaunay triangulation). Throws
/// std::invalid_argument where the polygon crosses itself.
std::vector<glm::ivec3> triangulated(std::span<const glm::dvec2> polygon);

/// Pairs of triangles that cross or overlap, those that share an edge or a corner but for what they share
/// (exact predicates). Cost: n log n.
std::size_t crossings(const TriangleMesh& mesh);

enum class Boolean { Union, Intersection, Difference };
/// The boolean of two closed meshes by corefinement with exact constructions; corners are rounded to double
/// at the end. Throws std::runtime_error where the result is not a closed manifold.
TriangleMesh corefine(const TriangleMesh& a, const TriangleMesh& b, Boolean which);

}  // namespace sdf::accuracy
