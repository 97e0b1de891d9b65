#include "sdf/script/script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <utility>

#include "sdf/model/float_range.h"
#include "sdf/model/no_number.h"
#include "sdf/script/context.h"

namespace sdf {

namespace {

Error sceneError(const std::string& name, const std::string& message) {
  return {ErrorKind::Scene, name + ": " + message};
}

// Two digits: such figures are no better.
std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

std::string namesOf(const std::vector<ParameterInfo>& parameters) {
  std::string names;
  for (const ParameterInfo& p : parameters)
    if (p.name != "time") names += (names.empty() ? "" : ", ") + p.name;
  return names;
}

// An override that no param() asked for is a slip of the pen.
Status checkOverrides(const Scene& scene, const ScriptOptions& options, const std::string& name) {
  if (options.tolerant) return okStatus();
  for (const auto& [key, value] : options.values) {
    const std::vector<ParameterInfo>& asked = scene.parameters;
    if (std::ranges::find(asked, key, &ParameterInfo::name) != asked.end()) continue;
    const std::string known = namesOf(asked);
    return sceneError(name, "-D " + key + ": the scene has no parameter '" + key + "' (it has " +
                                (known.empty() ? "none" : known) + ")");
  }
  return okStatus();
}

// Says which offsets are off, and by how much.
void lookAtOffsets(ScriptContext& context) try {
  Values values(context.options.values.begin(), context.options.values.end());
  values["time"] = context.options.time;
  for (const OffsetNote& note : context.offsets) {
    const auto found = checkOffset(note.offset, values);
    if (!found || !found->wrong()) continue;
    const std::string least = rounded(found->least), most = rounded(found->most);
    const std::string range = least == most ? least : least + " to " + most;
    context.scene.notes.push_back(note.place + ": " + note.reader + " " + range +
                                  " away where it should be " + rounded(found->wanted) +
                                  ", for the distance is not exact since the " + note.since +
                                  "; use exact shapes there, or change the parts before they are combined");
  }
} catch (const NodeLimitReached&) {
  // A scene that takes all of its memory is not looked at.
}

// Says of which parts the distance is no number somewhere within their bounds. What floats cannot hold is
// refused for that.
void lookForNoNumbers(ScriptContext& context) {
  Scene& scene = context.scene;
  Values values(context.options.values.begin(), context.options.values.end());
  values["time"] = context.options.time;
  for (const Part& part : scene.parts) {
    const Box box = scene.bounds ? intersect(part.shape.bounds, *scene.bounds) : part.shape.bounds;
    if (box.empty() || !box.finite() || beyondFloats(box)) continue;
    const auto found = findNoNumber(part.shape.distance, box, values);
    if (!found) continue;
    const glm::dvec3& p = found->at;
    const std::string place = "(" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ")";
    scene.notes.push_back((part.name.empty() ? "" : "part '" + part.name + "': ") + textOf(*found, place));
  }
}

}  // namespace

Expr inputOf(const ScriptContext& context, ParameterInfo info) {
  if (context.options.fixed) return info.value;
  if (context.options.narrowed.contains(info.name)) info.min = info.max = info.value;
  return Expr::parameter(info);
}

std::set<std::string> noteValuesRead(ScriptContext& context, const Expr& e) {
  std::set<std::string> names;
  for (const Expr& node : topologicalOrder(std::span(&e, 1)))
    if (node.op() == Op::Parameter) names.insert(node.parameterInfo().name);
  context.scene.valuesRead.insert(names.begin(), names.end());
  return names;
}

Result<Scene> runScene(const std::string& text, const std::string& name, const ScriptOptions& options) {
  if (!std::isfinite(options.time)) return sceneError(name, "the time must be a finite number of seconds");
  for (const auto& [key, value] : options.values) {
    if (key == "time") return sceneError(name, "-D time: set the scene's clock with --time");
    if (!std::isfinite(value)) return sceneError(name, "-D " + key + ": the value must be a finite number");
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::string source = text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
  if (source.starts_with('\x1B')) return sceneError(name, "this is compiled Lua; give the scene's text");
  ScriptContext context(name, options);
  const Status ran = runInSandbox(context, source);
  if (!context.toNarrow.empty()) {
    ScriptOptions narrower = options;
    narrower.narrowed.merge(context.toNarrow);
    return runScene(text, name, narrower);
  }
  if (!ran) return ran.error();
  lookAtOffsets(context);
  lookForNoNumbers(context);
  if (const Status known = checkOverrides(context.scene, options, name); !known) return known.error();
  if (context.scene.parts.empty() && !context.scene.missing.empty())
    return Error{ErrorKind::Scene, context.scene.missing.front()};
  if (context.scene.parts.empty())
    return sceneError(name, "the scene is empty; add a shape with part(name, shape) or return one");
  const auto isSet = [&](const char* name) { return context.settingLines.contains(name); };
  if (isSet("background_light") && !isSet("ambient")) context.scene.ambient = Vec3E(0.0);
  if (context.scene.lights.empty() && !isSet("ambient") && !isSet("background_light")) {
    context.scene.lights = standardLights();  // else shapes are flat spots of their colour
    if (!isSet("shadows")) context.scene.shadow = standardShadow();
    if (!isSet("background")) context.scene.background = standardBackground();
  }
  Result<Scene> scene = checked(std::move(context.scene));
  if (!scene) return sceneError(name, scene.error().message);
  return scene;
}

Result<Scene> loadScene(const std::filesystem::path& file, const ScriptOptions& options) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code))
    return Error{ErrorKind::Files, file.string() + ": this is a folder; name a scene file"};
  if (const std::uintmax_t size = std::filesystem::file_size(file, code); !code && size > options.memoryLimit)
    return Error{ErrorKind::Scene,
                 file.string() + ": it has " + std::to_string(size >> 20) + " MiB, and a scene may use " +
                     std::to_string(options.memoryLimit >> 20) + " MiB of memory; name a scene file"};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in)
    return Error{ErrorKind::Files, file.string() + ": cannot be read; check the name and the permissions"};
  return runScene(text.str(), file.string(), options);
}

}  // namespace sdf
