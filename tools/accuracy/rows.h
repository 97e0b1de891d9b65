// What the checks found of each entry of the catalog.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>

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

}  // namespace sdf::accuracy
