#include "sdf/mesh/band/narrow_band.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "mesh/scenes.h"
#include "sdf/eval/batch.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"

namespace sdf::test {
namespace narrow_band_test {

MeshStats topologyOf(const RawSurface& s) {
  MeshStats stats;
  measureTopology(s.triangles, s.points.size(), stats);
  return stats;
}

struct SignChanges {
  std::size_t edges = 0;  // of the lattice whose ends differ in sign
  std::size_t films = 0;  // samples of zero, up to rounding, between two of one sign
};

// Every sample taken with the whole tape.
SignChanges signChanges(const Tape& tape, const Box& bounds, double h) {
  constexpr double kZero = 1e-4;  // of a voxel
  const glm::ivec3 low(glm::floor(bounds.min / h) - 1.0), high(glm::ceil(bounds.max / h) + 1.0);
  const glm::ivec3 n = high - low + 1;
  const std::size_t step[3] = {static_cast<std::size_t>(n.y) * n.z, static_cast<std::size_t>(n.z), 1};
  std::vector<float> x(n.z), y(n.z), z(n.z), f(n.x * step[0]);
  BatchEvaluator batch;
  for (int i = 0; i < n.x; ++i)
    for (int j = 0; j < n.y; ++j) {
      for (int k = 0; k < n.z; ++k) {
        x[k] = static_cast<float>((low.x + i) * h);
        y[k] = static_cast<float>((low.y + j) * h);
        z[k] = static_cast<float>((low.z + k) * h);
      }
      batch.evaluate(tape, {.x = x.data(), .y = y.data(), .z = z.data()}, n.z, &f[i * step[0] + j * step[1]]);
    }
  SignChanges changes;
  for (std::size_t at = 0; at < f.size(); ++at) {
    const glm::ivec3 c(at / step[0], at / step[1] % n.y, at % n.z);
    bool film = false;
    for (int axis = 0; axis < 3; ++axis) {
      if (c[axis] + 1 == n[axis]) continue;
      const float next = f[at + step[axis]];
      changes.edges += (f[at] < 0.0f) != (next < 0.0f);
      film |= c[axis] > 0 && f[at - step[axis]] * next > 0.0f;
    }
    changes.films += film && std::abs(f[at]) <= kZero * h;
  }
  return changes;
}

struct Scene {
  const char* name;
  Shape shape;
  Box bounds;
  double voxel;
};

std::vector<Scene> hardScenes() {
  const Vec3E p = position();
  const Expr ball = length(p) - 1.0;
  const Box two = region(2.0);
  return {
      {"bored box", boredBox(), two, 1.0 / 24},
      {"smooth union", melt(), two, 1.0 / 24},
      {"lattice, its slope known by intervals only", latticeBall(), two, 1.0 / 24},
      {"hundreds of balls", strewn(400, 0.09), two, 1.0 / 20},
      {"sheet thinner than a voxel", ringAndSheet(), two, 1.0 / 40},
      {"sheet that falls between the samples in part",
       translate(rotate(ringAndSheet(), {0.01, 0.013, 0.0}), {.0137, .0213, .0311}), two, 1.0 / 32},
      {"five times too steep", field(ball * 5.0), two, 1.0 / 16},
      {"no slope bound over all of space", field(square(p.x) + square(p.y) + square(p.z) - 1.0), two,
       1.0 / 16},
      {"infinite slope", field(sqrt(abs(p.x)) + sqrt(abs(p.y)) + sqrt(abs(p.z)) - 1.2), two, 1.0 / 24},
      {"steps, where the sign changes by a jump", field(max(ball, p.y - floor(p.x * 4.0) * 0.125)), two,
       1.0 / 24},
      {"a jump that leaves the sign", field(ball * select(less(p.x, 0.1), 1.0, 7.0)), two, 1.0 / 16},
      {"bounds and lattice that do not start together", translate(sphere(0.7), {0.31, -0.17, 5.03}),
       Box{{-0.5, -0.9, 4.3}, {1.1, 0.6, 5.8}}, 1.0 / 16},
  };
}

TEST(NarrowBand, EverySignChangeOfTheLatticeBecomesAQuad) {
  for (const Scene& s : hardScenes()) {
    SCOPED_TRACE(s.name);
    NarrowBand band = bandOf(s.shape, s.bounds, s.voxel);
    const RawSurface surface = band.extract();
    const SignChanges changes = signChanges(*tapeOf(s.shape)->firstOutputOnly(), s.bounds, s.voxel);
    // Six edges meet in a sample, and two triangles lie across each.
    EXPECT_NEAR(surface.triangles.size(), 2.0 * changes.edges, 12.0 * changes.films);
    EXPECT_TRUE(topologyOf(surface).watertight);
  }
}

TEST(NarrowBand, ASphereComesOutWholeAndOutwards) {
  const double r = 1.0, h = 1.0 / 16;
  NarrowBand band = bandOf(sphere(r), region(r), h);
  const RawSurface s = band.extract();
  const MeshStats t = topologyOf(s);
  EXPECT_TRUE(t.watertight);
  EXPECT_TRUE(t.manifold);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.eulerCharacteristic, 2);
  EXPECT_NEAR(signedVolume(s.points, s.triangles), 4.0 / 3.0 * kPi, 4.0 * kPi * dualMeshError(h, r));
  for (const glm::uvec3& c : s.triangles) {
    const glm::vec3 a = s.points[c.x], n = glm::cross(s.points[c.y] - a, s.points[c.z] - a);
    ASSERT_GT(glm::dot(n, a), 0.0f);
  }
}

TEST(NarrowBand, ATorusKeepsItsHole) {
  const double major = 0.8, minor = 0.3, h = 1.0 / 32;
  const Shape shape = torus(major, minor);
  NarrowBand band = bandOf(shape, shape.bounds, h);
  const RawSurface s = band.extract();
  const MeshStats t = topologyOf(s);
  EXPECT_TRUE(t.watertight && t.manifold);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.eulerCharacteristic, 0);
  EXPECT_NEAR(signedVolume(s.points, s.triangles), 2.0 * kPi * kPi * major * minor * minor,
              4.0 * kPi * kPi * major * minor * dualMeshError(h, minor));
}

