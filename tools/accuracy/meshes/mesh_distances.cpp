#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh_cases.h"

namespace sdf::accuracy {
namespace {

// distance(i) of each number below `count`, in parallel.
template <class Distance>
std::vector<double> distances(std::size_t count, const Distance& distance) {
  std::vector<double> all(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { all[i] = distance(i); });
  return all;
}

Spread spreadOf(const std::vector<double>& distances) {
  Spread s;
  for (const double d : distances) s.rms += d * d, s.max = std::max(s.max, d);
  s.rms = std::sqrt(s.rms / static_cast<double>(distances.size()));
  return s;
}

}  // namespace

std::vector<glm::dvec3> pointsOn(const TriangleMesh& mesh, std::size_t count, unsigned seed) {
  const ByArea byArea(mesh.points, mesh.triangles);
  PointMaker::Random random(seed);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::ivec3& t = mesh.triangles[byArea.at(uniform(random, 0.0, 1.0))];
    double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    points.push_back((1.0 - u - v) * mesh.points[t.x] + u * mesh.points[t.y] + v * mesh.points[t.z]);
  }
  return points;
}

Spread spreadOver(const std::vector<glm::dvec3>& points,
                  const std::function<double(const glm::dvec3&)>& distance) {
  return spreadOf(distances(points.size(), [&](std::size_t i) { return distance(points[i]); }));
}

TriangleMesh weldedMesh(const Mesh& mesh) {
  TriangleMesh welded;
  for (std::uint32_t i = 0; i < mesh.welded; ++i) welded.points.emplace_back(mesh.positions[i]);
  for (const glm::uvec3& t : mesh.triangles)
    welded.triangles.emplace_back(mesh.pointOf(t.x), mesh.pointOf(t.y), mesh.pointOf(t.z));
  return welded;
}

Spread toSurface(const TriangleMesh& mesh, const PiecewiseSolid& solid, std::size_t points, unsigned seed) {
  const std::vector<glm::dvec3> on = pointsOn(mesh, points, seed);
  Spread s = spreadOf(distances(on.size(), [&](std::size_t i) { return solid.distance(on[i]); }));
  const auto atVertices =
      distances(mesh.points.size(), [&](std::size_t i) { return solid.distance(mesh.points[i]); });
  s.max = std::max(s.max, *std::max_element(atVertices.begin(), atVertices.end()));
  return s;
}

Spread toMesh(const std::vector<glm::dvec3>& surface, const TriangleMesh& mesh) {
  const Reference reference(mesh);
  return spreadOf(distances(surface.size(), [&](std::size_t i) { return reference.distance(surface[i]); }));
}

}  // namespace sdf::accuracy
