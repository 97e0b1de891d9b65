// Where the hits of primary rays are kept, whatever found them.
#pragma once
#include <optional>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"

namespace sdf::viewer {

/// A HitsTarget has one layer for each output of parts::kHits, and depth: a hit may be kept only where it is
/// nearer than the one that is there. The picture's shader reads the layers by the outputs' names.
class HitsTarget {
 public:
  /// Makes the layers as large as this, if they are not. With `counted` there is one more, for readings.
  /// Errors: as Target::create.
  Status resize(int width, int height, bool counted);

  /// Binds the layers, which then hold no hit anywhere, at the farthest depth.
  void clear() const;

  /// Binds the layers, with no readings counted.
  void clearCounts() const;

  /// Lets the program read the layers of hits, in texture units from 0 on.
  void giveTo(const Program& program) const;

  /// Returns the sum of the readings that were counted. Errors: as Target::sum.
  Result<double> readings() const;

  /// The number of the layer of readings.
  static constexpr int kCounts = 2;

 private:
  std::optional<Target> target_;
};

}  // namespace sdf::viewer
