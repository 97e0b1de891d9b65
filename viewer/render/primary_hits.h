// Where the primary rays of a frame start and, of a wide union, what they hit, drawn by one pass for each
// group.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/drawn_meshes.h"
#include "viewer/render/frame.h"
#include "viewer/render/hull_starts.h"
#include "viewer/render/volumes.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// The texture unit at which shaders find the texture sdfRows.
inline constexpr int kRowsUnit = 6;

/// PrimaryHits draw the passes that come before the picture.
class PrimaryHits {
 public:
  /// Compiles the passes. Errors: Graphics with the driver's log; those of Volumes::giveTo.
  static Result<PrimaryHits> make(const SceneShaders& shaders, Volumes& volumes);

  /// Draws from now on with other numbers: those of shaders of the same code (sameCode). It compiles nothing.
  void follow(const SceneShaders& shaders);

  /// Shows this mesh in the place of what rays would hit, of a plan that is `meshed`. Errors: Limits.
  Status showMesh(const ShownMesh& mesh) { return meshes_->show(mesh); }

  /// Computes the passes' uniforms of a frame. It calls no OpenGL.
  void prepare(const Frame& frame);
  /// Makes the targets of the shot's size, and draws where the rays of each tile start. `rows` is what the
  /// texture sdfRows holds, and stays so until the frame is drawn. Errors: Limits, Graphics.
  Status begin(const Shot& shot, std::span<const glm::vec4> rows);
  /// Draws the hits of the shot's sample, if the passes do. Errors: Graphics.
  Status drawSample(const Shot& shot);

  /// Lets the picture's program read the hits of the sample drawn last or else the starts.
  void giveTo(const Program& picture, const Shot& shot) const;
  /// Draws the tiles where the starts of this cell, or of any, say that there is something to see, with a
  /// program that Program::overTiles made.
  void drawTiles(const Program& program, const Shot& shot, std::optional<int> cell = {}) const;

  /// Return the readings that the primary rays took since begin, and those of the cones, as sums over all
  /// pixels. Both need `counted`. Errors: as Target::pixels.
  double readings() const { return readings_; }
  Result<double> coneReadings() const;

 private:
  struct Pass {
    std::optional<Program> cones, hits;
    UniformValues values{Function(std::vector<Expr>{})};
    bool takesRows = false;
    RowRange rows{};     // that it is drawn with one by one; none: once, without that
    int firstCell = -1;  // of the starts, one for each time that it is drawn; -1 if all rays start at the eye
    std::vector<Box> boxes{};  // at which rays start instead of where the cones say
    int draws() const { return rows.count > 0 ? static_cast<int>(rows.count) : 1; }
  };
  PrimaryHits() = default;
  void takeNumbers(const SceneShaders& shaders);
  Status makeTargets(const Shot& shot);
  void drawStarts(const Shot& shot) const;
  void drawHits(const Shot& shot) const;
  /// The corner of a cell.
  glm::ivec2 cornerOf(int cell, const Shot& shot) const;
  /// A cell that is alone has smaller tiles, too, or pixels.
  bool isFine() const { return cells_ == 1 && passes_.front().cones; }
  int fineSide() const;
  int firstLook() const;
  /// Chooses what a pass is drawn with, the i-th time.
  void chooseRow(const Pass& pass, const Program& program, int i) const;
  /// Lets a program read where the rays of a cell start.
  void giveStarts(const Program& program, int cell, const Shot& shot) const;

  std::vector<Pass> passes_;
  std::optional<DrawnMeshes> meshes_;
  std::optional<HullStarts> hull_;  // where rays start, if there is one
  bool looks_ = false;              // the picture shows how their triangles look
  bool meshed_ = false;             // they are one that is shown as a whole
  bool grouped_ = false;            // the passes draw hits
  std::optional<Program> boxCones_;
  UniformValues boxValues_{Function(std::vector<Expr>{})};  // of the cones at boxes
  int cells_ = 0, columns_ = 0;                             // of the starts
  bool counted_ = false;
  double readings_ = 0.0;
  std::span<const glm::vec4> rows_;
  std::optional<Target> coarse_, fine_;  // starts, of all cells beside one another and of smaller tiles
  std::optional<Target> hits_;           // outputs of parts::kHits, readings if counted, and depth
};

}  // namespace sdf::viewer
