// FNV-1a, a hash (Fowler, Noll, Vo 1991).
#pragma once
#include <cstdint>

namespace sdf {

/// The hash of nothing, and the factor, for hashes of 32 and of 64 bits.
template <class Hash>
inline constexpr Hash kFnvBegin = sizeof(Hash) == 4 ? Hash(2166136261u) : Hash(14695981039346656037u);
template <class Hash>
inline constexpr Hash kFnvFactor = sizeof(Hash) == 4 ? Hash(16777619u) : Hash(1099511628211u);

/// The hash of what came before and of one more byte, or of a word in a byte's place.
template <class Hash>
constexpr Hash fnv(Hash before, Hash next) {
  return (before ^ next) * kFnvFactor<Hash>;
}

}  // namespace sdf
