// Shapes that are written as formulas of the position.
#include <array>
#include <lua.hpp>

#include "sdf/script/library.h"
#include "sdf/shape/solids.h"

namespace sdf {

namespace {

int freeForm(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  const Expr distance = readFormula(L, 1, f.name + ": the formula");
  const FieldValues known = readFields(L, 2, f);
  const Box bounds = valueOr(known, "bounds", Box::everything());
  const double lipschitz = valueOr(known, "lipschitz", kInfinity);
  Shape shape = field(distance, bounds, lipschitz);
  if (!shape.ok()) raise(L, *shape.error);
  return pushShape(L, std::move(shape)), 1;
}

}  // namespace

// clang-format off
const std::vector<FunctionInfo>& shapeLibrary() {
  using enum SettingKind;
  static const std::vector<FunctionInfo> library{
      {"field",
       "field(function(x, y, z) return … end, {bounds = {{x0, y0, z0}, {x1, y1, z1}}, lipschitz = 2})",
       "solid where the formula is 0 or less",
       {{"bounds", SettingKind::Box, "a box that holds the solid; trusted", Rule::Any, {}, "none"},
        {"lipschitz", PlainNumber, "a bound on the formula's slope; trusted. Without one that is known or derived, the shape is slow to draw and to mesh", Rule::Positive, {}, "derived"}},
       freeForm},
  };
  return library;
}
// clang-format on

}  // namespace sdf
