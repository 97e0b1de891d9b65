// The passes of a wide union's groups. Private to viewer/shaders.
#pragma once
#include <vector>

#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// Those of the distance's groups, whose rays may go as far as it says times `inverse`; none if it is one
/// group.
std::vector<GroupShaders> groupShaders(const Expr& distance, double inverse, const ShaderOptions& options);

}  // namespace sdf::viewer
