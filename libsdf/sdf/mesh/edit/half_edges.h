// A closed triangle mesh that can be changed: triangles, and the triangle across each of their edges.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// A half-edge is a side of a triangle: side k of triangle t is number 3t + k and runs from its corner k to
/// the next. Closed and manifold at all times.
class HalfEdgeMesh {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  explicit HalfEdgeMesh(const FeatureMesh& mesh);
  /// What is left, densely numbered.
  FeatureMesh compacted() const;

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return from_[h]; }
  Index to(Index h) const { return from_[next(h)]; }
  Index apex(Index h) const { return from_[previous(h)]; }
  /// Of the triangle that h is the first half-edge of.
  std::array<glm::vec3, 3> corners(Index h) const {
    return {positions[from_[h]], positions[from_[h + 1]], positions[from_[h + 2]]};
  }
  Index twin(Index h) const { return twin_[h]; }
  bool isCrease(Index h) const { return crease_[h] != 0; }
  /// Of the triangle; the flip of an edge, which is no crease, keeps it.
  int material(Index h) const { return materials_.empty() ? 0 : materials_[h / 3]; }
  bool hasMaterials() const { return !materials_.empty(); }
  bool alive(Index h) const { return from_[h] != kNone; }
  bool vertexAlive(Index v) const { return out_[v] != kNone; }
  /// An outgoing half-edge; the next one counter-clockwise is turned(h).
  Index outgoing(Index v) const { return out_[v]; }
  Index turned(Index h) const { return twin_[previous(h)]; }

  Index halfEdges() const { return static_cast<Index>(from_.size()); }
  Index vertices() const { return static_cast<Index>(out_.size()); }
  std::size_t liveTriangles() const { return live_; }
  /// Creases that end at v: 0 on a smooth piece, 2 on a crease; any other number makes a corner, which a
  /// tip counts as.
  int creasesAt(Index v) const { return creases_[v]; }
  bool adjacent(Index u, Index v) const;
  /// The next half-edge out of from(h) that is a crease; h itself if there is no other.
  Index otherOnCrease(Index h) const {
    Index e = turned(h);
    while (e != h && !isCrease(e)) e = turned(e);
    return e;
  }

  /// Whether from(h) can be merged into to(h): the link condition, and creases stay apart and keep their
  /// corners.
  bool canCollapse(Index h) const;
  /// Precondition: canCollapse. What has no triangle in common may be collapsed at the same time.
  void collapse(Index h);
  /// Whether the edge can be replaced by the other diagonal.
  bool canFlip(Index h) const;
  void flip(Index h);
  /// Puts a new vertex at p into the edge; returns its number.
  Index split(Index h, const glm::vec3& p);

  std::vector<glm::vec3> positions;  ///< scene units

 private:
  void pair(Index a, Index b) { twin_[a] = b, twin_[b] = a; }
  void set(Index h, Index a, Index b, Index c);

  std::vector<Index> from_, twin_, out_;
  std::vector<int> materials_;         // by triangle; empty where all are of one
  std::vector<std::uint8_t> crease_;   // by half-edge
  std::vector<std::uint8_t> creases_;  // by vertex; 3 stands for more
  std::vector<char> tips_;             // by vertex, of the first ones
  std::size_t live_ = 0;
};

}  // namespace sdf
