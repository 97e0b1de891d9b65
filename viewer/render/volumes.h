// The textures in three dimensions that shaders of payloads read. All of it works in the current context,
// which must be the same for one object's whole life.
#pragma once
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"
#include "viewer/gpu/program.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// Volumes keep one texture for each volume of each payload, however many programs read it.
class Volumes {
 public:
  /// Lets a program read the volumes of its shader, and makes the textures that there are not yet. Errors:
  /// Limits if the driver has no room for so many, or for one so large.
  Status giveTo(const Program& program, const std::vector<ShaderVolume>& volumes);
  /// Puts the volumes of other shaders of the same code (sameCode) in the places of those that the programs
  /// were given, one for one. Errors: Limits if the driver has no room for one so large.
  Status follow(const std::vector<ShaderVolume>& before, const std::vector<ShaderVolume>& after);
  /// Makes them what samplers read. It need not be called again before something else is bound to their
  /// units.
  void bind() const;

 private:
  struct Texture {
    std::shared_ptr<const Payload> payload;
    Handle handle;
  };
  std::map<std::pair<const Payload*, std::size_t>, int> units_;
  std::vector<Texture> textures_;  // from the first unit on
};

}  // namespace sdf::viewer
