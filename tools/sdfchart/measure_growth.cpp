// How the time of each stage of meshing, and the memory, grow.
#include <map>
#include <set>

#include "bench/shapes.h"
#include "measurements.h"
#include "memory_peak.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators.h"
#include "sdf/shape/solids.h"

namespace sdf::chart {
namespace {

constexpr const char* kWhole = "whole";
constexpr const char* kStages[] = {kWhole,      "sampling",  "extraction", "projection", "creases",
                                   "balancing", "measuring", "normals",    "colouring"};

// What is meshed in one go: parts, each by itself.
struct Task {
  std::vector<Shape> parts;
  double voxel;
};

// One run of a task gives the time of every stage: it is run anew when a stage is asked for once more.
class StageTimes {
 public:
  explicit StageTimes(std::function<Task()> make) : make_(std::move(make)) {}

  double seconds(const std::string& stage) {
    if (seconds_.empty() || !served_.insert(stage).second) {
      run();
      served_ = {stage};
    }
    return seconds_[stage];
  }
  double memory() const { return memory_; }

 private:
  void run() {
    if (!task_) task_ = make_();
    seconds_.clear();
    const MemoryPeak peak;
    seconds_[kWhole] = secondsOf([&] {
      for (const Shape& part : task_->parts) {
        Progress progress;
        const MeshedShape meshed = take(meshShape(part, "part", {.voxelSize = task_->voxel}, progress));
        for (const auto& [stage, seconds] : meshed.stageSeconds) seconds_[stage] += seconds;
      }
    });
    memory_ = peak.bytes();
  }

  std::function<Task()> make_;
  std::optional<Task> task_;
  std::map<std::string, double> seconds_;
  std::set<std::string> served_;
  double memory_ = kNone;
};

std::vector<Measurement> ofTask(const std::string& scene, const std::string& unit, int size,
                                std::function<Task()> make) {
  const auto times = std::make_shared<StageTimes>(std::move(make));
  std::vector<Measurement> all;
  for (const std::string stage : kStages) {
    Row row{.kind = "growth", .scene = scene, .method = stage, .setting = std::to_string(size) + " " + unit};
    row.size = size;
    row.items = 1.0;
    all.push_back({row, [times, stage](Row* judged) {
                     const double seconds = times->seconds(stage);
                     if (judged && stage == kWhole) judged->memory = times->memory();
                     return seconds;
                   }});
  }
  return all;
}

}  // namespace

std::vector<Batch> growthBatches(Extent extent) {
  std::vector<Batch> batches;
  const auto add = [&](const char* scene, const char* unit, const std::vector<int>& sizes, auto make) {
    for (const int size : sizes)
      batches.push_back({.subject = std::string("growth ") + scene,
                         .weight = byExtent(extent, 5.0, 0.7, 0.3),
                         .runs = byExtent(extent, 5, 3, 1),
                         .budget = byExtent(extent, 60.0, 6.0, 0.0),
                         .together = true,
                         .make = [=] { return ofTask(scene, unit, size, [=] { return make(size); }); }});
  };
  using Sizes = std::vector<int>;
  add("over the voxels a side (drilled box)", "voxels",
      byExtent<Sizes>(extent, {16, 32, 64, 128, 256, 512}, {16, 32, 64, 128}, {16}), [](int n) {
        return Task{{bench::measuringShape(1)}, 2.0 / n};
      });
  add("over the number of balls (64 voxels)", "balls",
      byExtent<Sizes>(extent, {1, 10, 100, 1000, 10'000}, {1, 10, 100, 1000}, {10}), [](int n) {
        return Task{{bench::balls(n, 0.06)}, 3.5 / 64.0};
      });
  add("over the number of parts", "parts", byExtent<Sizes>(extent, {1, 4, 16, 64}, {1, 4, 16}, {1}),
      [](int n) {
        return Task{std::vector<Shape>(static_cast<std::size_t>(n), bench::measuringShape(2)), 4.0 / 32.0};
      });
  return batches;
}

}  // namespace sdf::chart
