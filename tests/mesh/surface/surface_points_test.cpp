#include "sdf/mesh/surface/surface_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <random>
#include <set>

#include "mesh/scenes.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"

namespace sdf::test {
namespace surface_points_test {

// Batches of points strewn over the leaf of one vertex after another, so that runs are cut where the leaf
// changes.
std::vector<glm::vec3> fullLeaves(const RawSurface& surface, double h, std::size_t leaves, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> inside(0.01, 7.99);
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < leaves; ++i) {
    const glm::dvec3 vertex(surface.points[i * 977 % surface.points.size()]);
    const glm::dvec3 origin = glm::floor(vertex / h / 8.0) * 8.0;
    for (std::size_t k = 0; k < kBatchPoints; ++k)
      points.emplace_back((origin + glm::dvec3{inside(random), inside(random), inside(random)}) * h);
  }
  return points;
}

// The vertices, each moved by up to a voxel.
std::vector<glm::vec3> shaken(const RawSurface& surface, double h, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> offset(static_cast<float>(-h), static_cast<float>(h));
  std::vector<glm::vec3> points = surface.points;
  for (glm::vec3& p : points) p += glm::vec3{offset(random), offset(random), offset(random)};
  return points;
}

constexpr double kVoxel = 1.0 / 32;

// Painted walls of unknown slope, two voxels apart. The middle between two, where the colour changes, lies
// half a voxel before the end of a leaf: beyond its last samples, but where its points may be.
Shape walls() {
  std::vector<Shape> walls;
  for (int k = -3; k <= 2; ++k) {
    const Expr x = position().x - (0.5 * k + 0.25 - 0.5 * kVoxel);
    const double half = 0.25 - kVoxel;
    walls.push_back(field(square(x) - half * half).paint({.color = {Expr((k + 4) / 8.0), 0.5, 0.5}}));
  }
  return unite(walls) & box({1.5, 0.3, 0.3});
}

struct SeenRun {
  std::size_t first, count;
  const Tape* tape;
  auto operator<=>(const SeenRun&) const = default;
};

struct PointScene {
  TapePtr tape;
  LocalTapes whole;
  NarrowBand band;
  std::vector<glm::vec3> points;

