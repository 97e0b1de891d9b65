// Scenes that name files.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sdf/script/script.h"
#include "support/folder.h"

namespace sdf::test {

/// A folder with the folder of a scene in it, "scenes".
class SceneFolder : public testing::Test {
 protected:
  SceneFolder() { std::filesystem::create_directory(scenes()); }

  std::filesystem::path scenes() const { return folder_ / "scenes"; }
  /// Runs a scene that lies there, with the options.
  Result<Scene> run(const std::string& text) const {
    return runScene(text, (scenes() / "scene.lua").string(), options_);
  }
  /// The scene, or a test failure and an empty one.
  Scene sceneOf(const std::string& text) const {
    Result<Scene> scene = run(text);
    if (scene) return std::move(*scene);
    ADD_FAILURE() << scene.error().message;
    return {};
  }
  /// "none" where there is no error.
  std::string errorOf(const std::string& text) const {
    const Result<Scene> scene = run(text);
    return scene ? "none" : scene.error().message;
  }
  /// The scene's path, and what follows it in a message.
  std::string here(const std::string& message) const { return (scenes() / "scene.lua").string() + message; }

  Folder folder_;
  ScriptOptions options_{};
};

}  // namespace sdf::test
