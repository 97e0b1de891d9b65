// The viewer's window.
#pragma once
#include <functional>
#include <memory>

#include "viewer/app/canvas.h"
#include "viewer/app/gui.h"
#include "viewer/app/input.h"
#include "viewer/gpu/context.h"

struct GLFWwindow;

namespace sdf::viewer {

/// WindowOptions are what a window begins with.
struct WindowOptions {
  SceneFile scene;
  Controls controls;
  int width = 1280, height = 720;
  bool fit = false;  ///< begins with all of the scene in view
  /// Asked after each turn: whether the window's context is lost.
  std::function<bool()> isLost = contextIsLost;
};

/// Shows the scene until the window is closed; where the driver is reset meanwhile, in another window from
/// then on. It must be called on the main thread. Errors: Graphics where no window can be opened, or the
/// driver is reset soon again; those of Session::open; and what goes wrong while it draws.
Status runWindow(const WindowOptions& options);

/// A Window is what runWindow runs: one turn after the other.
class Window {
 public:
  /// Opens the window. Errors: as runWindow.
  static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
  ~Window();

  /// Opens a window in the place of one whose context is lost: what the user has changed stays, the scene is
  /// loaded and compiled again. Errors: as runWindow.
  static Result<std::unique_ptr<Window>> reopen(std::unique_ptr<Window> lost);

  /// Waits until something happens or a little longer, and shows what came of it. Returns false once the
  /// window is to close.
  Result<bool> turn();

  Session& session() { return session_; }
  const Canvas& canvas() const { return canvas_; }
  const Gui& gui() const { return gui_; }
  GLFWwindow* handle() const { return window_.get(); }

 private:
  using Handle = std::unique_ptr<GLFWwindow, void (*)(GLFWwindow*)>;
  Window(Handle window, Session session, WindowOptions options);
  void listen();
  static Window& told(GLFWwindow* window);  // of an event, which the panels may answer
  void wait() const;
  Status show();
  void answer(const Requests& requests);

  Handle window_;  // first: its context must outlive what follows
  WindowOptions options_;
  Session session_;
  Canvas canvas_;
  Gui gui_;
  Input input_;
  Requests requests_;
  double lastTurn_ = 0.0, lastLook_ = 0.0;  // at the clock, at the file
  int repaints_ = 0;                        // still due to the panels
  bool refining_ = false;                   // the picture was refined at the last turn, and is to be further
};

}  // namespace sdf::viewer
