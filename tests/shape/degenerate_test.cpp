// Every number of every catalog entry at 0, below 0, not a number, endless, huge and tiny: refused by name,
// or a shape that holds its claim.
#include <gtest/gtest.h>

#include <limits>

#include "claims/readings.h"
#include "script/run.h"

namespace sdf::test {
namespace degenerate_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegenerate[] = {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity, 1e30, -1e30, 1e-30, -1e-30};

bool says(const Parameter& p, std::string_view word) { return p.doc.find(word) != std::string::npos; }

// An ordinary argument.
Argument ordinary(const Parameter& p) {
  const Shape solid = build(*findEntry("box"), {vector(0.5, 0.3, 0.2)});
  const Shape flat = build(*findEntry("rectangle"), {vector(0.5, 0.3)});
  switch (p.kind) {
    case ArgumentKind::Shape:
      return says(p, "flat") ? flat : solid;
    case ArgumentKind::Shapes:
      return std::vector<Shape>{solid, build(*findEntry("sphere"), {number(0.4)})};
    default:
      break;
  }
  if (!p.fallback.empty()) return {};  // takes it
  switch (p.kind) {
    case ArgumentKind::Number:
      return number(0.5);
    case ArgumentKind::Integer:
      return 3;
    case ArgumentKind::Vector2:
    case ArgumentKind::Vector3:
      return vector(2.0, 1.0, 3.0);
    default:
      return {};
  }
}

std::vector<double> numbersOf(const Parameter& p) {
  std::vector<double> numbers = numbersIn(p.fallback);
  if (numbers.empty()) numbers = {2.0, 1.0, 3.0};
  numbers.resize(3);
  return numbers;
}

// The parameter's argument with one of its numbers replaced, for each of them, and with all.
std::vector<Argument> with(const Parameter& p, double bad) {
  const int components = p.kind == ArgumentKind::Vector3 ? 3 : p.kind == ArgumentKind::Vector2 ? 2 : 0;
  std::vector<Argument> all;
  if (p.kind == ArgumentKind::Number) all.push_back(number(bad));
  if (p.kind == ArgumentKind::Integer && std::abs(bad) <= 1.0) all.emplace_back(static_cast<int>(bad));
  for (int i = 0; i < components; ++i) {
    std::vector<double> v = numbersOf(p);
    v[i] = bad;
    all.push_back(vector(v[0], v[1], v[2]));
  }
  if (components > 0) all.push_back(vector(bad, bad, bad));
  if (p.kind == ArgumentKind::Points) {
    using Points = std::vector<glm::dvec2>;
    for (const auto& corner : {glm::dvec2(bad, 0.5), glm::dvec2(0.5, bad), glm::dvec2(bad)})
      all.emplace_back(Points{{0, 0}, {1, 0}, corner, {0, 1}});
  }
  return all;
}

// "points" are spoken of one by one, and as what joins them.
bool isNamedIn(const std::string& message, const Parameter& p) {
  if (p.kind != ArgumentKind::Points) return message.find(p.name) != std::string::npos;
  return message.find("point") != std::string::npos || message.find("edges") != std::string::npos;
}

void expectClaimed(const CatalogEntry& e, const Shape& s) {
  const bool iterated = e.name.starts_with("ellips") && s.claim.kind == ClaimKind::Exact;
  const Subject subject(s, 1, iterated ? 5e-7 * s.bounds.longestSide() : 0.0);
  for (const auto clauses :
       {std::span<const Clause>(kClaimClauses), std::span<const Clause>(kReadingClauses)})
    for (const Clause& c : clauses) {
      if (std::string_view(c.name) == "rounding") continue;  // holds for shapes whose numbers are of one size
      const Verdict found = c.refute(subject);
      EXPECT_FALSE(found) << c.name << ": " << *found;
    }
}

// The entry with one argument replaced: refused in one line that names the entry, or a shape that holds its
// claim. Returns the refusal.
std::string refusalOrClaim(const CatalogEntry& e, std::size_t at, const Argument& bad) {
  std::vector<Argument> arguments;
  for (const Parameter& q : e.parameters) arguments.push_back(ordinary(q));
  arguments[at] = bad;
  const Shape s = build(e, arguments);
  if (s.ok()) {
    expectClaimed(e, s);
    return {};
  }
  EXPECT_TRUE(s.error->starts_with(e.name + ": ")) << *s.error;
  EXPECT_EQ(s.error->find('\n'), std::string::npos) << *s.error;
  return *s.error;
}

TEST(Degenerate, NumbersOfEveryEntryAreRefusedByNameOrHoldTheirClaim) {
  for (const CatalogEntry& e : catalog())
    for (std::size_t i = 0; i < e.parameters.size(); ++i)
      for (const double bad : kDegenerate)
        for (const Argument& a : with(e.parameters[i], bad)) {
          SCOPED_TRACE(e.name + ", " + e.parameters[i].name + " of " + std::to_string(bad));
          const std::string refusal = refusalOrClaim(e, i, a);
          EXPECT_TRUE(refusal.empty() || isNamedIn(refusal, e.parameters[i])) << refusal;
          const bool number = std::isfinite(bad);
          EXPECT_TRUE(number || !refusal.empty()) << "only finite numbers are sizes";
        }
}

// Huge, tiny, far away, endless, and empty.
std::vector<ShapeCase> extremeOperands(bool flat) {
  const CatalogEntry& round = *findEntry(flat ? "circle" : "sphere");
  const auto sized = [&](double radius) { return build(round, {number(radius)}); };
  std::vector<ShapeCase> all{{"huge", sized(1e30)}, {"tiny", sized(1e-30)}};
  for (const double far : {1e5, 1e30})
    all.push_back(
        {"far away", build(*findEntry("translate"), {sized(0.5), vector(far, -far, flat ? 0.0 : far)})});
  const Shape away = build(*findEntry("translate"), {sized(0.5), vector(5.0, 0.0)});
  all.push_back({"empty", build(*findEntry("intersection"), {std::vector<Shape>{sized(0.5), away}})});
  if (flat) return all;
  all.push_back({"half of space", build(*findEntry("plane"), {})});
  all.push_back({"a lattice", build(*findEntry("gyroid"), {})});
  return all;
}

TEST(Degenerate, OperandsOfEveryOperatorAreRefusedOrItHoldsItsClaim) {
  for (const CatalogEntry& e : catalog())
    for (std::size_t i = 0; i < e.parameters.size(); ++i) {
      const Parameter& p = e.parameters[i];
      if (p.kind != ArgumentKind::Shape && p.kind != ArgumentKind::Shapes) continue;
      for (const ShapeCase& c : extremeOperands(says(p, "flat"))) {
        SCOPED_TRACE(e.name + " of a shape that is " + c.name);
        const Shape usual = build(*findEntry("box"), {vector(0.5, 0.3, 0.2)});
        if (p.kind == ArgumentKind::Shape)
          refusalOrClaim(e, i, c.shape);
        else
          for (const auto& list :
               {std::vector{c.shape}, std::vector{c.shape, usual}, std::vector{usual, c.shape}})
            refusalOrClaim(e, i, list);
      }
    }
}

TEST(Degenerate, ListsThatAreEmptyAreRefused) {
  for (const CatalogEntry& e : catalog())
    for (std::size_t i = 0; i < e.parameters.size(); ++i) {
      SCOPED_TRACE(e.name);
      const ArgumentKind kind = e.parameters[i].kind;
      if (kind == ArgumentKind::Shapes) {
        EXPECT_NE(refusalOrClaim(e, i, std::vector<Shape>{}).find("shape"), std::string::npos);
      }
      if (kind == ArgumentKind::Points) {
        EXPECT_NE(refusalOrClaim(e, i, std::vector<glm::dvec2>{}).find("points"), std::string::npos);
      }
    }
}

TEST(Degenerate, SceneFilesAreToldTheLine) {
  const std::pair<const char*, const char*> refusals[] = {
      {"local s = sphere(1)\nreturn s:scale(0)", "scene.lua:2: scale: factor.x must be other than 0, got 0"},
      {"local s = sphere(1)\nreturn s:repeat_grid(0)",
       "scene.lua:2: repeat_grid: cell must not be 0 along every axis"},
      {"\n\nreturn cut_sphere(1, 2)",
       "scene.lua:3: cut_sphere: height must lie between -radius and radius, 1, got 2"},
      {"return extrude(polygon({0, 0}, {1, 1}, {1, 0}, {0, 1}), 1)",
       "scene.lua:1: polygon: edges 1 and 3 touch or cross"},
      {"return sphere(1):bend(1e30)",
       "scene.lua:1: bend: the shape would fold: it reaches the circle's centre, 5.72958e-29 from the x "
       "axis; use "
       "a rate nearer to 0 or make it thinner"},
  };
  for (const auto& [text, message] : refusals) EXPECT_EQ(errorOf(text), message);
}

}  // namespace degenerate_test
}  // namespace sdf::test
