// A scene at the present values of the inputs on which its slopes hang.
#pragma once
#include <optional>
#include <set>
#include <string>

#include "sdf/eval/function.h"
#include "sdf/model/model.h"
#include "sdf/scene/scene.h"
#include "viewer/render/scene_file.h"

namespace sdf::viewer {

/// A scene's slopes, and distances that are calibrated by them, hold for the whole ranges of its inputs, its
/// parameters and the clock. A PresentScene finds out on which of them they hang, and runs the scene's file
/// for present values: these inputs stay inputs of its formulas, but slopes and bounds are those of one value
/// (ScriptOptions::narrowed), as with the number in the parameter's place.
class PresentScene {
 public:
  /// Takes a scene that was loaded from the file with these values. If a shape is no exact distance and
  /// depends on inputs, the file is run at values within their ranges, and once for each such input. So the
  /// present values do not decide what is found.
  PresentScene(SceneFile file, const Scene& scene, const Values& parameters, double time);

  /// Returns the inputs on which slopes hang; none: the scene serves all values as it is.
  const std::set<std::string>& inputs() const { return inputs_; }
  /// Returns whether they have other values than at the call before; the first time false.
  bool move(const Values& parameters, double time);
  /// Returns the scene at these values. Where the file allows none for them, as where a radius is 0, it is
  /// the given one, of all values.
  Scene at(const Scene& all, const Values& parameters, double time) const;
  /// Returns what rays through at() go by: where regions lead farther than one slope, by those of the present
  /// values; by those of the clock only where they save more than they cost in each frame.
  Steps steps() const { return steps_; }
  /// Returns the scene at other values, from which renderers see which numbers change; null without inputs.
  const Scene* other() const { return other_ ? &*other_ : nullptr; }

 private:
  std::optional<Scene> run(const Values& parameters, double time, const std::set<std::string>& inputs) const;

  SceneFile file_;
  std::set<std::string> known_;  // parameters of the file
  std::set<std::string> inputs_;
  std::optional<Scene> other_;  // at other values
  Steps steps_ = Steps::ByRegion;
  Values last_;
};

}  // namespace sdf::viewer
