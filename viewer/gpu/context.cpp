#include "viewer/gpu/context.h"

#include <dlfcn.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "viewer/gpu/ways.h"

namespace sdf::viewer {
namespace {

const char* nameOf(Way way) {
  switch (way) {
    case Way::Surfaceless:
      return "EGL surfaceless";
    case Way::Device:
      return "EGL device";
    case Way::HiddenWindow:
      break;
  }
  return "hidden window";
}

Result<std::unique_ptr<Context>> openUnchecked(Way way) {
  switch (way) {
    case Way::Surfaceless:
      return openSurfaceless();
    case Way::Device:
      return openDevice();
    case Way::HiddenWindow:
      break;
  }
  return openHiddenWindow();
}

/// epoxy ends the program when it finds neither.
bool hasGlLibrary() {
  return ::dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL) || ::dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_LOCAL);
}

std::string text(GLenum name) {
  const auto* const bytes = reinterpret_cast<const char*>(glGetString(name));
  return bytes ? bytes : "unknown";
}

}  // namespace

Driver currentDriver() {
  GLint texture = 0;
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return {text(GL_RENDERER), text(GL_VENDOR), epoxy_gl_version(), std::min(texture, viewport[0]),
          std::min(texture, viewport[1])};
}

Result<std::unique_ptr<Context>> Context::open(Way way) {
  if (!hasGlLibrary())
    return Error{ErrorKind::Graphics, "neither libGL.so.1 nor libOpenGL.so.0 can be loaded"};
  auto context = openUnchecked(way);
  if (context) (*context)->driver_ = currentDriver();
  return context;
}

Result<std::unique_ptr<Context>> Context::headless() {
  std::array ways{Way::Surfaceless, Way::Device, Way::HiddenWindow};
  if (eglListsGpu()) std::swap(ways[0], ways[1]);
  std::string reasons;
  for (const Way way : ways) {
    auto context = open(way);
    if (context) return context;
    reasons += std::string(reasons.empty() ? "" : "; ") + nameOf(way) + ": " + context.error().message;
  }
  return Error{ErrorKind::Graphics,
               "there is no OpenGL 3.3 to draw with (" + reasons +
                   "); install a driver, e.g. on Debian: apt-get install libegl1 libgl1-mesa-dri"};
}

std::string Context::description() const {
  return driver_.renderer + ", OpenGL " + std::to_string(driver_.version / 10) + "." +
         std::to_string(driver_.version % 10) + ", " + nameOf(way_);
}

Status check(const std::string& doing) {
  const Status first = statusOf(glGetError(), doing);
  // One flag for each kind of error may be up (OpenGL 4.5, section 2.3.1).
  constexpr int kMostFlags = 8;
  for (int i = 0; i < kMostFlags && glGetError() != GL_NO_ERROR; ++i) {
  }
  return first;
}

Status statusOf(unsigned glError, const std::string& doing) {
  const std::string cannot = "cannot " + doing + ": ";
  switch (glError) {
    case GL_NO_ERROR:
      return okStatus();
    case GL_OUT_OF_MEMORY:
      return Error{ErrorKind::Limits, cannot + "the graphics memory is used up; take a smaller size"};
    case GL_CONTEXT_LOST:
      return Error{ErrorKind::Graphics, cannot + "the driver was reset and the context is lost; start again"};
    default:
      break;
  }
  constexpr std::array kNames{"GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION"};
  const unsigned index = glError - GL_INVALID_ENUM;
  const std::string name = index < kNames.size() ? kNames[index] : "error " + std::to_string(glError);
  return Error{ErrorKind::Graphics, cannot + "OpenGL reports " + name};
}

}  // namespace sdf::viewer
