// Meshes made by hand, as the mesher would hand them over.
#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sdf/export/export.h"

namespace sdf {

inline MeshMaterial paint(const std::string& name, const glm::vec3& color) {
  MeshMaterial material;
  material.name = name;
  material.color = color;
  return material;
}

/// Unit sphere about `centre` of rows * columns + 2 points: rings around Y between two poles.
inline Mesh sphere(int rows, int columns, const glm::vec3& centre = glm::vec3(0.0f)) {
  Mesh mesh;
  const auto add = [&](const glm::vec3& n) {
    mesh.positions.push_back(centre + n);
    mesh.normals.push_back(n);
    mesh.colors.push_back({0.25f, 0.5f, 0.75f});
  };
  add({0, 1, 0});
  for (int r = 1; r <= rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double polar = std::numbers::pi * r / (rows + 1), around = 2.0 * std::numbers::pi * c / columns;
      add({std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around)});
    }
  }
  add({0, -1, 0});
  const std::uint32_t south = static_cast<std::uint32_t>(rows * columns + 1);
  const auto at = [&](int r, int c) { return static_cast<std::uint32_t>(1 + r * columns + c % columns); };
  for (int c = 0; c < columns; ++c) {
    mesh.triangles.push_back({0, at(0, c), at(0, c + 1)});
    for (int r = 0; r + 1 < rows; ++r) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
    mesh.triangles.push_back({south, at(rows - 1, c + 1), at(rows - 1, c)});
  }
  mesh.triangleMaterial.assign(mesh.triangles.size(), 0);
  mesh.materials = {paint("blue", {0.25f, 0.5f, 0.75f})};
  mesh.welded = static_cast<std::uint32_t>(mesh.positions.size());
  return mesh;
}

/// The sphere with its second half of triangles red: vertices on the seam are repeated for the second
/// material.
inline Mesh twoColoredSphere(int rows, int columns) {
  Mesh mesh = sphere(rows, columns);
  mesh.materials.push_back(paint("red", {1.0f, 0.0f, 0.0f}));
  const std::size_t half = mesh.triangles.size() / 2;
  std::vector<std::uint32_t> copy(mesh.welded, 0);
  for (std::size_t t = half; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterial[t] = 1;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t original = mesh.triangles[t][k];
      if (copy[original] == 0) {
        copy[original] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(glm::vec3(mesh.positions[original]));
        mesh.normals.push_back(glm::vec3(mesh.normals[original]));
        mesh.colors.push_back({1.0f, 0.0f, 0.0f});
        mesh.copyOf.push_back(original);
      }
      mesh.triangles[t][k] = copy[original];
    }
  }
  return mesh;
}

inline ExportPart part(const std::string& name, Mesh mesh) {
  MeshStats stats;
  stats.vertices = mesh.welded;
  stats.triangles = mesh.triangles.size();
  stats.voxelSize = 0.125;
  stats.rmsDistance = 0.25;
  stats.maxDistance = 0.5;
  stats.watertight = stats.manifold = true;
  stats.components = 1;
  stats.eulerCharacteristic = 2;
  return {name, std::move(mesh), stats, {}};
}

}  // namespace sdf
