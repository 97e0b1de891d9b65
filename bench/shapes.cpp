#include "shapes.h"

#include <cmath>
#include <numbers>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::bench {
namespace {

Shape drilledBox() {
  const double quarter = std::numbers::pi / 2;
  const Shape bore = infiniteCylinder(0.5);
  const Shape body = intersect(box(Vec3E(Expr(1.0))), sphere(1.3));
  return subtract(
      {body, bore, rotate(bore, Vec3E(quarter, 0.0, 0.0)), rotate(bore, Vec3E(0.0, 0.0, quarter))});
}

Shape blendedBalls() {
  std::vector<Shape> all;
  for (int i = 0; i < 20; ++i)
    all.push_back(
        translate(sphere(0.35 + 0.1 * std::sin(i)),
                  Vec3E(1.2 * std::sin(1.3 * i), 1.2 * std::sin(2.1 * i + 1), 1.2 * std::sin(3.7 * i + 2))));
  return unite(all, Blend::quadratic(0.2));
}

Shape gyroidSheet() {
  const auto [x, y, z] = position() * Expr(5.0);
  const Expr g = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
  return field(max(abs(g) / 8.0 - 0.05, sphere(1.5).distance), Box::centred(glm::dvec3(1.5)));
}

Shape thinParts() {
  const Shape ring = rotate(torus(1.2, 0.05), Vec3E(std::numbers::pi / 2, 0.0, 0.0));
  return unite(ring, box(Vec3E(1.5, 1.5, 0.01)));
}

}  // namespace

Shape balls(int count, double radius) {
  std::vector<Shape> all;
  for (int i = 0; i < count; ++i)
    all.push_back(translate(sphere(radius), Vec3E(1.7 * std::sin(12.9898 * i), 1.7 * std::sin(78.233 * i),
                                                  1.7 * std::sin(37.719 * i))));
  return unite(all);
}

Shape measuringShape(int i) {
  switch (i) {
    case 0:
      return sphere(1.0);
    case 1:
      return drilledBox();
    case 2:
      return blendedBalls();
    case 3:
      return gyroidSheet();
    case 4:
      return balls(1000, 0.06);
    case 5:
      return thinParts();
    default:
      return translate(thinParts(), Vec3E(0.0137, 0.0213, 0.0311));
  }
}

std::string shapeName(int i) { return "S" + std::to_string(i + 1); }

}  // namespace sdf::bench
