// The picture in the window: drawn when something changed, coarsely while it keeps changing, and refined
// while nothing does.
#pragma once
#include <functional>
#include <optional>

#include "viewer/app/session.h"
#include "viewer/gpu/target.h"

namespace sdf::viewer {

/// FrameStatistics says what the last frame was.
struct FrameStatistics {
  int width = 0, height = 0;         ///< pixels drawn
  int samples = 1;                   ///< a side
  double seconds = 0.0;              ///< until it was finished
  int refined = 0;                   ///< samples a pixel that have been added up since the picture is still
  std::optional<double> outOfSteps;  ///< share of pixels whose ray ran out of steps; of whole pictures only
  std::optional<double> outOfShadowSteps;  ///< the same of the others' shadows
};

/// A Pace learns from the frames that were drawn what share of the window's pixels can be drawn in time.
class Pace {
 public:
  /// The seconds that a moving picture's frame may take: 20 frames a second, and a fifth to spare for the
  /// panels.
  static constexpr double kBudget = 0.04;
  /// The share of each side that the coarsest picture has.
  static constexpr double kCoarsest = 0.125;

  /// Records that a frame took this long with that many rays, counted in rays of a whole picture with one a
  /// pixel.
  void drew(double seconds, double rays);

  /// Returns the share of each side that the next frame may have: 1, or less by powers of the square root
  /// of 2.
  double scale() const;

 private:
  double wholeFrame_ = 0.0;  // seconds, by the frames so far
};

/// Pieces learn from those drawn so far how many rows of a picture are drawn at once, so that the window
/// answers what happens meanwhile.
class Pieces {
 public:
  /// The seconds that a piece may take.
  static constexpr double kBudget = 0.05;
  /// The pieces that a picture has at most. Each has a cost of its own, which fewer rows do not lessen: where
  /// that is beyond the budget, on a busy machine, a picture of single rows would take minutes.
  static constexpr int kMost = 64;

  /// Records that a piece of so many rays took this long.
  void drew(double rays, double seconds);

  /// Returns how many of a picture's rows, each of so many rays, are drawn next within these seconds: at
  /// least one in kMost.
  int rows(int rays, int height, double seconds) const;

 private:
  std::optional<double> ray_;  // seconds, by the pieces so far
};

/// A Canvas keeps the picture that the window shows, in the context that is current, which must be the same
/// for its whole life.
class Canvas {
 public:
  /// The seconds without a change after which a picture is drawn with all pixels and samples.
  static constexpr double kStill = 0.15;

  /// The seconds that an update may go on to refine.
  static constexpr double kRefining = 0.02;
  /// The seconds after which a coarse picture is drawn first, where there is none yet.
  static constexpr double kFirst = 0.5;

  /// The clock, in seconds, tells how long drawing takes.
  explicit Canvas(std::function<double()> clock = secondsNow) : clock_(std::move(clock)) {}
  static double secondsNow();

  /// Draws the settled session for a window of this size if the picture is not what it should be at this time
  /// (of any clock, seconds), or refines it if it is, for about Pieces::kBudget, and returns whether the
  /// picture is another one now. What takes longer is gone on with by the next update: a whole picture unless
  /// something has changed, a coarse one always. A window of 0 pixels, being minimised, keeps the picture
  /// that it had. Errors: Limits, Graphics.
  Result<bool> update(Session& session, int width, int height, double now);

  /// Whether a picture, or a sample of one, is part way drawn, or was begun before the last change: another
  /// update is due at once.
  bool working() const { return drawing_ || row_ > 0 || begun_ != asked_; }
  /// The share of the picture being drawn that is there, 0 to 1; none while none is.
  std::optional<double> drawnShare() const;

  /// Whether the last picture has all its pixels and samples; otherwise another update is due, kStill after
  /// the last change.
  bool whole() const { return whole_; }

  /// Whether the last picture has all samples that it gets to: nothing is due until something changes.
  bool resting() const { return !drawing_ && whole_ && statistics_.refined == samplesAtRest_; }
  /// The samples a pixel of a picture that rests: usefulSamples, or what the controls say if that is more.
  int samplesAtRest() const { return samplesAtRest_; }

  /// Copies the picture, if there is one, to the window that is current.
  void show() const;

  /// Returns the picture at rest, RGB, which is drawn now if it is not there yet. Errors: as update; Limits
  /// before the first update.
  Result<Picture> picture(Session& session);

  const FrameStatistics& statistics() const { return statistics_; }

 private:
  struct Shown {
    Controls controls;
    int compilations, meshes, width, height;  // of the window
    bool operator==(const Shown&) const = default;
  };
  /// A picture that is part way drawn.
  struct Drawing {
    Frame frame;
    double scale;
    int width, height, sample = 0, row = 0;  // of that sample
    double seconds = 0.0;
    double rays() const { return static_cast<double>(width) * height * frame.samples * frame.samples; }
    double share() const {
      return (sample + static_cast<double>(row) / height) / (frame.samples * frame.samples);
    }
  };
  void begin(const Session& session, double scale, int samples);
  void cancel();
  Status draw(Session& session, double seconds);  // a piece of what is being drawn, within these
  Status finish(const Session& session);
  Status refine(Session& session, double seconds);  // by a piece of one sample

  std::function<double()> clock_;
  std::optional<Shown> asked_, begun_;  // last; what was begun last
  std::optional<Drawing> drawing_;
  std::optional<Target> target_, next_;  // shown; being drawn
  Pace pace_;
  Pieces pieces_;
  FrameStatistics statistics_;
  double lastChange_ = 0.0;
  bool whole_ = false;
  int samplesAtRest_ = 0, row_ = 0;  // of the sample being drawn
};

}  // namespace sdf::viewer
