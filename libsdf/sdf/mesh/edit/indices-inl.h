// Picking elements of long lists in parallel, in their order.
#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sdf {

/// The numbers below `count` for which a condition holds, in their order.
template <class Condition>
std::vector<std::uint32_t> indicesThat(std::size_t count, const Condition& holds) {
  constexpr std::size_t kChunk = 8192;
  std::vector<std::vector<std::uint32_t>> pieces((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(count, (piece + 1) * kChunk);
    for (std::size_t i = piece * kChunk; i < end; ++i)
      if (const auto index = static_cast<std::uint32_t>(i); holds(index)) pieces[piece].push_back(index);
  });
  std::vector<std::uint32_t> all;
  for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

}  // namespace sdf
