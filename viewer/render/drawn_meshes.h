// Meshes as triangles among the hits of rays.
#pragma once
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "viewer/gpu/mesh_buffer.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/texels.h"
#include "viewer/render/frame.h"
#include "viewer/render/shown_mesh.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// DrawnMeshes are the triangles of a plan's meshes, or of one that is shown as a whole, with the pictures
/// that their materials need.
class DrawnMeshes {
 public:
  /// Compiles the pass, and hands the triangles over. Errors: Graphics with the driver's log; Limits.
  static Result<DrawnMeshes> make(const SceneShaders& shaders);

  /// Places the meshes as these are from now on: those of the same fields in the same order.
  void place(const std::vector<DrawnMesh>& meshes);
  /// Shows this mesh alone, where it is, of a plan that is `meshed`. Errors: Limits.
  Status show(const ShownMesh& mesh);
  /// Lets the picture's program read its materials.
  void giveMaterials(const Program& picture, int unit) const;

  /// Computes where the meshes are in a frame. It calls no OpenGL.
  void prepare(const Frame& frame);
  /// Draws the shot's sample of all into the target that is bound, where they are nearest.
  void draw(const Shot& shot) const;
  /// How many triangles that are.
  std::size_t triangles() const;

 private:
  enum class Looks { Hit = 1, Drawn = 3, Meshed = 4 };  // the status of hits, as parts::kCamera has it
  struct Drawn {
    double operand;
    Looks looks;
    std::optional<Function> place;  // none: the scene's; the mesh's own coordinates: of the scene's origin,
                                    // and how they change along its axes
    glm::dmat3 toScene{1.0};
    glm::dvec3 origin{0.0};
    std::size_t model;
  };
  struct Model {
    const MeshField* field;  // none of what is shown
    MeshBuffer buffer;
    std::vector<ShownMesh::Range> ranges;
    std::vector<ImageTexture> textures;  // the last one is white
  };
  explicit DrawnMeshes(Program program) : program_(std::move(program)) {}
  Status add(const DrawnMesh& mesh);
  static Result<Model> modelOf(const MeshField* field, const ShownMesh& mesh);

  static constexpr int kMaterialTexels = 3;
  Program program_;
  bool meshed_ = false;
  glm::dvec3 sceneOrigin_{0.0};        // what the shot's positions are relative to
  double edges_ = 0.0;                 // pixels
  Texels materials_{kMaterialTexels};  // a row each
  std::vector<Model> models_;
  std::vector<Drawn> drawn_;
};

}  // namespace sdf::viewer
