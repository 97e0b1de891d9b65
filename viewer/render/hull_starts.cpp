#include "viewer/render/hull_starts.h"

#include <epoxy/gl.h>

#include <utility>

#include "viewer/gpu/context.h"
#include "viewer/render/place_triangles.h"
#include "viewer/shaders/triangle_parts.h"

namespace sdf::viewer {
namespace {

constexpr int kCells = 48;  // half as many take more readings, twice as many are slower to draw

}  // namespace

HullStarts::HullStarts(const Plan& plan, Program program)
    : field_({plan.rest->distance, plan.rest->step}),
      inputs_(field_),
      bounds_(plan.rest->bounds),
      program_(std::move(program)) {}

void HullStarts::enclose(const Plan& plan) {
  field_ = Function({plan.rest->distance, plan.rest->step});
  inputs_ = OwnInputs(field_);
  bounds_ = plan.rest->bounds;
}

Result<HullStarts> HullStarts::make(const SceneShaders& shaders) {
  auto program = Program::create(parts::kTrianglesVertex, shaders.hull);
  if (!program) return program.error();
  return HullStarts(shaders.plan, std::move(*program));
}

void HullStarts::prepare(const Frame& frame) {
  if (!inputs_.move(frame.parameters)) return;
  hull_ = *hullOf(MarchField{field_.at(inputs_.values()), 1.0}, bounds_, kCells);  // its slope is known
  buffer_.reset();
}

Status HullStarts::draw(const Shot& shot, const Target& starts, const glm::vec4& nothing) {
  if (!buffer_) {
    std::vector<BufferVertex> corners;
    for (const glm::vec3& corner : hull_.corners) corners.push_back({corner});
    if (auto s = keep(MeshBuffer::make(corners, hull_.triangles), buffer_); !s) return s;
  }
  starts.clear(0, nothing);
  shot.set(program_, {});
  placeTriangles(program_, shot, glm::dmat3(1.0), hull_.origin);
  const DrawingMode least = leastOfAll();
  program_.draw(*buffer_, 0, static_cast<int>(hull_.triangles.size()));
  glFrontFace(GL_CCW);
  return okStatus();
}

}  // namespace sdf::viewer
