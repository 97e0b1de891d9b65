#include "opengl.h"

#include <cstdlib>

#include "sdfchart/measure/measure.h"

namespace sdf::chart {

namespace {

std::unique_ptr<viewer::Context> opened() {
  // Shaders that drivers keep on disk would say nothing of how long they take to compile.
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  ::setenv("__GL_SHADER_DISK_CACHE", "0", 1);
  return take(viewer::Context::headless());
}

}  // namespace

// Never closed: at the end of the process the driver's own threads may be gone already.
const viewer::Driver& openedDriver() {
  static viewer::Context* const context = opened().release();
  take(context->makeCurrent());
  return context->driver();
}

}  // namespace sdf::chart