TEST(NarrowBand, ABoxLosesVolumeOnlyAtItsEdges) {
  const glm::dvec3 half(0.71, 0.53, 0.37);
  const double h = 1.0 / 32;
  const Shape shape = box(half);
  NarrowBand band = bandOf(shape, shape.bounds, h);
  const RawSurface s = band.extract();
  const MeshStats t = topologyOf(s);
  EXPECT_TRUE(t.watertight && t.manifold);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.eulerCharacteristic, 2);
  // A cell that an edge of the box crosses spoils triangles up to two voxels from it; elsewhere f is linear.
  const double edges = 8.0 * (half.x + half.y + half.z);
  EXPECT_NEAR(signedVolume(s.points, s.triangles), 8.0 * half.x * half.y * half.z, edges * 4.0 * h * h);
}

TEST(NarrowBand, ARingThroughAThinSheetHasTwoHandles) {
  NarrowBand band = bandOf(ringAndSheet(), region(2.0), 1.0 / 64);
  const MeshStats t = topologyOf(band.extract());
  EXPECT_TRUE(t.watertight);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.eulerCharacteristic, -2);
}

TEST(NarrowBand, WorkGrowsWithSurfaceNotVolume) {
  constexpr double kSurfaceGrowth = 4.6;  // halving the voxel makes four times the surface, and 15 % for rims
  for (const double r : {1.0, 0.37}) {
    const double h = 1.0 / 64;
    const auto coarse = bandOf(sphere(r), region(2.0), h).sampleCount();
    const auto fine = bandOf(sphere(r), region(2.0), h / 2).sampleCount();
    EXPECT_LE(fine, kSurfaceGrowth * coarse) << "r = " << r;
  }
  // A leaf that the surface meets has its centre within a leaf's half diagonal of it. For all that is
  // sampled: the shell of that thickness, and a margin for cells that are looked at in vain.
  const double h = 1.0 / 128, r = 1.0, shell = 2.0 * std::sqrt(3.0) * 4.0;
  const double voxels = 4.0 * kPi * r * r / (h * h) * shell;
  EXPECT_LE(bandOf(sphere(r), region(2.0), h).sampleCount(), 1.25 * voxels);
}

// Leaves that are reached by the same balls lie on all sides of these.
TEST(NarrowBand, LeavesWithEqualTapesShareThem) {
  const Shape balls = strewn(30, 0.4);
  const NarrowBand band = bandOf(balls, region(2.2), 4.4 / 128);
  const BandField field(band, wholeTapes(tapeOf(balls)));
  const auto finder = field.finder();
  std::vector<TapePtr> distinct;
  const int n = 48;
  for (int i = 0; i < n * n * n; ++i) {
    const glm::vec3 at(i / (n * n), i / n % n, i % n);
    const TapePtr& tape = finder->at(4.4f / n * (at + 0.5f) - 2.2f).tapes.surface;
    const auto same = std::ranges::find_if(distinct, [&](const TapePtr& t) { return *t == *tape; });
    if (same == distinct.end())
      distinct.push_back(tape);
    else
      ASSERT_EQ(*same, tape);
  }
  EXPECT_GE(distinct.size(), 30u);
}

