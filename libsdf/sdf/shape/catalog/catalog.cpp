#include "sdf/shape/catalog.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "sdf/shape/catalog/entries.h"
#include "sdf/shape/check.h"

namespace sdf {

namespace {

// The numbers in a default such as "1" or "{{0, 0}, {1, 0}}", in order.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (const char* at = text.c_str(); *at;) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end != at) numbers.push_back(value);
    at = std::max<const char*>(end, at + 1);
  }
  return numbers;
}

Argument fallbackOf(const Parameter& p) {
  std::vector<double> numbers = numbersIn(p.fallback);
  std::vector<glm::dvec2> points;
  switch (p.kind) {
    case ArgumentKind::Number:
      return Expr(numbers.at(0));
    case ArgumentKind::Integer:
      return static_cast<int>(numbers.at(0));
    case ArgumentKind::Vector2:
    case ArgumentKind::Vector3:
      numbers.resize(3);
      return Vec3E(numbers[0], numbers[1], numbers[2]);
    case ArgumentKind::Choice:
      return static_cast<int>(std::ranges::find(p.choices, p.fallback) - p.choices.begin());
    case ArgumentKind::Points:
      for (std::size_t i = 0; i < numbers.size(); i += 2) points.emplace_back(numbers[i], numbers[i + 1]);
      return points;
    case ArgumentKind::Shape:
    case ArgumentKind::Shapes:
      break;
  }
  return std::monostate{};
}

// What messages call a kind, and which of an Argument's alternatives holds it.
struct KindInfo {
  const char* name;
  std::size_t index;
};

// clang-format off
const KindInfo& infoOf(ArgumentKind kind) {
  static const std::size_t whole = Argument(0).index(), vector = Argument(Vec3E()).index();
  static const KindInfo kinds[] = {
      {"a number", Argument(Expr()).index()}, {"an integer", whole},
      {"a vector of 2 numbers", vector}, {"a vector of 3 numbers", vector}, {"one of its choices", whole},
      {"a list of points", Argument(std::vector<glm::dvec2>()).index()},
      {"a shape", Argument(Shape()).index()}, {"a list of shapes", Argument(std::vector<Shape>()).index()}};
  return kinds[static_cast<int>(kind)];
}
// clang-format on

const Shape* firstFailed(const Argument& a) {
  if (const auto* shape = std::get_if<Shape>(&a)) return shape->ok() ? nullptr : shape;
  if (const auto* shapes = std::get_if<std::vector<Shape>>(&a))
    for (const Shape& s : *shapes)
      if (!s.ok()) return &s;
  return nullptr;
}

void checkArgument(const Parameter& p, const Argument& a, Check& c) {
  if (a.index() == 0) {
    c.that(!p.required, p.name + " is missing; it is " + infoOf(p.kind).name);
    return;
  }
  c.that(a.index() == infoOf(p.kind).index, p.name + " must be " + infoOf(p.kind).name);
  if (!c.ok()) return;
  switch (p.kind) {
    case ArgumentKind::Number:
      c.number(p.name, std::get<Expr>(a), p.rule);
      break;
    case ArgumentKind::Integer:
      c.number(p.name, Expr(std::get<int>(a)), p.rule);
      break;
    case ArgumentKind::Vector2:
    case ArgumentKind::Vector3:
      c.vector(p.name, std::get<Vec3E>(a), p.rule, p.kind == ArgumentKind::Vector2 ? 2 : 3);
      break;
    case ArgumentKind::Choice: {
      const int i = std::get<int>(a);
      c.that(i >= 0 && i < static_cast<int>(p.choices.size()),
             p.name + " must be one of " + shown(p.choices));
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
    const std::pair<Group, std::vector<CatalogEntry>> groups[] = {
        {Group::Solid, solidEntries()},   {Group::Flat, flatEntries()},   {Group::Boolean, booleanEntries()},
        {Group::Deform, deformEntries()}, {Group::Place, placeEntries()}, {Group::Pattern, patternEntries()}};
    std::vector<CatalogEntry> all;
    for (const auto& [group, some] : groups)
      for (const CatalogEntry& e : some) all.emplace_back(e).group = group;
    return all;
  }();
  return entries;
}

const CatalogEntry* findEntry(std::string_view name) {
  const auto& all = catalog();
  const auto it = std::ranges::find(all, name, &CatalogEntry::name);
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
  return entry.build(arguments);
}

}  // namespace sdf
