#include "viewer/gpu/context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <vector>

namespace sdf::viewer {
namespace {

/// A Version of OpenGL is what a context is asked for.
struct Version {
  int major, minor;
};
constexpr Version kVersions[] = {{4, 5}, {4, 3}, {3, 3}};

using Opened = Result<std::unique_ptr<Context>>;

Opened madeCurrent(std::unique_ptr<Context> context) {
  if (const Status current = context->makeCurrent(); !current) return current.error();
  return context;
}

Error because(std::string reason) { return {ErrorKind::Graphics, std::move(reason)}; }

Error eglFailed(const char* function) {
  const EGLint code = eglGetError();
  std::string what = " fails with EGL error " + std::to_string(code);
  if (code == EGL_NOT_INITIALIZED) what = " finds no driver";
  if (code == EGL_BAD_MATCH) what = " has no such version";
  return because(function + what);
}

/// Displays are shared by the whole process, so that none is ever terminated: another context may be on it.
class EglContext : public Context {
 public:
  EglContext(Way way, EGLDisplay display, EGLContext context)
      : Context(way), display_(display), context_(context) {}
  ~EglContext() override {
    if (eglGetCurrentContext() == context_)
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  Status makeCurrent() override {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      return eglFailed("eglMakeCurrent");
    return okStatus();
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

Status needClientExtension(const char* name) {
  if (!epoxy_has_egl()) return because("libEGL.so.1 cannot be loaded");
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, name)) return because(std::string("no driver has ") + name);
  return okStatus();
}

Result<EGLConfig> chooseConfig(EGLDisplay display) {
  constexpr EGLint kWanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config{};
  EGLint count = 0;
  if (!eglChooseConfig(display, kWanted, &config, 1, &count)) return eglFailed("eglChooseConfig");
  if (count == 0) return because("the driver has OpenGL ES only");
  return config;
}

EGLContext createContext(EGLDisplay display, EGLConfig config, Version version, bool robust) {
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,
      version.major,
      EGL_CONTEXT_MINOR_VERSION,
      version.minor,
      EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
      robust ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
      EGL_LOSE_CONTEXT_ON_RESET,
      EGL_NONE,
  };
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

Opened openOn(EGLDisplay display, Way way) {
  if (display == EGL_NO_DISPLAY) return eglFailed("eglGetPlatformDisplay");
  if (!eglInitialize(display, nullptr, nullptr)) return eglFailed("eglInitialize");
  for (const char* const name : {"EGL_KHR_create_context", "EGL_KHR_surfaceless_context"})
    if (!epoxy_has_egl_extension(display, name)) return because(std::string("the driver lacks ") + name);
  if (!eglBindAPI(EGL_OPENGL_API)) return because("the driver has OpenGL ES only");
  const auto config = chooseConfig(display);
  if (!config) return config.error();
  for (const Version version : kVersions)
    for (const bool robust : {true, false})
      if (const EGLContext context = createContext(display, *config, version, robust))
        return madeCurrent(std::make_unique<EglContext>(way, display, context));
  return eglFailed("eglCreateContext");
}

Result<std::vector<EGLDeviceEXT>> listDevices() {
  for (const char* const name : {"EGL_EXT_device_enumeration", "EGL_EXT_device_query"})
    if (const Status has = needClientExtension(name); !has) return has.error();
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count)) return eglFailed("eglQueryDevices");
  std::vector<EGLDeviceEXT> devices(std::size_t(count), nullptr);
  if (!eglQueryDevicesEXT(count, devices.data(), &count)) return eglFailed("eglQueryDevices");
  devices.resize(std::size_t(count));
  return devices;
}

bool isGpu(EGLDeviceEXT device) {
  const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions && !epoxy_extension_in_string(extensions, "EGL_MESA_device_software");
}

bool eglListsGpu() {
  const auto devices = listDevices();
  return devices && std::any_of(devices->begin(), devices->end(), isGpu);
}

Opened openSurfaceless() {
  if (const Status has = needClientExtension("EGL_MESA_platform_surfaceless"); !has) return has.error();
  return openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                Way::Surfaceless);
}

