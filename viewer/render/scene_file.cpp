#include "viewer/render/scene_file.h"

#include <utility>

#include "sdf/triangles/brick_cache.h"

namespace sdf::viewer {

Result<Scene> SceneFile::load(ScriptOptions options) const {
  options.folders = folders;
  options.withoutMissing = true;
  if (cached) options.meshCache = BrickCache::usersFolder();
  return loadScene(path, options);
}

}  // namespace sdf::viewer
