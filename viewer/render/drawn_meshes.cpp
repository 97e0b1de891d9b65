#include "viewer/render/drawn_meshes.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "viewer/gpu/context.h"
#include "viewer/render/place_triangles.h"
#include "viewer/shaders/triangle_parts.h"

namespace sdf::viewer {
namespace {

constexpr int kColorUnit = 0, kEmissionUnit = 1;

// The coordinates at the origin, and their derivatives: all that linear functions are.
Function placeOf(const PlacedMesh& placed) {
  std::vector<Expr> outputs;
  for (const Expr& e : placed.at) {
    const auto at = [&](double x, double y, double z) { return remap(e, {Expr(x), Expr(y), Expr(z)}, 0.0); };
    const Expr here = at(0.0, 0.0, 0.0);
    outputs.insert(outputs.end(),
                   {here, at(1.0, 0.0, 0.0) - here, at(0.0, 1.0, 0.0) - here, at(0.0, 0.0, 1.0) - here});
  }
  return Function(outputs);
}

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

}  // namespace

Result<DrawnMeshes> DrawnMeshes::make(const SceneShaders& shaders) {
  auto program = Program::create(parts::kTrianglesVertex, shaders.triangles);
  if (!program) return program.error();
  DrawnMeshes made(std::move(*program));
  for (const DrawnMesh& mesh : shaders.plan.drawn)
    if (auto s = made.add(mesh); !s) return s.error();
  return made;
}

Status DrawnMeshes::add(const DrawnMesh& mesh) {
  const MeshField* const field = mesh.placed.field.get();
  const auto known = std::ranges::find(models_, field, &Model::field);
  const auto place = static_cast<std::size_t>(known - models_.begin());
  if (known == models_.end()) {
    auto model = modelOf(*field);
    if (!model) return model.error();
    models_.push_back(std::move(*model));
  }
  drawn_.push_back({mesh.operand.number, mesh.own, placeOf(mesh.placed), {}, {}, place});
  return okStatus();
}

Result<DrawnMeshes::Model> DrawnMeshes::modelOf(const MeshField& field) {
  const TriangleMesh& mesh = field.mesh();
  const std::vector<std::uint32_t> order = byMaterial(mesh);
  std::vector<glm::uvec3> triangles;
  for (const std::uint32_t i : order) triangles.push_back(mesh.triangles[i]);
  auto buffer = MeshBuffer::make(verticesOf(mesh), triangles);
  if (!buffer) return buffer.error();
  Model model{&field, std::move(*buffer), {}, {}};
  for (const TextureImage& image : mesh.images) {
    auto texture = ImageTexture::make(image.width, image.height, image.pixels);
    if (!texture) return texture.error();
    model.textures.push_back(std::move(*texture));
  }
  constexpr unsigned char kFull = 255;
  auto white = ImageTexture::make(1, 1, std::vector<unsigned char>(4, kFull));
  if (!white) return white.error();
  model.textures.push_back(std::move(*white));
  const int plain = static_cast<int>(mesh.images.size());
  for (std::size_t first = 0; first < order.size();) {
    const std::uint32_t number = materialOf(mesh, order[first]);
    std::size_t last = first;
    while (last < order.size() && materialOf(mesh, order[last]) == number) ++last;
    const TriangleMaterial& m = mesh.materials[number];
    model.ranges.push_back({static_cast<int>(first), static_cast<int>(last - first),
                            glm::vec4(m.color, m.roughness), glm::vec4(m.emission, m.metallic),
                            m.colorTexture < 0 ? plain : m.colorTexture,
                            m.emissionTexture < 0 ? plain : m.emissionTexture});
    first = last;
  }
  return model;
}

void DrawnMeshes::prepare(const Frame& frame) {
  for (Drawn& drawn : drawn_) {
    const std::vector<double> v = drawn.place.uniform(frame.parameters);
    glm::dmat3 toMesh;
    glm::dvec3 offset;
    for (int row = 0; row < 3; ++row) {
      offset[row] = v[4 * row];
      for (int column = 0; column < 3; ++column) toMesh[column][row] = v[4 * row + 1 + column];
    }
    drawn.toScene = glm::inverse(toMesh);
    drawn.origin = -(drawn.toScene * offset);
  }
}

void DrawnMeshes::draw(const Shot& shot) const {
  shot.set(program_, {});
  program_.set("colorTexture", kColorUnit);
  program_.set("emissionTexture", kEmissionUnit);
  glEnable(GL_DEPTH_TEST);
  for (const Drawn& drawn : drawn_) {
    const Model& model = models_[drawn.model];
    placeTriangles(program_, shot, drawn.toScene, drawn.origin);
    constexpr float kHit = 1.0f, kDrawn = 3.0f;
    program_.set("identity", glm::vec2(drawn.operand, drawn.own ? kDrawn : kHit));
    for (const Range& range : model.ranges) {
      program_.set("look", std::vector{range.look});
      program_.set("glow", std::vector{range.glow});
      model.textures[static_cast<std::size_t>(range.colorTexture)].bind(kColorUnit);
      model.textures[static_cast<std::size_t>(range.emissionTexture)].bind(kEmissionUnit);
      program_.draw(model.buffer, range.first, range.count);
    }
  }
  glFrontFace(GL_CCW);
}

}  // namespace sdf::viewer
