#include "sdf/shape/catalog.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/entries.h"

namespace sdf {

namespace {

// The numbers in a default such as "1" or "{{0, 0}, {1, 0}}", in order.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (const char* at = text.c_str(); *at;) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      numbers.push_back(value);
      at = end;
    }
  }
  return numbers;
}

Vec3E vectorOf(const std::vector<double>& n) {
  const auto at = [&](std::size_t i) { return n.size() > i ? n[i] : 0.0; };
  return {at(0), at(1), at(2)};
}

std::vector<glm::dvec2> pointsOf(const std::vector<double>& n) {
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i + 1 < n.size(); i += 2) points.emplace_back(n[i], n[i + 1]);
  return points;
}

Argument fallbackOf(const Parameter& p) {
  const std::vector<double> numbers = numbersIn(p.fallback);
  switch (p.kind) {
    case ArgumentKind::Number:
      return Expr(numbers.at(0));
    case ArgumentKind::Integer:
      return static_cast<int>(numbers.at(0));
    case ArgumentKind::Vector2:
    case ArgumentKind::Vector3:
      return vectorOf(numbers);
    case ArgumentKind::Choice:
      return static_cast<int>(std::find(p.choices.begin(), p.choices.end(), p.fallback) - p.choices.begin());
    case ArgumentKind::Points:
      return pointsOf(numbers);
    case ArgumentKind::Shape:
    case ArgumentKind::Shapes:
      break;
  }
  return std::monostate{};
}

const char* kindName(ArgumentKind kind) {
  switch (kind) {
    case ArgumentKind::Number:
      return "a number";
    case ArgumentKind::Integer:
      return "an integer";
    case ArgumentKind::Vector2:
      return "a vector of 2 numbers";
    case ArgumentKind::Vector3:
      return "a vector of 3 numbers";
    case ArgumentKind::Choice:
      return "one of its choices";
    case ArgumentKind::Points:
      return "a list of points";
    case ArgumentKind::Shape:
      return "a shape";
    case ArgumentKind::Shapes:
      break;
  }
  return "a list of shapes";
}

bool holdsKind(const Argument& a, ArgumentKind kind) {
  switch (kind) {
    case ArgumentKind::Number:
      return std::holds_alternative<Expr>(a);
    case ArgumentKind::Vector2:
    case ArgumentKind::Vector3:
      return std::holds_alternative<Vec3E>(a);
    case ArgumentKind::Integer:
    case ArgumentKind::Choice:
      return std::holds_alternative<int>(a);
    case ArgumentKind::Points:
      return std::holds_alternative<std::vector<glm::dvec2>>(a);
    case ArgumentKind::Shape:
      return std::holds_alternative<Shape>(a);
    case ArgumentKind::Shapes:
      break;
  }
  return std::holds_alternative<std::vector<Shape>>(a);
}

const Shape* firstFailed(const Argument& a) {
  if (const auto* shape = std::get_if<Shape>(&a)) return shape->ok() ? nullptr : shape;
  if (const auto* shapes = std::get_if<std::vector<Shape>>(&a))
    for (const Shape& s : *shapes)
      if (!s.ok()) return &s;
  return nullptr;
}

std::string choiceList(const std::vector<std::string>& choices) {
  std::string list;
  for (const std::string& c : choices) list += (list.empty() ? "" : ", ") + c;
  return list;
}

void checkArgument(const Parameter& p, const Argument& a, Check& c) {
  if (a.index() == 0) {
    c.that(!p.required, p.name + " is missing; it is " + kindName(p.kind));
    return;
  }
  c.that(holdsKind(a, p.kind), p.name + " must be " + kindName(p.kind));
  if (!c.ok()) return;
  switch (p.kind) {
    case ArgumentKind::Number:
      c.number(p.name, std::get<Expr>(a), p.rule);
      break;
    case ArgumentKind::Integer:
      c.number(p.name, Expr(std::get<int>(a)), p.rule);
      break;
    case ArgumentKind::Vector2:
      c.vector(p.name, std::get<Vec3E>(a), p.rule, 2);
      break;
    case ArgumentKind::Vector3:
      c.vector(p.name, std::get<Vec3E>(a), p.rule, 3);
      break;
    case ArgumentKind::Choice: {
      const int i = std::get<int>(a);
      c.that(i >= 0 && i < static_cast<int>(p.choices.size()),
             p.name + " must be one of " + choiceList(p.choices));
      break;
    }
    default:
      break;
  }
}

}  // namespace

Expr radians(const Expr& degrees) { return degrees * (std::numbers::pi / 180.0); }

const std::vector<CatalogEntry>& catalog() {
  static const std::vector<CatalogEntry> entries = [] {
    std::vector<CatalogEntry> all;
    for (auto group :
         {solidEntries, flatEntries, booleanEntries, deformEntries, placeEntries, patternEntries}) {
      std::vector<CatalogEntry> some = group();
      std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
  }();
  return entries;
}

const CatalogEntry* findEntry(std::string_view name) {
  const auto& all = catalog();
  const auto it = std::find_if(all.begin(), all.end(), [&](const CatalogEntry& e) { return e.name == name; });
  return it == all.end() ? nullptr : &*it;
}

Shape build(const CatalogEntry& entry, std::vector<Argument> arguments) {
  Check c(entry.name);
  c.that(arguments.size() <= entry.parameters.size(),
         "takes at most " + std::to_string(entry.parameters.size()) + " arguments, got " +
             std::to_string(arguments.size()));
  arguments.resize(entry.parameters.size());
  for (std::size_t i = 0; i < arguments.size() && c.ok(); ++i) {
    const Parameter& p = entry.parameters[i];
    if (arguments[i].index() == 0 && !p.fallback.empty()) arguments[i] = fallbackOf(p);
    if (const Shape* failed = firstFailed(arguments[i])) return *failed;
    checkArgument(p, arguments[i], c);
  }
  if (!c.ok()) return c.failure();
  return entry.build(Arguments(std::move(arguments)));
}

}  // namespace sdf
