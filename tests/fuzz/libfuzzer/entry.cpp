// libFuzzer's entry; SDF_FUZZ_TARGET names the target.
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sdf::fuzz::SDF_FUZZ_TARGET({data, size});
  return 0;
}
