#include "sdf/shape/operators/place.h"
#include "sdf/shape/catalog/entries.h"

namespace sdf {

std::vector<CatalogEntry> placeEntries() {
  using namespace parameter;
  const Parameter operand = shape("shape", "the shape to place");
  return {
      entry("translate", "Moved.", "as the shape", {operand, vector3("offset", "scene units")}, translate),
      entry(
          "rotate",
          "Turned about the x axis, then about y, then about z, by the right-hand rule; the axes stay fixed.",
          "as the shape",
          {operand, turn("angles", "degrees about x, y and z; of a flat shape one number, about z")},
          [](const Shape& s, const Vec3E& angles) {
            return rotate(s, {radians(angles.x), radians(angles.y), radians(angles.z)});
          }),
      entry("rotate_about", "Turned about an axis through the origin, by the right-hand rule.",
            "as the shape",
            {operand, vector3("axis", "direction, any length but 0"), number("angle", "degrees")},
            [](const Shape& s, const Vec3E& axis, const Expr& angle) {
              return rotateAbout(s, axis, radians(angle));
            }),
      entry(
          "scale",
          "Scaled about the origin; negative factors reflect. One number scales alike along all axes.",
          "as the shape; with unequal factors near the true one of flat, round and rounded shapes, of other "
          "curved ones off by up to the root of their ratio",
          {operand, vector3("factor", "factors along x, y and z", Rule::NotZero)},
          [](const Shape& s, const Vec3E& factors) { return scale(s, factors); }),
      entry("mirror", "The shape and its mirror image in a plane through the origin, united.",
            "as the shape if it keeps to one side of the plane and clear of it; exact outside if exact; else "
            "bound",
            {operand, choice("axis", "the axis that is reflected", {"x", "y", "z"}),
             optional(vector3("normal", "direction that is reflected, in place of an axis"))},
            [](const Shape& s, int axis, const std::optional<Vec3E>& normal) {
              glm::dvec3 along(0.0);
              along[axis] = 1.0;
              return mirror(s, normal.value_or(along));
            }),
  };
}

}  // namespace sdf
