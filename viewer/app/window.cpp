#include "viewer/app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <utility>

#include "viewer/gpu/context.h"
#include "viewer/gpu/picture.h"

namespace sdf::viewer {
namespace {

constexpr double kLookEvery = 0.25;     // seconds between looks at the file
constexpr double kProgressEvery = 0.1;  // seconds between looks at the mesh that is being made
constexpr double kLongestStep = 0.1;    // seconds that the clock moves at once, however long a frame took
// Dear ImGui answers an event one frame later, and shows what came of it in the next.
constexpr int kRepaints = 3;

Error cannotOpen() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return {ErrorKind::Graphics, std::string("cannot open a window: ") +
                                   (reason ? reason : "GLFW gives no reason") +
                                   "; use --render OUT.png for a picture without one"};
}

glm::ivec2 pixelsOf(GLFWwindow* window) {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window, &size.x, &size.y);
  return size;
}

void startPanels(GLFWwindow* window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is left in the user's folders
  float scale = 1.0f, ignored = 1.0f;
  glfwGetWindowContentScale(window, &scale, &ignored);
  ImGui::GetIO().FontGlobalScale = scale;
  // It calls what listened before it.
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
  if (!glfwInit()) return cannotOpen();
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  const std::string title = options.scene.path.filename().string() + " - sdfview";
  Handle window(glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr),
                glfwDestroyWindow);
  if (!window) return cannotOpen();
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  auto session = Session::open(options.scene, options.controls);
  if (!session) return session.error();
  session->aspect = static_cast<double>(options.width) / options.height;
  if (options.fit)
    if (const Status s = session->fit(); !s) return s.error();
  return std::unique_ptr<Window>(new Window(std::move(window), std::move(*session), options));
}

Result<std::unique_ptr<Window>> Window::reopen(std::unique_ptr<Window> lost) {
  WindowOptions options = lost->options_;
  options.controls = lost->session_.controls;
  options.fit = false;
  glm::ivec2 place(0);
  glfwGetWindowSize(lost->handle(), &options.width, &options.height);
  glfwGetWindowPos(lost->handle(), &place.x, &place.y);
  const bool playing = lost->session_.playing;
  Gui gui = std::move(lost->gui_);
  Input input = lost->input_;
  input.release();  // its keys go up elsewhere
  lost.reset();     // what it made goes with its context
  auto window = open(options);
  if (!window) return window.error();
  glfwSetWindowPos((*window)->handle(), place.x, place.y);
  (*window)->session_.playing = playing;
  (*window)->input_ = input;
  (*window)->gui_ = std::move(gui);
  (*window)->gui_.notice = "the driver was reset; all was drawn again";
  return window;
}

Window::Window(Handle window, Session session, WindowOptions options)
    : window_(std::move(window)),
      options_(std::move(options)),
      session_(std::move(session)),
      gui_(options_.scene.path.stem().string() + ".png", options_.scene.path.stem().string() + ".glb"),
      lastTurn_(glfwGetTime()) {
  listen();
  startPanels(handle());
}

