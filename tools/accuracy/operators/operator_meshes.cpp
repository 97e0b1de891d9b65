#include "operator_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <utility>

namespace sdf::accuracy {
namespace {

// One vertex for each pair of vertices, in either order.
class EdgePoints {
 public:
  explicit EdgePoints(std::vector<glm::dvec3>& points) : points_(points) {}

  template <class Make>
  int operator()(int a, int b, Make make) {
    const auto [at, isNew] = index_.try_emplace(std::minmax(a, b), static_cast<int>(points_.size()));
    if (isNew) points_.push_back(make(points_[std::min(a, b)], points_[std::max(a, b)]));
    return at->second;
  }

 private:
  std::vector<glm::dvec3>& points_;
  std::map<std::pair<int, int>, int> index_;
};

// Triangles that cross the plane where the coordinate is 0 cut along it.
TriangleMesh cutAtZero(TriangleMesh mesh, int axis) {
  EdgePoints onPlane(mesh.points);
  std::vector<glm::ivec3> whole;
  const auto sideOf = [&](int i) {
    return mesh.points[i][axis] > 0.0 ? 1 : mesh.points[i][axis] < 0.0 ? -1 : 0;
  };
  const auto crossing = [&](int a, int b) {
    return onPlane(a, b, [&](const glm::dvec3& p, const glm::dvec3& q) {
      glm::dvec3 at = p + (q - p) * (p[axis] / (p[axis] - q[axis]));
      at[axis] = 0.0;
      return at;
    });
  };
  for (glm::ivec3 t : mesh.triangles) {
    // Turned until t.x is alone on its side, or lies on the plane between the other two.
    const auto alone = [&] { return sideOf(t.y) * sideOf(t.z) > 0 && sideOf(t.x) * sideOf(t.y) < 0; };
    const auto between = [&] { return sideOf(t.x) == 0 && sideOf(t.y) * sideOf(t.z) < 0; };
    for (int k = 0; k < 3 && !alone() && !between(); ++k) t = {t.y, t.z, t.x};
    if (between()) {
      const int m = crossing(t.y, t.z);
      whole.insert(whole.end(), {{t.x, t.y, m}, {t.x, m, t.z}});
    } else if (alone()) {
      const int m = crossing(t.x, t.y), n = crossing(t.x, t.z);
      whole.insert(whole.end(), {{t.x, m, n}, {m, t.y, t.z}, {m, t.z, n}});
    } else {
      whole.push_back(t);
    }
  }
  mesh.triangles = std::move(whole);
  return mesh;
}

}  // namespace

TriangleMesh boxMesh(const glm::dvec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TriangleMesh octahedronMesh(double r) {
  return {{{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TriangleMesh tetrahedronMesh(double radius) {
  const double s = radius / std::sqrt(3.0);
  return {{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleMesh prismMesh(const std::vector<glm::dvec2>& outline, const glm::dvec2& middle, double halfHeight) {
  TriangleMesh mesh;
  const int n = static_cast<int>(outline.size()), low = 2 * n, high = 2 * n + 1;
  for (const double z : {-halfHeight, halfHeight})
    for (const glm::dvec2& p : outline) mesh.points.emplace_back(p, z);
  mesh.points.emplace_back(middle, -halfHeight);
  mesh.points.emplace_back(middle, halfHeight);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(),
                          {{low, j, i}, {high, n + i, n + j}, {i, j, n + j}, {i, n + j, n + i}});
  }
  return mesh;
}

TriangleMesh sphereMesh(double radius, int times) {
  TriangleMesh mesh = octahedronMesh(1.0);
  for (int i = 0; i < times; ++i)
    mesh = mapped(refined(std::move(mesh), 1), [](const glm::dvec3& p) { return glm::normalize(p); });
  return mapped(std::move(mesh), [&](const glm::dvec3& p) { return radius * p; });
}

glm::dmat3 turn(const glm::dvec3& axis, double angle) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

PointMap twistMap(double rate) {
  return [=](const glm::dvec3& p) { return turn({0, 1, 0}, rate * p.y) * p; };
}

PointMap bendMap(double k) {
  return [=](const glm::dvec3& p) {
    const double radius = 1.0 / k - p.y;
    return glm::dvec3(radius * std::sin(k * p.x), 1.0 / k - radius * std::cos(k * p.x), p.z);
  };
}

PointMap taperMap(double rate) {
  return [=](const glm::dvec3& p) {
    const double factor = 1.0 + rate * p.y;
    return glm::dvec3(p.x * factor, p.y, p.z * factor);
  };
}

TriangleMesh mapped(TriangleMesh mesh, const PointMap& map, bool reflects) {
  for (glm::dvec3& p : mesh.points) p = map(p);
  return reflects ? flipped(std::move(mesh)) : mesh;
}

TriangleMesh moved(const TriangleMesh& mesh, const glm::dvec3& by) {
  return mapped(mesh, [&](const glm::dvec3& p) { return p + by; });
}

TriangleMesh turned(const TriangleMesh& mesh, const glm::dmat3& by) {
  return mapped(mesh, [&](const glm::dvec3& p) { return by * p; });
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (glm::ivec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

TriangleMesh together(const std::vector<TriangleMesh>& parts) {
  TriangleMesh all;
  for (const TriangleMesh& part : parts) {
    const int first = static_cast<int>(all.points.size());
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    for (const glm::ivec3& t : part.triangles) all.triangles.push_back(t + first);
  }
  return all;
}

TriangleMesh united(const std::vector<TriangleMesh>& parts) {
  TriangleMesh all = parts.at(0);
  for (std::size_t i = 1; i < parts.size(); ++i) all = corefine(all, parts[i], Boolean::Union);
  return all;
}

TriangleMesh refined(TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) {
    EdgePoints middles(mesh.points);
    std::vector<glm::ivec3> finer;
    const auto middle = [&](int a, int b) {
      return middles(a, b, [](const glm::dvec3& p, const glm::dvec3& q) { return 0.5 * (p + q); });
    };
    for (const glm::ivec3& t : mesh.triangles) {
      const int a = middle(t.y, t.z), b = middle(t.z, t.x), c = middle(t.x, t.y);
      finer.insert(finer.end(), {{t.x, c, b}, {c, t.y, a}, {b, a, t.z}, {a, b, c}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

double longestEdge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (const glm::ivec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, glm::distance(mesh.points[t[i]], mesh.points[t[(i + 1) % 3]]));
  return longest;
}

TriangleMesh pulledApart(const TriangleMesh& whole, int axis, double half) {
  TriangleMesh mesh = cutAtZero(whole, axis);
  const int count = static_cast<int>(mesh.points.size());
  // Points of the cut stand on both of its sides: their copies, `count` on, belong to the negative half.
  mesh.points.insert(mesh.points.end(), mesh.points.begin(), mesh.points.begin() + count);
  // Edges along the cut, and the side of the triangle that has them.
  std::map<std::pair<int, int>, int> seams;
  for (glm::ivec3& t : mesh.triangles) {
    double side = 0.0;
    for (int i = 0; i < 3; ++i) side += mesh.points[t[i]][axis];
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      if (mesh.points[a][axis] == 0.0 && mesh.points[b][axis] == 0.0) seams[{a, b}] = side > 0.0 ? 1 : -1;
    }
    if (side < 0.0) t += count;
  }
  for (const auto& [edge, side] : seams) {
    const auto [a, b] = edge;
    if (side > 0 && seams.at({b, a}) < 0)
      mesh.triangles.insert(mesh.triangles.end(), {{b, a, a + count}, {b, a + count, b + count}});
  }
  for (int i = 0; i < count; ++i) {
    mesh.points[i][axis] += half;
    mesh.points[i + count][axis] -= half;
  }
  std::vector<Triangle> triangles;
  for (const glm::ivec3& t : mesh.triangles)
    triangles.push_back({mesh.points[t.x], mesh.points[t.y], mesh.points[t.z]});
  return welded(triangles);  // without the copies that no triangle has
}

TriangleMesh pulledApart(const TriangleMesh& mesh, const glm::dvec3& half) {
  TriangleMesh result = mesh;
  for (int axis = 0; axis < 3; ++axis)
    if (half[axis] > 0.0) result = pulledApart(result, axis, half[axis]);
  return result;
}

}  // namespace sdf::accuracy
