// Meshers that are not the library's, over the same distances.
#pragma once
#include "sdf/eval/tape.h"
#include "sdfchart/truth/mesh_truth.h"

namespace sdf::chart {

/// OpenVDB as it is commonly used: every voxel of the bounds is read, by SIMD and on all threads, those
/// within two voxels of the surface are kept, and volumeToMesh extracts it. Voxels are h long. Precondition:
/// the slope is known.
accuracy::TriangleMesh meshDenselyByOpenVdb(const Subject& subject, const Tape& distance, double h);

/// CGAL's implicit surface mesher, one thread, facets no farther than `tolerance` from the surface. Throws
/// std::runtime_error after `seconds`.
accuracy::TriangleMesh meshImplicitlyByCgal(const Subject& subject, const Tape& distance, double tolerance,
                                            double seconds);

}  // namespace sdf::chart
