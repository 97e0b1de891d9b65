// Where scenes come from.
#pragma once
#include <filesystem>
#include <vector>

#include "sdf/script/script.h"

namespace sdf::viewer {

/// A SceneFile is a scene's file, and the folders beside its own from which it may read meshes.
struct SceneFile {
  std::filesystem::path path;
  std::vector<std::filesystem::path> folders{};
  bool cached = true;  ///< what is sampled of its meshes is kept in the user's folder (BrickCache)

  SceneFile() = default;
  SceneFile(std::filesystem::path file, std::vector<std::filesystem::path> more = {},  // NOLINT: implicit
            bool keeps = true)
      : path(std::move(file)), folders(std::move(more)), cached(keeps) {}

  bool operator==(const SceneFile&) const = default;

  /// Runs the file with these options. Errors: those of loadScene.
  Result<Scene> load(ScriptOptions options) const;
};

}  // namespace sdf::viewer
