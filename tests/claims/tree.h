// Scenes as trees of catalog entries: made at random, written as scene text, built, and shrunk.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sdf/shape/catalog.h"

namespace sdf::test {

struct Tree;
/// An argument: absent, a number, a whole number (also a choice or a flag), a vector, points, or shapes.
using Term =
    std::variant<std::monostate, double, int, glm::dvec3, std::vector<glm::dvec2>, std::vector<Tree>>;

/// One call of a catalog entry, a term for each of its parameters.
struct Tree {
  const CatalogEntry* entry;
  std::vector<Term> terms;
};

/// How a call is built; the library's own build unless a test plants an error.
using Builder = std::function<Shape(const CatalogEntry&, std::vector<Argument>)>;

/// The shape that the tree describes.
Shape shapeOf(const Tree& tree, const Builder& builder = build);
/// The same as scene text: "sphere(0.5):twist(2)".
std::string textOf(const Tree& tree);
/// Calls in the tree.
int sizeOf(const Tree& tree);
/// Calls `visit` with every call's entry.
void forEachEntry(const Tree& tree, const std::function<void(const CatalogEntry&)>& visit);
/// How far the distance may be off for iterated entries, which say "exact to" a share of their largest
/// radius.
double exactnessOf(const Tree& tree);

/// A tree of at most this depth whose shape the library accepts, with at most kMostNodes nodes in its graph.
/// Arguments come from the catalog's descriptions: kind, rule and unit.
Tree randomTree(unsigned seed, int depth);
/// A tree with this entry at its root.
Tree randomTree(unsigned seed, int depth, const CatalogEntry& root);
inline constexpr int kMostNodes = 4000;

/// The smallest tree for which `fails` still holds that can be reached by putting a call's operand or a plain
/// primitive in its place, leaving out operands and optional arguments, and simplifying numbers, one at a
/// time.
Tree shrunk(Tree tree, const std::function<bool(const Tree&)>& fails);

/// Is the point in the solid, by what the operators mean for sets of points? A call that has no such meaning
/// (a smooth blend, an offset) stands for itself, with its own distance's sign. Nothing where a sign is too
/// near to its change to be told from rounding.
using Membership = std::function<std::optional<bool>(const glm::dvec3&)>;
Membership membershipOf(const Tree& tree);

}  // namespace sdf::test
