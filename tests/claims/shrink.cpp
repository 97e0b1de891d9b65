#include <algorithm>
#include <cmath>
#include <utility>

#include "claims/tree.h"

namespace sdf::test {

namespace {

std::vector<double> simpler(double v) {
  std::vector<double> all{0.0, 1.0, std::abs(v)};
  for (const double unit : {1.0, 10.0, 100.0}) all.push_back(std::round(v * unit) / unit);
  return all;
}

std::vector<Term> simpler(const Parameter& p, const Term& term) {
  std::vector<Term> all;
  if (!p.required) all.emplace_back(std::monostate{});
  if (const double* number = std::get_if<double>(&term))
    for (const double v : simpler(*number)) all.emplace_back(v);
  if (const int* whole = std::get_if<int>(&term))
    for (const int v : {0, 1, 2, 3, *whole / 2, *whole - 1}) all.emplace_back(v);
  if (const auto* vector = std::get_if<glm::dvec3>(&term))
    for (int axis = 0; axis < 3; ++axis)
      for (const double v : simpler((*vector)[axis])) {
        glm::dvec3 changed = *vector;
        changed[axis] = v;
        all.emplace_back(changed);
      }
  if (const auto* points = std::get_if<std::vector<glm::dvec2>>(&term))
    for (std::size_t i = 0; i < points->size(); ++i) {
      auto fewer = *points;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      all.emplace_back(std::move(fewer));
      for (int axis = 0; axis < 2; ++axis)
        for (const double v : simpler((*points)[i][axis])) {
          auto changed = *points;
          changed[i][axis] = v;
          all.emplace_back(std::move(changed));
        }
    }
  return all;
}

Tree plain(const char* name) {
  const CatalogEntry* entry = findEntry(name);
  return {entry, std::vector<Term>(entry->parameters.size())};
}

// Every tree that is one step simpler, the boldest steps first.
std::vector<Tree> stepsFrom(const Tree& tree) {
  std::vector<Tree> all{plain("sphere"), plain("circle")};
  const auto with = [&](std::size_t i, Term term) {
    Tree changed = tree;
    changed.terms[i] = std::move(term);
    all.push_back(std::move(changed));
  };
  for (std::size_t i = 0; i < tree.terms.size(); ++i) {
    const auto* operands = std::get_if<std::vector<Tree>>(&tree.terms[i]);
    if (!operands) continue;
    all.insert(all.end(), operands->begin(), operands->end());
    for (std::size_t k = 0; k < operands->size(); ++k) {
      std::vector<Tree> changed = *operands;
      if (operands->size() > 1) {
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(k));
        with(i, changed);
      }
      changed = *operands;
      for (Tree& step : stepsFrom((*operands)[k])) {
        changed[k] = std::move(step);
        with(i, changed);
      }
    }
  }
  for (std::size_t i = 0; i < tree.terms.size(); ++i)
    if (!std::holds_alternative<std::vector<Tree>>(tree.terms[i]))
      for (Term& term : simpler(tree.entry->parameters[i], tree.terms[i])) with(i, std::move(term));
  return all;
}

}  // namespace

Tree shrunk(Tree tree, const std::function<bool(const Tree&)>& fails) {
  const auto cost = [](const Tree& t) { return std::pair(sizeOf(t), textOf(t).size()); };
  for (;;) {
    std::vector<Tree> steps = stepsFrom(tree);
    // Every step taken makes the tree smaller or its text shorter, so this ends.
    const auto taken = std::find_if(steps.begin(), steps.end(),
                                    [&](const Tree& step) { return cost(step) < cost(tree) && fails(step); });
    if (taken == steps.end()) return tree;
    tree = std::move(*taken);
  }
}

}  // namespace sdf::test
