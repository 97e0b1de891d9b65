// Pictures, costs and shaders without a window.
#pragma once
#include "viewer/options.h"

namespace sdf::viewer {

/// Does what --render, --bench and --glsl ask for; costs go to `out` as JSON. Errors: all kinds.
Status runHeadless(const Options& options, std::ostream& out);

}  // namespace sdf::viewer
