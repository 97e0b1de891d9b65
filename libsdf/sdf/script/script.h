// The scene language: Lua 5.4 in a sandbox. See docs/scene-language.md.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/scene/scene.h"

namespace sdf {

struct ScriptOptions {
  /// Overrides of param(name, …); a name that the scene lacks is an error.
  std::map<std::string, double> values{};
  /// Values that the scene cannot take are no error: a name that it lacks is passed over, and what is outside
  /// a parameter's range becomes the nearest value in it. For values that were set before the file changed.
  bool tolerant = false;
  double time = 0.0;  ///< seconds; the value of `time`
  /// Parameters and time are formulas of constants: bounds and claims fit their values, and the scene holds
  /// for no others. A script cannot tell the difference.
  bool fixed = false;
  /// Names of parameters, or "time", that are meant for their present value alone: bounds and claims fit it,
  /// and hold for no other. Scene::parameters tells the whole range all the same.
  std::set<std::string> narrowed{};
  std::uint64_t instructionLimit = 50'000'000;
  std::size_t memoryLimit = 256u << 20;  ///< bytes, of Lua and of the graph together
  double timeLimit =
      60.0;  ///< seconds; for work that few instructions can ask for, such as copying long tables
  /// The folder in which meshes' samples for shaders are kept (BrickCache); empty: nowhere.
  std::filesystem::path meshCache{};
  /// Folders, beside the scene's own, from which it may read.
  std::vector<std::filesystem::path> folders{};
  /// A mesh that cannot be had is no error: the scene is made without it, and says so (Scene::missing). Where
  /// nothing is left then it is one.
  bool withoutMissing = false;
};

/// Runs a scene file. Errors (ErrorKind::Scene; Files if it cannot be read) name file and line and what was
/// expected.
Result<Scene> loadScene(const std::filesystem::path& file, const ScriptOptions& options = {});
/// The same for text; `name` stands for the file in messages.
Result<Scene> runScene(const std::string& text, const std::string& name, const ScriptOptions& options = {});

}  // namespace sdf
