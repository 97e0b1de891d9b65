// The matrix: every kind of measurement as batches.
#pragma once
#include "measure.h"
#include "subjects.h"

namespace sdf::chart {

/// How much is measured: for the charts, for a look in about two minutes, or one setting of each method,
/// once, to try the program.
enum class Extent { Full, Quick, Trial };

/// One of three by the extent.
template <class T>
T byExtent(Extent extent, T full, T quick, T trial) {
  return extent == Extent::Full ? full : extent == Extent::Quick ? quick : trial;
}

/// Time, and the two-sided distance to the surface, of each mesher at its settings.
std::vector<Batch> meshingBatches(const std::vector<Subject>& subjects, const Extent& extent);

}  // namespace sdf::chart
