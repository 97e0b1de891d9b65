// Replacing the edge between two triangles of a sampled mesh by their other diagonal.
#pragma once
#include "sdf/mesh/refine/crowded.h"
#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {

/// Flips an edge if that lessens the largest distance of both triangles' samples, or, where both lie within
/// `flat` of a plane, the slenderness of the worse one: needles on planes are in the way of proofs. Not if
/// something would cross (of what a block names, see CrowdedTriangles). Returns whether it did. Precondition:
/// HalfEdgeMesh::canFlip.
bool flipIfBetter(SampledMesh& sampled, CrowdedTriangles& crowded, SampledMesh::Index h, float flat,
                  std::uint8_t block);

}  // namespace sdf
