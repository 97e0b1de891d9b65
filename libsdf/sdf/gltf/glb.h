// The container of binary glTF.
#pragma once
#include <ostream>
#include <string_view>
#include <vector>

namespace sdf {

/// Writes a .glb of a JSON chunk and, unless there is no data, a BIN chunk (Khronos, glTF 2.0 Specification,
/// 2021, section 4.4). Precondition: both together stay below 4 GiB.
void writeGlb(std::ostream& out, std::string_view json, const std::vector<unsigned char>& data);

}  // namespace sdf
