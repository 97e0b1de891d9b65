#include "sdf/mesh/certify.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <random>

#include "mesh/scenes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/certify_reading.h"
#include "sdf/mesh/mesher.h"

namespace sdf::test {
namespace {

// A mesh and what is asked of its certificate: what the exporter asks.
struct Subject {
  Shape shape;
  Mesh mesh;
  double measured;
  CertifyOptions options;

  Subject(const Shape& s, double voxel) : shape(s) {
    Progress progress;
    const Box bounds = intersect(findBounds(s), region(2.0));
    MeshedShape meshed = meshShape(s, "part", {.voxelSize = voxel, .bounds = bounds}, progress).value();
    mesh = std::move(meshed.mesh);
    measured = meshed.stats.maxDistance;
    options = {bounds, 2.5 * measured, voxel, kFarthestVoxels * voxel};
  }
  Certificate certificate() const {
    Progress progress;
    return certify(mesh.positions, mesh.triangles, Model(shape).at(), options, progress);
  }
};

struct ProvenCase {
  const char* name;
  Shape shape;
  double voxel;
};

TEST(Certify, BoundsRightMeshesWithinThreeTimesTheirMeasuredDistance) {
  const ProvenCase cases[] = {
      {"ball", sphere(1.0), 1.0 / 16},
      {"ring", torus(1.0, 0.4), 1.0 / 40},
      {"blended balls",
       unite({translate(sphere(0.5), {0.2, 0.0, 0.0}), translate(sphere(0.5), {-0.2, 0.0, 0.0})},
             Blend::quadratic(0.2)),
       1.0 / 40},
      {"two balls", translate(sphere(0.5), {0.7, 0.0, 0.0}) | translate(sphere(0.5), {-0.7, 0.0, 0.0}),
       1.0 / 24},
  };
  for (const ProvenCase& c : cases) {
    SCOPED_TRACE(c.name);
    const Subject subject(c.shape, c.voxel);
    const Certificate proof = subject.certificate();
    EXPECT_TRUE(proof.proven()) << proof.unproven << " cells, the first at (" << proof.firstUnproven.x << ", "
                                << proof.firstUnproven.y << ", " << proof.firstUnproven.z << ")";
    EXPECT_GE(proof.toSurface, subject.measured);  // which lies on the mesh
    EXPECT_LE(proof.bound(), 3.0 * subject.measured);
  }
}

// How far a ball's surface is from a mesh that lies around the origin, from below: at the middles and corners
// of its triangles, and of these back to the mesh.
double distanceOfBall(double radius, const Mesh& mesh) {
  double most = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    for (const auto& w : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1 / 3., 1 / 3., 1 / 3.}, {.5, .5, 0}}) {
      const glm::dvec3 p = w.x * glm::dvec3(mesh.positions[t.x]) + w.y * glm::dvec3(mesh.positions[t.y]) +
                           w.z * glm::dvec3(mesh.positions[t.z]);
      most = std::max(most, std::abs(glm::length(p) - radius));
    }
  return most;
}

TEST(Certify, NeverClaimsLessThanTheTrueDistanceOfDisturbedMeshes) {
  int proven = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    Subject subject(sphere(1.0), 1.0 / 10);
    const float by = std::pow(10.0f, -4.0f + 3.0f * (seed % 6) / 6.0f);
    for (glm::vec3& p : subject.mesh.positions)
      if (seed < 6 || unit(random) > 0.9f) p += by * glm::vec3(unit(random), unit(random), unit(random));
    const Certificate proof = subject.certificate();
    if (!proof.proven()) continue;
    ++proven;
    EXPECT_GE(proof.toSurface, distanceOfBall(1.0, subject.mesh));
  }
  EXPECT_GE(proven, 8);  // small disturbances are no matter
}

TEST(Certify, SeesOneVertexThatIsOff) {
  Subject subject(sphere(1.0), 1.0 / 16);
  const double before = subject.certificate().bound();
  for (const double side : {1.0, -1.0}) {
    Subject moved = subject;
    moved.mesh.positions[100] *= static_cast<float>(1.0 + side * 5.0 * before);
    const Certificate proof = moved.certificate();
    EXPECT_TRUE(!proof.proven() || proof.bound() >= 5.0 * before * (1.0 - 0x1p-20));
  }
}

void expectUnprovenNear(const Certificate& proof, const glm::dvec3& centre, double reach) {
  EXPECT_FALSE(proof.proven());
  EXPECT_LE(glm::length(proof.firstUnproven - centre), reach);
}

