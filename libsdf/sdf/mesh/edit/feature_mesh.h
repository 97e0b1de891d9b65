// A closed triangle mesh that knows its creases: what is handed from the finding of edges to simplifying.
#pragma once
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/triangles/compaction.h"

namespace sdf {

/// Pieces that meet at less than this angle are one, in radians: 5 degrees.
inline constexpr float kCreaseAngle = 0.08726646f;

/// What a triangle shows at a corner, linear (surface_paint.h).
struct CornerColor {
  glm::vec3 color, ambient;
  friend bool operator==(const CornerColor&, const CornerColor&) = default;
};

/// Triangles, counter-clockwise seen from outside, closed and manifold, and those of their edges along which
/// the surface has an edge or its paint a border. A vertex without creases lies on one smooth piece of the
/// surface, one with two of them on a crease, any other at a corner (or where a crease fades out).
struct FeatureMesh {
  std::vector<glm::vec3> positions;  ///< scene units
  std::vector<glm::uvec3> triangles;
  std::vector<std::array<std::uint32_t, 2>> creases;  ///< pairs of vertices, the lower first; sorted
  /// Of each triangle, the number among the shape's; where two meet there is a crease. Empty: all are of one.
  std::vector<int> materials{};
  /// Of each triangle's corners; empty: they are those of the surface there.
  std::vector<std::array<CornerColor, 3>> colors{};
  /// Of the first vertices: is it a tip (tips.h), which does not move? No other is.
  std::vector<char> tips{};

  bool isTip(std::uint32_t v) const { return v < tips.size() && tips[v] != 0; }
};

/// A triangle that was taken away, and keeps its place in the list for a while, has one vertex for all
/// corners.
inline bool isGone(const glm::uvec3& triangle) { return triangle.x == triangle.y; }

/// Does a vertex have no normal of its own, as on a crease?
inline bool isNone(const glm::vec3& normal) { return normal == glm::vec3(0.0f); }

/// A triangle and a normal that are 60 degrees or more from each other (cosine) belong to different pieces.
inline constexpr float kFacing = 0.5f;
/// Are they nearer? `area` is along the triangle's normal.
template <class Vector>
bool isFacing(const Vector& area, const Vector& normal) {
  const auto along = glm::dot(area, normal), square = glm::dot(area, area);
  return along > 0 && along * along > kFacing * kFacing * square;
}

/// Drops the triangles that are gone, and the vertices that no triangle has, with their normals, if these are
/// given. What is left keeps its order. Returns Compaction::after. Cost: linear.
std::vector<std::uint32_t> dropUnused(FeatureMesh& mesh, std::vector<glm::vec3>* normals = nullptr);

}  // namespace sdf
