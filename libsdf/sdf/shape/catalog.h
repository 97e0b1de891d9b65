// The one list of shapes and operators: the scene language, its reference page and the claim tests are made
// from it.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#include "sdf/shape/shape.h"

namespace sdf {

/// The kind of an argument. Numbers, integers and vectors are the same everywhere in space.
enum class ArgumentKind {
  Number,   ///< a number that may depend on parameters
  Integer,  ///< a whole number
  Vector2,  ///< {x, y}
  Vector3,  ///< {x, y, z}
  Choice,   ///< one of Parameter::choices
  Points,   ///< a list of {x, y}
  Shape,    ///< a shape
  Shapes    ///< a list of shapes
};

/// A rule for an argument's numbers. It is checked on their present values before `build` is called.
enum class Rule {
  Any,          ///< finite
  Positive,     ///< above 0
  NotNegative,  ///< 0 or more
  NotZero,      ///< other than 0
  Count         ///< a whole number from 1; does not depend on parameters
};
bool keeps(Rule rule, double value);
/// The rule in words: "positive"; "a finite number" for Any.
const char* wording(Rule rule);
/// A number as messages and the reference show it, six significant digits; and choices: `"a", "b" or "c"`.
std::string shown(double value);
std::string shown(const std::vector<std::string>& choices);

struct Parameter {
  std::string name;  ///< snake_case, as in scene files
  ArgumentKind kind = ArgumentKind::Number;
  std::string doc;  ///< unit and meaning, one line
  Rule rule = Rule::Any;
  /// The default as scene text ("1", "{1, 1, 1}", "quadratic"); "" with required == false: absent.
  std::string fallback;
  bool required = true;
  std::vector<std::string> choices;  ///< for Choice
  bool isTurn = false;               ///< angles about the axes: of a flat shape one, about z
};

/// A checked argument. monostate: optional and not given. Vector2 comes as Vec3E with z = 0, Choice as its
/// index in `choices`, Integer as int. Angles are in degrees, as in scene files.
using Argument =
    std::variant<std::monostate, Expr, Vec3E, int, std::vector<glm::dvec2>, Shape, std::vector<Shape>>;

/// The section of the reference page that an entry is in.
enum class Group {
  Solid,    ///< solids
  Flat,     ///< flat shapes
  Boolean,  ///< combining
  Deform,   ///< changing
  Place,    ///< placing
  Pattern   ///< repeating
};

struct CatalogEntry {
  /// The scene language's name. Operators on a shape, whose first parameter is a Shape or Shapes, are methods
  /// too.
  std::string name;
  Group group;
  std::string doc;    ///< what it is, its axis and its origin; one or two sentences
  std::string claim;  ///< the claim in words for the reference page, e.g. "exact", "bound, L = 1"
  std::vector<Parameter> parameters;
  /// Makes the shape of checked arguments, one for each parameter.
  std::function<Shape(const std::vector<Argument>&)> build;
};

/// Every shape and operator, in the order of the reference page.
const std::vector<CatalogEntry>& catalog();
/// nullptr where there is none of that name.
const CatalogEntry* findEntry(std::string_view name);

/// Builds after checking each argument's rule and finiteness, and that numbers do not depend on position; a
/// broken rule yields Shape::failed("sphere: radius must be positive, got -1"). Arguments that are monostate
/// or beyond the end of the list take their parameter's fallback. A failed shape among the arguments is
/// returned as it is.
Shape build(const CatalogEntry& entry, std::vector<Argument> arguments);

}  // namespace sdf
