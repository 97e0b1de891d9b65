// Triangle meshes to try.
#pragma once
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "sdf/triangles/triangle_mesh.h"

namespace sdf::test {

/// A closed mesh of n x m points around two circles: at(u, v) with both from 0 to 2 pi.
inline TriangleMesh ring(int n, int m, const std::function<glm::dvec3(double, double)>& at) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k)
      mesh.positions.emplace_back(at(2.0 * std::numbers::pi * i / n, 2.0 * std::numbers::pi * k / m));
  const auto place = [&](int i, int k) { return static_cast<std::uint32_t>(i % n * m + k % m); };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k) {
      mesh.triangles.emplace_back(place(i, k), place(i, k + 1), place(i + 1, k));
      mesh.triangles.emplace_back(place(i + 1, k), place(i, k + 1), place(i + 1, k + 1));
    }
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// A bumpy torus about the y axis, 2 n² triangles.
inline TriangleMesh bumpyTorus(int n, double bumps = 0.05) {
  return ring(n, n, [=](double u, double v) {
    const double minor = 0.4 + bumps * std::sin(5.0 * u) * std::cos(4.0 * v), far = 1.0 + minor * std::cos(v);
    return glm::dvec3(far * std::cos(u), minor * std::sin(v), far * std::sin(u));
  });
}

/// The box from low to high, twelve triangles.
inline TriangleMesh boxOf(const glm::vec3& low, const glm::vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  return mesh;
}

inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
  a.materialOf.assign(a.triangles.size(), 0);
  return a;
}

/// Every triangle with corners of its own, as in STL.
inline TriangleMesh apart(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (int k = 0; k < 3; ++k) result.positions.push_back(mesh.positions[t[k]]);
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  result.materialOf.assign(result.triangles.size(), 0);
  return result;
}

/// Three-sided prisms of length 1 around the z axis, where all have an edge.
inline TriangleMesh wedgesOnAnEdge(std::uint32_t count) {
  TriangleMesh fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint32_t>(fan.positions.size());
    for (const double angle : {i * 2.0, i * 2.0 + 1.0})
      for (const double z : {0.0, 1.0})
        fan.positions.emplace_back(std::cos(std::numbers::pi * angle / count),
                                   std::sin(std::numbers::pi * angle / count), z);
    for (const glm::uvec3& t : {glm::uvec3(0, k + 2, k), glm::uvec3(1, k + 1, k + 3), glm::uvec3(0, k, k + 1),
                                glm::uvec3(0, k + 1, 1), glm::uvec3(1, k + 3, k + 2), glm::uvec3(1, k + 2, 0),
                                glm::uvec3(k, k + 2, k + 3), glm::uvec3(k, k + 3, k + 1)})
      fan.triangles.push_back(t);
  }
  fan.materialOf.assign(fan.triangles.size(), 0);
  return fan;
}

/// Without some triangles.
inline TriangleMesh without(const TriangleMesh& mesh, const std::function<bool(std::size_t)>& gone) {
  TriangleMesh result = mesh;
  result.triangles.clear();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!gone(i)) result.triangles.push_back(mesh.triangles[i]);
  result.materialOf.assign(result.triangles.size(), 0);
  return result;
}

inline glm::dvec3 randomIn(std::mt19937& random, double half) {
  std::uniform_real_distribution<double> side(-half, half);
  const double x = side(random), y = side(random), z = side(random);
  return {x, y, z};
}

}  // namespace sdf::test
