#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "viewer/gpu/ways.h"

namespace sdf::viewer {
namespace {

Error because(std::string reason) { return {ErrorKind::Graphics, std::move(reason)}; }

Error eglFailed(const char* function) {
  switch (const EGLint code = eglGetError()) {
    case EGL_NOT_INITIALIZED:
      return because(std::string(function) + " finds no driver");
    case EGL_BAD_MATCH:
      return because(std::string(function) + " has no such version");
    default:
      return because(std::string(function) + " fails with EGL error " + std::to_string(code));
  }
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

Result<std::unique_ptr<Context>> openOn(EGLDisplay display, Way way) {
  if (display == EGL_NO_DISPLAY) return eglFailed("eglGetPlatformDisplay");
  if (!eglInitialize(display, nullptr, nullptr)) return eglFailed("eglInitialize");
  for (const char* const name : {"EGL_KHR_create_context", "EGL_KHR_surfaceless_context"})
    if (!epoxy_has_egl_extension(display, name)) return because(std::string("the driver lacks ") + name);
  if (!eglBindAPI(EGL_OPENGL_API)) return because("the driver has OpenGL ES only");
  const auto config = chooseConfig(display);
  if (!config) return config.error();
  for (const Version version : kVersions)
    for (const bool robust : {true, false})
      if (const EGLContext context = createContext(display, *config, version, robust)) {
        auto opened = std::make_unique<EglContext>(way, display, context);
        const Status current = opened->makeCurrent();
        if (!current) return current.error();
        return std::unique_ptr<Context>(std::move(opened));
      }
  return eglFailed("eglCreateContext");
}

Result<std::vector<EGLDeviceEXT>> listDevices() {
  for (const char* const name : {"EGL_EXT_device_enumeration", "EGL_EXT_device_query"}) {
    const Status has = needClientExtension(name);
    if (!has) return has.error();
  }
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

}  // namespace

bool eglListsGpu() {
  const auto devices = listDevices();
  return devices && std::any_of(devices->begin(), devices->end(), isGpu);
}

Result<std::unique_ptr<Context>> openSurfaceless() {
  const Status has = needClientExtension("EGL_MESA_platform_surfaceless");
  if (!has) return has.error();
  return openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                Way::Surfaceless);
}

Result<std::unique_ptr<Context>> openDevice() {
  auto devices = listDevices();
  if (!devices) return devices.error();
  const Status has = needClientExtension("EGL_EXT_platform_device");
  if (!has) return has.error();
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

}  // namespace sdf::viewer
