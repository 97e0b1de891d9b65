#include "viewer/render/drawn_meshes.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
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

}  // namespace

Result<DrawnMeshes> DrawnMeshes::make(const SceneShaders& shaders) {
  auto program = Program::create(parts::kTrianglesVertex, shaders.triangles);
  if (!program) return program.error();
  DrawnMeshes made(std::move(*program));
  constexpr double kEdges = 1.25;  // pixels
  made.meshed_ = shaders.plan.meshed;
  made.sceneOrigin_ = shaders.plan.options.origin;
  made.edges_ = shaders.plan.options.view == View::Wire ? kEdges : 0.0;
  for (const DrawnMesh& mesh : shaders.plan.drawn)
    if (auto s = made.add(mesh); !s) return s.error();
  return made;
}

Status DrawnMeshes::add(const DrawnMesh& mesh) {
  const MeshField* const field = mesh.placed.field.get();
  const auto known = std::ranges::find(models_, field, &Model::field);
  const auto place = static_cast<std::size_t>(known - models_.begin());
  if (known == models_.end()) {
    auto model = modelOf(field, shownMesh(field->mesh()));
    if (!model) return model.error();
    models_.push_back(std::move(*model));
  }
  drawn_.push_back(
      {mesh.operand.number, mesh.own ? Looks::Drawn : Looks::Hit, placeOf(mesh.placed), {}, {}, place});
  return okStatus();
}

void DrawnMeshes::place(const std::vector<DrawnMesh>& meshes) {
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    drawn_[i].operand = meshes[i].operand.number;
    drawn_[i].place = placeOf(meshes[i].placed);
  }
}

Result<DrawnMeshes::Model> DrawnMeshes::modelOf(const MeshField* field, const ShownMesh& mesh) {
  auto buffer = MeshBuffer::make(mesh.vertices, mesh.triangles);
  if (!buffer) return buffer.error();
  Model model{field, std::move(*buffer), mesh.ranges, {}};
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
  for (ShownMesh::Range& range : model.ranges)
    for (int* texture : {&range.colorTexture, &range.emissionTexture})
      if (*texture < 0) *texture = plain;
  return model;
}

Status DrawnMeshes::show(const ShownMesh& mesh) {
  auto model = modelOf(nullptr, mesh);
  if (!model) return model.error();
  models_.clear();
  models_.push_back(std::move(*model));
  const bool own = !mesh.materials.empty();
  drawn_ = {Drawn{0.0, own ? Looks::Meshed : Looks::Drawn, {}, glm::dmat3(1.0), -sceneOrigin_, 0}};
  materials_.fill(own ? mesh.materials : std::vector<glm::vec4>(kMaterialTexels));
  return okStatus();
}

void DrawnMeshes::giveMaterials(const Program& picture, int unit) const {
  materials_.bind(unit);
  picture.set("meshMaterials", unit);
}

void DrawnMeshes::prepare(const Frame& frame) {
  for (Drawn& drawn : drawn_) {
    if (!drawn.place) continue;
    const std::vector<double> v = drawn.place->uniform(frame.parameters);
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

std::size_t DrawnMeshes::triangles() const {
  std::size_t count = 0;
  for (const Drawn& drawn : drawn_)
    for (const ShownMesh::Range& range : models_[drawn.model].ranges)
      count += static_cast<std::size_t>(range.count);
  return count;
}

void DrawnMeshes::draw(const Shot& shot) const {
  shot.set(program_, {});
  program_.set("colorTexture", kColorUnit);
  program_.set("emissionTexture", kEmissionUnit);
  if (meshed_) program_.set("edges", edges_);
  glEnable(GL_DEPTH_TEST);
  for (const Drawn& drawn : drawn_) {
    const Model& model = models_[drawn.model];
    placeTriangles(program_, shot, drawn.toScene, drawn.origin);
    program_.set("identity", glm::vec2(drawn.operand, static_cast<float>(drawn.looks)));
    for (const ShownMesh::Range& range : model.ranges) {
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
