// Proofs that the surface passes each prism of a shell once, close to its triangle.
#pragma once
#include <span>
#include <vector>

#include "sdf/proof/reading.h"
#include "sdf/proof/shell.h"

namespace sdf {

/// What is proven of one prism.
struct PrismProof {
  bool looked = false;
  bool passed = false;       ///< by the surface, from the inner side to the outer one
  double bound = kInfinity;  ///< from the triangle to the surface along each line, at most; scene units
  double sides = 0.0;        ///< f is no less on the outer side, and no larger than its negative on the inner
  bool proven() const { return passed && sides > 0.0; }
};

/// Proves the triangles' prisms, in parts where that helps and a bound of `goal` is not reached. The tape
/// holds all over the prisms; `continuous`: so is the field.
void provePrisms(const Tape& tape, bool continuous, const Shell& shell,
                 std::span<const std::uint32_t> triangles, double goal, ProofReading& reading,
                 std::vector<PrismProof>& proofs);

}  // namespace sdf
