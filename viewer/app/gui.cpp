#include "viewer/app/gui.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>

#include "viewer/app/gui_parts.h"

namespace sdf::viewer {
namespace {

constexpr float kMargin = 8.0f, kPanelWidth = 320.0f;
constexpr float kLabelWidth = 8.0f;  // of a slider, in heights of the font
constexpr const char* kViews[] = {"Picture",  "Normals",  "Steps",     "Distance slice",
                                  "Gradient", "Material", "Occlusion", "Shadow"};
static_assert(std::size(kViews) == static_cast<std::size_t>(View::Count));
constexpr const char* kMethods[] = {"Auto-relaxed", "Plain"};
constexpr int kMostSamples = 6, kFewestSteps = 8, kMostSteps = 4096;

template <class Enum, std::size_t N>
void choice(const char* label, Enum& value, const char* const (&names)[N]) {
  int index = static_cast<int>(value);
  if (ImGui::Combo(label, &index, names, static_cast<int>(N))) value = static_cast<Enum>(index);
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
                    ImGuiSliderFlags_AlwaysClamp);
}

void marching(Controls& controls) {
  choice("view", controls.view, kViews);
  choice("method", controls.method, kMethods);
  ImGui::SliderInt("steps", &controls.maxSteps, kFewestSteps, kMostSteps, "at most %d",
                   ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  ImGui::SliderInt("samples", &controls.samples, 1, kMostSamples, "%d a side", ImGuiSliderFlags_AlwaysClamp);
}

void camera(Session& session, Requests& requests) {
  ImGui::BeginDisabled(!session.controls.eye);
  if (ImGui::Button("The scene's (0)")) session.controls.eye.reset();
  ImGui::EndDisabled();
  ImGui::SameLine();
  requests.copyCamera |= ImGui::Button("Copy as scene text (C)");
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(textOf(session.eye()).c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

void Gui::picture(Requests& requests) {
  requests.savePicture |= ImGui::Button("Save (P)");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##file", &pictureName);
  if (notice.empty()) return;
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(notice.c_str());
  ImGui::PopTextWrapPos();
}

void Gui::statistics(const Session& session, const Canvas& canvas, Requests& requests) {
  const FrameStatistics& frame = canvas.statistics();
  ImGui::Text("%.1f ms a frame, %d x %d, %d samples", 1e3 * frame.seconds, frame.width, frame.height,
              frame.samples * frame.samples);
  const Renderer& renderer = session.renderer();
  ImGui::Text("shaders: %zu bytes, compiled in %.0f ms", renderer.shaders().bytes(),
              1e3 * renderer.compileSeconds());
  if (frame.outOfSteps) ImGui::Text("%.2f %% of the pixels ran out of steps", 100.0 * *frame.outOfSteps);
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
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(session.message().c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace sdf::viewer
