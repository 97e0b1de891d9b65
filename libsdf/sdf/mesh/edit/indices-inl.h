// Collecting from long lists in parallel, in their order.
#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sdf {

/// Numbers that one task takes; fixed, so that nothing depends on the number of threads.
inline constexpr std::size_t kIndexChunk = 8192;

/// What visit(i, out) appends to `out` for each number i below `count`, in their order; chunks in parallel.
template <class T, class Visit>
std::vector<T> collected(std::size_t count, const Visit& visit) {
  std::vector<std::vector<T>> pieces((count + kIndexChunk - 1) / kIndexChunk);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(count, (piece + 1) * kIndexChunk);
    for (std::size_t i = piece * kIndexChunk; i < end; ++i)
      visit(static_cast<std::uint32_t>(i), pieces[piece]);
  });
  std::vector<T> all;
  for (const std::vector<T>& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

/// The numbers below `count` for which a condition holds, in their order.
template <class Condition>
std::vector<std::uint32_t> indicesThat(std::size_t count, const Condition& holds) {
  return collected<std::uint32_t>(count, [&](std::uint32_t i, std::vector<std::uint32_t>& out) {
    if (holds(i)) out.push_back(i);
  });
}

}  // namespace sdf
