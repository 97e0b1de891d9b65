// OpenGL, as the viewer opens it.
#pragma once
#include "viewer/gpu/context.h"

namespace sdf::chart {

/// The driver of a context without a window, which is opened by the first call and current from then on.
/// Throws std::runtime_error where there is none.
const viewer::Driver& openedDriver();

}  // namespace sdf::chart
