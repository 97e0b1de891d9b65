// The scene's frames as one file that moves.
#pragma once
#include <map>

#include "frame_export.h"
#include "sdf/gltf/animation.h"

namespace sdf::exporter {

/// Meshes what is new in each frame and follows what has only moved. Options and progress outlive it.
class AnimationExport {
 public:
  AnimationExport(const Options& options, ProgressLine& progress)
      : options_(options), progress_(progress), voxelSize_(options.voxelSize) {}

  /// Takes the next frame, the i-th.
  Status add(int i);
  /// Writes the file, after all frames.
  Status write();

  /// A line for each mesh; where a part has several they are numbered.
  const FileReport& report() const { return report_; }
  const std::vector<ParameterInfo>& parameters() const { return animation_.scenes.back().parameters; }

 private:
  /// What a mesh was made from, and where it was last seen.
  struct Origin {
    Shape shape;
    std::optional<Box> clip;
    RigidMotion last;
    std::size_t line;  ///< in the report
  };
  /// A part's meshes, as in the animation.
  struct Track {
    std::size_t part;
    std::vector<Origin> origins;
  };

  Track& trackOf(const std::string& name);
  bool follow(Track& track, const Shape& shape, const std::optional<Box>& clip);
  void begin(Track& track, const Shape& shape, FrameExport& frame, std::size_t place);
  void see(Track& track, std::size_t mesh, const RigidMotion& motion);
  Status meshNew(FrameExport& frame);
  void nameMeshes();
  void warn();

  const Options& options_;
  ProgressLine& progress_;
  std::optional<double> voxelSize_;
  Animation animation_;
  std::map<std::string, Track> tracks_;
  FileReport report_;
};

}  // namespace sdf::exporter
