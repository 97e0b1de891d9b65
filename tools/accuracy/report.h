// docs/accuracy.md: what the checks found, a row for each entry of the catalog.
#pragma once
#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "check.h"

namespace sdf::accuracy {

/// What all cases of one catalog entry found together: sums of the counts, and the worst of each figure.
struct Row {
  std::string entry;
  Checked found;
  double chord = 0.0;
  double lipschitz = 0.0;  ///< as claimed
  bool exact = false;      ///< some case claims to be exact, everywhere or outside
};

/// Checks the cases one after the other; they are made here, since a mesh may be large. An entry whose meshes
/// are small is tried at 450,000 points, one whose meshes are large at 100,000, which takes longer; divided
/// by `fraction`. Seeds follow from the cases' order. Throws std::invalid_argument where a shape is a failed
/// one.
Row rowOf(const std::string& entry, std::span<const std::function<ReferenceCase()>> cases,
          std::uint64_t fraction = 1);

/// The whole page. Deterministic but for the float readings, which are those of the machine's instruction
/// set.
void writeReport(std::ostream& out, std::span<const Row> primitives, std::span<const Row> operators);

}  // namespace sdf::accuracy
