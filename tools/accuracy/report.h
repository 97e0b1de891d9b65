// docs/accuracy.md: what the checks found, a row for each entry of the catalog and each known failure.
#pragma once
#include <ostream>
#include <span>

#include "failures/failure_case.h"
#include "offset_cases.h"
#include "rows.h"

namespace sdf::accuracy {

/// A known failure and what its two methods measured.
struct FailureRow {
  FailureCase failure;
  Figures figures;
};

/// The whole page. Deterministic but for the float readings, which are those of the machine's instruction
/// set.
void writeReport(std::ostream& out, std::span<const Row> primitives, std::span<const Row> operators,
                 std::span<const OffsetRow> offsets, std::span<const FailureRow> failures);

}  // namespace sdf::accuracy
