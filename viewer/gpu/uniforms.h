// Which uniforms a shader asks for.
#pragma once
#include <set>
#include <string>
#include <string_view>

namespace sdf::viewer {

/// The names of the uniforms that a shader's source declares, arrays without their brackets. A declaration
/// begins its line; what comments say does not count.
std::set<std::string> declaredUniforms(std::string_view source);

}  // namespace sdf::viewer
