#include "rows.h"

#include <algorithm>
#include <stdexcept>

namespace sdf::accuracy {
namespace {

constexpr std::uint64_t kPointsOfSmall = 450'000, kPointsOfLarge = 100'000;
constexpr std::size_t kLargeMesh = 10'000;  // triangles

}  // namespace

Row rowOf(const std::string& entry, std::span<const std::function<ReferenceCase()>> cases,
          std::uint64_t fraction) {
  Row row{entry, {}};
  unsigned seed = 0;
  for (const std::function<ReferenceCase()>& make : cases) {
    const ReferenceCase c = make();
    if (!c.shape.ok()) throw std::invalid_argument(c.name + ": " + *c.shape.error);
    const std::uint64_t points = c.mesh.triangles.size() < kLargeMesh ? kPointsOfSmall : kPointsOfLarge;
    row.found.add(check(c, points / fraction / cases.size() + 1, ++seed));
    row.chord = std::max(row.chord, c.chord);
    row.exact = row.exact || c.shape.claim.kind <= ClaimKind::ExactOutside;
    row.lipschitz = std::max(row.lipschitz, c.shape.claim.lipschitz);
  }
  return row;
}

}  // namespace sdf::accuracy
