#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "viewer/gpu/ways.h"

namespace sdf::viewer {
namespace {

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

}  // namespace

Result<std::unique_ptr<Context>> openHiddenWindow() {
  if (!glfwInit()) return glfwFailed();
  for (const Version version : kVersions)
    if (GLFWwindow* const window = createHidden(version)) {
      auto opened = std::make_unique<WindowContext>(window);
      const Status current = opened->makeCurrent();
      if (!current) return current.error();
      return std::unique_ptr<Context>(std::move(opened));
    }
  return glfwFailed();
}

}  // namespace sdf::viewer