TEST(Certify, RefusesAMeshThatLacksAPieceOfTheSurface) {
  const glm::dvec3 at(1.2, 0.0, 0.0);
  const double r = 0.2, voxel = 1.0 / 16;
  Subject subject(sphere(0.8), voxel);
  ASSERT_TRUE(subject.certificate().proven());
  subject.options.bounds = region(1.5);
  subject.shape = sphere(0.8) | translate(sphere(r), Vec3E(at));
  expectUnprovenNear(subject.certificate(), at, r + 2.0 * voxel);
  // Also where the piece is smaller than any triangle.
  subject.shape = sphere(0.8) | translate(sphere(0.01), Vec3E(at));
  expectUnprovenNear(subject.certificate(), at, 2.0 * voxel);
  // And inside the solid.
  subject.shape = subtract({sphere(0.8), translate(sphere(r), {0.1, 0.2, 0.0})});
  expectUnprovenNear(subject.certificate(), {0.1, 0.2, 0.0}, r + 2.0 * voxel);
}

TEST(Certify, RefusesAMeshWithAPieceTooMuch) {
  const glm::dvec3 at(1.2, 0.0, 0.0);
  const double voxel = 1.0 / 16;
  Subject subject(sphere(0.8) | translate(sphere(0.2), Vec3E(at)), 1.0 / 32);
  ASSERT_TRUE(subject.certificate().proven());
  subject.shape = sphere(0.8);
  expectUnprovenNear(subject.certificate(), at, 0.2 + 2.0 * voxel);
}

TEST(Certify, RefusesWhatIsTurnedRoundOrOpen) {
  Subject subject(sphere(1.0), 1.0 / 16);
  Subject turned = subject;
  std::swap(turned.mesh.triangles[50].x, turned.mesh.triangles[50].y);
  const glm::uvec3& t = subject.mesh.triangles[50];
  expectUnprovenNear(turned.certificate(), glm::dvec3(subject.mesh.positions[t.x]), 0.5);
  Subject open = subject;
  open.mesh.triangles.pop_back();
  EXPECT_FALSE(open.certificate().proven());
  Subject inverted = subject;
  for (glm::uvec3& v : inverted.mesh.triangles) std::swap(v.x, v.y);
  EXPECT_FALSE(inverted.certificate().proven());
  Subject none = subject;
  none.mesh.triangles.clear();
  EXPECT_FALSE(none.certificate().proven());
}

TEST(Certify, RefusesFieldsThatJump) {
  // The sign changes at the mesh, but there is no zero there.
  Subject subject(sphere(1.0), 1.0 / 16);
  const Expr ball = length(position()) - 1.0;
  subject.shape = field(select(less(ball, 0.0), ball - 0.5, ball + 0.5), region(1.1), kInfinity);
  EXPECT_FALSE(subject.certificate().proven());
}

TEST(Certify, DoesNotDependOnTheNumberOfThreads) {
  Subject subject(boredBox(), 1.0 / 16);
  subject.mesh.positions[7] += glm::vec3(0.2f, 0.1f, 0.0f);  // so that places are compared, too
  Certificate all[2];
  for (const int threads : {1, 2})
    tbb::task_arena(threads).execute([&] { all[threads - 1] = subject.certificate(); });
  EXPECT_EQ(all[0].toSurface, all[1].toSurface);
  EXPECT_EQ(all[0].toMesh, all[1].toMesh);
  EXPECT_EQ(all[0].widest, all[1].widest);
  EXPECT_EQ(all[0].cells, all[1].cells);
  EXPECT_EQ(all[0].unproven, all[1].unproven);
  EXPECT_EQ(all[0].firstUnproven, all[1].firstUnproven);
}

TEST(Certify, EndsSoonWhereItIsStopped) {
  struct Stopping : Progress {
    void update(double) override { stop(), ++updates; }
    std::atomic<int> updates{0};
  } progress;
  const Subject subject(torus(1.0, 0.4), 1.0 / 40);
  certify(subject.mesh.positions, subject.mesh.triangles, Model(subject.shape).at(), subject.options,
          progress);
  EXPECT_GE(progress.updates, 1);
  EXPECT_LE(progress.updates, 64);  // of some hundred: those that were under way
}

// Patches that stand anywhere, with points of them.
struct RandomPatch {
  std::mt19937 random;
  glm::dvec3 centre, radius;
  std::array<glm::dvec3, 3> axes;

  explicit RandomPatch(unsigned seed) : random(seed) {
    centre = 1.3 * direction();
    const glm::dvec3 n = glm::normalize(direction()), u = glm::normalize(glm::cross(n, direction()));
    axes = {u, glm::cross(n, u), n};
    radius = glm::dvec3(std::pow(10.0, -3.0 + 2.5 * std::abs(share()))) * (1.1 + direction());
  }
  double share() { return std::uniform_real_distribution<>(-1.0, 1.0)(random); }
  glm::dvec3 direction() {
    const double x = share(), y = share(), z = share();
    return {x, y, z};
  }
  glm::dvec3 point() {
    const glm::dvec3 s = direction() * radius;
    return centre + s.x * axes[0] + s.y * axes[1] + s.z * axes[2];
  }
  Patch patch() const { return Patch::box(centre, axes, radius); }
};

