// Where the hits of primary rays are kept, whatever found them.
#pragma once
#include <optional>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"

namespace sdf::viewer {

/// A target with one layer for each output of parts::kHits, and depth: a hit may be kept only where it is
/// nearer than the one that is there. The picture's shader reads the layers by the outputs' names.
class HitsTarget {
 public:
  /// Makes the layers as large as this, if they are not. With `counted` there is one more, for readings.
  /// Errors: as Target::create.
  Status resize(int width, int height, bool counted);

  /// Makes it what is drawn into.
  void bind() const { target_->bind(); }

  /// Binds it, with no hit anywhere, as far away as can be.
  void clear() const;

  /// Binds it with no readings counted.
  void clearCounts() const;

  /// Lets the program read the layers of hits, in texture units from 0 on.
  void giveTo(const Program& program) const;

  /// The sum of the readings that were counted. Errors: as Target::sum.
  Result<double> readings() const;

  /// The layer of readings.
  static constexpr int kCounts = 2;

 private:
  std::optional<Target> target_;
};

}  // namespace sdf::viewer
