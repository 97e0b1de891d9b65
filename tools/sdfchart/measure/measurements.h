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
std::vector<Batch> meshingBatches(const std::vector<Subject>& subjects, Extent extent);
/// Time and readings a ray, depth errors, missed and false hits of each method of marching; over these scene
/// files, or where there are none over scenes of its own.
std::vector<Batch> marchingBatches(const std::vector<Subject>& files, Extent extent);
/// Angle errors of each scheme of normals, over its step and the distance from the origin.
std::vector<Batch> normalBatches(Extent extent);
/// Errors of the light in the shadows of lamps of some sizes, and of ambient occlusion.
std::vector<Batch> shadowBatches(Extent extent);
std::vector<Batch> occlusionBatches(Extent extent);
/// Points a second and rounding of the readings, over the number of operations. A shader that would take
/// longer than so many seconds to compile is a failure.
std::vector<Batch> evaluationBatches(Extent extent, double compileSeconds = 20.0);
/// Time of each stage of meshing, and memory, over voxels, operations and parts.
std::vector<Batch> growthBatches(Extent extent);
/// The known failures. Quick are those of formulas, marching and blends.
std::vector<Batch> stabilityBatches(Extent extent);

}  // namespace sdf::chart
