// Work on all cores.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace sdf {

/// Calls work(i) for each i below count, lower ones first, in so many threads at the same time, of which this
/// is one: as many as there are cores if none are said, and fewer where no more can be had. What it throws
/// is thrown once all threads have ended.
inline void inParallel(std::size_t count, const std::function<void(std::size_t)>& work,
                       std::size_t threads = std::thread::hardware_concurrency()) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i; (i = next++) < count;) work(i);
  };
  std::vector<std::future<void>> others;
  try {
    while (others.size() + 1 < std::min(threads, count))
      others.push_back(std::async(std::launch::async, run));
  } catch (const std::system_error&) {  // no memory for one
  }
  run();
  for (std::future<void>& other : others) other.get();
}

}  // namespace sdf
