#include "viewer/app/materials.h"

#include <algorithm>

namespace sdf::viewer {
namespace {

double largest(Attribute attribute) {
  double value = 1.0;
  for (const SurfaceControl& control : kSurfaceControls)
    if (attribute >= control.first) value = control.largest;
  return value;
}

/// Where ambient light is answered like any other, editing the colour edits both.
Attribute leading(const Part& part, Attribute attribute) {
  const int a = static_cast<int>(attribute), offset = static_cast<int>(Attribute::AmbientRed);
  const bool ambient = attribute >= Attribute::AmbientRed && attribute <= Attribute::AmbientBlue;
  const auto& surface = part.shape.surface;
  return ambient && surface[a] == surface[a - offset] ? static_cast<Attribute>(a - offset) : attribute;
}

}  // namespace

std::optional<ParameterInfo> surfaceParameter(const Part& part, Attribute attribute) {
  const Attribute named = leading(part, attribute);
  const Expr& e = part.shape.surface[static_cast<int>(attribute)];
  if (!e.isConstant() || attribute == Attribute::MaterialId) return std::nullopt;
  const double value = e.constantValue();
  return ParameterInfo{part.name + "=" + std::to_string(static_cast<int>(named)), value, std::min(value, 0.0),
                       std::max(value, largest(named))};
}

Scene withSurfaceParameters(Scene scene, const std::set<std::string>& parts) {
  for (Part& part : scene.parts) {
    if (!parts.contains(part.name)) continue;
    const Part before = part;
    std::vector<Shape> operands;
    if (const auto& outer = part.shape.outer) operands.assign(outer->operands.begin(), outer->operands.end());
    for (int i = 0; i < kAttributeCount; ++i)
      if (const auto info = surfaceParameter(before, static_cast<Attribute>(i))) {
        part.shape.surface[i] = Expr::parameter(*info);
        for (Shape& operand : operands) operand.surface[i] = part.shape.surface[i];
      }
    if (operands.empty()) continue;
    auto outer = std::make_shared<Union>(Union{part.shape.outer->blend, {}});
    outer->operands.append(operands);
    part.shape.outer = std::move(outer);
  }
  return scene;
}

}  // namespace sdf::viewer
