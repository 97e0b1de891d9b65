#include "sdf/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <random>

namespace sdf {
namespace disjoint_sets_test {

TEST(DisjointSets, GoByTheirLeastNumber) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.join(4, 2));
  EXPECT_TRUE(sets.join(2, 3));
  EXPECT_FALSE(sets.join(3, 4));
  for (const std::uint32_t i : {2u, 3u, 4u}) EXPECT_EQ(sets.of(i), 2u);
  EXPECT_EQ(sets.of(0), 0u);
  EXPECT_EQ(sets.of(1), 1u);
}

TEST(DisjointSets, AreWhatRelabellingMakesOfThem) {
  constexpr std::uint32_t kCount = 200;
  DisjointSets sets(kCount);
  std::vector<std::uint32_t> label(kCount);
  std::iota(label.begin(), label.end(), 0u);
  std::mt19937 random(1);
  for (int i = 0; i < 150; ++i) {
    const std::uint32_t a = random() % kCount, b = random() % kCount;
    const std::uint32_t from = std::max(label[a], label[b]), to = std::min(label[a], label[b]);
    EXPECT_EQ(sets.join(a, b), from != to);
    std::ranges::replace(label, from, to);
    for (std::uint32_t k = 0; k < kCount; ++k) ASSERT_EQ(sets.of(k), label[k]);
  }
}

TEST(DisjointSets, GrowAndStartAfresh) {
  DisjointSets sets;
  sets.add(), sets.add();
  EXPECT_TRUE(sets.join(0, 1));
  sets.clear();
  sets.add(), sets.add();
  EXPECT_EQ(sets.of(1), 1u);
}

}  // namespace disjoint_sets_test
}  // namespace sdf
