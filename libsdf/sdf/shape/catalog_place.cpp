#include "sdf/shape/entries.h"
#include "sdf/shape/place.h"

namespace sdf {

namespace {

Vec3E axisVector(int axis) { return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}; }

}  // namespace

std::vector<CatalogEntry> placeEntries() {
  using namespace parameter;
  const Parameter operand = shape("shape", "the shape to place");
  return {
      {"translate",
       Group::Place,
       "Moved.",
       "as the shape",
       {operand, vector3("offset", "scene units", Rule::Any)},
       [](const Arguments& a) { return translate(a.shape(0), a.vector(1)); }},
      {"rotate",
       Group::Place,
       "Turned about the x axis, then about y, then about z, by the right-hand rule; the axes stay fixed.",
       "as the shape",
       {operand, vector3("angles", "degrees about x, y and z", Rule::Any)},
       [](const Arguments& a) {
         const Vec3E& v = a.vector(1);
         return rotate(a.shape(0), {radians(v.x), radians(v.y), radians(v.z)});
       }},
      {"rotate_about",
       Group::Place,
       "Turned about an axis through the origin, by the right-hand rule.",
       "as the shape",
       {operand, vector3("axis", "direction, any length but 0", Rule::Any),
        number("angle", "degrees", Rule::Any)},
       [](const Arguments& a) { return rotateAbout(a.shape(0), a.vector(1), radians(a.number(2))); }},
      {"scale",
       Group::Place,
       "Scaled about the origin; negative factors reflect. One number scales alike along all axes.",
       "as the shape; with unequal factors bound",
       {operand, vector3("factor", "factors along x, y and z", Rule::NotZero)},
       [](const Arguments& a) { return scale(a.shape(0), a.vector(1)); }},
      {"mirror",
       Group::Place,
       "The shape and its mirror image in a plane through the origin, united.",
       "as the shape if it keeps to one side of the plane and clear of it; exact outside if exact; else "
       "bound",
       {operand, choice("axis", "the axis that is reflected", {"x", "y", "z"}),
        optional(vector3("normal", "direction that is reflected, in place of an axis", Rule::Any))},
       [](const Arguments& a) {
         return mirror(a.shape(0), a.given(2) ? a.vector(2) : axisVector(a.integer(1)));
       }},
  };
}

}  // namespace sdf
