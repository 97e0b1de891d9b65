// The passes of a wide union's groups. Private to viewer/shaders.
#pragma once
#include <span>
#include <vector>

#include "viewer/shaders/assemble.h"
#include "viewer/shaders/groups.h"

namespace sdf::viewer {

/// Those of the operands' groups, whose rays may go as far as these say times `inverse`; none if it is one
/// group. They tell the winners' numbers if asked.
std::vector<GroupShaders> groupShaders(std::span<const Numbered> operands, bool winners, double inverse,
                                       const ShaderOptions& options);

}  // namespace sdf::viewer
