// What is reported of meshes of formulas whose value is no distance, held to distances that are found in
// double by a search of its own: rays in all directions from points of the mesh, and lines through space to
// the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "mesh/measure/surface_search.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/solids/solids.h"
#include "support/thorough.h"

namespace sdf::test {
namespace random_fields_test {

// Zero on an ellipsoid or a rounded cube of half a unit or so, near the origin.
Expr quadric(Random& random) {
  const bool quartic = below(random, 3) == 0;
  const Expr coordinates[] = {position().x, position().y, position().z};
  Expr sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Expr d = square(coordinates[axis] - between(random, -0.5, 0.5));
    sum = sum + (quartic ? square(d) : d) * between(random, 0.6, 2.0);
  }
  return sum - std::pow(between(random, 0.3, 0.8), quartic ? 4.0 : 2.0);
}

Expr formula(Random& random, int depth) {
  if (depth == 0) return quadric(random);
  const Expr a = formula(random, depth - 1);
  const Vec3E p = position();
  switch (below(random, 8)) {
    case 0:
      return min(a, formula(random, depth - 1));
    case 1:
      return max(a, -formula(random, depth - 1));
    case 2:
      return max(a, formula(random, depth - 1));
    case 3:
      return a * formula(random, depth - 1);
    case 4:
      return a * a * a;  // flat where it is 0
    case 5:
      return a * (dot(p, p) + 0.05);
    case 6:
      return a * exp(p.x * between(random, -3.0, 3.0));
    default:
      return a + 0.02 * sin(p.x * 5.0) * sin(p.y * 5.0);
  }
}

struct Outcome {
  bool meshed = false;
  std::string message;
};

Outcome holdToSearch(unsigned seed) {
  Random random(seed);
  const double size = std::pow(10.0, between(random, -2.0, 2.0));
  const Expr drawn = formula(random, 1 + below(random, 2));
  const Expr f = drawn * std::pow(10.0, between(random, -6.0, 6.0));
  const Expr scaled = remap(f, {position().x / size, position().y / size, position().z / size}, 1.0 / size);
  const Box bounds = Box::centred(glm::dvec3(2.0 * size));
  const double voxel = 4.0 * size / (16 + below(random, 24));
  Progress progress;
  const auto made = meshShape(field(scaled, bounds), "field", {.voxelSize = voxel}, progress);
  if (!made) return {false, made.error().message};
  const Mesh& mesh = made->mesh;
  const MeshStats& stats = made->stats;
  const Search search(scaled);
  const double rounding = 4e-6 * size;

  // The place that is named is as far off as it is said to be.
  const glm::dvec3 farthest(stats.farthest);
  const double toMesh = distanceToMesh({stats.farthest}, mesh.positions, mesh.triangles, progress).max;
  if (toMesh <= rounding) {
    const double found = search.nearest(farthest, 4.0 * voxel, random);
    EXPECT_GE(stats.maxDistance, 0.85 * found - rounding) << "too small, seed " << seed;
    EXPECT_LE(stats.maxDistance, 1.15 * found + rounding) << "too large, seed " << seed;
  } else {
    EXPECT_NEAR(stats.maxDistance, toMesh, rounding) << seed;
    // What is below the least normal float may be 0 for floats, as in so flat a field.
    const bool isRead = std::abs(search.value(farthest)) < 0x1p-126;
    EXPECT_TRUE(isRead || search.nearest(farthest, 4.0 * voxel, random) <= rounding)
        << "no surface there, seed " << seed;
  }
  // Nothing of the mesh is farther off.
  for (int i = 0; i < 20; ++i) {
    const glm::uvec3& t = mesh.triangles[below(random, static_cast<int>(mesh.triangles.size()))];
    const double u = between(random, 0.0, 1.0), v = between(random, 0.0, 1.0 - u);
    const glm::dvec3 p = (1.0 - u - v) * glm::dvec3(mesh.positions[t.x]) +
                         u * glm::dvec3(mesh.positions[t.y]) + v * glm::dvec3(mesh.positions[t.z]);
    const double found = search.nearest(p, 4.0 * voxel, random);
    EXPECT_LE(found, 1.15 * stats.maxDistance + rounding) << "at a point of the mesh, seed " << seed;
  }
  holdSurface(search, Box::centred(glm::dvec3(1.5 * size)), *made, random, seed);
  holdSides(search, Box::centred(glm::dvec3(1.5 * size)), *made, random, seed);
  return {true, ""};
}

TEST(RandomFields, AreAsFarOffAsReported) {
  const unsigned count = isThorough() ? 500 : 24;
  unsigned meshed = 0;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const Outcome outcome = holdToSearch(seed);
    meshed += outcome.meshed;
    // One solid less another, or what two share, may be nothing, or nearly so; waves may be all that is left
    // of a formula far away.
    const auto says = [&](const char* words) { return outcome.message.find(words) != std::string::npos; };
    EXPECT_TRUE(outcome.meshed || says("no surface inside the bounds") || says("too thin to be seen") ||
                says("leaves the bounds") || says("is no number at"))
        << outcome.message << ", seed " << seed;
  }
  EXPECT_GE(meshed, count * 9 / 10);
}

}  // namespace random_fields_test
}  // namespace sdf::test
