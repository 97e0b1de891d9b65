// The catalog's groups, and short ways to write their entries. Private to shape/.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sdf/shape/catalog.h"

namespace sdf {

/// One list for each group, in a file of its name, in the order of the reference page. catalog() sets the
/// group.
std::vector<CatalogEntry> solidEntries();
std::vector<CatalogEntry> flatEntries();
std::vector<CatalogEntry> booleanEntries();
std::vector<CatalogEntry> deformEntries();
std::vector<CatalogEntry> placeEntries();
std::vector<CatalogEntry> patternEntries();

/// The argument as the type that a function takes; a std::optional of it may be empty.
template <class T>
decltype(auto) argumentAs(const Argument& a) {
  if constexpr (requires(const T& t) { t.has_value(); })
    return a.index() == 0 ? T() : T(std::get<typename T::value_type>(a));
  else
    return (std::get<T>(a));
}

/// The function with its arguments taken from a list.
template <class... T>
std::function<Shape(const std::vector<Argument>&)> onList(std::function<Shape(T...)> make) {
  return [make](const std::vector<Argument>& a) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      return make(argumentAs<std::decay_t<T>>(a[i])...);
    }
    (std::index_sequence_for<T...>());
  };
}

/// An entry that calls `make` with the arguments in the order of the parameters. An argument that may be
/// absent comes as a std::optional.
template <class Make>
CatalogEntry entry(std::string name, std::string doc, std::string claim, std::vector<Parameter> parameters,
                   Make make) {
  return {std::move(name),       {},
          std::move(doc),        std::move(claim),
          std::move(parameters), onList(std::function(make))};
}

/// Parameters by kind: number("radius", "of the ball", Rule::Positive, "1"). Without a fallback the parameter
/// is required.
namespace parameter {

struct OfKind {
  ArgumentKind kind;
  Parameter operator()(std::string name, std::string doc, Rule rule = Rule::Any,
                       std::string fallback = "") const {
    const bool required = fallback.empty();
    return {std::move(name), kind, std::move(doc), rule, std::move(fallback), required, {}};
  }
};
inline constexpr OfKind number{ArgumentKind::Number};
inline constexpr OfKind integer{ArgumentKind::Integer};
inline constexpr OfKind vector2{ArgumentKind::Vector2};
inline constexpr OfKind vector3{ArgumentKind::Vector3};
inline constexpr OfKind points{ArgumentKind::Points};
inline constexpr OfKind shape{ArgumentKind::Shape};
inline constexpr OfKind shapes{ArgumentKind::Shapes};

inline Parameter size(std::string name, std::string doc, std::string fallback) {
  return number(std::move(name), std::move(doc), Rule::Positive, std::move(fallback));
}
inline Parameter halfHeight(std::string fallback) {
  return size("half_height", "from the centre to the top and to the bottom", std::move(fallback));
}
/// Angles about x, y and z.
inline Parameter turn(std::string name, std::string doc) {
  Parameter p = vector3(std::move(name), std::move(doc));
  p.isTurn = true;
  return p;
}
/// The first choice is the fallback.
inline Parameter choice(std::string name, std::string doc, std::vector<std::string> choices) {
  std::string first = choices.front();
  return {std::move(name), ArgumentKind::Choice, std::move(doc), Rule::Any, std::move(first),
          false,           std::move(choices)};
}
/// The same parameter, absent (monostate) where it is not given.
inline Parameter optional(Parameter p) {
  p.required = false;
  p.fallback.clear();
  return p;
}

}  // namespace parameter

/// Scene files give angles in degrees, the C++ functions take radians.
Expr radians(const Expr& degrees);

}  // namespace sdf
