// What every mesh that was read goes through, whatever its format.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/meshfile/read_formats.h"
#include "sdf/triangles/compaction.h"
#include "sdf/triangles/polygon.h"

namespace sdf {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool near(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kFarthestCoordinate;
}

Status checkPositions(const std::filesystem::path& file, const std::vector<glm::vec3>& positions) {
  const auto refuse = [&](auto isGood, const std::string& what) -> Status {
    const auto first = std::ranges::find_if_not(positions, isGood);
    if (first == positions.end()) return okStatus();
    const auto bad = positions.end() - first - std::count_if(first, positions.end(), isGood);
    return unreadable(file, std::to_string(bad) + " of its " + std::to_string(positions.size()) +
                                " vertices have coordinates " + what + ", vertex " +
                                std::to_string(first - positions.begin()) + " is the first");
  };
  if (Status all = refuse(finite, "that are no finite numbers"); !all) return all;
  return refuse(near, "beyond 1e15 (scale the mesh down)");
}

/// Its normal, as long as twice the area. In double, which no float's square leaves.
glm::dvec3 areaNormal(const TriangleMesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]);
  return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
}

void dropFlatTriangles(ReadMesh& read) {
  TriangleMesh& mesh = read.mesh;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::dvec3 n = areaNormal(mesh, t);
    if (n == glm::dvec3(0.0)) continue;
    mesh.triangles[kept] = t;
    mesh.materialOf[kept++] = mesh.materialOf[i];
  }
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  mesh.materialOf.resize(kept);
  if (dropped > 0) {
    warn(read.warnings, std::to_string(dropped) + " of " + std::to_string(kept + dropped) +
                            " triangles have no area and are left out");
  }
}

void dropUnused(TriangleMesh& mesh) {
  const Compaction left = dropUnusedVertices(mesh.triangles, mesh.positions.size());
  left.apply(mesh.positions), left.apply(mesh.normals);
  left.apply(mesh.colors), left.apply(mesh.textureAt);
}

/// Unit; 0 where there is no direction.
glm::vec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

/// Where triangles around a vertex leave no mean, any of them will do.
void fillNormals(TriangleMesh& mesh) {
  bool lacking = false;
  for (glm::vec3& n : mesh.normals) {
    n = unit(glm::dvec3(n));
    lacking = lacking || n == glm::vec3(0.0f);
  }
  if (!lacking) return;
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sums[t[k]] += areaNormal(mesh, t);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      glm::vec3& n = mesh.normals[t[k]];
      if (n == glm::vec3(0.0f)) n = unit(sums[t[k]]);
      if (n == glm::vec3(0.0f)) n = unit(areaNormal(mesh, t));
    }
  }
}

/// NaN counts as 0.
float within(float v, float most) { return v > 0.0f ? std::min(v, most) : 0.0f; }

void clampLook(TriangleMesh& mesh) {
  for (glm::vec3& c : mesh.colors) c = {within(c.x, 1.0f), within(c.y, 1.0f), within(c.z, 1.0f)};
  for (glm::vec2& at : mesh.textureAt)
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) at = glm::vec2(0.0f);
  constexpr float kBrightest = 1e6f;
  for (TriangleMaterial& m : mesh.materials) {
    for (int k = 0; k < 3; ++k) m.color[k] = within(m.color[k], 1.0f);
    for (int k = 0; k < 3; ++k) m.emission[k] = within(m.emission[k], kBrightest);
    m.metallic = within(m.metallic, 1.0f);
    m.roughness = within(m.roughness, 1.0f);
  }
}

}  // namespace

bool addPolygon(const std::vector<std::uint32_t>& corners, std::uint32_t material, const FacePlace& place,
                ReadMesh& read) {
  TriangleMesh& mesh = read.mesh;
  if (corners.size() > kMostReadTriangles) return false;
  if (!cutPolygon(mesh.positions, corners, mesh.triangles)) {
    warn(read.warnings, std::string(place.unit) + " " + std::to_string(place.number) + ": a face of " +
                            std::to_string(corners.size()) +
                            " corners crosses itself, so its triangles overlap; divide it");
  }
  mesh.materialOf.resize(mesh.triangles.size(), material);
  return mesh.triangles.size() <= kMostReadTriangles;
}

Status tidy(const std::filesystem::path& file, ReadMesh& read) {
  if (read.mesh.triangles.empty()) return unreadable(file, "it has no triangles");
  if (Status sound = checkPositions(file, read.mesh.positions); !sound) return sound;
  dropFlatTriangles(read);
  if (read.mesh.triangles.empty()) return unreadable(file, "none of its triangles has an area");
  dropUnused(read.mesh);
  fillNormals(read.mesh);
  clampLook(read.mesh);
  return okStatus();
}

}  // namespace sdf