  PointScene(const Shape& shape, std::size_t leaves) : tape(tapeOf(shape)), whole(wholeTapes(tape)) {
    Progress progress;
    band = sampleNarrowBand(Model(shape).at(), {kVoxel, region(2.0), kPlentyOfMemory}, progress).value();
    const RawSurface surface = band.extract();
    points = fullLeaves(surface, kVoxel, leaves, 7);
    points.insert(points.end(), surface.points.begin(), surface.points.end());
    const auto near = shaken(surface, kVoxel, 8);
    points.insert(points.end(), near.begin(), near.end());
  }
  std::vector<SeenRun> runs() const {
    std::vector<SeenRun> seen;
    std::mutex guard;
    Progress progress;
    forEachRun(
        points.size(), [&](std::size_t i) { return points[i]; }, BandField(band, whole), progress,
        [&](const PointRun& run) {
          const std::lock_guard lock(guard);
          seen.push_back({run.first, run.count, run.tapes.surface.get()});
        });
    return seen;
  }
};

Shape manyBalls() { return strewn(300, 0.09, true); }

// A local tape leaves out the parts of a length that are nothing, and with them a square root, which the
// batch reading takes to within 4 ulp: of lengths below 4 here.
constexpr float kRootError = 4 * 0x1p-22f;

struct Comparison {
  std::size_t wrong = 0, near = 0, fullRuns = 0, runs = 0;
  std::size_t instructions = 0;  // of the local distance tapes, summed over the runs
};

// Every output of every run's tapes against the whole scene's: near the surface, colours and materials to the
// bit.
Comparison compareWithWhole(const PointScene& scene) {
  constexpr int kOutputs = static_cast<int>(SurfaceOutput::Count);
  std::mutex guard;
  Comparison c;
  Progress progress;
  forEachRun(
      scene.points.size(), [&](std::size_t i) { return scene.points[i]; }, BandField(scene.band, scene.whole),
      progress,
      [&](const PointRun& run) {
        PointRows at;
        float local[kOutputs + 1][kBatchPoints], whole[kOutputs + 1][kBatchPoints];
        for (std::size_t i = 0; i < run.count; ++i) at.set(i, scene.points[run.first + i]);
        float *l[kOutputs], *w[kOutputs];
        for (int k = 0; k < kOutputs; ++k) l[k] = local[k], w[k] = whole[k];
        run.batch.evaluate(*run.tapes.surface, at.rows(), run.count, l);
        run.batch.evaluate(*run.tapes.distance, at.rows(), run.count, local[kOutputs]);
        run.batch.evaluate(*scene.tape, at.rows(), run.count, w);
        std::copy_n(whole[0], run.count, whole[kOutputs]);
        const std::lock_guard lock(guard);
        for (int k = 0; k <= kOutputs; ++k) {
          const float tolerance = k == 0 || k == kOutputs ? kRootError : 0.0f;
          for (std::size_t i = 0; i < run.count; ++i) {
            // Farther off a union's operands may be passed over: what is left is farther, too.
            const bool far = whole[0][i] > 2.0f * static_cast<float>(run.voxel);
            const bool same = std::abs(local[k][i] - whole[k][i]) <= tolerance;
            c.wrong += far ? !(local[0][i] >= whole[0][i] - kRootError) : !same;
            c.near += !far;
          }
        }
        c.fullRuns += run.count == kBatchPoints;
        c.instructions += run.tapes.distance->instructions().size();
        ++c.runs;
      });
  return c;
}

TEST(ForEachRun, LocalTapesSayWhatTheWholeSceneSays) {
  const PointScene scene(manyBalls(), 40);
  const Comparison c = compareWithWhole(scene);
  EXPECT_EQ(c.wrong, 0u);
  EXPECT_GT(c.near, 6 * scene.points.size() / 3) << "of six outputs, most points are to be near the surface";
  EXPECT_GT(c.fullRuns, 20u) << "no run was cut at the size of a batch";
  // A leaf of 8 voxels, a quarter wide, feels a few of the 300 balls.
  EXPECT_LT(c.instructions, c.runs * scene.tape->instructions().size() / 10);
}

TEST(ForEachRun, LocalTapesHoldBetweenALeafsLastSamplesAndTheNextLeaf) {
  const PointScene scene(walls(), 40);
  EXPECT_EQ(compareWithWhole(scene).wrong, 0u);
}

TEST(ForEachRun, VisitsEveryPointOnceInChunksThatKeepTheirOrder) {
  const PointScene scene(manyBalls(), 20);
  std::vector<int> visits(scene.points.size());
  std::vector<std::size_t> reached((scene.points.size() + kRunChunk - 1) / kRunChunk);
  for (const SeenRun& run : scene.runs()) {
    ASSERT_GE(run.count, 1u);
    ASSERT_LE(run.count, kBatchPoints);
    const std::size_t chunk = run.first / kRunChunk, last = run.first + run.count - 1;
    ASSERT_EQ(last / kRunChunk, chunk);
    ASSERT_EQ(run.first, chunk * kRunChunk + reached[chunk]);
    reached[chunk] += run.count;
    for (std::size_t i = run.first; i <= last; ++i) ++visits[i];
  }
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(visits.size()));
}

TEST(ForEachRun, RunsDoNotDependOnTheNumberOfThreads) {
  const PointScene scene(manyBalls(), 20);
  auto runsWith = [&](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    auto runs = scene.runs();
    std::sort(runs.begin(), runs.end());
    return runs;
  };
  EXPECT_EQ(runsWith(1), runsWith(4));
}

