// The whole catalog and scenes composed at random, held to every clause of their claims and to what the
// readings promise.
#include <gtest/gtest.h>

#include <map>

#include "claims/readings.h"
#include "claims/tree.h"
#include "script/run.h"

namespace sdf::test {
namespace claims_test {

#ifdef SDF_SANITIZED
constexpr int kScenes = 50;
constexpr unsigned kSets = 2;  // of arguments for each entry
#else
constexpr int kScenes = 500;
constexpr unsigned kSets = 8;
#endif
constexpr int kChunks = 10, kDeepest = 6;

/// A clause's name, and what refutes it.
using Refutation = std::pair<std::string, std::string>;

/// The first clause that is refuted.
std::optional<Refutation> refuted(const Subject& subject) {
  for (const auto clauses :
       {std::span<const Clause>(kClaimClauses), std::span<const Clause>(kReadingClauses)})
    for (const Clause& c : clauses)
      if (const Verdict found = c.refute(subject)) return std::pair(std::string(c.name), *found);
  return std::nullopt;
}

/// The distance's sign is that of the composition.
Verdict hasTheSolidOf(const Tree& tree, const Subject& s) {
  const Membership inside = membershipOf(tree);
  for (const glm::dvec3& p : s.points()) {
    const Interval f = s.at(p);
    const double slack = s.exactness() + placeRounding(p);
    if (!(f.lo > slack || f.hi < -slack)) continue;
    const std::optional<bool> expected = inside(p);
    if (expected && *expected != (f.hi < 0.0))
      return finding("f = ", exactly(f), " at ", exactly(p), ", which is ", *expected ? "inside" : "outside");
  }
  return {};
}

std::optional<Refutation> refuted(const Tree& tree, unsigned seed, const Builder& builder = build) {
  const Shape shape = shapeOf(tree, builder);
  if (!shape.ok()) return std::nullopt;  // while shrinking: not a scene
  const Subject subject(shape, seed, exactnessOf(tree));
  if (const Verdict found = hasTheSolidOf(tree, subject)) return std::pair(std::string("solid"), *found);
  return refuted(subject);
}

/// What is wrong with the smallest tree that fails as this one does.
std::string report(const Tree& tree, unsigned seed, const Refutation& found, const Builder& builder = build) {
  std::string what = found.second;
  const Tree smallest = shrunk(tree, [&](const Tree& t) {
    const std::optional<Refutation> again = refuted(t, seed, builder);
    if (!again || again->first != found.first) return false;
    what = again->second;
    return true;
  });
  return "seed " + std::to_string(seed) + ", clause '" + found.first + "': " + what + "\nof     return " +
         textOf(smallest) + "\nfirst in return " + textOf(tree);
}

TEST(Shrinking, FindsTheSmallestSceneThatShowsAPlantedError) {
  // A round that leaves the bounds as they were.
  const Builder planted = [](const CatalogEntry& e, std::vector<Argument> arguments) {
    const std::optional<Box> bounds =
        e.name == "round" ? std::optional(std::get<Shape>(arguments[0]).bounds) : std::nullopt;
    Shape s = build(e, std::move(arguments));
    if (bounds && s.ok()) s.bounds = *bounds;
    return s;
  };
  int found = 0;
  for (unsigned seed = 1; found < 3; ++seed) {
    const Tree tree = randomTree(seed, 4, *findEntry("union"));
    const auto wrong = refuted(tree, seed, planted);
    if (!wrong || wrong->first != "bounds" || refuted(tree, seed)) continue;
    ++found;
    const std::string text = report(tree, seed, *wrong, planted);
    EXPECT_NE(text.find("seed " + std::to_string(seed) + ", clause 'bounds': f = "), std::string::npos)
        << text;
    EXPECT_NE(text.find("return sphere():round(1)\n"), std::string::npos) << text;
  }
}

class EveryEntry : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Catalog, EveryEntry, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const CatalogEntry& e : catalog()) names.push_back(e.name);
                           return names;
                         }()),
                         [](const auto& info) { return info.param; });

TEST_P(EveryEntry, HoldsItsClaimForAnyArguments) {
  const CatalogEntry& entry = *findEntry(GetParam());
  for (unsigned seed = 1; seed <= kSets; ++seed) {
    const Tree tree = randomTree(seed, isPrimitive(entry) ? 0 : 1 + seed % 2, entry);
    if (const auto found = refuted(tree, seed)) ADD_FAILURE() << report(tree, seed, *found);
  }
}

class EveryCase : public testing::TestWithParam<ShapeCase> {};
INSTANTIATE_TEST_SUITE_P(Catalog, EveryCase, testing::ValuesIn(primitiveCases()), [](const auto& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST_P(EveryCase, HoldsItsClaim) {
  const Shape& shape = GetParam().shape;
  const bool iterated = GetParam().name.starts_with("ellips") && shape.claim.kind == ClaimKind::Exact;
  const double exactness = iterated ? 5e-7 * std::max({shape.bounds.max.x, shape.bounds.max.y}) : 0.0;
  const auto found = refuted(Subject(shape, 1, exactness));
  EXPECT_FALSE(found) << "clause '" << found->first << "': " << found->second;
}

class RandomScenes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Chunk, RandomScenes, testing::Range(0, kChunks));

TEST_P(RandomScenes, HoldTheirClaims) {
  for (int i = 0; i < kScenes / kChunks; ++i) {
    const unsigned seed = 1000 + GetParam() * (kScenes / kChunks) + i;
    const Tree tree = randomTree(seed, 1 + static_cast<int>(seed) % kDeepest);
    if (const auto found = refuted(tree, seed)) ADD_FAILURE() << report(tree, seed, *found);
  }
}

TEST(RandomTrees, ReadAsSceneTextThatMakesTheSameShape) {
  constexpr unsigned kTrees = 60;
  for (unsigned seed = 1; seed <= kTrees; ++seed) {
    const Tree tree = randomTree(seed, static_cast<int>(seed) % 4);
    const Scene scene = sceneOf("return " + textOf(tree));
    ASSERT_EQ(scene.parts.size(), 1u);
    EXPECT_EQ(scene.parts[0].shape.distance, shapeOf(tree).distance) << textOf(tree);
  }
}

TEST(RandomTrees, UseEveryEntryAndMostlyClaimSomething) {
  constexpr int kTrees = 500;
  std::map<std::string, int> uses;
  int claiming = 0;
  for (int i = 0; i < kTrees; ++i) {
    const Tree tree = randomTree(1000 + i, 1 + (1000 + i) % kDeepest);
    forEachEntry(tree, [&](const CatalogEntry& e) { ++uses[e.name]; });
    claiming += shapeOf(tree).claim.lipschitz < kInfinity;
  }
  EXPECT_GT(claiming, kTrees * 3 / 4) << "a field without a constant claims little that could be refuted";
  for (const CatalogEntry& e : catalog()) EXPECT_GT(uses[e.name], 0) << e.name;
}

}  // namespace claims_test
}  // namespace sdf::test
