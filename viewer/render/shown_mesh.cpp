#include "viewer/render/shown_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sdf::viewer {
namespace {

std::vector<BufferVertex> verticesOf(const TriangleMesh& mesh) {
  std::vector<BufferVertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].position = mesh.positions[i];
    if (!mesh.normals.empty()) vertices[i].normal = mesh.normals[i];
    if (!mesh.colors.empty()) vertices[i].color = mesh.colors[i];
    if (!mesh.textureAt.empty()) vertices[i].textureAt = mesh.textureAt[i];
  }
  return vertices;
}

std::uint32_t materialOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  return mesh.materialOf.empty() ? 0 : mesh.materialOf[triangle];
}

std::vector<std::uint32_t> byMaterial(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return materialOf(mesh, i); });
  return order;
}

// The order of parts::kTakeMeshLook.
void addMaterial(const MeshMaterial& m, std::vector<glm::vec4>& texels) {
  texels.emplace_back(m.specular, m.shininess);
  texels.emplace_back(m.reflectivity, m.fresnelPower, m.fresnelBias, 0.0f);
  texels.emplace_back(m.emission, 0.0f);
}

void add(const Mesh& mesh, ShownMesh& shown) {
  const auto firstVertex = static_cast<std::uint32_t>(shown.vertices.size());
  const auto firstMaterial = static_cast<float>(shown.materials.size() / 3);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    shown.vertices.push_back({.position = mesh.positions[i],
                              .normal = mesh.normals[i],
                              .color = mesh.colors[i],
                              .ambient = mesh.ambient[i]});
  for (const MeshMaterial& material : mesh.materials) addMaterial(material, shown.materials);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i == 0 || mesh.triangleMaterial[i] != mesh.triangleMaterial[i - 1])
      shown.ranges.push_back(
          {.first = static_cast<int>(shown.triangles.size()),
           .count = 0,
           .look = glm::vec4(1.0f, 1.0f, 1.0f, firstMaterial + static_cast<float>(mesh.triangleMaterial[i])),
           .glow = glm::vec4(1.0f)});
    ++shown.ranges.back().count;
    shown.triangles.push_back(mesh.triangles[i] + firstVertex);
  }
}

}  // namespace

ShownMesh shownMesh(const TriangleMesh& mesh) {
  ShownMesh shown;
  shown.vertices = verticesOf(mesh);
  shown.images = mesh.images;
  const std::vector<std::uint32_t> order = byMaterial(mesh);
  for (const std::uint32_t i : order) shown.triangles.push_back(mesh.triangles[i]);
  for (std::size_t first = 0; first < order.size();) {
    const std::uint32_t number = materialOf(mesh, order[first]);
    std::size_t last = first;
    while (last < order.size() && materialOf(mesh, order[last]) == number) ++last;
    const TriangleMaterial& m = mesh.materials[number];
    shown.ranges.push_back({static_cast<int>(first), static_cast<int>(last - first),
                            glm::vec4(m.color, m.roughness), glm::vec4(m.emission, m.metallic),
                            m.colorTexture, m.emissionTexture});
    first = last;
  }
  return shown;
}

ShownMesh shownMesh(const std::vector<ExportPart>& parts) {
  ShownMesh shown;
  for (const ExportPart& part : parts) add(part.mesh, shown);
  return shown;
}

ShownMesh unshared(const ShownMesh& mesh) {
  ShownMesh result{{}, {}, mesh.ranges, mesh.images, mesh.materials};
  result.vertices.reserve(3 * mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (int k = 0; k < 3; ++k) result.vertices.push_back(mesh.vertices[t[k]]);
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

}  // namespace sdf::viewer