TEST(ForEachGroupedRun, VisitsEveryPointOnceWithTheTapesThatHoldThere) {
  const PointScene scene(manyBalls(), 20);
  std::vector<glm::vec3> points = scene.points;
  std::shuffle(points.begin(), points.end(), std::mt19937(9));
  const BandField field(scene.band, scene.whole);
  std::vector<int> visits(points.size());
  std::mutex guard;
  std::size_t wrong = 0, again = 0;
  std::map<std::size_t, std::set<const Tape*>> seen;  // by chunk: tapes whose last run was not full
  Progress progress;
  forEachGroupedRun(points, field, progress, [&](const PointRun& run, const std::size_t* which) {
    const std::lock_guard lock(guard);
    const auto finder = field.finder();
    for (std::size_t k = 0; k < run.count; ++k) {
      ++visits[which[k]];
      wrong += finder->at(points[which[k]]).tapes.surface != run.tapes.surface ||
               run.points.at(k) != points[which[k]];
    }
    auto& short_ = seen[which[0] / kRunChunk];
    again += short_.contains(run.tapes.surface.get());
    if (run.count < kBatchPoints) short_.insert(run.tapes.surface.get());
  });
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(again, 0u) << "points that share their tapes were not read together";
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(visits.size()));
}

TEST(ForEachRun, FarFromEveryLeafTheFallbackServes) {
  const TapePtr tape = tapeOf(sphere(1.0));
  const LocalTapes whole = wholeTapes(tape);
  const NarrowBand band = bandOf(sphere(1.0), region(1.0), 1.0 / 32);
  const std::vector<glm::vec3> points{{0, 0, 0}, {100, 0, 0}, {1, 0, 0}, {-1e12f, 0, 0}, {NAN, 0, 0}};
  std::vector<const Tape*> used(points.size());
  Progress progress;
  forEachRun(
      points.size(), [&](std::size_t i) { return points[i]; }, BandField(band, whole), progress,
      [&](const PointRun& run) {
        for (std::size_t i = 0; i < run.count; ++i) used[run.first + i] = run.tapes.surface.get();
      });
  EXPECT_EQ(used[0], whole.surface.get());
  EXPECT_EQ(used[1], whole.surface.get());
  EXPECT_NE(used[2], whole.surface.get());
  EXPECT_EQ(used[3], whole.surface.get());
  EXPECT_EQ(used[4], whole.surface.get());
}

TEST(ForEachRun, DoesNothingOnceStopped) {
  const PointScene scene(manyBalls(), 0);
  Progress progress;
  progress.stop();
  int runs = 0;
  forEachRun(
      scene.points.size(), [&](std::size_t i) { return scene.points[i]; }, BandField(scene.band, scene.whole),
      progress, [&](const PointRun&) { ++runs; });
  EXPECT_EQ(runs, 0);
}

struct Refined {
  std::vector<glm::vec3> positions, normals;
};

Refined refined(const Shape& shape, double h) {
  NarrowBand band = bandOf(shape, shape.bounds, h);
  const LocalTapes whole = wholeTapes(tapeOf(shape));
  Progress progress;
  Refined r{band.extract().points, {}};
  refineVertices(r.positions, r.normals, BandField(band, whole), progress);
  return r;
}

// Rounding of a point's three coordinates, and of a distance computed in some ten operations on numbers of
// size m.
double pointRounding(double m) { return (std::sqrt(3.0) + 10.0) * m * kRoundoff; }

TEST(RefineVertices, PutsVerticesOnASphereWithItsNormals) {
  const double r = 0.8, h = 1.0 / 16;
  const glm::dvec3 c(1.1, -0.3, 0.2);
  const double rounding = pointRounding(r + glm::length(c));
  const Refined s = refined(translate(sphere(r), c), h);
  ASSERT_GT(s.positions.size(), 500u);
  for (std::size_t i = 0; i < s.positions.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(s.positions[i]) - c;
    ASSERT_NEAR(glm::length(d), r, rounding);
    ASSERT_LT(glm::length(glm::dvec3(s.normals[i]) - d / glm::length(d)), rounding / r + 8.0 * kRoundoff);
  }
}

