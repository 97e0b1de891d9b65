#include "viewer/app/session.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "sdf/script/script.h"
#include "viewer/app/materials.h"
#include "viewer/render/in_view.h"

namespace sdf::viewer {
namespace {

/// These values as the scene took them (ScriptOptions::tolerant), less those that it passed over.
Values taken(const Values& values, const Scene& scene) {
  Values result;
  for (const ParameterInfo& p : scene.parameters)
    if (values.contains(p.name)) result[p.name] = p.value;
  return result;
}

}  // namespace

Watch::Watch(std::filesystem::path file) : file_(std::move(file)), last_(stamp()) {}

bool Watch::written() {
  const auto now = stamp();
  if (!now || now == last_) return false;
  last_ = now;
  return true;
}

std::optional<Watch::Stamp> Watch::stamp() const {
  std::error_code noTime, noSize;
  const Stamp now(std::filesystem::last_write_time(file_, noTime), std::filesystem::file_size(file_, noSize));
  return noTime || noSize ? std::nullopt : std::optional(now);
}

Result<Session> Session::open(const SceneFile& file, Controls controls) {
  auto scene = file.load({.values = controls.parameters, .time = controls.time});
  if (!scene) return scene.error();
  LookFunction look = lookOf(*scene, file, controls.parameters);
  Values values = controls.parameters;
  values["time"] = controls.time;
  Built built{controls.shader, {}};
  built.shader.origin = originFor(controls.eye.value_or(look.at(values, kPictureAspect).eye));
  if (showsMesh(built.shader.view)) built.shader.view = View::Picture;  // until there is a mesh
  auto made = loaded(file, std::move(*scene), std::move(look), controls.parameters, controls.time, built);
  if (!made) return made.error();
  return Session(file, std::move(controls), std::move(*made), std::move(built));
}

Result<Session::Loaded> Session::loaded(const SceneFile& file, Scene scene, LookFunction look,
                                        const Values& parameters, double time, const Built& wanted) {
  PresentScene present(file, scene, parameters, time);
  Scene now = present.at(scene, parameters, time);
  auto made = build(now, present, wanted);
  if (!made) return made.error();
  return Loaded{std::move(scene), std::move(present), std::move(now), std::move(look), std::move(*made)};
}

Session::Session(SceneFile file, Controls start, Loaded loaded, Built built)
    : controls(std::move(start)),
      file_(std::move(file)),
      watch_(file_.path),
      scene_(std::move(loaded.scene)),
      present_(std::move(loaded.present)),
      now_(std::move(loaded.now)),
      look_(std::move(loaded.look)),
      renderer_(std::move(loaded.renderer)),
      built_(std::move(built)),
      ran_(read()) {
  watchFiles();
  tellMissing();
}

Result<Renderer> Session::build(const Scene& now, const PresentScene& present, const Built& wanted) {
  std::optional<Scene> other;
  if (present.other()) other = withSurfaceParameters(*present.other(), wanted.materials);
  ShaderOptions shader = wanted.shader;
  shader.steps = present.steps();
  return Renderer::make(withSurfaceParameters(now, wanted.materials), shader, other ? &*other : nullptr);
}

Status Session::fit() {
  const auto box = boxInView(scene_, file_, controls.parameters, controls.time);
  if (!box) return box.error();
  controls.eye = fitted(eye(), *box, aspect);
  return okStatus();
}

void Session::settle() {
  if (read() != ran_) run(controls.editedMaterials);
  followValues();
  followMesh();
  if (wanted() == built_) return;
  auto made = build(wanted());
  const Status shown = made ? showMesh(*made) : okStatus();
  if (made && !shown) made = shown.error();
  if (!made) {
    buildMessage_ = made.error().message;
    controls.shader = built_.shader;
    controls.editedMaterials = built_.materials;
    return;
  }
  renderer_ = std::move(*made);
  built_ = wanted();
  buildMessage_.clear();
  ++compilations_;
}

void Session::followValues() {
  if (!present_.move(controls.parameters, controls.time)) return;
  Scene now = present_.at(scene_, controls.parameters, controls.time);
  const auto compiled = renderer_.follow(withSurfaceParameters(now, built_.materials));
  const Status shown = compiled && *compiled ? showMesh(renderer_) : okStatus();
  buildMessage_ = !compiled ? compiled.error().message : !shown ? shown.error().message : "";
  if (!compiled) return;
  now_ = std::move(now);
  compilations_ += *compiled;
}

Status Session::load(const Built& wanted) {
  auto scene = file_.load({.values = controls.parameters, .tolerant = true, .time = controls.time});
  if (!scene) return scene.error();
  Values parameters = taken(controls.parameters, *scene);
  LookFunction look = lookOf(*scene, file_, parameters);
  auto made = loaded(file_, std::move(*scene), std::move(look), parameters, controls.time, wanted);
  if (!made) return made.error();
  if (auto s = showMesh(made->renderer); !s) return s;

  scene_ = std::move(made->scene);
  present_ = std::move(made->present);
  now_ = std::move(made->now);
  look_ = std::move(made->look);
  renderer_ = std::move(made->renderer);
  watchFiles();
  tellMissing();
  built_ = wanted;
  buildMessage_.clear();
  ++compilations_;
  controls.parameters = std::move(parameters);
  return okStatus();
}

bool Session::run(const std::set<std::string>& editedMaterials) {
  const Status loaded = load(wanted(editedMaterials));
  fileMessage_ = loaded ? "" : loaded.error().message;
  ran_ = read();
  return loaded.ok();
}

void Session::watchFiles() {
  std::map<std::string, Watch> watched;
  for (const std::string& file : scene_.files) {
    const auto known = watched_.find(file);
    watched.emplace(file, known == watched_.end() ? Watch(file) : known->second);
  }
  watched_ = std::move(watched);
}

void Session::tellMissing() {
  missingMessage_.clear();
  for (const std::string& why : scene_.missing)
    missingMessage_ += (missingMessage_.empty() ? "" : "\n") + why;
  for (const std::string& why : renderer_.shaders().plan.doubtful)
    missingMessage_ += (missingMessage_.empty() ? "" : "\n") + why;
}

void Session::followFile() {
  bool written = watch_.written();
  for (auto& [file, watch] : watched_) written = watch.written() || written;
  if (written) reload();
}

void Session::reload() {
  ++edition_;
  if (!run({})) return;
  controls.editedMaterials.clear();
  controls.materials.clear();
  controls.look = {};
}

void Session::resetParameters() {
  controls.parameters.clear();
  reload();  // the file's values are known to the script only
}

bool Session::hasClock() const {
  return std::ranges::any_of(scene_.parameters, [](const ParameterInfo& p) { return p.name == "time"; });
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

Values Session::read() const {
  Values result;
  for (const auto& [name, value] : values())
    if (scene_.valuesRead.contains(name)) result[name] = value;
  return result;
}

Look Session::look() const {
  Look look = look_.at(values(), aspect);
  if (controls.eye) look.eye = *controls.eye;
  const LookEdits& edits = controls.look;
  for (const auto& [index, light] : edits.lights)
    if (index < look.lights.size()) look.lights[index] = light;
  look.ambient = edits.ambient.value_or(look.ambient);
  look.fogColor = edits.fogColor.value_or(look.fogColor);
  look.fogDensity = edits.fogDensity.value_or(look.fogDensity);
  return look;
}

Result<Readings> Session::measure(int width, int height) const {
  Built counts = built_;
  counts.shader.countReadings = true;
  auto counting = build(counts);
  if (!counting) return counting.error();
  if (auto s = showMesh(*counting); !s) return s.error();
  const auto target = Target::create(width, height, {PixelFormat::Rgba8, PixelFormat::Rgba32f});
  if (!target) return target.error();
  if (const Status drawn = counting->draw(frame(), *target); !drawn) return drawn.error();
  return counting->readings(*target);
}

}  // namespace sdf::viewer
