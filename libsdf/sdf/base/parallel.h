// Work on all cores.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace sdf {

/// Calls work(i) for each i below count, on all cores, in any order. It must not throw.
inline void inParallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i; (i = next++) < count;) work(i);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i) others.emplace_back(run);
  run();
}

}  // namespace sdf
