// The signed distance to triangles.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/triangles/closed.h"
#include "sdf/triangles/tree.h"

namespace sdf {

/// How the inside is told from the outside.
enum class SignBy {
  Normals,  ///< by the normal where the nearest point is: right for closed surfaces that do not cross
  Winding   ///< by how often the triangles wind around a point: right for all closed ones
};

/// A signed distance with its gradient. Immutable, and read from any thread.
class TriangleDistance {
 public:
  struct Read {
    double distance;         ///< negative inside
    glm::dvec3 gradient;     ///< of length 1; that of one side where there are several
    std::uint32_t triangle;  ///< the nearest
  };

  /// Triangles, at least one. Cost: n log n.
  explicit TriangleDistance(ClosedTriangles triangles);
  TriangleDistance(const TriangleDistance&) = delete;
  TriangleDistance& operator=(const TriangleDistance&) = delete;

  const ClosedTriangles& triangles() const { return triangles_; }
  SignBy signBy() const { return signBy_; }
  /// Do the triangles wind around something? Asked is beside at most 20,000 of them.
  bool hasInside() const;
  /// The triangles that have the solid on one side, with that side behind them; nothing where some cross.
  /// Their edges may have more than two of them.
  std::optional<std::vector<glm::uvec3>> surface() const;
  /// The corners of the box around all.
  const glm::dvec3& min() const { return min_; }
  const glm::dvec3& max() const { return max_; }

  /// The distance at p, within 4 ulp of that to the nearest triangle however near that is: of the feature
  /// that is nearest it is computed in twice the precision of a double (Dekker 1971). The sign is that of the
  /// pseudonormal there, weighted by angles (Baerentzen, Aanaes 2005), or of the winding number. `hint` as in
  /// TriangleTree::nearest. Cost: some log n.
  Read read(const glm::dvec3& p, std::uint32_t hint = 0) const { return read(p, hint, {}); }

 private:
  friend class DistanceAlong;
  /// The same where it is known, or not, that p is inside.
  Read read(const glm::dvec3& p, std::uint32_t hint, std::optional<bool> inside) const;
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;
  glm::dvec3 pseudonormal(const NearestPoint& nearest) const;
  bool isInside(const glm::dvec3& p, const NearestPoint& nearest, const glm::dvec3& way) const;
  void setNormals();
  /// The largest triangle of each of so many sets, the number of triangles where it has none.
  std::vector<std::uint32_t> largestOfEach(std::size_t sets,
                                           const std::function<std::uint32_t(std::uint32_t)>& setOf) const;
  bool normalsTellSides() const;
  /// Is the solid before a triangle, where its normal points to, and behind it?
  std::array<bool, 2> sidesOf(std::uint32_t triangle) const;
  bool isWoundAround(const glm::dvec3& p) const;
  /// `crossing` is 0 for each triangle that crosses no other one.
  void setPatches(const std::vector<char>& crossing);

  ClosedTriangles triangles_;
  glm::dvec3 min_, max_;
  TriangleTree tree_;
  std::vector<glm::vec3> pointNormals_, edgeNormals_;  // by point; by triangle and edge
  SignBy signBy_ = SignBy::Winding;
  // Where the winding number tells the inside: what lies before and behind each triangle that crosses no
  // other, which is the same for all that hang together over edges of two, and which of its edges are such.
  struct Patch {
    std::array<bool, 2> inside{};
    std::uint8_t joined = 0;  // bits
    bool known = false;
  };
  std::vector<Patch> patches_;  // by triangle
};

/// Reads the distance at points one after the other, faster where each is near the one before: it begins with
/// the triangle that was nearest, and there is no surface in the ball around a point up to its distance.
class DistanceAlong {
 public:
  explicit DistanceAlong(const TriangleDistance& distance) : distance_(distance) {}
  TriangleDistance::Read operator()(const glm::dvec3& p);

 private:
  const TriangleDistance& distance_;
  glm::dvec3 last_{0.0};
  TriangleDistance::Read read_{};  // there
};

}  // namespace sdf
