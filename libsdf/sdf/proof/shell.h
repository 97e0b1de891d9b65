// The shell around a mesh: a prism on each triangle, which share their walls.
#pragma once
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/proof/reading.h"

namespace sdf {

/// A closed mesh with an offset at each vertex. Triangle t's prism is all m + s o with |s| <= 1, where m and
/// o are the same means of its corners' positions and offsets.
class Shell {
 public:
  /// Offsets lie in the middle of the normals around a vertex, and are as long as a mitre is that lifts each
  /// of the faces by about half a side's length, but by `least` at least.
  Shell(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles, double least);

  std::size_t size() const { return triangles_.size(); }
  const glm::uvec3& triangle(std::uint32_t t) const { return triangles_[t]; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  Prism prism(std::uint32_t t) const;
  Box boxOf(std::uint32_t t) const;
  /// Of the triangle alone.
  Box flatBoxOf(std::uint32_t t) const;
  glm::dvec3 centre(std::uint32_t t) const;
  double reach(std::uint32_t vertex) const { return glm::length(offsets_[vertex]); }
  void halveOffset(std::uint32_t vertex) { offsets_[vertex] *= 0.5; }

 private:
  std::vector<glm::dvec3> positions_;
  const std::vector<glm::uvec3>& triangles_;
  std::vector<glm::dvec3> offsets_;
};

/// How often a shell's prisms cover a point, counted with sign: the degree of the map from mesh times [-1, 1]
/// to space, which is the winding number of the shell's outer side less that of its inner one.
class ShellDegree {
 public:
  explicit ShellDegree(const Shell& shell);
  /// None where a ray from the point runs along a side, or the point is too close to the shell's sides. Not
  /// 0: the point is in some prism.
  std::optional<int> at(const glm::dvec3& p) const;

 private:
  using Triangle = std::array<glm::dvec3, 3>;
  Triangle side(std::uint32_t s) const;
  std::pair<glm::ivec2, glm::ivec2> columnsOf(const Triangle& t) const;
  int column(double x, int axis) const;

  const Shell& shell_;
  Box bounds_;
  int columns_;                               // along y and z each
  std::vector<std::uint32_t> first_, sides_;  // sides over each column: 2 t the outer, 2 t + 1 the inner one
};

}  // namespace sdf
