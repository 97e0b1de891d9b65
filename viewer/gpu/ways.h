// The ways to a context, each in a file of its own. Private to viewer/gpu.
#pragma once
#include <memory>

#include "viewer/gpu/context.h"

namespace sdf::viewer {

/// A Version of OpenGL is what a context is asked for.
struct Version {
  int major, minor;
};
inline constexpr Version kVersions[] = {{4, 5}, {4, 3}, {3, 3}};

/// Whether one of EGL's devices is a GPU.
bool eglListsGpu();

/// Each opens a context in its way and makes it current. Errors: Graphics, with the reason only.
Result<std::unique_ptr<Context>> openSurfaceless();
Result<std::unique_ptr<Context>> openDevice();
Result<std::unique_ptr<Context>> openHiddenWindow();

}  // namespace sdf::viewer
