// Scenes that move, in one glTF file.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sdf/expr/motion.h"
#include "sdf/gltf/part.h"
#include "sdf/scene/scene.h"

namespace sdf {

/// One mesh of a part, and where it is at each moment.
struct AnimatedMesh {
  ExportPart part;
  /// From where it was meshed to where it is, by frame; nothing while the part looks otherwise or is not
  /// there.
  std::vector<std::optional<RigidMotion>> motions;
};

/// A part: one mesh if it does nothing but move, else one for each shape that it takes, of which at most one
/// is there at any moment.
struct AnimatedPart {
  std::string name;
  std::vector<AnimatedMesh> meshes;
};

struct Animation {
  std::vector<double> times;        ///< of the frames, ascending, seconds
  std::vector<Scene> scenes;        ///< by frame: cameras and lights
  std::vector<AnimatedPart> parts;  ///< their meshes have a motion or nothing for each frame
};

/// Changes with time that cannot be written, a line each: the camera's angle, the colours and intensities of
/// lights, their number and kinds. The file has the first frame's.
std::vector<std::string> notAnimated(const Animation& animation);

/// Do meshes move among each other, or change?
bool moves(const Animation& animation);

}  // namespace sdf
