// The picture in the window: drawn when something changed, coarsely while it keeps changing, and refined
// while nothing does.
#pragma once
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

/// A Canvas keeps the picture that the window shows, in the context that is current, which must be the same
/// for its whole life.
class Canvas {
 public:
  /// The seconds without a change after which a picture is drawn with all pixels and samples.
  static constexpr double kStill = 0.15;

  /// The seconds that an update may go on to refine.
  static constexpr double kRefining = 0.02;

  /// Draws the settled session for a window of this size if the picture is not what it should be at this time
  /// (of any clock, seconds), or refines it if it is, and returns whether the picture is another one now. A
  /// window of 0 pixels, being minimised, keeps the picture that it had. Errors: Limits, Graphics.
  Result<bool> update(Session& session, int width, int height, double now);

  /// Whether the last picture has all its pixels and samples; otherwise another update is due, kStill after
  /// the last change.
  bool whole() const { return whole_; }

  /// Whether the last picture has all samples that it gets to: nothing is due until something changes.
  bool resting() const { return whole_ && statistics_.refined == samplesAtRest_; }
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
    int compilations, width, height;  // of the window
    bool operator==(const Shown&) const = default;
  };
  Status draw(Session& session, double scale, int samples);
  Status refine(Session& session);  // by one sample

  std::optional<Shown> shown_;
  std::optional<Target> target_;
  Pace pace_;
  FrameStatistics statistics_;
  double lastChange_ = 0.0;
  bool whole_ = false;
  int samplesAtRest_ = 0;
  std::optional<Target> refined_;  // shown once it has more samples than the whole picture
};

}  // namespace sdf::viewer
