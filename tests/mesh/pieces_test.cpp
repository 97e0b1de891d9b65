#include "sdf/mesh/pieces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/scenes.h"
#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {
namespace pieces_test {

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

Shape bar() { return box({0.3, 0.1, 0.2}) | translate(sphere(0.15), {0.3, 0.0, 0.0}); }

// Its colour goes along it.
Shape striped() {
  static const MaterialPtr stripes =
      makeMaterial({.name = "stripes", .color = {0.5 + 0.5 * sin(8.0 * position().x), 0.2, 0.1}});
  return bar().paint(stripes);
}

Result<MeshedShape> tryMesh(const Shape& shape, double tolerance) {
  Progress progress;
  return meshShape(shape, "part", {.tolerance = tolerance}, progress);
}

TEST(Pieces, AreOperandsThatLieApart) {
  const Shape pair = sphere(1.0) | translate(box({0.5, 0.5, 0.5}), {1.2, 0.0, 0.0});
  EXPECT_EQ(isolatedPieces(pair | translate(sphere(0.5), {5.0, 0.0, 0.0}), 0.1).size(), 2u);
  EXPECT_EQ(isolatedPieces(pair, 0.1).size(), 1u);
  const Shape apart = sphere(1.0) | translate(sphere(1.0), {2.5, 0.0, 0.0});
  EXPECT_EQ(isolatedPieces(apart, 0.4).size(), 2u);
  EXPECT_EQ(isolatedPieces(apart, 0.6).size(), 1u);
}

TEST(Pieces, ArePutTogetherAgainByAnOperandThatReachesBoth) {
  const Shape apart = sphere(1.0) | translate(sphere(1.0), {4.0, 0.0, 0.0});
  EXPECT_EQ(isolatedPieces(apart | box({5.0, 0.1, 0.1}), 0.1).size(), 1u);
}

TEST(Pieces, OfWhatIsNoHardUnionOfBoundedSolidsAreOne) {
  const Shape a = sphere(1.0), b = translate(sphere(1.0), {8.0, 0.0, 0.0});
  EXPECT_EQ(isolatedPieces(a, 0.1).size(), 1u);
  EXPECT_EQ(isolatedPieces(unite(a, b, Blend::quadratic(0.1)), 0.1).size(), 1u);
  EXPECT_EQ(isolatedPieces(a | b | plane({0.0, 1.0, 0.0}, -9.0), 0.1).size(), 1u);
}

TEST(Pieces, KnowTheFirstThatTheyAreCopiesOf) {
  const auto turned = [](double x, double angle) {
    return translate(rotate(striped(), {0.0, degrees(angle), 0.0}), {x, 0.0, 0.0});
  };
  const std::vector<Piece> pieces =
      isolatedPieces(unite({turned(0.0, 0.3), turned(2.0, 1.1), translate(bar(), {4.0, 0.0, 0.0}),
                            turned(6.0, -2.0), translate(sphere(0.2), {8.0, 0.0, 0.0})}),
                     0.1);
  ASSERT_EQ(pieces.size(), 5u);
  const std::size_t first[] = {0, 0, 2, 0, 4};
  for (std::size_t i = 0; i < pieces.size(); ++i) EXPECT_EQ(pieces[i].like, first[i]) << i;
  // Motions hold to within 1e-10 of what they move (motionBetween), which is up to six units away.
  const TapePtr before = tapeOf(pieces[0].shape)->firstOutputOnly(),
                after = tapeOf(pieces[3].shape)->firstOutputOnly();
  for (const glm::dvec3& p :
       {glm::dvec3(0.5, 0.1, 0.3), glm::dvec3(-0.4, 0.7, -0.2), glm::dvec3(0.1, 0.0, 0.0)})
    EXPECT_NEAR(evaluate(*after, pieces[3].motion(p)), evaluate(*before, p), 1e-9);
}

TEST(Pieces, AreMeshedAsTheWholeIs) {
  const Shape pieces = unite({bar(), translate(rotate(bar(), {20.0, 50.0, 0.0}), {3.0, 1.0, 0.0}),
                              translate(sphere(0.4), {0.0, 3.0, 0.0})});
  const MeshedShape all = meshed(pieces, 0.0, 2e-3);
  EXPECT_EQ(all.stats.components, 3);
  EXPECT_EQ(all.stats.eulerCharacteristic, 6);
  EXPECT_EQ(all.stats.triangles, all.mesh.triangles.size());
  EXPECT_GT(all.stats.surfacePoints, 0u);
  EXPECT_GT(all.stats.rmsDistance, 0.0);
  // The copy is where its own function is: read at its vertices.
  const TapePtr own = tapeOf(pieces)->firstOutputOnly();
  for (const glm::vec3& p : all.mesh.positions) EXPECT_LE(std::abs(evaluate(*own, glm::dvec3(p))), 2e-3);
}

TEST(Pieces, SmallOnesBesideLargeOnesAreKept) {
  const Shape door = box({0.5, 1.0, 0.04}), hull = translate(box({50.0, 6.0, 8.0}), {0.0, 20.0, 0.0});
  const Result<MeshedShape> mesh = tryMesh(door | hull, 0.01);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->stats.components, 2);
  EXPECT_EQ(mesh->mesh.triangles.size(), 24u);
  EXPECT_LT(nearestVertex(mesh->mesh.positions, {0.5, 1.0, 0.04}), 1e-3);
}

