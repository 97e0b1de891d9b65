// The machine that is measured on.
#pragma once
#include <string>

namespace sdf::bench {

/// The processor, the cores in use, the instruction set and the memory.
std::string machine();

}  // namespace sdf::bench
