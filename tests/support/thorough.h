// How much the long tests of the release build try; see `./bootstrap test --long`.
#pragma once

#include <cstdlib>
#include <string_view>

namespace sdf::test {

/// Whether the environment says SDF_TESTS=all: every point and variant is to be tried.
inline bool isThorough() {
  const char* asked = std::getenv("SDF_TESTS");
  return asked && std::string_view(asked) == "all";
}

}  // namespace sdf::test
