// The passes of a wide union's groups. Private to viewer/shaders.
#pragma once
#include <span>
#include <vector>

#include "viewer/shaders/assemble.h"
#include "viewer/shaders/groups.h"

namespace sdf::viewer {

/// Those of the operands' groups, within these bounds, whose rays may go as far as these say times `inverse`;
/// none if it is one group, or some have more numbers than a driver need take. They tell the winners'
/// numbers, below `operandsInAll`, if asked.
std::vector<GroupShaders> groupShaders(std::span<const Numbered> operands, double operandsInAll, bool winners,
                                       double inverse, const Box& bounds, const ShaderOptions& options);

}  // namespace sdf::viewer
