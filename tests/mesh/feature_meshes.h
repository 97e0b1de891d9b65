// Meshes with known creases, and what the tests of simplifying measure.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "mesh/scenes.h"
#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf::test {

/// One tape and one resolution everywhere.
class WholeField : public LocalField {
 public:
  WholeField(const Shape& shape, double voxel) : tapes_(wholeTapes(tapeOf(shape))), voxel_(voxel) {}
  std::unique_ptr<Finder> finder() const override { return std::make_unique<Same>(*this); }

 private:
  struct Same : Finder {
    explicit Same(const WholeField& f) : field(f) {}
    Local at(const glm::vec3&) override { return {field.tapes_, field.voxel_}; }
    const WholeField& field;
  };
  LocalTapes tapes_;
  double voxel_;
};

/// Joins patches whose points coincide.
class Sewn {
 public:
  std::uint32_t point(const glm::vec3& p) {
    const auto key =
        std::make_tuple(std::lround(p.x * 1e5f), std::lround(p.y * 1e5f), std::lround(p.z * 1e5f));
    const auto [it, isNew] = number_.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back(p);
    return it->second;
  }
  void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::uvec3 t(point(a), point(b), point(c));
    if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
  }
  void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    triangle(a, b, c), triangle(a, c, d);
  }
  void crease(const glm::vec3& a, const glm::vec3& b) {
    const std::uint32_t u = point(a), v = point(b);
    mesh.creases.push_back({std::min(u, v), std::max(u, v)});
  }
  FeatureMesh take() {
    std::sort(mesh.creases.begin(), mesh.creases.end());
    return std::move(mesh);
  }
  FeatureMesh mesh;

 private:
  std::map<std::tuple<long, long, long>, std::uint32_t> number_;
};

/// A cube of half size 1, n squares along each edge, its twelve edges creases.
inline FeatureMesh griddedCube(int n) {
  Sewn s;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const auto at = [&](int i, int j) {
        glm::vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = -1.0f + 2.0f * static_cast<float>(i) / static_cast<float>(n);
        p[(axis + 2) % 3] = -1.0f + 2.0f * static_cast<float>(j) / static_cast<float>(n);
        return p;
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          if (side > 0.0f)
            s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          else
            s.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
      // Each edge of the cube once: along axis + 1, at this side, at either end of axis + 2.
      for (int i = 0; i < n; ++i)
        for (const int j : {0, n}) s.crease(at(i, j), at(i + 1, j));
    }
  return s.take();
}

/// A cylinder along y of radius 1 from -1 to 1: n points around, `rings` strips up the wall and in each cap;
/// its two rims are creases.
inline FeatureMesh griddedCylinder(int n, int rings) {
  Sewn s;
  const auto at = [&](int i, float radius, float y) {
    const double angle = 2.0 * kPi * (i % n) / n;
    return glm::vec3(radius * std::sin(angle), y, radius * std::cos(angle));
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < rings; ++k) {
      const auto share = [&](int at) { return static_cast<float>(at) / static_cast<float>(rings); };
      const float low = -1.0f + 2.0f * share(k), high = -1.0f + 2.0f * share(k + 1);
      s.quad(at(i, 1.0f, low), at(i + 1, 1.0f, low), at(i + 1, 1.0f, high), at(i, 1.0f, high));
      s.quad(at(i, share(k), 1.0f), at(i, share(k + 1), 1.0f), at(i + 1, share(k + 1), 1.0f),
             at(i + 1, share(k), 1.0f));
      s.quad(at(i, share(k), -1.0f), at(i + 1, share(k), -1.0f), at(i + 1, share(k + 1), -1.0f),
             at(i, share(k + 1), -1.0f));
    }
    for (const float y : {-1.0f, 1.0f}) s.crease(at(i, 1.0f, y), at(i + 1, 1.0f, y));
  }
  return s.take();
}

}  // namespace sdf::test
