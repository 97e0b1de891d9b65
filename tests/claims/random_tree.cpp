#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "claims/tree.h"

namespace sdf::test {

namespace {

bool says(const Parameter& p, std::string_view word) { return p.doc.find(word) != std::string::npos; }
bool takesShapes(const Parameter& p) {
  return p.kind == ArgumentKind::Shape || p.kind == ArgumentKind::Shapes;
}
bool isOperator(const CatalogEntry& e) {
  return std::any_of(e.parameters.begin(), e.parameters.end(), takesShapes);
}

// A tree with its shape, so that a call is tried without building its operands again.
struct Grown {
  Tree tree;
  Shape shape;
};

class Grower {
 public:
  explicit Grower(unsigned seed) : random_(seed) {}

  /// A tree whose shape has this dimension.
  Grown grow(int depth, int dimension) {
    for (;;) {
      const CatalogEntry& entry = catalog()[random_() % catalog().size()];
      if (isOperator(entry) == (depth == 0)) continue;
      if (std::optional<Grown> grown = call(entry, depth, dimension)) return *std::move(grown);
    }
  }

  /// A call of this entry; nothing if the library refuses what is tried.
  std::optional<Grown> call(const CatalogEntry& entry, int depth, int dimension) {
    constexpr int kTries = 6;
    std::vector<Grown> operands;
    for (const Parameter& p : entry.parameters)
      if (takesShapes(p)) addOperands(p, depth, dimension, operands);
    for (int i = 0; i < kTries; ++i) {
      Grown grown = tried(entry, operands);
      if (grown.shape.ok() && grown.shape.dimension == dimension) return grown;
    }
    return std::nullopt;
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  bool oneIn(int n) { return random_() % n == 0; }
  int whole(int lo, int hi) { return lo + static_cast<int>(random_() % (hi - lo + 1)); }

  // Short when written.
  static double threeDigits(double v) {
    if (v == 0.0) return v;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(v))) - 2.0);
    return unit < 1.0 ? std::round(v / unit) / std::round(1.0 / unit) : std::round(v);
  }

  double number(const Parameter& p) {
    if (p.rule == Rule::Count) return whole(1, 3);
    if (says(p, "0 to 1")) return threeDigits(uniform(0.0, 1.0));
    const bool maybeZero = p.rule == Rule::Any || p.rule == Rule::NotNegative;
    if (maybeZero && oneIn(8)) return 0.0;
    const double size = threeDigits(says(p, "degrees") ? uniform(1.0, 180.0) : std::exp(uniform(-3.0, 1.0)));
    const bool maybeNegative = p.rule == Rule::Any || p.rule == Rule::NotZero;
    return maybeNegative && oneIn(2) ? -size : size;
  }

  // Corners in order of their angle about a point: a simple polygon.
  std::vector<glm::dvec2> polygon() {
    std::vector<double> angles(whole(3, 9));
    for (double& a : angles) a = uniform(-std::numbers::pi, std::numbers::pi);
    std::sort(angles.begin(), angles.end());
    std::vector<glm::dvec2> corners;
    for (const double a : angles) {
      const double r = uniform(0.2, 1.5);
      corners.emplace_back(threeDigits(r * std::cos(a)), threeDigits(r * std::sin(a)));
    }
    return corners;
  }

  Term term(const Parameter& p) {
    if (!p.required && oneIn(3)) return {};
    switch (p.kind) {
      case ArgumentKind::Number:
        return number(p);
      case ArgumentKind::Integer:
        return whole(1, 9);
      case ArgumentKind::Vector2:
        return glm::dvec3(number(p), number(p), 0.0);
      case ArgumentKind::Vector3:
        return oneIn(4) ? glm::dvec3(number(p)) : glm::dvec3(number(p), number(p), number(p));
      case ArgumentKind::Choice:
        return whole(0, static_cast<int>(p.choices.size()) - 1);
      case ArgumentKind::Points:
        return polygon();
      case ArgumentKind::Shape:
      case ArgumentKind::Shapes:
        break;
    }
    return {};
  }

  void addOperands(const Parameter& p, int depth, int dimension, std::vector<Grown>& operands) {
    const int count = p.kind == ArgumentKind::Shapes ? whole(1, 3) : 1;
    const int wanted = says(p, "flat") ? 2 : dimension;
    // One branch reaches the depth, the others end anywhere.
    for (int i = 0; i < count; ++i)
      operands.push_back(grow(operands.empty() ? depth - 1 : whole(0, std::min(depth - 1, 2)), wanted));
  }

  Grown tried(const CatalogEntry& entry, const std::vector<Grown>& operands) {
    Tree tree{&entry, {}};
    std::vector<Argument> arguments;
    std::size_t next = 0;
    for (const Parameter& p : entry.parameters) {
      if (!takesShapes(p)) {
        tree.terms.push_back(term(p));
        arguments.push_back(argument(tree.terms.back()));
        continue;
      }
      // A list takes all that is left, but one for each later shape.
      const std::size_t end = p.kind == ArgumentKind::Shape ? next + 1 : operands.size();
      std::vector<Tree> trees;
      std::vector<Shape> shapes;
      for (; next < end; ++next) {
        trees.push_back(operands[next].tree);
        shapes.push_back(operands[next].shape);
      }
      tree.terms.emplace_back(std::move(trees));
      if (p.kind == ArgumentKind::Shape)
        arguments.emplace_back(shapes.front());
      else
        arguments.emplace_back(std::move(shapes));
    }
    return {std::move(tree), build(entry, std::move(arguments))};
  }

  static Argument argument(const Term& term) {
    if (const double* number = std::get_if<double>(&term)) return Expr(*number);
    if (const int* integer = std::get_if<int>(&term)) return *integer;
    if (const auto* v = std::get_if<glm::dvec3>(&term)) return Vec3E(*v);
    if (const auto* points = std::get_if<std::vector<glm::dvec2>>(&term)) return *points;
    return std::monostate{};
  }

  std::mt19937 random_;
};

// Tries until one is accepted and small enough.
template <class Try>
Tree firstThatFits(unsigned seed, Try tryOne) {
  Grower grower(seed);
  for (;;) {
    const NodeLimit limit(kMostNodes);
    try {
      if (std::optional<Grown> grown = tryOne(grower)) return std::move(grown->tree);
    } catch (const NodeLimitReached&) {
    }
  }
}

}  // namespace

Tree randomTree(unsigned seed, int depth) {
  return firstThatFits(seed, [&](Grower& g) { return std::optional(g.grow(depth, 3)); });
}

Tree randomTree(unsigned seed, int depth, const CatalogEntry& root) {
  return firstThatFits(seed,
                       [&](Grower& g) { return g.call(root, depth, root.group == Group::Flat ? 2 : 3); });
}

}  // namespace sdf::test
