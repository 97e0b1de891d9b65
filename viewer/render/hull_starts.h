// Where primary rays start, by a hull of what they march.
#pragma once
#include <optional>

#include "sdf/eval/function.h"
#include "sdf/march/hull.h"
#include "viewer/gpu/mesh_buffer.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/frame.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// HullStarts keep the hull of a scene's rest.
class HullStarts {
 public:
  /// Errors: Graphics with the driver's log.
  static Result<HullStarts> make(const SceneShaders& shaders);

  /// Keeps the hull of this plan's rest from now on.
  void enclose(const Plan& plan);

  /// Makes the hull of the frame's values, unless it is that of the frame before: in some milliseconds, tens
  /// where a distance is a long formula. It calls no OpenGL.
  void prepare(const Frame& frame);
  /// Draws where the shot's rays enter and leave the hull, in a target that holds `nothing` where they do
  /// not. Errors: Limits where memory runs out.
  Status draw(const Shot& shot, const Target& starts, const glm::vec4& nothing);

 private:
  HullStarts(const Plan& plan, Program program);

  Function field_;
  OwnInputs inputs_;
  Box bounds_;
  Program program_;
  Hull hull_;
  std::optional<MeshBuffer> buffer_;  // of it
};

}  // namespace sdf::viewer
