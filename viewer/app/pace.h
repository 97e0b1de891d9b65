// Dynamic resolution: how many pixels a moving picture may have.
#pragma once

namespace sdf::viewer {

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

}  // namespace sdf::viewer
