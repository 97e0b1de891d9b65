#include "sdf/shape/shape.h"

#include <cassert>

#include "sdf/shape/operand.h"

namespace sdf {

MaterialPtr makeMaterial(Material material) { return std::make_shared<const Material>(std::move(material)); }

const MaterialPtr& defaultMaterial() {
  static const MaterialPtr grey = [] {
    Material m;
    m.name = "default";
    return std::make_shared<const Material>(std::move(m));
  }();
  return grey;
}

Attributes attributesOf(const Material& material) {
  Attributes a;
  const auto set = [&a](Attribute which, const Expr& e) { a[static_cast<int>(which)] = e; };
  const auto setColour = [&](Attribute first, const Vec3E& c) {
    const int i = static_cast<int>(first);
    a[i] = c.x, a[i + 1] = c.y, a[i + 2] = c.z;
  };
  setColour(Attribute::Red, material.color);
  setColour(Attribute::AmbientRed, material.ambient.value_or(material.color));
  setColour(Attribute::SpecularRed, material.specular);
  setColour(Attribute::EmissionRed, material.emission);
  set(Attribute::Shininess, material.shininess);
  set(Attribute::Reflectivity, material.reflectivity);
  set(Attribute::FresnelPower, material.fresnelPower);
  set(Attribute::FresnelBias, material.fresnelBias);
  set(Attribute::MaterialId, 0.0);
  return a;
}

Shape Shape::failed(std::string message) {
  Shape s;
  s.distance = 1.0;
  s.bounds = Box{};
  s.error = std::move(message);
  return s;
}

Shape Shape::paint(const MaterialPtr& material) const {
  assert(material);
  Shape painted = *this;
  painted.surface = attributesOf(*material);
  painted.materials = {material};
  painted.outer = mappedUnion(*this, [&](const Shape& operand) { return operand.paint(material); });
  return painted;
}

}  // namespace sdf