TEST(PatchReading, ContainsValuesSlopesAndCurvature) {
  int curved = 0, rising = 0;
  PatchReading reading;
  for (const Shape& shape :
       {boredBox(), melt(), latticeBall(), sphere(1.0), torus(1.0, 0.3), box(Vec3E(1.0))}) {
    const TapePtr tape = tapeOf(shape);
    for (unsigned seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      RandomPatch p(seed);
      const PatchBounds bounds = reading.run(*tape, p.patch(), true);
      const double least = reading.leastSlope(*tape, p.patch(), 2);
      curved += bounds.curved;
      rising += least > 0.0;
      for (int i = 0; i < 40; ++i) {
        const glm::dvec3 a = p.point();
        // Points of a patch are rounded, values too: by some ulps of numbers of this size.
        const double ulps = 64.0 * 0x1p-53, v = evaluate(*tape, a);
        EXPECT_LE(bounds.value.lo - ulps, v);
        EXPECT_GE(bounds.value.hi + ulps, v);
        // Towards the centre, so that all points lie in the patch.
        const double step = 0.1 * p.radius.z * (glm::dot(a - p.centre, p.axes[2]) > 0.0 ? -1.0 : 1.0);
        const auto at = [&](double k) { return evaluate(*tape, a + k * step * p.axes[2]); };
        const double slope = (at(1.0) - at(0.0)) / step, rounding = ulps / std::abs(step);
        EXPECT_LE(bounds.slope[2].lo - rounding, slope);
        EXPECT_GE(bounds.slope[2].hi + rounding, slope);
        EXPECT_LE(least - rounding, std::max(slope, 0.0));
        if (!bounds.curved) continue;
        const double bend = (at(0.0) - 2.0 * at(1.0) + at(2.0)) / (step * step);
        EXPECT_LE(bounds.curvature[5].lo - 4.0 * rounding / std::abs(step), bend);
        EXPECT_GE(bounds.curvature[5].hi + 4.0 * rounding / std::abs(step), bend);
      }
    }
  }
  EXPECT_GE(curved, 60);
  EXPECT_GE(rising, 30);
}

TEST(PatchReading, KnowsThatABlendsSlopeIsAMeanOfItsPartsAndHowItBends) {
  // Between two balls, where both are equal, and where the blend fades out. Up is their slope across, sqrt(3)
  // / 2 of each; intervals without the mean would add half of it.
  const double k = 0.2, r = 1.0;
  const Shape shape = unite({translate(sphere(r), {0.5, 0.0, 0.0}), translate(sphere(r), {-0.5, 0.0, 0.0})},
                            Blend::quadratic(k));
  const TapePtr tape = tapeOf(shape)->firstOutputOnly();
  PatchReading reading;
  const std::array<glm::dvec3, 3> axes{glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
  const double size = 0.02, height = std::sqrt(r * r - 0.25);
  for (const double x : {0.0, 0.1, -0.2}) {
    const Patch patch = Patch::box({x, height, 0.0}, axes, glm::dvec3(size));
    const PatchBounds bounds = reading.run(*tape, patch, true);
    ASSERT_TRUE(bounds.curved);
    // Along y each ball's slope is y / |p|, which changes by size / r here, twice for what intervals add.
    EXPECT_GE(bounds.slope[2].lo, height / std::hypot(height, 0.5 + std::abs(x)) - 4.0 * size / r);
    EXPECT_LE(bounds.slope[2].hi, 1.0 + 4.0 * size / r);
    // Across, two slopes at most 2 apart bend by (2)² / 2k more than the balls, 1 / r.
    EXPECT_LE(std::max(-bounds.curvature[3].lo, bounds.curvature[3].hi), 4.0 / (2.0 * k) + 2.0 / r);
  }
}

TEST(PatchReading, FindsTheSlopeBesideEdgesOfABox) {
  // Out of an edge and a corner of an exact box, whose parts are |max(q, 0)| and min(max q, 0), by halves of
  // sqrt(2) and thirds of sqrt(3); less the angle that the patch sees.
  const TapePtr tape = tapeOf(box(Vec3E(1.0)))->firstOutputOnly();
  PatchReading reading;
  const auto slope = [&](const glm::dvec3& at, const glm::dvec3& way) {
    const glm::dvec3 n = glm::normalize(way), u = glm::normalize(glm::cross(n, glm::dvec3(0.1, 0.2, 1.0)));
    return reading.leastSlope(*tape, Patch::box(at, {u, glm::cross(n, u), n}, glm::dvec3(0.01)), 2);
  };
  // Some hundred interval operations on numbers about 1, each rounded outward by an ulp or two: below 1e-13.
  EXPECT_NEAR(slope({1, 0, 0}, {1, 0, 0}), 1.0, 1e-12);
  EXPECT_NEAR(slope({1, 1, 0}, {1, 1, 0}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(slope({1, 1, 1}, {1, 1, 1}), std::sqrt(1.0 / 3.0), 1e-12);
  EXPECT_LE(slope({1, 1, 0}, {1, -1, 0}), 0.0);
}

}  // namespace
}  // namespace sdf::test
