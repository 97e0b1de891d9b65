// What a plain mesher does: samples on a dense lattice, a vertex for each cell that changes sign.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"

namespace sdf::accuracy {

struct NaiveMesh {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// Surface nets (Gibson 1998) over the lattice of multiples of h in the box, inside being f < 0: one vertex a
/// cell, at the mean of the cell's linear crossings, and a quad for each lattice edge that changes sign.
/// Nothing is closed at the box's sides.
NaiveMesh surfaceNets(const std::function<double(const glm::dvec3&)>& f, const Box& box, double h);

/// How its triangles hang together.
struct NaiveTopology {
  int components = 0;
  int euler = 0;
  int boundaryEdges = 0;     ///< edges with one triangle
  int nonManifoldEdges = 0;  ///< edges with more than two
};
NaiveTopology topologyOf(const NaiveMesh& mesh);

}  // namespace sdf::accuracy