Opened openDevice() {
  auto devices = listDevices();
  if (!devices) return devices.error();
  if (const Status has = needClientExtension("EGL_EXT_platform_device"); !has) return has.error();
  // GPUs before what draws in software.
  std::stable_partition(devices->begin(), devices->end(), isGpu);
  std::string reason = "there is none";
  for (EGLDeviceEXT device : *devices) {
    auto context = openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr), Way::Device);
    if (context) return context;
    reason = context.error().message;
  }
  return because(reason);
}

Error glfwFailed() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return {ErrorKind::Graphics, reason ? reason : "GLFW fails without a reason"};
}

/// GLFW is never terminated: the program may have other windows.
class WindowContext : public Context {
 public:
  explicit WindowContext(GLFWwindow* window) : Context(Way::HiddenWindow), window_(window) {}
  ~WindowContext() override { glfwDestroyWindow(window_); }
  Status makeCurrent() override {
    glfwMakeContextCurrent(window_);
    if (glfwGetCurrentContext() != window_) return glfwFailed();
    return okStatus();
  }

 private:
  GLFWwindow* window_;
};

GLFWwindow* createHidden(Version version) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  return glfwCreateWindow(1, 1, "", nullptr, nullptr);
}

Opened openHiddenWindow() {
  if (!glfwInit()) return glfwFailed();
  for (const Version version : kVersions)
    if (GLFWwindow* const window = createHidden(version))
      return madeCurrent(std::make_unique<WindowContext>(window));
  return glfwFailed();
}

/// Opener opens a context of a Way and makes it current. Errors say why not, and no more.
struct Opener {
  const char* name;
  Opened (*open)();
};
constexpr Opener kOpeners[] = {
    {"EGL surfaceless", openSurfaceless}, {"EGL device", openDevice}, {"hidden window", openHiddenWindow}};

const Opener& openerOf(Way way) { return kOpeners[static_cast<int>(way)]; }

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
  return {text(GL_RENDERER), epoxy_gl_version(), std::min(texture, viewport[0]),
          std::min(texture, viewport[1])};
}

Result<std::unique_ptr<Context>> Context::open(Way way) {
  if (!hasGlLibrary())
    return Error{ErrorKind::Graphics, "neither libGL.so.1 nor libOpenGL.so.0 can be loaded"};
  auto context = openerOf(way).open();
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
    reasons += std::string(reasons.empty() ? "" : "; ") + openerOf(way).name + ": " + context.error().message;
  }
  return Error{ErrorKind::Graphics,
               "there is no OpenGL 3.3 to draw with (" + reasons +
                   "); install a driver, e.g. on Debian: apt-get install libegl1 libgl1-mesa-dri"};
}

std::string Context::description() const {
  return driver_.renderer + ", OpenGL " + std::to_string(driver_.version / 10) + "." +
         std::to_string(driver_.version % 10) + ", " + openerOf(way_).name;
}

Status check(const std::string& doing) {
  const Status first = statusOf(glGetError(), doing);
  // One flag for each kind of error may be up (OpenGL 4.5, section 2.3.1).
  constexpr int kMostFlags = 8;
  for (int i = 0; i < kMostFlags && glGetError() != GL_NO_ERROR; ++i) {
  }
  return first;
}

bool contextIsLost() {
  constexpr int kTellsSince = 45;  // OpenGL 4.5
  if (epoxy_gl_version() >= kTellsSince || epoxy_has_gl_extension("GL_KHR_robustness"))
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
  if (epoxy_has_gl_extension("GL_ARB_robustness")) return glGetGraphicsResetStatusARB() != GL_NO_ERROR;
  return false;
}

bool hasDoubles() { return epoxy_has_gl_extension("GL_ARB_gpu_shader_fp64"); }

void finish() { glFinish(); }

Status statusOf(unsigned glError, const std::string& doing) {
  const std::string cannot = "cannot " + doing + ": ";
  if (glError == GL_NO_ERROR) return okStatus();
  if (glError == GL_OUT_OF_MEMORY)
    return Error{ErrorKind::Limits, cannot + "the graphics memory is used up; take a smaller size"};
  if (glError == GL_CONTEXT_LOST)
    return Error{ErrorKind::Graphics, cannot + "the driver was reset and the context is lost; start again"};
  constexpr std::array kNames{"GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION"};
  const unsigned index = glError - GL_INVALID_ENUM;
  const std::string name = index < kNames.size() ? kNames[index] : "error " + std::to_string(glError);
  return Error{ErrorKind::Graphics, cannot + "OpenGL reports " + name};
}

}  // namespace sdf::viewer
