#include "viewer/render/scene_file.h"

#include <utility>

#include "sdf/gltf/read_mesh.h"
#include "sdf/triangles/brick_cache.h"

namespace sdf::viewer {

Result<Scene> SceneFile::load(ScriptOptions options) const {
  options.readMesh = readMesh;
  options.folders = folders;
  options.withoutMissing = true;
  if (cached) options.meshCache = BrickCache::usersFolder();
  return loadScene(path, options);
}

}  // namespace sdf::viewer
