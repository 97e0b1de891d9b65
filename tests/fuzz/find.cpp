#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

namespace sdf::fuzz {

void find(const std::string& what) {
  std::fprintf(stderr, "FIND: %s\n", what.c_str());
  std::abort();
}

}  // namespace sdf::fuzz