Window::~Window() {
  glfwMakeContextCurrent(handle());
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

Window& Window::told(GLFWwindow* window) {
  Window& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
  self.repaints_ = kRepaints;
  return self;
}

void Window::listen() {
  glfwSetWindowUserPointer(handle(), this);
  glfwSetKeyCallback(handle(), [](GLFWwindow* w, int key, int, int action, int) {
    Window& self = told(w);
    // Letting go is always heard: the key may have been pressed before a panel took over.
    if (action == GLFW_RELEASE || !ImGui::GetIO().WantCaptureKeyboard)
      self.input_.key(key, action, self.session_, self.requests_);
  });
  glfwSetMouseButtonCallback(handle(), [](GLFWwindow* w, int button, int action, int modifiers) {
    Window& self = told(w);
    if (action == GLFW_RELEASE || !ImGui::GetIO().WantCaptureMouse)
      self.input_.button(button, action, modifiers);
  });
  glfwSetCursorPosCallback(handle(), [](GLFWwindow* w, double x, double y) {
    Window& self = told(w);
    int width = 0, height = 0;
    glfwGetWindowSize(w, &width, &height);
    self.input_.cursor({x, y}, std::max(height, 1), self.session_);
  });
  glfwSetScrollCallback(handle(), [](GLFWwindow* w, double, double steps) {
    Window& self = told(w);
    if (!ImGui::GetIO().WantCaptureMouse) self.input_.scroll(steps, self.session_);
  });
  glfwSetWindowFocusCallback(handle(), [](GLFWwindow* w, int focused) {
    Window& self = told(w);
    if (!focused) self.input_.release();
  });
  glfwSetCharCallback(handle(), [](GLFWwindow* w, unsigned) { told(w); });
  glfwSetWindowRefreshCallback(handle(), [](GLFWwindow* w) { told(w); });
  glfwSetFramebufferSizeCallback(handle(), [](GLFWwindow* w, int, int) { told(w); });
}

void Window::wait() const {
  const glm::ivec2 size = pixelsOf(handle());
  const bool visible = size.x > 0 && size.y > 0;
  const bool moving = session_.playing || input_.flying() || repaints_ > 0;
  if (visible && moving)
    glfwPollEvents();
  else if (visible && (refining_ || canvas_.working()))
    glfwPollEvents();
  else if (session_.meshing())
    glfwWaitEventsTimeout(kProgressEvery);
  else
    glfwWaitEventsTimeout(visible && !canvas_.resting() ? 0.5 * Canvas::kStill : kLookEvery);
}

Result<bool> Window::turn() {
  wait();
  const double now = glfwGetTime(), passed = std::min(now - lastTurn_, kLongestStep);
  lastTurn_ = now;
  if (now - lastLook_ >= kLookEvery) {
    const std::string before = session_.message();
    session_.followFile();
    if (session_.message() != before) repaints_ = kRepaints;
    lastLook_ = now;
  }
  const glm::ivec2 size = pixelsOf(handle());
  if (size.x > 0 && size.y > 0) session_.aspect = static_cast<double>(size.x) / size.y;
  session_.advance(passed);
  input_.fly(passed, session_);
  const bool wasMeshing = session_.meshing();
  session_.settle();
  if (wasMeshing || session_.meshing()) repaints_ = std::max(repaints_, 1);

  const auto drawn = canvas_.update(session_, size.x, size.y, now);
  if (!drawn) return drawn.error();
  refining_ = *drawn && canvas_.statistics().refined > 0 && !canvas_.resting();
  if (*drawn && canvas_.statistics().refined == 0) gui_.readings.reset();  // they were another picture's
  if (*drawn || repaints_ > 0 || canvas_.working()) {
    repaints_ = std::max(repaints_ - 1, 0);
    if (const Status shown = show(); !shown) return shown.error();
  }
  answer(std::exchange(requests_, {}));
  return !glfwWindowShouldClose(handle());
}

Status Window::show() {
  canvas_.show();
  // Dear ImGui puts back what was in use before it, which must not be a program that is deleted by then.
  glUseProgram(0);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  gui_.mesh.overPicture(session_);
  if (!input_.panelsHidden()) gui_.panels(session_, canvas_, requests_);
  gui_.overlay(session_);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(handle());
  return check("show the picture");
}

void Window::answer(const Requests& requests) {
  const auto tell = [&](std::string notice) {
    gui_.notice = std::move(notice);
    repaints_ = kRepaints;
  };
  if (requests.savePicture) {
    Status saved = checkPictureName(gui_.pictureName);
    if (saved) {
      const auto picture = canvas_.picture(session_);
      saved = picture ? writePng(gui_.pictureName, *picture) : Status(picture.error());
    }
    tell(saved ? "saved " + gui_.pictureName : saved.error().message);
  }
  if (requests.exportMesh) {
    const Status written = session_.exportMesh(gui_.mesh.exportName);
    tell(written ? "exported " + gui_.mesh.exportName : written.error().message);
  }
  if (requests.fit) {
    const Status fitted = session_.fit();
    tell(fitted ? "" : fitted.error().message);
  }
  if (requests.copyCamera) {
    glfwSetClipboardString(handle(), textOf(session_.eye()).c_str());
    tell("the camera is in the clipboard");
  }
  if (requests.measure) {
    const glm::ivec2 size = pixelsOf(handle());
    const auto readings = session_.measure(size.x, size.y);
    if (readings) gui_.readings = *readings;
    tell(readings ? "" : readings.error().message);
  }
  if (requests.close) glfwSetWindowShouldClose(handle(), GLFW_TRUE);
}

Status runWindow(const WindowOptions& options) {
  constexpr double kSoon = 5.0;  // seconds
  auto window = Window::open(options);
  double opened = -kSoon;  // in the place of another
  while (window) {
    const auto goesOn = (*window)->turn();
    if (goesOn && !*goesOn) return okStatus();
    if (options.isLost()) {
      if (glfwGetTime() - opened < kSoon)
        return Error{ErrorKind::Graphics,
                     "the driver was reset again and again; take a smaller --size, or a simpler scene"};
      window = Window::reopen(std::move(*window));
      opened = glfwGetTime();
    } else if (!goesOn) {
      return goesOn.error();
    }
  }
  return window.error();
}

}  // namespace sdf::viewer
