// How much the long tests of the release build try; see `./bootstrap test --long`.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace sdf::test {

/// Whether the environment says SDF_TESTS=all: every point and variant is to be tried.
inline bool isThorough() {
  const char* asked = std::getenv("SDF_TESTS");
  return asked && std::string_view(asked) == "all";
}

/// Of the points that docs/accuracy.md is written from, tests try a part in so many.
inline std::uint64_t accuracyFraction() { return isThorough() ? 1 : 16; }

}  // namespace sdf::test
