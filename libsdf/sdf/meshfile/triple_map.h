// Vertices found again by three numbers that make them equal.
#pragma once
#include <cstdint>

#include "sdf/base/flat_map.h"

namespace sdf {

/// Numbers the different triples of 32-bit words in the order in which they come.
class TripleMap {
 public:
  std::uint32_t size() const { return size_; }
  /// The triple's number: size(), as it was before, for a new one.
  std::uint32_t insert(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t pair = pairs_.insert(key(a, b), pairCount_).first;
    pairCount_ += pair == pairCount_;
    const std::uint32_t triple = triples_.insert(key(pair, c), size_).first;
    size_ += triple == size_;
    return triple;
  }

 private:
  /// One to one. The bits of simple floats are mostly 0, at the end above all, and so would be those that the
  /// table goes by (the finalizer of MurmurHash3, Appleby 2011).
  static std::uint64_t key(std::uint32_t high, std::uint32_t low) {
    std::uint64_t k = static_cast<std::uint64_t>(high) << 32 | low;
    k = (k ^ k >> 33) * 0xff51afd7ed558ccdull;
    k = (k ^ k >> 33) * 0xc4ceb9fe1a85ec53ull;
    return k ^ k >> 33;
  }

  FlatMap<std::uint32_t> pairs_, triples_;
  std::uint32_t pairCount_ = 0, size_ = 0;
};

}  // namespace sdf
