#include "support/mesh_audit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "reference/reference.h"
#include "sdf/eval/batch.h"
#include "sdf/model/model.h"

namespace sdf::test {
namespace {

/// The mesh with one vertex for each point.
accuracy::TriangleMesh welded(const Mesh& mesh) {
  accuracy::TriangleMesh all;
  for (std::uint32_t v = 0; v < mesh.welded; ++v) all.points.emplace_back(mesh.positions[v]);
  for (const glm::uvec3& t : mesh.triangles) {
    glm::ivec3 corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = static_cast<int>(t[k] < mesh.welded ? t[k] : mesh.copyOf[t[k] - mesh.welded]);
    all.triangles.push_back(corners);
  }
  return all;
}

/// A partition that is joined bit by bit.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

void auditTopology(const accuracy::TriangleMesh& mesh, MeshAudit& a) {
  std::map<std::pair<int, int>, std::vector<int>> triangles;  // of each edge, by its direction
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k)
      triangles[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}].push_back(t);
  a.closed = a.manifold = !mesh.triangles.empty();
  // Corners that an edge's two triangles have at the same vertex belong to one fan.
  Sets fans(3 * mesh.triangles.size()), parts(mesh.points.size());
  const auto corner = [&](int t, int v) {
    const glm::ivec3& c = mesh.triangles[t];
    return 3 * t + (c.x == v ? 0 : c.y == v ? 1 : 2);
  };
  std::size_t edges = 0;
  for (const auto& [edge, here] : triangles) {
    const auto [from, to] = edge;
    const auto there = triangles.find({to, from});
    const std::size_t back = there == triangles.end() ? 0 : there->second.size();
    a.closed = a.closed && here.size() == back;
    a.manifold = a.manifold && here.size() == 1 && back == 1;
    edges += from < to || back == 0;
    parts.join(from, to);
    if (back == 0) continue;
    for (const int v : {from, to}) fans.join(corner(here[0], v), corner(there->second[0], v));
  }
  std::vector<int> fanOf(mesh.points.size(), -1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      int& fan = fanOf[mesh.triangles[t][k]];
      const int own = fans.root(3 * t + k);
      if (fan < 0) fan = own;
      a.manifold = a.manifold && fan == own;
    }
  std::size_t used = 0;
  for (int v = 0; v < static_cast<int>(fanOf.size()); ++v)
    if (fanOf[v] >= 0) ++used, a.components += parts.root(v) == v;
  a.eulerCharacteristic = static_cast<int>(used + mesh.triangles.size()) - static_cast<int>(edges);
}

std::size_t countTurned(const accuracy::TriangleMesh& mesh, const Shape& shape, double near) {
  constexpr double kSliver = 0.01;  // height, of the longest side
  const TapePtr tape = Model(shape).at().whole()->firstOutputOnly();
  BatchEvaluator batch;
  PointRows middles, gradients;
  float value[kBatchPoints];
  std::size_t turned = 0;
  for (std::size_t first = 0; first < mesh.triangles.size(); first += kBatchPoints) {
    const std::size_t count = std::min(kBatchPoints, mesh.triangles.size() - first);
    const auto corner = [&](std::size_t i, int k) { return mesh.points[mesh.triangles[first + i][k]]; };
    for (std::size_t i = 0; i < count; ++i)
      middles.set(i, glm::vec3((corner(i, 0) + corner(i, 1) + corner(i, 2)) / 3.0));
    batch.evaluateGradient(*tape, middles.rows(), count, value, gradients.x, gradients.y, gradients.z);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 gradient(gradients.at(i));
      if (std::abs(value[i]) > near * glm::length(gradient)) continue;
      const glm::dvec3 u = corner(i, 1) - corner(i, 0), v = corner(i, 2) - corner(i, 0), w = v - u,
                       area = glm::cross(u, v);
      const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
      turned += glm::length(area) > kSliver * longest && glm::dot(area, gradient) < 0.0;
    }
  }
  return turned;
}

}  // namespace

MeshAudit audit(const Mesh& mesh, const Shape& shape, double near) {
  const accuracy::TriangleMesh all = welded(mesh);
  MeshAudit a;
  auditTopology(all, a);
  if (a.closed && a.manifold) a.crossings = accuracy::crossings(all);
  a.turned = countTurned(all, shape, near);
  return a;
}

}  // namespace sdf::test
