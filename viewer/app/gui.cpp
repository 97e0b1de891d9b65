#include "viewer/app/gui.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/app/materials.h"

namespace sdf::viewer {
namespace {

constexpr float kMargin = 8.0f, kPanelWidth = 320.0f;
constexpr float kLabelWidth = 8.0f;  // of a slider, in heights of the font
constexpr int kMostSamples = 6, kFewestSteps = 8, kMostSteps = 4096;

template <class Enum, std::size_t N>
void choice(const char* label, Enum& value, const Choice<Enum> (&choices)[N]) {
  const char* labels[N];
  std::ranges::transform(choices, labels, &Choice<Enum>::label);
  int index = static_cast<int>(value);
  if (ImGui::Combo(label, &index, labels, static_cast<int>(N))) value = choices[index].value;
}

// What Dear ImGui's sliders and drags can be asked for.
constexpr double kWidest = 1e6, kLargest = 1e300;

constexpr ImGuiSliderFlags kClamped = ImGuiSliderFlags_AlwaysClamp;
constexpr ImGuiSliderFlags kLogarithmic = kClamped | ImGuiSliderFlags_Logarithmic;
constexpr ImGuiColorEditFlags kColor = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR;

/// A slider, or where the range is too wide for one, a number to drag. The name is shown as it is, whatever
/// characters it has.
bool number(const std::string& name, double& value, double least, double most) {
  least = std::max(least, -kLargest);
  most = std::min(most, kLargest);
  ImGui::PushID(name.c_str());
  const float speed = static_cast<float>(0.01 * std::min(std::max(std::abs(value), 1.0), kWidest));
  const bool moved = most - least <= kWidest ? ImGui::SliderScalar("##value", ImGuiDataType_Double, &value,
                                                                   &least, &most, "%.4g", kClamped)
                                             : ImGui::DragScalar("##value", ImGuiDataType_Double, &value,
                                                                 speed, &least, &most, "%.4g", kClamped);
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::TextUnformatted(name.c_str());
  ImGui::PopID();
  return moved;
}

/// A light's colour and what multiplies it; the shaders want their product.
bool coloredLight(glm::vec4& product) {
  const float largest = std::max({product.x, product.y, product.z});
  float intensity = largest;
  glm::vec3 color = largest > 0.0f ? glm::vec3(product) / largest : glm::vec3(1.0f);
  // Not quite to 0, where the colour would be lost.
  constexpr float kLeast = 0.001f, kMost = 10.0f;
  bool moved = ImGui::ColorEdit3("colour", glm::value_ptr(color), kColor);
  moved |= ImGui::SliderFloat("intensity", &intensity, kLeast, kMost, "%.3f", kLogarithmic);
  if (moved) product = glm::vec4(intensity * color, product.w);
  return moved;
}

/// Of a light that has a size; shaders know whether one has.
bool sizeOf(LookLight& light, float speed) {
  if (light.size == 0.0f) return false;
  constexpr float kLeast = 1e-4f, kSteepest = 89.0f;  // not quite to 0, where there would be none to drag
  if (light.vector.w > 0.0f)
    return ImGui::DragFloat("radius", &light.size, speed, kLeast, 1e6f, "%.3g", kClamped);
  float degrees = glm::degrees(std::asin(light.size));
  const bool moved = ImGui::SliderFloat("radius", &degrees, kLeast, kSteepest, "%.2f degrees", kLogarithmic);
  if (moved) light.size = std::sin(glm::radians(degrees));
  return moved;
}

/// `speed` is how far a drag of a pixel moves a light's place, scene units.
bool lightControls(LookLight& light, float speed) {
  const bool point = light.vector.w > 0.0f;
  glm::vec3 vector(light.vector);
  bool moved =
      ImGui::DragFloat3(point ? "position" : "towards it", glm::value_ptr(vector), point ? speed : 0.01f);
  const float length = glm::length(vector);
  if (moved && (point || length > 0.0f))
    light.vector = glm::dvec4(point ? vector : vector / length, light.vector.w);
  moved |= coloredLight(light.color);
  bool shadow = light.color.w > 0.0f;
  moved |= ImGui::Checkbox("casts a shadow", &shadow);
  light.color.w = shadow ? 1.0f : 0.0f;
  return sizeOf(light, speed) || moved;
}

/// The numbers of one control, if they are the same all over the part.
void surfaceControl(Session& session, const Part& part, const SurfaceControl& control) {
  ParameterInfo infos[3];
  float color[3] = {};
  for (int i = 0; i < control.count; ++i) {
    const auto info = surfaceParameter(part, static_cast<Attribute>(static_cast<int>(control.first) + i));
    if (!info) return;
    infos[i] = *info;
    color[i] = static_cast<float>(session.value(*info));
  }
  Values& moved = session.controls.materials;
  if (control.count == 1) {
    double value = session.value(infos[0]);
    if (number(control.name, value, infos[0].min, infos[0].max)) moved[infos[0].name] = value;
  } else if (ImGui::ColorEdit3(control.name, color, kColor)) {
    for (int i = 0; i < control.count; ++i) moved[infos[i].name] = static_cast<double>(color[i]);
  }
}

void parameterSliders(Session& session) {
  const auto& all = session.scene().parameters;
  const bool any = std::any_of(all.begin(), all.end(), [](const auto& p) { return p.name != "time"; });
  if (!any) {
    ImGui::TextDisabled("the scene has none");
    return;
  }
  for (const ParameterInfo& p : all) {
    double value = session.value(p);
    if (p.name != "time" && number(p.name, value, p.min, p.max)) session.controls.parameters[p.name] = value;
  }
  if (ImGui::Button("As in the file##parameters")) session.resetParameters();
}

void lightPanel(Session& session) {
  Look look = session.look();
  LookEdits& edits = session.controls.look;
  const float speed = static_cast<float>(0.002 * glm::length(look.eye.to - look.eye.from));
  for (std::size_t i = 0; i < look.lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const bool point = look.lights[i].vector.w > 0.0f;
    ImGui::Text("light %zu, %s", i + 1, point ? "a point" : "far away");
    if (lightControls(look.lights[i], speed)) edits.lights[i] = look.lights[i];
    ImGui::PopID();
  }
  if (ImGui::ColorEdit3("ambient", glm::value_ptr(look.ambient), kColor)) edits.ambient = look.ambient;
  if (ImGui::ColorEdit3("fog", glm::value_ptr(look.fogColor), kColor)) edits.fogColor = look.fogColor;
  if (ImGui::SliderFloat("fog density", &look.fogDensity, 0.0f, 1.0f, "%.4f", kLogarithmic))
    edits.fogDensity = look.fogDensity;
  if (ImGui::Button("As in the file##light")) edits = {};
}

void materialPanel(Session& session) {
  ImGui::TextDisabled("numbers that are the same all over a part");
  for (const Part& part : session.scene().parts) {
    ImGui::PushID(part.name.c_str());
    auto& edited = session.controls.editedMaterials;
    bool open = edited.contains(part.name);
    if (ImGui::Checkbox("##edit", &open))
      open ? void(edited.insert(part.name)) : void(edited.erase(part.name));
    ImGui::SameLine();
    ImGui::TextUnformatted(part.name.c_str());
    if (open)
      for (const SurfaceControl& control : kSurfaceControls) surfaceControl(session, part, control);
    ImGui::PopID();
  }
}

void clock(Session& session) {
  if (!session.hasClock()) {
    ImGui::TextDisabled("the scene stands still");
    return;
  }
  if (ImGui::Button(session.playing ? "Pause" : "Play")) session.playing = !session.playing;
  ImGui::SameLine();
  if (ImGui::Button("To 0")) session.controls.time = 0.0;
  ImGui::SameLine();
  constexpr double kLeast = 0.0, kMost = 1e6;
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::DragScalar("##time", ImGuiDataType_Double, &session.controls.time, 0.02f, &kLeast, &kMost, "%.2f s",
                    kClamped);
}

void marching(Controls& controls) {
  choice("view", controls.shader.view, kViews);
  choice("method", controls.shader.method, kMethods);
  choice("start", controls.shader.start, kStarts);
  ImGui::SliderInt("steps", &controls.maxSteps, kFewestSteps, kMostSteps, "at most %d", kLogarithmic);
  ImGui::SliderInt("samples", &controls.samples, 1, kMostSamples, "%d a side", kClamped);
}

/// Of a camera that has one; shaders know whether it has.
void lens(Session& session) {
  Eye eye = session.eye();
  if (eye.aperture == 0.0) return;
  const double far = glm::length(eye.to - eye.from);
  constexpr double kLeast = 1e-9;  // not quite 0, where there would be none
  double focus = eye.focus.value_or(far);
  bool moved = ImGui::DragScalar("aperture", ImGuiDataType_Double, &eye.aperture,
                                 static_cast<float>(1e-4 * far), &kLeast, &kLargest, "%.4g", kClamped);
  if (ImGui::DragScalar("focus", ImGuiDataType_Double, &focus, static_cast<float>(2e-3 * far), &kLeast,
                        &kLargest, "%.4g", kClamped)) {
    eye.focus = focus;
    moved = true;
  }
  if (moved) session.controls.eye = eye;
}

void camera(Session& session, Requests& requests) {
  ImGui::BeginDisabled(!session.controls.eye);
  if (ImGui::Button("The scene's (0)")) session.controls.eye.reset();
  ImGui::EndDisabled();
  ImGui::SameLine();
  requests.fit |= ImGui::Button("All in view (F)");
  requests.copyCamera |= ImGui::Button("Copy as scene text (C)");
  lens(session);
  ImGui::TextWrapped("%s", textOf(session.eye()).c_str());
}

}  // namespace

void Gui::picture(Requests& requests) {
  requests.savePicture |= ImGui::Button("Save (P)");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##file", &pictureName);
  if (!notice.empty()) ImGui::TextWrapped("%s", notice.c_str());
}

void Gui::statistics(const Session& session, const Canvas& canvas, Requests& requests) {
  for (const std::string& note : session.scene().notes) ImGui::TextWrapped("%s", note.c_str());
  const FrameStatistics& frame = canvas.statistics();
  ImGui::Text("%.1f ms a frame, %d x %d, %d samples", 1e3 * frame.seconds, frame.width, frame.height,
              frame.samples * frame.samples);
  if (const auto share = canvas.drawnShare())
    ImGui::Text("drawing: %.0f %%", 100.0 * *share);
  else if (canvas.resting())
    ImGui::Text("refined to %d samples", frame.refined);
  else
    ImGui::Text("refined: %d of %d samples", frame.refined, canvas.samplesAtRest());
  const Renderer& renderer = session.renderer();
  ImGui::Text("shaders: %zu bytes, compiled in %.0f ms", renderer.shaders().bytes(),
              1e3 * renderer.compileSeconds());
  if (frame.outOfSteps) ImGui::Text("%.2f %% of the pixels ran out of steps", 100.0 * *frame.outOfSteps);
  if (frame.outOfShadowSteps.value_or(0.0) > 0.0)
    ImGui::Text("%.2f %% are dark where a shadow ran out of its steps", 100.0 * *frame.outOfShadowSteps);
  requests.measure |= ImGui::Button("Count readings (M)");
  if (readings)
    ImGui::Text("a pixel: %.1f primary, %.1f shadow,\n%.1f occlusion, %.1f reflection", readings->primary,
                readings->shadow, readings->occlusion, readings->reflection);
}

void Gui::panels(Session& session, const Canvas& canvas, Requests& requests) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({kPanelWidth, std::max(window.y - 2.0f * kMargin, kMargin)},
                           ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowBgAlpha(0.8f);
  if (ImGui::Begin("sdfview")) {
    ImGui::PushItemWidth(-kLabelWidth * ImGui::GetFontSize());
    const auto section = [](const char* name, bool open) {
      return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
    };
    if (section("Parameters", true)) parameterSliders(session);
    if (section("Time", true)) clock(session);
    if (section("View", true)) marching(session.controls);
    if (section("Mesh", showsMesh(session.controls.shader.view))) mesh.controls(session, requests);
    if (section("Statistics", true)) statistics(session, canvas, requests);
    if (section("Light", false)) lightPanel(session);
    if (section("Materials", false)) materialPanel(session);
    if (section("Camera", false)) camera(session, requests);
    if (section("Save as PNG", true)) picture(requests);
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void Gui::overlay(const Session& session) const {
  if (session.message().empty()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * window.x, window.y - kMargin}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowSize({std::max(window.x - 2.0f * kMargin, kMargin), 0.0f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.45f, 0.05f, 0.05f, 0.95f));
  ImGui::Begin("error", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextWrapped("%s", session.message().c_str());
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace sdf::viewer