TEST(RefineVertices, PutsVerticesOnATorusWithItsNormals) {
  const double major = 0.8, minor = 0.3;
  const double rounding = pointRounding(major + minor);
  const Refined s = refined(torus(major, minor), 1.0 / 32);
  for (std::size_t i = 0; i < s.positions.size(); ++i) {
    const glm::dvec3 p(s.positions[i]);
    const double across = std::hypot(p.x, p.z);
    const glm::dvec3 ring = glm::dvec3(p.x, 0.0, p.z) * (major / across), d = p - ring;
    ASSERT_NEAR(glm::length(d), minor, rounding);
    ASSERT_LT(glm::length(glm::dvec3(s.normals[i]) - d / glm::length(d)), rounding / minor + 8.0 * kRoundoff);
  }
}

TEST(RefineVertices, GivesABoxTheExactNormalsOfItsFaces) {
  const glm::dvec3 half(0.5, 0.41, 0.3);
  const double h = 1.0 / 32;
  const Refined s = refined(box(half), h);
  std::size_t onFaces = 0;
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const glm::dvec3 p = glm::abs(glm::dvec3(s.positions[i]));
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (p[u] > half[u] - 2.0 * h || p[v] > half[v] - 2.0 * h) continue;
      glm::vec3 face(0.0f);
      face[axis] = std::copysign(1.0f, s.positions[i][axis]);
      ASSERT_EQ(s.normals[i], face);
      ASSERT_NEAR(p[axis], half[axis], pointRounding(half[axis]));
      ++onFaces;
    }
  EXPECT_GT(onFaces, s.positions.size() / 2);
}

TEST(RefineVertices, LeavesPointsThatLieExactlyOnAFaceWithItsNormal) {
  const glm::vec3 half(0.5f, 0.41f, 0.3f);
  const Shape shape = box(glm::dvec3(half));
  const NarrowBand band = bandOf(shape, shape.bounds, 1.0 / 32);
  std::vector<glm::vec3> positions, expected, normals;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f})
      for (const float u : {0.0f, 0.25f, -0.77f})
        for (const float v : {0.0f, -0.5f}) {
          glm::vec3 p, n(0.0f);
          p[axis] = side * half[axis];
          p[(axis + 1) % 3] = u * half[(axis + 1) % 3];
          p[(axis + 2) % 3] = v * half[(axis + 2) % 3];
          n[axis] = side;
          positions.push_back(p);
          expected.push_back(n);
        }
  const std::vector<glm::vec3> before = positions;
  Progress progress;
  refineVertices(positions, normals, BandField(band, wholeTapes(tapeOf(shape))), progress);
  EXPECT_EQ(positions, before);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_EQ(normals[i], expected[i]) << before[i].x << ' ' << before[i].y << ' ' << before[i].z;
}

TEST(RefineVertices, MovesNoVertexFartherThanAVoxel) {
  // |f| / |grad f| overshoots by far where the slope is small: near the middle of a flat-bottomed field.
  const Vec3E p = position();
  const Shape shape = field(pow(dot(p, p), 4.0) - 0.01, region(1.0));
  const double h = 1.0 / 16;
  NarrowBand band = bandOf(shape, shape.bounds, h);
  std::vector<glm::vec3> positions = band.extract().points, normals;
  for (int i = 1; i <= 20; ++i) positions.emplace_back(0.03f * i, 0.0f, 0.0f);
  const auto before = positions;
  Progress progress;
  refineVertices(positions, normals, BandField(band, wholeTapes(tapeOf(shape))), progress);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    ASSERT_LE(glm::distance(positions[i], before[i]), h * (1.0 + 4.0 * kRoundoff));
    ASSERT_NEAR(glm::length(normals[i]), 1.0, 4.0 * kRoundoff);
  }
}

}  // namespace surface_points_test
}  // namespace sdf::test
