// Rays that look behind the surface: past edges, through films and thin plates.
#include "march/scenes.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"

namespace sdf {
namespace look_behind_test {

using namespace test;

constexpr double kEpsilon = 1e-4;

MarchOptions with(MarchMethod method, bool lookBehind) {
  return {.method = method, .epsilon = kEpsilon, .maxSteps = 100000, .lookBehind = lookBehind};
}

Hits traceOne(const Shape& shape, const glm::dvec3& from, const glm::dvec3& towards, const MarchOptions& o) {
  Rays rays;
  rays.add(from, glm::normalize(towards - from), 0.0, 8.0);
  return trace(shape, rays, o);
}

class LookBehind : public testing::TestWithParam<MarchMethod> {};
INSTANTIATE_TEST_SUITE_P(March, LookBehind,
                         testing::Values(MarchMethod::Plain, MarchMethod::OverRelaxed,
                                         MarchMethod::Accelerated, MarchMethod::AutoRelaxed));

// A pocket whose cutter ends in the face y = 1: at its mouth the distance is 0 between two positive ones.
Shape pocket() {
  return subtract(box(Vec3E(1.0, 1.0, 1.0)), translate(box(Vec3E(0.4, 0.4, 0.4)), Vec3E(0.0, 0.6, 0.0)));
}

TEST_P(LookBehind, RaysGoThroughTheFilmWhereACutEndsInAFace) {
  for (const glm::dvec3 from :
       {glm::dvec3(0.1, 3.0, 0.2), glm::dvec3(1.0, 2.0, 0.4), glm::dvec3(-2.4, 1.9, 0.1)}) {
    const glm::dvec3 mouth(0.1, 1.0, 0.05);
    const double toMouth = glm::length(mouth - from);
    const Hits lid = traceOne(pocket(), from, mouth, with(GetParam(), false));
    EXPECT_LE(lid.t[0], toMouth);
    const Hits through = traceOne(pocket(), from, mouth, with(GetParam(), true));
    EXPECT_EQ(through.status[0], RayStatus::Hit);
    EXPECT_GT(through.t[0], toMouth + 0.1);
    const glm::dvec3 p = from + through.t[0] * glm::normalize(mouth - from);
    const double wall = std::min({p.y - 0.2, 0.4 - std::abs(p.x), 0.4 - std::abs(p.z)});
    EXPECT_LE(std::abs(wall), kEpsilon);
  }
}

TEST_P(LookBehind, ARayBesideAnEdgeMisses) {
  const Shape cube = box(Vec3E(1.0, 1.0, 1.0));
  const double beside = 1.0 + 0.5 * kEpsilon;
  const glm::dvec3 from(beside, 0.3, 4.0), to(beside, 0.3, 0.0), slanted(beside + 1.0, 0.3, 0.0);
  EXPECT_EQ(traceOne(cube, from, slanted, with(GetParam(), true)).status[0], RayStatus::Miss);
  // Past the edge x = 1, z = 1, half an epsilon away from it.
  const glm::dvec3 off(std::sqrt(0.5), 0.0, std::sqrt(0.5)),
      past = glm::dvec3(1.0, 0.3, 1.0) + 0.5 * kEpsilon * off;
  const glm::dvec3 along(-off.z, 0.0, off.x);
  EXPECT_EQ(traceOne(cube, past - 3.0 * along, past, with(GetParam(), false)).status[0], RayStatus::Hit);
  EXPECT_EQ(traceOne(cube, past - 3.0 * along, past, with(GetParam(), true)).status[0], RayStatus::Miss);
  // Along a face it hits as it does without: nothing shows soon that it leaves.
  EXPECT_EQ(traceOne(cube, from, to, with(GetParam(), true)).status[0], RayStatus::Hit);
}

TEST_P(LookBehind, APlateOfThreeEpsilonsIsHitAtAnyAngle) {
  const Shape plate = box(Vec3E(1.0, 1.0, 1.5 * kEpsilon));
  for (const double x : {0.0, 1.0, 3.0, 20.0}) {
    const glm::dvec3 from = glm::dvec3(0.1, 0.2, 0.0) + 4.0 * glm::normalize(glm::dvec3(x, 0.0, 1.0));
    const Hits hits = traceOne(plate, from, glm::dvec3(0.1, 0.2, 0.0), with(GetParam(), true));
    EXPECT_EQ(hits.status[0], RayStatus::Hit) << x;
    EXPECT_NEAR(from.z * (1.0 - hits.t[0] / 4.0), 1.5 * kEpsilon, 2.0 * kEpsilon) << x;
  }
}

}  // namespace look_behind_test
}  // namespace sdf
