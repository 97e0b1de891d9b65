#include "sdf/scene/scene.h"

#include <algorithm>
#include <set>

#include "sdf/scene/patterns.h"
#include "sdf/shape/operators/booleans.h"

namespace sdf {

void Scene::add(std::string name, Shape shape) {
  for (std::size_t number = parts.size() + 1; name.empty(); ++number)
    if (std::string free = "part " + std::to_string(number);
        std::ranges::find(parts, free, &Part::name) == parts.end())
      name = std::move(free);
  parts.push_back({std::move(name), std::move(shape)});
}

Expr Scene::parameter(std::string name, double value, double min, double max) {
  parameters.push_back({std::move(name), value, min, max});
  return Expr::parameter(parameters.back());
}

Shape Scene::whole() const {
  std::vector<Shape> shapes;
  for (const Part& part : parts) shapes.push_back(part.shape);
  return unite(shapes);
}

std::vector<Light> standardLights() {
  const Light key{.vector = {-2.0, 6.0, 4.0}, .color = {1.0, 0.96, 0.9}, .intensity = 0.9};
  const Light fill{
      .vector = {6.0, 1.0, 3.0}, .color = {0.6, 0.75, 1.0}, .intensity = 0.3, .castsShadow = false};
  return {key, fill};
}

Shadow standardShadow() { return {.kind = Shadow::Kind::Soft}; }

Vec3E standardBackground() { return verticalGradient({0.16, 0.17, 0.19}, {0.01, 0.012, 0.018}); }

Result<Scene> checked(Scene scene) {
  if (scene.parts.empty()) return Error{ErrorKind::Scene, "the scene is empty; add a shape to it"};
  std::set<std::string> names;
  for (const Part& part : scene.parts) {
    const std::string subject = "part '" + part.name + "'";
    if (part.name.empty()) return Error{ErrorKind::Scene, "a part has no name; add parts with Scene::add"};
    if (!names.insert(part.name).second)
      return Error{ErrorKind::Scene, subject + " is there twice; give each part a name of its own"};
    if (!part.shape.ok()) return Error{ErrorKind::Scene, subject + ": " + *part.shape.error};
    if (part.shape.dimension != 3)
      return Error{ErrorKind::Scene, subject + " is flat; extrude or revolve it"};
  }
  std::set<std::string> parameterNames;
  for (const ParameterInfo& p : scene.parameters)
    if (!parameterNames.insert(p.name).second)
      return Error{ErrorKind::Scene,
                   "parameter '" + p.name + "' is there twice; give each a name of its own"};
  return scene;
}

}  // namespace sdf
