#include "naive_mesh.h"

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace sdf::accuracy {
namespace {

/// Samples at the lattice points of a box.
class Lattice {
 public:
  Lattice(const std::function<double(const glm::dvec3&)>& f, const Box& box, double h) : h_(h) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = static_cast<int>(std::ceil(box.min[axis] / h - 1e-9));
      n_[axis] = static_cast<int>(std::floor(box.max[axis] / h + 1e-9)) - low_[axis] + 1;
    }
    values_.reserve(static_cast<std::size_t>(n_.x) * n_.y * n_.z);
    for (int x = 0; x < n_.x; ++x)
      for (int y = 0; y < n_.y; ++y)
        for (int z = 0; z < n_.z; ++z) values_.push_back(f(point({x, y, z})));
  }
  const glm::ivec3& size() const { return n_; }
  glm::dvec3 point(const glm::ivec3& c) const { return glm::dvec3(low_ + c) * h_; }
  int index(const glm::ivec3& c) const { return (c.x * n_.y + c.y) * n_.z + c.z; }
  double at(const glm::ivec3& c) const { return values_[index(c)]; }
  bool inside(const glm::ivec3& c) const { return at(c) < 0.0; }

 private:
  double h_;
  glm::ivec3 low_, n_;
  std::vector<double> values_;
};

glm::ivec3 unit(int axis) { return {axis == 0, axis == 1, axis == 2}; }

template <class Visit>
void forEachCell(const glm::ivec3& n, const Visit& visit) {
  for (int x = 0; x < n.x; ++x)
    for (int y = 0; y < n.y; ++y)
      for (int z = 0; z < n.z; ++z) visit(glm::ivec3(x, y, z));
}

/// Mean of the crossings on a cell's twelve edges; false where there are none.
bool meanCrossing(const Lattice& lattice, const glm::ivec3& cell, glm::dvec3& mean) {
  int crossings = 0;
  mean = glm::dvec3(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      const glm::ivec3 a = cell + (k & 1) * unit((axis + 1) % 3) + (k >> 1) * unit((axis + 2) % 3),
                       b = a + unit(axis);
      if (lattice.inside(a) == lattice.inside(b)) continue;
      const double t = lattice.at(a) / (lattice.at(a) - lattice.at(b));
      mean += lattice.point(a) + t * (lattice.point(b) - lattice.point(a));
      ++crossings;
    }
  if (crossings > 0) mean /= crossings;
  return crossings > 0;
}

}  // namespace

NaiveMesh surfaceNets(const std::function<double(const glm::dvec3&)>& f, const Box& box, double h) {
  const Lattice lattice(f, box, h);
  NaiveMesh mesh;
  std::map<int, std::uint32_t> vertexOf;
  forEachCell(lattice.size() - 1, [&](const glm::ivec3& c) {
    glm::dvec3 at;
    if (!meanCrossing(lattice, c, at)) return;
    vertexOf[lattice.index(c)] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(at);
  });
  forEachCell(lattice.size() - 1, [&](const glm::ivec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (c[u] == 0 || c[v] == 0 || lattice.inside(c) == lattice.inside(c + unit(axis))) continue;
      std::uint32_t q[4];
      const glm::ivec3 around[4] = {c, c - unit(u), c - unit(u) - unit(v), c - unit(v)};
      for (int k = 0; k < 4; ++k) q[k] = vertexOf.at(lattice.index(around[k]));
      if (!lattice.inside(c)) std::swap(q[1], q[3]);
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    }
  });
  return mesh;
}

NaiveTopology topologyOf(const NaiveMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<char> used(mesh.points.size(), 0);
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      ++edges[std::minmax(a, b)];
      parent[root(a)] = root(b);
      used[a] = 1;
    }
  NaiveTopology topology;
  int vertices = 0;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    vertices += used[v];
    topology.components += used[v] && root(v) == v;
  }
  for (const auto& [edge, triangles] : edges) {
    topology.boundaryEdges += triangles == 1;
    topology.nonManifoldEdges += triangles > 2;
  }
  topology.euler = vertices - static_cast<int>(edges.size()) + static_cast<int>(mesh.triangles.size());
  return topology;
}

}  // namespace sdf::accuracy
