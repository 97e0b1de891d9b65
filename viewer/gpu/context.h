// OpenGL without a window, and what went wrong in it. Everything else in viewer/ works in whichever context
// is current in its thread: one of these, or a window's.
#pragma once
#include <memory>
#include <string>

#include "sdf/base/result.h"

namespace sdf::viewer {

/// A Driver is what draws in a context, and how far it reaches.
struct Driver {
  std::string renderer;  ///< as the driver names it, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  int version = 0;       ///< of OpenGL: 45 for 4.5
  int mostWidth = 0;     ///< pixels a row of a target may have
  int mostHeight = 0;    ///< rows a target may have
};

/// Asks for the driver of the current context.
Driver currentDriver();

/// The ways in which a context without a visible window comes about.
enum class Way { Surfaceless, Device, HiddenWindow };

/// A Context is an OpenGL core context of 4.5, 4.3 or 3.3, the highest to be had, that loses itself rather
/// than hang when the GPU is reset, where the driver can. It is current in the thread that opened it.
class Context {
 public:
  /// Opens a context on EGL's surfaceless platform, else on an EGL device, else in a hidden window, which
  /// needs X and the main thread. Devices come first where one is a GPU: Mesa's surfaceless platform would
  /// draw in software beside another maker's driver. Errors: Graphics, with why each way failed and what to
  /// install.
  static Result<std::unique_ptr<Context>> headless();

  /// Opens a context in that way only. Errors: Graphics, with why not.
  static Result<std::unique_ptr<Context>> open(Way way);

  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes the context current in the calling thread. Errors: Graphics.
  virtual Status makeCurrent() = 0;

  Way way() const { return way_; }
  const Driver& driver() const { return driver_; }

  /// Says in one line what draws, the version of OpenGL and the way here.
  std::string description() const;

 protected:
  explicit Context(Way way) : way_(way) {}

 private:
  Way way_;
  Driver driver_;
};

/// Returns what OpenGL has to report since the last call, as an error: "cannot DOING: WHY". It waits for
/// nothing: a draw that is still under way reports later. Errors: Limits if memory ran out, else Graphics.
Status check(const std::string& doing);

/// Whether the current context has lost all that was in it since this was last asked: the driver was reset. A
/// driver that cannot tell never has.
bool contextIsLost();

/// Returns whether shaders of the present context can compute in double.
bool hasDoubles();

/// Waits until all is drawn that OpenGL was told to draw.
void finish();

/// Returns what check does for a value of glGetError.
Status statusOf(unsigned glError, const std::string& doing);

}  // namespace sdf::viewer
