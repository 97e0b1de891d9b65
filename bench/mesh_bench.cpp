#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "benches.h"
#include "dense.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/creases/tips.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/uncross.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/refine/balance.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"
#include "shapes.h"

namespace sdf::bench {
namespace {

constexpr int kResolution = 512;
// Shapes that are meshed by both, with a bound on the slope of their distance: S4's is |(5, 5, 5)| √2 / 8
// < 1.54.
constexpr int kCompared = 5;
constexpr double kSlope[kCompared] = {1.0, 1.0, 1.0, 1.54, 1.0};

// From the shape to triangles, as the mesher does it.
std::size_t meshSparsely(const Shape& shape, const Box& bounds, double voxelSize) {
  Progress progress;
  Result<NarrowBand> band = sampleNarrowBand(Model(shape).at(), {voxelSize, bounds, kInfinity}, progress);
  if (!band) {
    std::fprintf(stderr, "%s\n", band.error().message.c_str());
    std::exit(1);
  }
  return band->extract().triangles.size();
}

// What a shape is meshed at to be as accurate as asked, from its samples to its final vertices.
struct Accurate {
  int n;
  double rms;   // asked, scene units
  double time;  // asked, as a share of the dense baseline's
};
constexpr Accurate kAccurate[kCompared] = {{350, 6.0e-6, 0.85},
                                           {96, 7.7e-5, 0.072},
                                           {188, 6.2e-5, 0.19},
                                           {232, 6.5e-5, 0.30},
                                           {196, 4.2e-4, 0.0085}};

struct Sharp {
  std::unique_ptr<BandField> field;
  FeatureMesh mesh;
};

// Seconds of each stage of one mesh.
constexpr std::array kStages = {"sampling", "extraction", "projection", "creases", "tips", "balancing"};
class StageClock {
 public:
  void end() {
    const Clock::time_point now = Clock::now();
    seconds.push_back(std::chrono::duration<double>(now - std::exchange(last_, now)).count());
  }
  std::vector<double> seconds;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

Sharp meshSharply(NarrowBand& band, const ModelTapes& model, const Box& bounds, double voxel,
                  Progress& progress, StageClock& clock) {
  band = sampleNarrowBand(model, {voxel, bounds, kInfinity}, progress).value();
  Sharp sharp{std::make_unique<BandField>(band, LocalTapes{model.whole(), model.whole()->firstOutputOnly()}),
              {}};
  clock.end();
  RawSurface raw = band.extract();
  clock.end();
  const std::vector<glm::vec3> extracted = raw.points;
  std::vector<glm::vec3> normals;
  refineVertices(raw.points, normals, *sharp.field, progress);
  clock.end();
  auto [mesh, doubtful] =
      sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, *sharp.field, progress);
  clock.end();
  placeTips(mesh, normals, doubtful, *sharp.field, progress);
  clock.end();
  const std::vector<glm::vec3> before = mesh.positions;
  balanceVertices(mesh, normals);
  uncrossMoved(mesh, doubtful, before);
  clock.end();
  sharp.mesh = std::move(mesh);
  return sharp;
}

Box region() { return Box::centred(glm::dvec3(kRegion)); }

std::string sparseName(int i, int n) { return "mesh/" + shapeName(i) + "/" + std::to_string(n) + "/sparse"; }
std::string sharpName(int i) {
  return "mesh/" + shapeName(i) + "/" + std::to_string(kAccurate[i].n) + "/sharp";
}
std::string denseName(int i) { return "mesh/" + shapeName(i) + "/" + std::to_string(kResolution) + "/dense"; }
std::string ballsName(int count) { return "mesh/" + std::to_string(count) + " balls/256"; }

template <class Work>
void add(const std::string& name, int repetitions, const Work& work) {
  addBenchmark(name, repetitions, [work](benchmark::State& state) {
    std::size_t triangles = 0;
    for (auto _ : state) triangles = work();
    state.counters["triangles"] = static_cast<double>(triangles);
  })->Unit(benchmark::kMillisecond);
}

void addSparse(int i, int n, int repetitions) {
  add(sparseName(i, n), repetitions,
      [shape = measuringShape(i), n] { return meshSparsely(shape, region(), 2.0 * kRegion / n); });
}

// With the Progress and the tapes made anew, as a program would.
struct SharpRun {
  explicit SharpRun(int i) : model(Model(measuringShape(i)).at()) {
    result = meshSharply(band, model, region(), 2.0 * kRegion / kAccurate[i].n, progress, clock);
  }
  Progress progress;
  NarrowBand band;
  ModelTapes model;
  StageClock clock;
  Sharp result;
};

std::size_t sharpTriangles(int i) { return SharpRun(i).result.mesh.triangles.size(); }

double rmsOf(int i) {
  SharpRun run(i);
  MeshStats stats;
  measureDistance(run.result.mesh.positions, run.result.mesh.triangles, *run.result.field, run.progress,
                  stats);
  return stats.rmsDistance;
}

}  // namespace

bool meshersAgree() {
  constexpr int kCoarse = 128;
  // A sample within rounding of zero may lie inside for one and outside for the other: a few cells in ten
  // thousand.
  constexpr double kShare = 1e-3;
  bool all = true;
  for (int i = 0; i < kCompared; ++i) {
    const double sparse = meshSparsely(measuringShape(i), region(), 2.0 * kRegion / kCoarse);
    const double dense = meshDensely(handwritten(i).row, kCoarse, kSlope[i]).triangles.size();
    if (sparse > 0.0 && std::abs(sparse - dense) <= kShare * dense) continue;
    std::fprintf(stderr, "%s at N = %d: %g triangles sparsely, %g densely\n", shapeName(i).c_str(), kCoarse,
                 sparse, dense);
    all = false;
  }
  return all;
}

void registerMeshing() {
  constexpr int kSmooth = 2, kMany = 4;
  for (int i = 0; i < kCompared; ++i) {
    const int repetitions = i == kSmooth || i == kMany ? 3 : 7;  // the dense ones take seconds
    addSparse(i, kResolution, 7);
    add(sharpName(i), 7, [i] { return sharpTriangles(i); });
    add(denseName(i), repetitions,
        [i] { return meshDensely(handwritten(i).row, kResolution, kSlope[i]).triangles.size(); });
  }
  for (const int i : {0, 1, kMany}) addSparse(i, kResolution / 2, 9), addSparse(i, kResolution * 2, 5);
  for (const auto& [count, radius] : {std::pair{10, 0.6}, {1000, 0.06}})
    add(ballsName(count), 9,
        [shape = balls(count, radius)] { return meshSparsely(shape, shape.bounds, 2.0 * kRegion / 256); });
}

void addMeshingFigures(const Medians& medians, std::vector<Figure>& figures) {
  constexpr double kGrowth = 4.6, kManyBalls = 1.6, kSparse = 60.0;
  for (int i = 0; i < kCompared; ++i)
    figures.push_back({"meshing " + shapeName(i) + ", N = 512: speed, dense baseline = 1", true,
                       i == 4 ? kSparse : 1.0,
                       medians.seconds(denseName(i)) / medians.seconds(sparseName(i, kResolution))});
  for (int i = 0; i < kCompared; ++i) {
    const std::string what = "sharp mesh of " + shapeName(i) + ", N = " + std::to_string(kAccurate[i].n);
    figures.push_back({what + ": time, dense baseline at 512 = 1", false, kAccurate[i].time,
                       medians.seconds(sharpName(i)) / medians.seconds(denseName(i))});
    figures.push_back({what + ": RMS distance", false, kAccurate[i].rms, rmsOf(i)});
  }
  for (const int i : {0, 1, 4})
    for (const int n : {kResolution / 2, kResolution})
      figures.push_back({"meshing " + shapeName(i) + ", N = " + std::to_string(n) + " to " +
                             std::to_string(2 * n) + ": times the cost",
                         false, kGrowth,
                         medians.seconds(sparseName(i, 2 * n)) / medians.seconds(sparseName(i, n))});
  figures.push_back({"meshing, N = 256, 10 to 1000 balls of one total area: times the cost", false,
                     kManyBalls, medians.seconds(ballsName(1000)) / medians.seconds(ballsName(10))});
}

void printStages() {
  constexpr int kRuns = 7;
  std::printf("\nmedian milliseconds of a sharp mesh\n%-12s", "");
  for (const char* stage : kStages) std::printf(" %11s", stage);
  std::printf("\n");
  for (int i = 0; i < kCompared; ++i) {
    std::array<std::array<double, kRuns>, kStages.size()> seconds{};
    for (int run = 0; run < kRuns; ++run) {
      const SharpRun one(i);
      for (std::size_t k = 0; k < kStages.size(); ++k) seconds[k][run] = one.clock.seconds[k];
    }
    std::printf("%s, N = %-4d", shapeName(i).c_str(), kAccurate[i].n);
    for (auto& times : seconds) {
      std::ranges::nth_element(times, times.begin() + kRuns / 2);
      std::printf(" %11.2f", 1e3 * times[kRuns / 2]);
    }
    std::printf("\n");
  }
}

}  // namespace sdf::bench
