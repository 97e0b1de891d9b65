#include <glm/geometric.hpp>

#include "sdf/export/export.h"
#include "sdf/mesh/mesher.h"

namespace sdf {
namespace {

/// Voxels along the longest side, unless told otherwise: a side of a thousand pixels then has five to a
/// voxel.
constexpr double kDefaultVoxels = 200.0;

}  // namespace

Result<ExportSize> exportSize(const std::vector<Part>& parts, const std::optional<Box>& clip,
                              Progress& progress) {
  Box all;
  for (const Part& part : parts) {
    Box box = findBounds(part.shape);
    if (clip) box = intersect(box, *clip);
    if (progress.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    if (box.empty()) continue;
    // Rather now than after the other parts: the mesher knows best how to word why it cannot be meshed.
    if (!box.finite()) {
      const auto refused = meshShape(part.shape, part.name, {.bounds = clip}, progress);
      if (!refused) return refused.error();
    }
    all = unite(all, box);
  }
  if (!all.finite()) return ExportSize{};
  return ExportSize{glm::length(all.size()), all.longestSide() / kDefaultVoxels};
}

}  // namespace sdf
