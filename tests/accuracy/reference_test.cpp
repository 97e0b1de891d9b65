// The references themselves, against distances that are known.
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sdf::accuracy {
namespace reference_test {

TriangleMesh cube(const glm::dvec3& centre, double half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(centre + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TEST(Reference, GivesTheSignedDistanceOfACube) {
  const Reference reference(cube({0, 0, 0}, 1.0));
  EXPECT_EQ(reference.signedDistance({0, 0, 0}), -1.0);
  EXPECT_EQ(reference.signedDistance({3, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(reference.signedDistance({2, 2, 2}), std::sqrt(3.0));
  EXPECT_EQ(reference.side({1, 0.25, 0.5}), 0);
}

TEST(Reference, RefusesAMeshThatIsNotClosed) {
  TriangleMesh open = cube({0, 0, 0}, 1.0);
  open.triangles.pop_back();
  EXPECT_THROW(Reference{open}, std::invalid_argument);
}

TEST(Corefine, CutsAndJoinsCubes) {
  const TriangleMesh a = cube({0, 0, 0}, 1.0), b = cube({1, 1, 1}, 1.0);
  const Reference both(corefine(a, b, Boolean::Intersection));
  EXPECT_EQ(both.signedDistance({0.5, 0.5, 0.5}), -0.5);
  EXPECT_EQ(both.side({-0.5, 0.5, 0.5}), 1);
  const Reference either(corefine(a, b, Boolean::Union));
  EXPECT_EQ(either.side({0.5, 0.5, 0.5}), -1);
  EXPECT_DOUBLE_EQ(either.signedDistance({0.5, 0.5, 0.5}), -std::sqrt(0.5));
  const Reference less(corefine(a, b, Boolean::Difference));
  EXPECT_EQ(less.side({0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(less.signedDistance({0.5, 0.5, 0.5}), 0.5);
}

}  // namespace reference_test
}  // namespace sdf::accuracy
