// The catalog's groups, and short ways to write their parameters. Private to shape/.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "sdf/shape/catalog.h"

namespace sdf {

/// One list per file catalog_<group>.cpp, in the order of the reference page.
std::vector<CatalogEntry> solidEntries();
std::vector<CatalogEntry> flatEntries();
std::vector<CatalogEntry> booleanEntries();
std::vector<CatalogEntry> deformEntries();
std::vector<CatalogEntry> placeEntries();
std::vector<CatalogEntry> patternEntries();

/// Parameters by kind. An empty fallback makes the parameter required.
namespace parameter {

inline Parameter of(ArgumentKind kind, std::string name, std::string doc, Rule rule, std::string fallback) {
  Parameter p;
  p.name = std::move(name);
  p.kind = kind;
  p.doc = std::move(doc);
  p.rule = rule;
  p.required = fallback.empty();
  p.fallback = std::move(fallback);
  return p;
}
inline Parameter number(std::string name, std::string doc, Rule rule, std::string fallback = "") {
  return of(ArgumentKind::Number, std::move(name), std::move(doc), rule, std::move(fallback));
}
inline Parameter integer(std::string name, std::string doc, Rule rule, std::string fallback = "") {
  return of(ArgumentKind::Integer, std::move(name), std::move(doc), rule, std::move(fallback));
}
inline Parameter vector2(std::string name, std::string doc, Rule rule, std::string fallback = "") {
  return of(ArgumentKind::Vector2, std::move(name), std::move(doc), rule, std::move(fallback));
}
inline Parameter vector3(std::string name, std::string doc, Rule rule, std::string fallback = "") {
  return of(ArgumentKind::Vector3, std::move(name), std::move(doc), rule, std::move(fallback));
}
inline Parameter points(std::string name, std::string doc, std::string fallback = "") {
  return of(ArgumentKind::Points, std::move(name), std::move(doc), Rule::Any, std::move(fallback));
}
inline Parameter choice(std::string name, std::string doc, std::vector<std::string> choices) {
  std::string first = choices.front();
  Parameter p = of(ArgumentKind::Choice, std::move(name), std::move(doc), Rule::Any, std::move(first));
  p.choices = std::move(choices);
  return p;
}
inline Parameter shape(std::string name, std::string doc) {
  return of(ArgumentKind::Shape, std::move(name), std::move(doc), Rule::Any, "");
}
inline Parameter shapes(std::string name, std::string doc) {
  return of(ArgumentKind::Shapes, std::move(name), std::move(doc), Rule::Any, "");
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
