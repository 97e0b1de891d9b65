#include "sdf/script/script.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "fuzz/targets.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/gltf/view.h"
#include "sdf/mesh/mesher.h"
#include "sdf/model/model.h"

namespace sdf::fuzz {
namespace {

constexpr std::size_t kLongestText = 4096;
constexpr std::size_t kMostParts = 4;
// findBounds reads a tape up to some 500,000 times; with a longer one an input would take seconds.
constexpr std::size_t kLongestTape = 60;

ScriptOptions smallLimits(bool fixed) {
  ScriptOptions options;
  options.fixed = fixed;
  options.time = 0.5;
  options.instructionLimit = 100'000;
  options.memoryLimit = 16u << 20;
  options.timeLimit = 5.0;
  return options;
}

// These concern the scene or the run as a whole.
bool mayLackALine(std::string_view message) {
  static constexpr std::array<std::string_view, 5> kWhole = {
      "the scene is empty", "needed more than 16 MiB of memory", "this is compiled Lua",
      "the script must return shapes", "the shape that the script returns is flat"};
  return std::any_of(kWhole.begin(), kWhole.end(), [&](auto start) { return message.starts_with(start); });
}

void checkError(const Error& error) {
  constexpr std::string_view kFile = "scene.lua:";
  const std::string& message = error.message;
  const auto fault = [&](const char* what) { find(std::string(what) + ": '" + message + "'"); };
  if (error.kind != ErrorKind::Scene) fault("an error of another kind");
  if (message.find_first_of("\r\n") != std::string::npos) fault("more than one line");
  if (!message.starts_with(kFile)) fault("an error that does not name the file");
  std::string_view rest = std::string_view(message).substr(kFile.size());
  const std::size_t digits = rest.find_first_not_of("0123456789");
  const bool hasLine = digits != 0 && digits != std::string_view::npos && rest[digits] == ':';
  if (hasLine) rest.remove_prefix(digits + 1);
  if (rest.size() < 2) fault("an error without a message");
  if (!hasLine && !mayLackALine(rest.substr(1))) fault("an error without a line");
}

// What uses of a part read of it.
void touch(const Part& part) {
  if (part.name.empty()) find("a part without a name");
  const Shape& shape = part.shape;
  const Tape tape = *Model(shape).at().whole();
  for (const glm::dvec3& p : {glm::dvec3(0.0), glm::dvec3(0.25, -1.5, 3.0), glm::dvec3(-1e4)}) {
    evaluateAll(tape, p);
    evaluateGradient(tape, p);
    const Box around{p - 0.5, p + 0.5};
    const Interval range = evaluate(tape, around);
    if (!range.contains(evaluate(tape, p))) find("an interval without the value at the box's centre");
    lipschitzOver(tape, around);
  }
  if (tape.firstOutputOnly()->instructions().size() > kLongestTape) return;
  const Box bounds = findBounds(shape);
  for (int axis = 0; axis < 3; ++axis)
    if (std::isnan(bounds.min[axis]) || std::isnan(bounds.max[axis])) find("bounds that are NaN");
}

}  // namespace

void script(Input input) {
  if (input.size() > kLongestText) return;
  const std::string text(input.begin(), input.end());
  for (const bool fixed : {false, true}) {
    const Result<Scene> scene = runScene(text, "scene.lua", smallLimits(fixed));
    if (!scene) {
      checkError(scene.error());
      continue;
    }
    for (std::size_t i = 0; i < std::min(scene->parts.size(), kMostParts); ++i) touch(scene->parts[i]);
    viewCamera(*scene);
    viewLights(*scene, glm::dvec3(0.0));
    evaluateAll(Tape(std::array{scene->background.x, scene->background.y, scene->background.z}),
                {0.0, 1.0, 0.0});
  }
}

}  // namespace sdf::fuzz