TEST(Pieces, WithoutASurfaceAreLeftOut) {
  const Shape nothing = sphere(1.0) & translate(sphere(1.0), {0.0, 2.5, 0.0}),
              nothingElse = translate(nothing, {0.0, 0.0, 9.0}),
              ball = translate(sphere(1.0), {9.0, 0.0, 0.0});
  const Result<MeshedShape> some = tryMesh(unite({nothing, ball, nothingElse}), 0.01);
  ASSERT_TRUE(some.ok()) << some.error().message;
  EXPECT_EQ(some->stats.components, 1);
  const Result<MeshedShape> none = tryMesh(nothing | nothingElse, 0.01);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::Scene);
}

TEST(Pieces, KeepTheirMaterialsAndTheirColours) {
  const auto painted = [](const char* name, double red, double x) {
    return translate(sphere(0.5), {x, 0.0, 0.0}).paint({.name = name, .color = {red, 0.0, 0.0}});
  };
  const Shape four =
      unite({painted("a", 0.1, 0.0), painted("b", 0.2, 3.0), painted("a", 0.1, 6.0), painted("c", 0.3, 9.0)});
  const Result<MeshedShape> result = tryMesh(four, 0.01);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Mesh& mesh = result->mesh;
  ASSERT_EQ(mesh.triangleMaterial.size(), mesh.triangles.size());
  EXPECT_TRUE(std::ranges::is_sorted(mesh.triangleMaterial));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const float x = mesh.positions[mesh.triangles[t].x].x;
    const std::string expected = x < 1.5f ? "a" : x < 4.5f ? "b" : x < 7.5f ? "a" : "c";
    const float red = expected == "a" ? 0.1f : expected == "b" ? 0.2f : 0.3f;
    EXPECT_EQ(mesh.materials[mesh.triangleMaterial[t]].name, expected);
    EXPECT_FLOAT_EQ(mesh.colors[mesh.triangles[t].x].x, red);
    EXPECT_FLOAT_EQ(mesh.materials[mesh.triangleMaterial[t]].color.x, red);
  }
}

TEST(Pieces, CopiesShowTheColoursOfTheirOwnPlaces) {
  const Shape copy = translate(rotate(striped(), {0.0, 70.0, 25.0}), {3.0, 0.0, 0.0});
  const MeshedShape all = meshed(striped() | copy, 0.0, 2e-3);
  const TapePtr red = Function((striped() | copy).surface[0]).at();
  // Colours are held to four steps of a byte, which are 0.03 of linear light where it is brightest, at
  // samples, and to some more at corners between them; a copy in another's place is off by up to 1.
  for (std::size_t v = 0; v < all.mesh.positions.size(); ++v)
    EXPECT_NEAR(all.mesh.colors[v].x, evaluate(*red, glm::dvec3(all.mesh.positions[v])), 1.5 * 0.03);
}

TEST(Pieces, DoNotDependOnTheNumberOfThreads) {
  const Shape shape = unite({bar(), translate(torus(0.5, 0.1), {3.0, 0.0, 0.0}),
                             translate(bar(), {6.0, 0.0, 0.0}), translate(sphere(0.3), {9.0, 0.0, 0.0})});
  const auto with = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return meshed(shape, 0.0, 5e-3);
  };
  const MeshedShape one = with(1), seven = with(7);
  EXPECT_EQ(one.mesh.positions, seven.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, seven.mesh.triangles);
  EXPECT_EQ(one.stats.maxDistance, seven.stats.maxDistance);
}

TEST(Pieces, StopWhenTheWholeDoes) {
  Progress progress;
  progress.stop();
  const Result<MeshedShape> mesh =
      meshShape(sphere(1.0) | translate(sphere(1.0), {5.0, 0.0, 0.0}), "part", {.tolerance = 0.01}, progress);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().kind, ErrorKind::Interrupted);
}

TEST(Pieces, ThatCannotKeepAToleranceAreNamedByThePart) {
  const Shape crescent = subtract({sphere(0.5), translate(sphere(0.5), {0.05, 0.0, 0.0})});
  const Result<MeshedShape> mesh = tryMesh(crescent | translate(sphere(0.5), {4.0, 0.0, 0.0}), 1e-3);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().kind, ErrorKind::Limits);
  EXPECT_NE(mesh.error().message.find("part 'part'"), std::string::npos) << mesh.error().message;
}

}  // namespace pieces_test
}  // namespace sdf::test
