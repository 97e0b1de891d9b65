#include "sdf/base/flat_map.h"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

namespace sdf {
namespace flat_map_test {

TEST(FlatMap, HoldsWhatAStandardMapHolds) {
  FlatMap<int> map;
  std::unordered_map<std::uint64_t, int> reference;
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    // Few different keys, so that many come twice; close ones, as addresses are, and 0.
    const std::uint64_t key = random() % 2 == 0 ? random() % 3000 * 48 : (random() % 3000) << 40;
    const auto [value, fresh] = map.insert(key, i);
    const auto [it, freshThere] = reference.emplace(key, i);
    ASSERT_EQ(fresh, freshThere) << key;
    ASSERT_EQ(value, it->second) << key;
  }
  EXPECT_GT(reference.size(), 4000u);
}

TEST(FlatMap, FindsAddressesAgain) {
  FlatMap<int> map;
  std::vector<double> numbers(1000);
  for (int i = 0; i < 1000; ++i) map.insert(&numbers[i], i);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(map.at(&numbers[i]), i);
}

}  // namespace flat_map_test
}  // namespace sdf
