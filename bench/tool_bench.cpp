#include <cstdio>
#include <filesystem>
#include <limits>

#include "benches.h"
#include "exporter.h"
#include "handwritten.h"
#include "shapes.h"

namespace sdf::bench {
namespace {

const char* const kMetals = "sdf2gltf metals.lua";

// A union of so many balls in a script; together they have one area, and the smallest are two voxels wide.
constexpr int kBalls[] = {2000, 20000};
std::string ballsName(int count) { return "sdf2gltf " + std::to_string(count) + " balls"; }

std::string sample(const std::string& name) { return SDF_SAMPLES "/" + name; }

// Peak memory in MB of an export at N = 512, as the exporter reports it; NaN if it fails.
double peakMegabytes(const std::string& scene) {
  const std::optional<Exported> done = exported({scene, "--voxel-size", std::to_string(2.0 * kRegion / 512)});
  return done ? done->peakMegabytes : std::numeric_limits<double>::quiet_NaN();
}

// The scene in samples/bench that belongs to a shape: its name begins with the shape's.
std::string sceneOf(int i) {
  const std::string start = "s" + std::to_string(i + 1) + "_";
  std::error_code ignored;
  for (const auto& file : std::filesystem::directory_iterator(sample("bench"), ignored))
    if (file.path().filename().string().starts_with(start)) return file.path();
  return sample("bench/" + start);
}

void add(const std::string& name, const std::vector<std::string>& words) {
  addBenchmark(name, 7, [words](benchmark::State& state) {
    const WorkFolder folder;
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", folder / "out.glb", "--quiet"});
    for (auto _ : state)
      if (runExporter(all) != 0) state.SkipWithError("the export failed");
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

void registerTool() {
  add(kMetals, {sample("metals.lua")});
  for (const int count : kBalls)
    add(ballsName(count), {sample("bench/many_balls.lua"), "-D", "count=" + std::to_string(count)});
}

void addToolFigures(const Medians& medians, std::vector<Figure>& figures) {
  constexpr double kSeconds = 0.5, kMegabytes = 500.0;
  for (int i = 0; i < kShapes; ++i)
    figures.push_back({"peak memory of sdf2gltf, " + shapeName(i) + ", N = 512: MB", false, kMegabytes,
                       peakMegabytes(sceneOf(i))});
  figures.push_back({"sdf2gltf metals.lua: seconds", false, kSeconds, medians.seconds(kMetals)});
  const double few = medians.seconds(ballsName(kBalls[0])), many = medians.seconds(ballsName(kBalls[1]));
  std::printf("sdf2gltf of 2,000 balls: %.2f s; of 20,000: %.2f s\n", few, many);
  figures.push_back(
      {"sdf2gltf, 2,000 to 20,000 balls of one total area: times the cost", false, 4.0, many / few});
}

}  // namespace sdf::bench
