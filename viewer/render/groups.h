// What the primary rays meet of a wide union, drawn group by group.
#pragma once
#include <optional>
#include <vector>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/frame.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

class Groups {
 public:
  /// Errors: Graphics with the driver's log.
  static Result<Groups> make(const std::vector<GroupShaders>& shaders, bool counted);

  /// Makes the targets, and draws starts(). Errors: Limits, Graphics.
  Status begin(const Frame& frame, const Shot& shot);
  /// Draws hits() of the shot's sample. Errors: Graphics.
  Status drawSample(const Shot& shot);

  /// Of each pixel, what parts::kHits says; t is 1e30 where nothing is met.
  const Target& hits() const { return *hits_; }
  /// Where the rays of a tile may start, each group's in a cell of its own.
  const Target& starts() const { return *starts_; }
  int count() const { return static_cast<int>(groups_.size()); }  ///< of cells

  /// If they are counted: readings by the primary rays of all pixels since begin, means over the samples, and
  /// by the cones. Errors: as Target::pixels.
  double readings() const { return readings_; }
  Result<double> coneReadings() const;

 private:
  struct Passes {
    Program cones, hits;
  };
  struct Group {
    GlslWriter values;
    std::size_t passes;
  };
  Groups(std::vector<Passes> passes, std::vector<Group> groups, bool counted);
  void drawStarts(const Shot& shot) const;
  void drawHits(const Shot& shot) const;
  /// Of a group's cell.
  glm::ivec2 cornerOf(int group, const Shot& shot) const;

  std::vector<Passes> passes_;
  std::vector<Group> groups_;
  std::vector<std::vector<glm::vec4>> values_;  // of the groups' uniforms, in the frame that is being drawn
  bool counted_;
  double readings_ = 0.0;  // so far, but for the cones'
  int columns_;            // of cells
  std::optional<Target> starts_, hits_;
};

}  // namespace sdf::viewer
