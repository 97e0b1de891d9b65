#include "viewer/app/session.h"

#include <algorithm>
#include <utility>

#include "sdf/script/script.h"
#include "viewer/app/materials.h"

namespace sdf::viewer {
namespace {

/// The values of those parameters that the scene has, within their ranges.
Values kept(const Values& values, const Scene& scene) {
  Values result;
  for (const ParameterInfo& p : scene.parameters)
    if (const auto it = values.find(p.name); it != values.end())
      result[p.name] = std::clamp(it->second, p.min, p.max);
  return result;
}

/// The scene built for these values; those that it has no parameters for are dropped from them.
Result<Scene> loadKeeping(const std::filesystem::path& file, Values& values, double time) {
  ScriptOptions options;
  options.time = time;
  auto plain = loadScene(file, options);
  if (!plain) return plain;
  values = kept(values, *plain);
  if (values.empty()) return plain;
  options.values = values;
  return loadScene(file, options);
}

}  // namespace

Result<Session> Session::open(const SessionOptions& options) {
  ScriptOptions script;
  script.values = options.overrides;
  script.time = options.time;
  auto scene = loadScene(options.scene, script);
  if (!scene) return scene.error();
  auto renderer = build(*scene, {options.view, options.method, {}});
  if (!renderer) return renderer.error();
  return Session(options, std::move(*scene), std::move(*renderer));
}

Session::Session(const SessionOptions& options, Scene scene, Renderer renderer)
    : file_(options.scene),
      watch_(file_),
      scene_(std::move(scene)),
      look_(scene_),
      renderer_(std::move(renderer)),
      built_{options.view, options.method, {}} {
  controls.parameters = options.overrides;
  controls.eye = options.eye;
  controls.time = options.time;
  controls.view = options.view;
  controls.method = options.method;
  controls.samples = options.samples;
  controls.maxSteps = options.maxSteps;
}

Result<Renderer> Session::build(const Scene& scene, const Built& wanted, bool countReadings) {
  ShaderOptions options;
  options.view = wanted.view;
  options.method = wanted.method;
  options.countReadings = countReadings;
  return Renderer::make(withSurfaceParameters(scene, wanted.materials), options);
}

void Session::settle() {
  if (wanted() == built_) return;
  auto made = build(scene_, wanted());
  if (!made) {
    buildMessage_ = made.error().message;
    controls.view = built_.view;
    controls.method = built_.method;
    controls.editedMaterials = built_.materials;
    return;
  }
  renderer_ = std::move(*made);
  built_ = wanted();
  buildMessage_.clear();
  ++compilations_;
}

Status Session::load() {
  Values parameters = controls.parameters;
  auto scene = loadKeeping(file_, parameters, controls.time);
  if (!scene) return scene.error();
  const Built wanted{controls.view, controls.method, {}};
  auto made = build(*scene, wanted);
  if (!made) return Error{made.error().kind, file_.string() + ": " + made.error().message};

  scene_ = std::move(*scene);
  look_ = LookFunction(scene_);
  renderer_ = std::move(*made);
  built_ = wanted;
  buildMessage_.clear();
  ++compilations_;
  controls.parameters = std::move(parameters);
  controls.editedMaterials.clear();
  controls.materials.clear();
  controls.look = {};
  return okStatus();
}

void Session::followFile() {
  if (watch_.written()) reload();
}

void Session::reload() {
  const Status loaded = load();
  fileMessage_ = loaded ? "" : loaded.error().message;
}

void Session::resetParameters() {
  controls.parameters.clear();
  reload();  // what the script did with value(…) follows only now
}

bool Session::hasClock() const {
  const auto& all = scene_.parameters;
  return std::any_of(all.begin(), all.end(), [](const ParameterInfo& p) { return p.name == "time"; });
}

double Session::value(const ParameterInfo& parameter) const {
  for (const Values* moved : {&controls.parameters, &controls.materials})
    if (const auto it = moved->find(parameter.name); it != moved->end()) return it->second;
  return parameter.value;
}

Values Session::values() const {
  Values all = controls.parameters;
  all.insert(controls.materials.begin(), controls.materials.end());
  all["time"] = controls.time;
  return all;
}

Look Session::look() const {
  Look look = look_.at(values());
  if (controls.eye) look.eye = *controls.eye;
  const LookEdits& edits = controls.look;
  for (const auto& [index, light] : edits.lights) look.lights[index] = light;
  look.ambient = edits.ambient.value_or(look.ambient);
  look.fogColor = edits.fogColor.value_or(look.fogColor);
  look.fogDensity = edits.fogDensity.value_or(look.fogDensity);
  return look;
}

Frame Session::frame() const {
  Frame frame;
  frame.parameters = values();
  frame.look = look();
  frame.samples = controls.samples;
  frame.maxSteps = controls.maxSteps;
  return frame;
}

Result<Readings> Session::measure(int width, int height) const {
  auto counting = build(scene_, built_, true);
  if (!counting) return counting.error();
  const auto target = Target::create(width, height, {PixelFormat::Rgba8, PixelFormat::Rgba32f});
  if (!target) return target.error();
  if (const Status drawn = counting->draw(frame(), *target); !drawn) return drawn.error();
  return counting->readings(*target);
}

}  // namespace sdf::viewer
