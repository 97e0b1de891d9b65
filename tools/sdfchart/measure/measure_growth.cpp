// How the time of each stage of meshing, and the memory, grow.
#include <algorithm>
#include <map>
#include <set>

#include "bench/shapes.h"
#include "measurements.h"
#include "memory_peak.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

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

// The most that the process holds in each stage, beyond what it held when this was made.
class StageMemory : public Progress {
 public:
  void beginStage(std::string_view name) override {
    endStage();
    stage_ = name;
  }
  // By stage; of stages that come several times, the most.
  const std::map<std::string, double>& taken() {
    endStage();
    return bytes_;
  }

 private:
  void endStage() {
    const double bytes = peak_.restart();
    double& most = bytes_.emplace(stage_, bytes).first->second;
    most = std::max(most, bytes);
  }

  MemoryPeak peak_;
  std::string stage_ = "before";
  std::map<std::string, double> bytes_;
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
  double memory(const std::string& stage) const { return memory_.at(stage); }

 private:
  void run() {
    if (!task_) task_ = make_();
    seconds_.clear();
    StageMemory memory;
    seconds_[kWhole] = secondsOf([&] {
      for (const Shape& part : task_->parts) {
        const MeshedShape meshed = take(meshShape(part, "part", {.voxelSize = task_->voxel}, memory));
        for (const auto& [stage, seconds] : meshed.stageSeconds) seconds_[stage] += seconds;
      }
    });
    memory_ = memory.taken();
    memory_[kWhole] = std::ranges::max_element(memory_, {}, [](const auto& m) { return m.second; })->second;
  }

  std::function<Task()> make_;
  std::optional<Task> task_;
  std::map<std::string, double> seconds_;
  std::set<std::string> served_;
  std::map<std::string, double> memory_;
};

std::vector<Measurement> ofTask(const std::string& scene, const std::string& setting, double size,
                                std::function<Task()> make) {
  const auto times = std::make_shared<StageTimes>(std::move(make));
  std::vector<Measurement> all;
  for (const std::string stage : kStages) {
    Row row{.kind = "growth", .scene = scene, .method = stage, .setting = setting, .size = size};
    row.items = 1.0;
    all.push_back({row, [times, stage](Row* judged) {
                     const double seconds = times->seconds(stage);
                     if (judged) judged->memory = times->memory(stage);
                     return seconds;
                   }});
  }
  return all;
}

}  // namespace

std::vector<Batch> growthBatches(Extent extent) {
  std::vector<Batch> batches;
  // `sizeOf` says how large a task is, by what the chart's axis counts.
  const auto add = [&](const char* scene, const char* unit, const std::vector<int>& counts, auto make,
                       auto sizeOf) {
    for (const int count : counts)
      batches.push_back({.subject = std::string("growth ") + scene,
                         .weight = byExtent(extent, 5.0, 0.7, 0.3),
                         .runs = byExtent(extent, 5, 3, 1),
                         .budget = byExtent(extent, 60.0, 6.0, 0.0),
                         .together = true,
                         .make = [=] {
                           return ofTask(scene, std::to_string(count) + " " + unit, sizeOf(count),
                                         [=] { return make(count); });
                         }});
  };
  using Sizes = std::vector<int>;
  const auto count = [](int n) { return static_cast<double>(n); };
  const auto balls = [](int n) { return bench::balls(n, 0.06); };
  add(
      "over the voxels a side (drilled box)", "voxels",
      byExtent<Sizes>(extent, {16, 32, 64, 128, 256, 512}, {16, 32, 64, 128}, {16}),
      [](int n) {
        return Task{{bench::measuringShape(1)}, 2.0 / n};
      },
      count);
  add(
      "over the operations (unions of balls, 64 voxels)", "balls",
      byExtent<Sizes>(extent, {1, 10, 100, 1000, 10'000}, {1, 10, 100, 1000}, {10}),
      [balls](int n) {
        return Task{{balls(n)}, 3.5 / 64.0};
      },
      [balls](int n) { return static_cast<double>(Tape(balls(n).distance).instructions().size()); });
  add(
      "over the number of parts (blended balls, 32 voxels)", "parts",
      byExtent<Sizes>(extent, {1, 4, 16, 64}, {1, 4, 16}, {1}),
      [](int n) {
        return Task{std::vector<Shape>(static_cast<std::size_t>(n), bench::measuringShape(2)), 4.0 / 32.0};
      },
      count);
  return batches;
}

}  // namespace sdf::chart