TEST(NarrowBand, AThousandBallsCostTheirSurfaceToo) {
  const double h = 4.0 / 512, r = 0.06, dense = 512.0 * 512.0 * 512.0;
  const Shape balls = strewn(1000, r);
  const auto samples = bandOf(balls, region(2.0), h).sampleCount();
  const auto coarse = bandOf(balls, region(2.0), 2.0 * h).sampleCount();
  // Leaves within half a leaf's diagonal of a ball, for each ball.
  const double reach = r / h + std::sqrt(3.0) * 4.0;
  EXPECT_LE(samples, 1.25 * 1000 * 4.0 / 3.0 * kPi * reach * reach * reach);
  EXPECT_LE(samples, dense / 6.0);
  EXPECT_LE(samples, 4.6 * coarse);
}

TEST(NarrowBand, TooMuchMemoryIsRefusedBeforeItIsTaken) {
  struct Case {
    double voxel, limit;
    const char* named;
  };
  for (const Case& c : {Case{4.0 / 4096, double(1 << 26), "0.00097"}, Case{1e-5, kPlentyOfMemory, "1e-05"},
                        Case{1e-12, kPlentyOfMemory, "1e-12"}}) {
    SCOPED_TRACE(c.voxel);
    Progress progress;
    rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    const auto band = tryBand(sphere(1.9), region(2.0), c.voxel, progress, c.limit);
    getrusage(RUSAGE_SELF, &after);
    ASSERT_FALSE(band.ok());
    EXPECT_EQ(band.error().kind, ErrorKind::Limits);
    EXPECT_NE(band.error().message.find(std::string("voxel size of ") + c.named), std::string::npos)
        << band.error().message;
    EXPECT_EQ(band.error().message.find('\n'), std::string::npos);
    EXPECT_LE((after.ru_maxrss - before.ru_maxrss) * 1024.0, double(1 << 26));
  }
}

// The message names a size that is not refused in turn, and no more than it must.
TEST(NarrowBand, TheVoxelSizeThatIsNamedFits) {
  constexpr double kLimit = 1 << 25;
  const Shape rods = unite(std::vector{box(Vec3E(1.0, 0.01, 0.01)), box(Vec3E(0.01, 1.0, 0.01)),
                                       translate(box(Vec3E(0.01, 0.01, 1.0)), {0.5, 0.5, 0.0})});
  for (const Shape& shape : {sphere(1.0), box(Vec3E(1.0)), rods, rotate(rods, {0.1, 0.2, 0.3}), latticeBall(),
                             strewn(100, 0.05), translate(torus(0.7, 0.01), {0.1, 0.2, 0.3})})
    for (const double voxel : {1e-10, 1e-4, 1e-3}) {
      Progress progress;
      const ModelTapes model = Model(shape).at();
      const auto sampled = [&](double size) {
        return sampleNarrowBand(model, {size, region(1.5), kLimit}, progress);
      };
      const auto refused = sampled(voxel);
      if (refused) continue;
      const std::string message = refused.error().message, before = "take a voxel size of ";
      ASSERT_NE(message.find(before), std::string::npos) << message;
      const double named = std::stod(message.substr(message.find(before) + before.size()));
      EXPECT_TRUE(sampled(named)) << message;
      EXPECT_FALSE(sampled(named / 4)) << message;
    }
}

TEST(NarrowBand, StopsWithinASecondWhenAnotherThreadAsks) {
  struct Begun : Progress {
    std::atomic<bool> begun{false};
    void update(double) override { begun = true; }
  } progress;
  std::chrono::steady_clock::time_point asked;
  std::thread user([&] {
    while (!progress.begun) std::this_thread::yield();
    asked = std::chrono::steady_clock::now();
    progress.stop();
  });
  const auto band = tryBand(strewn(1000, 0.06), region(2.0), 4.0 / 1024, progress);
  const auto returned = std::chrono::steady_clock::now();
  user.join();
  ASSERT_FALSE(band.ok());
  EXPECT_EQ(band.error().kind, ErrorKind::Interrupted);
  EXPECT_LT(std::chrono::duration<double>(returned - asked).count(), 1.0);
}

}  // namespace narrow_band_test
}  // namespace sdf::test
