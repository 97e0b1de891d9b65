// Meshes from files as triangles among the hits of rays.
#pragma once
#include <glm/mat3x3.hpp>
#include <vector>

#include "viewer/gpu/mesh_buffer.h"
#include "viewer/gpu/program.h"
#include "viewer/render/frame.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// DrawnMeshes are the triangles of a plan's meshes, each with the pictures that its materials need.
class DrawnMeshes {
 public:
  /// Compiles the pass, and hands the triangles over. Errors: Graphics with the driver's log; Limits.
  static Result<DrawnMeshes> make(const SceneShaders& shaders);

  /// Computes where the meshes are in a frame. It calls no OpenGL.
  void prepare(const Frame& frame);
  /// Draws the shot's sample of all into the target that is bound, where they are nearest.
  void draw(const Shot& shot) const;

 private:
  struct Range {
    int first, count;  // triangles of one material
    glm::vec4 look, glow;
    int colorTexture, emissionTexture;  // of textures
  };
  struct Drawn {
    double operand;
    bool own;
    Function place;  // the mesh's own coordinates: of the scene's origin, and how they change along its axes
    glm::dmat3 toScene{1.0};
    glm::dvec3 origin{0.0};
    std::size_t model;
  };
  struct Model {
    const MeshField* field;
    MeshBuffer buffer;
    std::vector<Range> ranges;
    std::vector<ImageTexture> textures;  // the last one is white
  };
  explicit DrawnMeshes(Program program) : program_(std::move(program)) {}
  Status add(const DrawnMesh& mesh);
  static Result<Model> modelOf(const MeshField& field);

  Program program_;
  std::vector<Model> models_;
  std::vector<Drawn> drawn_;
};

}  // namespace sdf::viewer
