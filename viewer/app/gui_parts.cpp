#include "viewer/app/gui_parts.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "viewer/app/materials.h"

namespace sdf::viewer {
namespace {

// What Dear ImGui's sliders and drags can be asked for.
constexpr double kWidest = 1e6, kLargest = 1e300;

constexpr ImGuiSliderFlags kClamped = ImGuiSliderFlags_AlwaysClamp;
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
  moved |= ImGui::SliderFloat("intensity", &intensity, kLeast, kMost, "%.3f",
                              kClamped | ImGuiSliderFlags_Logarithmic);
  if (moved) product = glm::vec4(intensity * color, product.w);
  return moved;
}

bool lightControls(LookLight& light) {
  const bool point = light.vector.w > 0.0f;
  glm::vec3 vector(light.vector);
  bool moved = ImGui::DragFloat3(point ? "position" : "towards it", glm::value_ptr(vector), 0.01f);
  const float length = glm::length(vector);
  if (moved && (point || length > 0.0f))
    light.vector = glm::vec4(point ? vector : vector / length, light.vector.w);
  moved |= coloredLight(light.color);
  bool shadow = light.color.w > 0.0f;
  moved |= ImGui::Checkbox("casts a shadow", &shadow);
  light.color.w = shadow ? 1.0f : 0.0f;
  return moved;
}

constexpr const char* kSurface[] = {"colour",
                                    "",
                                    "",
                                    "ambient",
                                    "",
                                    "",
                                    "highlight",
                                    "",
                                    "",
                                    "shininess",
                                    "reflectivity",
                                    "Fresnel power",
                                    "Fresnel bias",
                                    "emission",
                                    "",
                                    ""};

/// One surface number, or three that are a colour. Returns how many attributes that was.
int surfaceControl(Session& session, const Part& part, int attribute) {
  const bool triple = *kSurface[attribute + 1 < int(std::size(kSurface)) ? attribute + 1 : attribute] == '\0';
  const int count = triple ? 3 : 1;
  std::optional<ParameterInfo> infos[3];
  float color[3] = {};
  for (int i = 0; i < count; ++i) {
    infos[i] = surfaceParameter(part, static_cast<Attribute>(attribute + i));
    if (!infos[i]) return count;  // it varies over the part
    color[i] = static_cast<float>(session.value(*infos[i]));
  }
  Values& moved = session.controls.materials;
  if (triple) {
    if (ImGui::ColorEdit3(kSurface[attribute], color, kColor))
      for (int i = 0; i < count; ++i) moved[infos[i]->name] = static_cast<double>(color[i]);
    return count;
  }
  double value = session.value(*infos[0]);
  if (number(kSurface[attribute], value, infos[0]->min, infos[0]->max)) moved[infos[0]->name] = value;
  return count;
}

}  // namespace

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
  for (std::size_t i = 0; i < look.lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const bool point = look.lights[i].vector.w > 0.0f;
    ImGui::Text("light %zu, %s", i + 1, point ? "a point" : "far away");
    if (lightControls(look.lights[i])) edits.lights[i] = look.lights[i];
    ImGui::PopID();
  }
  if (ImGui::ColorEdit3("ambient", glm::value_ptr(look.ambient), kColor)) edits.ambient = look.ambient;
  if (ImGui::ColorEdit3("fog", glm::value_ptr(look.fogColor), kColor)) edits.fogColor = look.fogColor;
  if (ImGui::SliderFloat("fog density", &look.fogDensity, 0.0f, 1.0f, "%.4f",
                         kClamped | ImGuiSliderFlags_Logarithmic))
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
    for (int a = 0; open && a < static_cast<int>(std::size(kSurface));) a += surfaceControl(session, part, a);
    ImGui::PopID();
  }
}

}  // namespace sdf::viewer
