#include "sdf/base/parallel.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace sdf::test {
namespace parallel_test {

TEST(InParallel, DoesEachOnceInAnyNumberOfThreads) {
  for (const std::size_t threads : {0, 1, 2, 7}) {
    std::vector<int> times(100, 0);
    inParallel(
        times.size(), [&](std::size_t i) { ++times[i]; }, threads);
    EXPECT_EQ(times, std::vector<int>(100, 1)) << threads;
  }
  inParallel(0, [](std::size_t) { ADD_FAILURE(); });
}

TEST(InParallel, DoesThemInTheirOrderInOneThread) {
  std::vector<std::size_t> seen, order(50);
  std::iota(order.begin(), order.end(), std::size_t{0});
  inParallel(
      order.size(), [&](std::size_t i) { seen.push_back(i); }, 1);
  EXPECT_EQ(seen, order);
}

TEST(InParallel, ThrowsWhatItsWorkThrows) {
  for (const std::size_t threads : {1, 4})
    for (const std::size_t bad : {std::size_t{0}, std::size_t{99}}) {
      const auto work = [&](std::size_t i) {
        if (i == bad) throw std::runtime_error("bad");
      };
      EXPECT_THROW(inParallel(100, work, threads), std::runtime_error);
    }
}

}  // namespace parallel_test
}  // namespace sdf::test
