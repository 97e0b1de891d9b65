#include "viewer/app/mesh_panel.h"

#include <epoxy/gl.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "viewer/render/legend.h"

namespace sdf::viewer {
namespace {

/// A length, from one share of the scene's extent to another; true where it was moved.
bool lengthSlider(const char* name, double& value, double extent, double least, double most) {
  const double from = least * extent, to = most * extent;
  return ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &from, &to, "%.3g",
                             ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
}

/// Either triangles as large everywhere, or a tolerance.
void sizes(MeshSettings& settings, double extent) {
  constexpr double kVoxel = 1.0 / 400.0;  // about the exporter's, of a diagonal
  bool uniform = settings.voxelSize && !settings.tolerance;
  double tolerance = settings.tolerance.value_or(kDefaultTolerance * extent);
  if (settings.toleranceOfDiagonal && settings.tolerance) tolerance *= extent;
  double voxel = settings.voxelSize.value_or(kVoxel * extent);
  const auto keepTolerance = [&] {
    settings.tolerance = tolerance;
    settings.toleranceOfDiagonal = false;
  };
  if (ImGui::RadioButton("tolerance", !uniform) && uniform) settings = {};
  ImGui::SameLine();
  if (ImGui::RadioButton("uniform", uniform) && !uniform) settings = {.voxelSize = voxel};
  uniform = settings.voxelSize && !settings.tolerance;
  if (!uniform && lengthSlider("tolerance##length", tolerance, extent, 1e-5, 0.1)) keepTolerance();
  if (lengthSlider("voxel size", voxel, extent, 1e-3, 0.1)) {
    settings.voxelSize = voxel;
    if (!uniform) keepTolerance();
  }
}

void progress(Session& session) {
  if (session.meshing()) {
    ImGui::Text("meshing: %s", session.meshStage().c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) session.cancelMesh();
    return;
  }
  const MeshView* mesh = session.mesh();
  if (!mesh) {
    if (ImGui::SmallButton("Mesh")) session.meshAgain();
    return;
  }
  ImGui::Text("%zu triangles", mesh->shown.triangles.size());
  ImGui::SameLine();
  if (ImGui::SmallButton("Again")) session.meshAgain();
  for (const std::string& warning : mesh->warnings) ImGui::TextWrapped("%s", warning.c_str());
  if (!mesh->own) return;
  const MeshStats stats = combined(mesh->own->parts);
  ImGui::Text("%.3g off at most, rms %.3g", stats.maxDistance, stats.rmsDistance);
}

}  // namespace

void MeshPanel::controls(Session& session, Requests& requests) {
  Controls& controls = session.controls;
  if (!showsMesh(controls.shader.view)) {
    ImGui::TextDisabled("of the last four views");
    return;
  }
  if (controls.shader.view == View::Split) {
    constexpr double kLeast = 0.02, kMost = 0.98;
    ImGui::SliderScalar("split", ImGuiDataType_Double, &controls.split, &kLeast, &kMost, "%.2f",
                        ImGuiSliderFlags_AlwaysClamp);
  }
  if (!controls.meshFile) sizes(controls.mesh, session.extent());
  progress(session);
  requests.exportMesh |= ImGui::Button("Export");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##export", &exportName);
  if (controls.meshFile) {
    if (ImGui::Button("The scene's own mesh")) controls.meshFile.reset();
    return;
  }
  ImGui::BeginDisabled(fileName.empty());
  if (ImGui::Button("Show file")) {
    controls.meshFile = fileName;
    controls.mesh.voxelSize.reset();
    if (controls.mesh.toleranceOfDiagonal) controls.mesh = {};
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##mesh", "mesh to show against the scene", &fileName);
}

void MeshPanel::overPicture(const Session& session) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  if (session.controls.shader.view == View::Split && session.mesh()) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float x = static_cast<float>(session.controls.split) * window.x, y = 0.5f * window.y;
    constexpr float kKnob = 7.0f;
    list.AddLine({x, 0.0f}, {x, window.y}, IM_COL32(20, 20, 20, 160), 3.0f);
    list.AddLine({x, 0.0f}, {x, window.y}, IM_COL32(255, 255, 255, 220), 1.0f);
    list.AddCircleFilled({x, y}, kKnob, IM_COL32(255, 255, 255, 220));
    list.AddCircle({x, y}, kKnob, IM_COL32(20, 20, 20, 160), 0, 1.5f);
  }
  if (session.errors()) legend(session);
}

void MeshPanel::legend(const Session& session) {
  const ErrorFigures& figures = *session.errors();
  if (drawn_ != figures) {
    const Picture picture =
        legendOf(figures, static_cast<int>(std::max(1.0f, ImGui::GetIO().FontGlobalScale)));
    width_ = picture.width, height_ = picture.height;
    texture_ = Handle(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); });
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 picture.bytes.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, GLuint(bound));
    drawn_ = figures;
  }
  constexpr float kMargin = 10.0f;
  const ImVec2 window = ImGui::GetIO().DisplaySize, to(window.x - kMargin, window.y - kMargin);
  const ImVec2 from(to.x - static_cast<float>(width_), to.y - static_cast<float>(height_));
  // NOLINTNEXTLINE: Dear ImGui hands numbers of textures on as pointers
  ImGui::GetBackgroundDrawList()->AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t(texture_.id())), from,
                                           to);
}

}  // namespace sdf::viewer
