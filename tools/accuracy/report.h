// docs/accuracy.md: what the checks found, a row for each entry of the catalog, each mesh and each known
// failure.
#pragma once
#include <ostream>
#include <span>

#include "accuracy/meshes/mesh_cases.h"
#include "accuracy/operators/offset_cases.h"
#include "command_line/text.h"
#include "failures/failure_case.h"
#include "rows.h"

namespace sdf::accuracy {

/// A known failure and what its two methods measured.
struct FailureRow {
  FailureCase failure;
  Figures figures;
};

using command_line::formatted, command_line::grouped;

/// The whole page. Deterministic but for the float readings, which are those of the machine's instruction
/// set.
void writeReport(std::ostream& out, std::span<const Row> primitives, std::span<const Row> operators,
                 std::span<const OffsetRow> offsets, std::span<const MeshRow> meshes,
                 std::span<const FailureRow> failures);

/// Its section on meshes.
void writeMeshes(std::ostream& out, std::span<const MeshRow> meshes);

}  // namespace sdf::accuracy
