// The ways to a context, each in a file of its own. Private to viewer/gpu.
#pragma once
#include <memory>

#include "viewer/gpu/context.h"

namespace sdf::viewer {

/// A version of OpenGL to ask for.
struct Version {
  int major, minor;
};
inline constexpr Version kVersions[] = {{4, 5}, {4, 3}, {3, 3}};

/// Is one of EGL's devices a GPU?
bool eglListsGpu();

// Each makes the context current. Errors: Graphics, with the reason only.
Result<std::unique_ptr<Context>> openSurfaceless();
Result<std::unique_ptr<Context>> openDevice();
Result<std::unique_ptr<Context>> openHiddenWindow();

}  // namespace sdf::viewer
