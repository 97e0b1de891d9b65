#include "sdf/shape/shape.h"

#include <cassert>

#include "sdf/shape/operand.h"

namespace sdf {

MaterialPtr makeMaterial(Material material) { return std::make_shared<const Material>(std::move(material)); }

const MaterialPtr& defaultMaterial() {
  static const MaterialPtr grey = makeMaterial({.name = "default"});
  return grey;
}

Attributes attributesOf(const Material& m) {
  const Vec3E ambient = m.ambient.value_or(m.color);
  // clang-format off
  return {m.color.x, m.color.y, m.color.z,
          ambient.x, ambient.y, ambient.z,
          m.specular.x, m.specular.y, m.specular.z,
          m.shininess,
          m.reflectivity, m.fresnelPower, m.fresnelBias,
          m.emission.x, m.emission.y, m.emission.z,
          0.0};
  // clang-format on
}

Union::Tally::Tally(std::size_t operands)
    : counted(static_cast<std::int64_t>(operands * ((sizeof(Shape) + kNodeBytes - 1) / kNodeBytes))) {}

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
