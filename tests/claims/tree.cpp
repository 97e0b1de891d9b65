#include "claims/tree.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace sdf::test {

namespace {

std::string written(double v) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), v).ptr;
  return {text.data(), end};
}

std::string written(const Parameter& p, const Term& term) {
  if (const double* number = std::get_if<double>(&term)) return written(*number);
  if (const auto* v = std::get_if<glm::dvec3>(&term)) {
    const std::string xy = "{" + written(v->x) + ", " + written(v->y);
    return xy + (p.kind == ArgumentKind::Vector3 ? ", " + written(v->z) : "") + "}";
  }
  if (const int* whole = std::get_if<int>(&term))
    return p.kind == ArgumentKind::Choice ? "\"" + p.choices[*whole] + "\"" : std::to_string(*whole);
  std::string list;
  if (const auto* points = std::get_if<std::vector<glm::dvec2>>(&term)) {
    for (const glm::dvec2& q : *points)
      list += (list.empty() ? "{" : ", {") + written(q.x) + ", " + written(q.y) + "}";
    return "{" + list + "}";
  }
  if (const auto* trees = std::get_if<std::vector<Tree>>(&term)) {
    for (const Tree& t : *trees) list += (list.empty() ? "" : ", ") + textOf(t);
    return list;
  }
  return "nil";
}

Argument argumentOf(const Parameter& p, const Term& term, const Builder& builder) {
  if (const double* number = std::get_if<double>(&term)) return Expr(*number);
  if (const int* whole = std::get_if<int>(&term)) return *whole;
  if (const auto* v = std::get_if<glm::dvec3>(&term)) return Vec3E(*v);
  if (const auto* points = std::get_if<std::vector<glm::dvec2>>(&term)) return *points;
  const auto* trees = std::get_if<std::vector<Tree>>(&term);
  if (!trees) return std::monostate{};
  std::vector<Shape> shapes;
  for (const Tree& t : *trees) shapes.push_back(shapeOf(t, builder));
  if (p.kind == ArgumentKind::Shape) return shapes.front();
  return shapes;
}

const std::vector<Tree>* operandsIn(const Term& term) { return std::get_if<std::vector<Tree>>(&term); }

double largestNumber(const Term& term) {
  if (const double* number = std::get_if<double>(&term)) return std::abs(*number);
  const auto* v = std::get_if<glm::dvec3>(&term);
  return v ? std::max({std::abs(v->x), std::abs(v->y), std::abs(v->z)}) : 0.0;
}

}  // namespace

Shape shapeOf(const Tree& tree, const Builder& builder) {
  std::vector<Argument> arguments;
  for (std::size_t i = 0; i < tree.terms.size(); ++i)
    arguments.push_back(argumentOf(tree.entry->parameters[i], tree.terms[i], builder));
  return builder(*tree.entry, std::move(arguments));
}

std::string textOf(const Tree& tree) {
  std::size_t count = tree.terms.size(), first = 0;
  while (count > 0 && tree.terms[count - 1].index() == 0) --count;
  std::string subject;
  if (count > 0 && tree.entry->parameters[0].kind == ArgumentKind::Shape) {
    subject = written(tree.entry->parameters[0], tree.terms[0]) + ":";
    first = 1;
  }
  std::string list;
  for (std::size_t i = first; i < count; ++i)
    list += (i == first ? "" : ", ") + written(tree.entry->parameters[i], tree.terms[i]);
  return subject + tree.entry->name + "(" + list + ")";
}

void forEachEntry(const Tree& tree, const std::function<void(const CatalogEntry&)>& visit) {
  visit(*tree.entry);
  for (const Term& term : tree.terms)
    if (const auto* operands = operandsIn(term))
      for (const Tree& t : *operands) forEachEntry(t, visit);
}

int sizeOf(const Tree& tree) {
  int size = 0;
  forEachEntry(tree, [&](const CatalogEntry&) { ++size; });
  return size;
}

double exactnessOf(const Tree& tree) {
  constexpr std::string_view kExactTo = "exact to ";
  double largest = 0.0, sum = 0.0;
  for (const Term& term : tree.terms) {
    largest = std::max(largest, largestNumber(term));
    if (const auto* operands = operandsIn(term))
      for (const Tree& t : *operands) sum += exactnessOf(t);
  }
  if (tree.entry->claim.starts_with(kExactTo)) {
    const double share = std::stod(tree.entry->claim.substr(kExactTo.size()));
    return share * std::max(largest, 1.0);  // 1: the defaults' largest radius
  }
  // Only scaling enlarges distances, and errors with them.
  return tree.entry->name == "scale" ? sum * std::max(1.0, largest) : sum;
}

}  // namespace sdf::test
