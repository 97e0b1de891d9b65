// Sets of numbers that can be joined (union-find).
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sdf {

/// The numbers below a count, each in a set of its own until sets are joined. A set goes by its least number.
/// Cost of a call: about constant, for each halves the path that it takes (van Leeuwen, Tarjan 1984).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  void clear() { parent_.clear(); }
  /// Adds the next number, in a set of its own.
  void add() { parent_.push_back(static_cast<std::uint32_t>(parent_.size())); }
  /// The least number of the set that i is in.
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Makes the sets of a and b one. Returns whether they were two.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace sdf
