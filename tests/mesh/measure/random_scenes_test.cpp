// Random scenes in voxels that are too coarse for them: what the mesh lacks, or has on the wrong side, is
// reported.
#include <gtest/gtest.h>

#include "claims/tree.h"
#include "mesh/measure/surface_search.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/solids/solids.h"
#include "support/thorough.h"

namespace sdf::test {
namespace random_scenes_test {

TEST(RandomScenes, LoseNothingUnseen) {
  const unsigned count = isThorough() ? 500 : 24;
  unsigned meshed = 0;
  for (unsigned seed = 1; seed <= count; ++seed) {
    Random random(seed);
    const Tree tree = randomTree(seed, 3);
    const Shape shape = shapeOf(tree) & box(Vec3E(4.0));
    const Box bounds = findBounds(shape);
    if (bounds.empty() || shape.dimension == 2) continue;
    Progress progress;
    const double voxel = bounds.longestSide() / (8 + below(random, 16));
    const auto made = meshShape(shape, "scene", {.voxelSize = voxel}, progress);
    if (!made) continue;
    ++meshed;
    SCOPED_TRACE(textOf(tree));
    const Search search(shape.distance);
    holdSurface(search, bounds, *made, random, seed);
    holdSides(search, bounds, *made, random, seed);
  }
  EXPECT_GE(meshed, count / 2);
}

}  // namespace random_scenes_test
}  // namespace sdf::test
