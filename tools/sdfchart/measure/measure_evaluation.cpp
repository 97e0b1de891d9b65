// Readings of the graph: points a second, and rounding, over the number of operations.
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/shapes.h"
#include "measurements.h"
#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdfchart/peers/shader_reading.h"

namespace sdf::chart {
namespace {

constexpr unsigned kSeed = 1;

struct PointsToRead {
  std::vector<float> x, y, z;

  PointsToRead(std::size_t count, const Box& box) {
    std::mt19937 random(kSeed);
    for (std::size_t i = 0; i < count; ++i)
      for (auto [row, axis] : {std::pair{&x, 0}, {&y, 1}, {&z, 2}})
        row->push_back(std::uniform_real_distribution<float>(static_cast<float>(box.min[axis]),
                                                             static_cast<float>(box.max[axis]))(random));
  }
  std::size_t size() const { return x.size(); }
  glm::dvec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  Rows rows() const { return {x.data(), y.data(), z.data()}; }
};

Expr ballsOf(int count) { return bench::balls(count, 0.06).distance; }

// A union of balls, its tape, and points to read it at.
struct SceneToRead {
  Tape tape;
  PointsToRead points;

  double operations() const { return static_cast<double>(tape.instructions().size()); }
};

// So many points that a reading takes some milliseconds; at least a batch.
PointsToRead pointsFor(const Tape& tape, const Box& box) {
  constexpr double kWork = 4e6;
  const double operations = static_cast<double>(tape.instructions().size());
  return {static_cast<std::size_t>(std::clamp(kWork / operations, double{kBatchPoints}, 4096.0)), box};
}

// In units of the last place of the largest number in play, a coordinate or the value.
void judge(const Tape& tape, const PointsToRead& points, const std::vector<float>& values, Row& row) {
  ErrorSum errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 p = points[i];
    const double exact = evaluate(tape, p);
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(exact)});
    errors.add(std::abs(values[i] - exact) / (0x1p-24 * std::exp2(std::ceil(std::log2(size)))));
  }
  errors.giveTo(row);
}

Measurement inDouble(const std::shared_ptr<const SceneToRead>& scene, Row row) {
  row.method = "double";
  constexpr std::size_t kFewer = 8;
  const std::size_t count = std::max<std::size_t>(scene->points.size() / kFewer, 32);
  row.items = static_cast<double>(count);
  return {row, [scene, count](Row*) {
            ScalarReading<double> reading;
            volatile double kept = 0.0;
            return secondsOfShort([&] {
              for (std::size_t i = 0; i < count; ++i) {
                const glm::dvec3 p = scene->points[i];
                reading.run(scene->tape, {p.x, p.y, p.z});
                kept = reading.output();
              }
            });
          }};
}

// The batch reading with one instruction set; 0: the machine's best.
Measurement inBatches(const std::shared_ptr<const SceneToRead>& scene, Row row, const std::string& method,
                      std::int64_t set) {
  row.method = method;
  row.items = static_cast<double>(scene->points.size());
  return {row, [scene, set](Row* judged) {
            hwy::SetSupportedTargetsForTest(set);
            BatchEvaluator batch;
            std::vector<float> values(scene->points.size());
            const auto read = [&] {
              batch.evaluate(scene->tape, scene->points.rows(), values.size(), values.data());
            };
            const double seconds = secondsOfShort(read);
            hwy::SetSupportedTargetsForTest(0);
            if (judged) judge(scene->tape, scene->points, values, *judged);
            return seconds;
          }};
}

// The instruction sets that the library is compiled for and the machine has, by name.
std::vector<std::pair<std::string, std::int64_t>> instructionSets() {
  std::vector<std::pair<std::string, std::int64_t>> sets;
  hwy::SetSupportedTargetsForTest(0);
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    const std::string name = BatchEvaluator::targetName();
    if (std::none_of(sets.begin(), sets.end(), [&](const auto& known) { return known.first == name; }))
      sets.emplace_back(name, left & -left);
  }
  hwy::SetSupportedTargetsForTest(0);
  return sets;
}

// So many times each point that a reading by OpenGL takes some milliseconds.
int timesFor(const SceneToRead& scene) {
  constexpr double kWork = 1e8;
  const double once = scene.operations() * static_cast<double>(scene.points.size());
  return static_cast<int>(std::clamp(kWork / once, 1.0, 64.0));
}

std::vector<glm::vec4> texels(const PointsToRead& points) {
  std::vector<glm::vec4> all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.emplace_back(points.x[i], points.y[i], points.z[i], 0.0f);
  return all;
}

// The shader of so many balls. Compiling takes Mesa about the 3/2 power of the operations, and cannot be
// stopped: a quarter of the balls goes first, and says whether the whole would take too long.
std::unique_ptr<ShaderReading> compiledShader(int count, const SceneToRead& scene, double mostSeconds) {
  constexpr int kSoonCompiled = 100;
  constexpr double kGrowth = 8.0;
  if (const int fewer = count / 4; fewer >= kSoonCompiled) {
    const double seconds = secondsOf([&] { compiledShader(fewer, scene, mostSeconds); });
    if (kGrowth * seconds > mostSeconds)
      throw std::runtime_error(
          formatted("OpenGL took %.2g s to compile %d balls; four times as many would take more than %g s",
                    seconds, fewer, mostSeconds));
  }
  return std::make_unique<ShaderReading>(ballsOf(count), texels(scene.points), timesFor(scene));
}

Measurement inShader(const std::shared_ptr<const SceneToRead>& scene, Row row, int count,
                     double compileSeconds) {
  row.method = "GLSL";
  row.items = static_cast<double>(scene->points.size()) * timesFor(*scene);
  return {row, [scene, count, compileSeconds,
                reading = std::make_shared<std::unique_ptr<ShaderReading>>()](Row* judged) {
            if (!*reading) *reading = compiledShader(count, *scene, compileSeconds);
            const double seconds = secondsOfShort([&] { (*reading)->run(); });
            if (judged) {
              judged->machine = ShaderReading::driver();
              judge(scene->tape, scene->points, (*reading)->values(), *judged);
            }
            return seconds;
          }};
}

// The tape that holds in a box around a point of the surface, a sixteenth of the region long.
std::shared_ptr<const SceneToRead> specialised(const Tape& tape) {
  const glm::dvec3 middle(0.06, 1.7 * std::sin(0.0), 0.0);  // on the first ball
  const Box box = Box{middle, middle}.grown(bench::kRegion / 16.0);
  ScalarReading<Interval> workspace;
  std::vector<Decision> decisions;
  evaluate(tape, box, workspace, decisions);
  const TapePtr shorter = tape.specialised(decisions.data(), 1);
  const Tape& found = shorter ? *shorter : tape;
  return std::make_shared<const SceneToRead>(SceneToRead{found, pointsFor(found, box)});
}

std::vector<Measurement> ofBalls(int count, double compileSeconds) {
  const Tape tape(ballsOf(count));
  const Box region = Box::centred(glm::dvec3(bench::kRegion));
  const auto scene = std::make_shared<const SceneToRead>(SceneToRead{tape, pointsFor(tape, region)});
  const Row row{.kind = "evaluation",
                .scene = "unions of balls",
                .setting = std::to_string(count) + " balls",
                .size = scene->operations()};
  std::vector<Measurement> all{inDouble(scene, row)};
  const std::string best = BatchEvaluator::targetName();
  for (const auto& [name, set] : instructionSets()) {
    all.push_back(inBatches(scene, row, name, set));
    all.back().row.isDefault = name == best;
  }
  all.push_back(inShader(scene, row, count, compileSeconds));
  const auto near = specialised(tape);
  all.push_back(inBatches(near, row, "specialised, best set", 0));
  all.back().row.evaluations = near->operations() / scene->operations();
  return all;
}

}  // namespace

std::vector<Batch> evaluationBatches(Extent extent, double compileSeconds) {
  const auto counts = byExtent<std::vector<int>>(extent, {1, 3, 10, 30, 100, 300, 1000, 3000, 10'000, 50'000},
                                                 {1, 10, 100, 1000, 10'000}, {1, 10});
  std::vector<Batch> batches;
  for (const int count : counts)
    batches.push_back({.subject = "evaluation, " + std::to_string(count) + " balls",
                       .weight = 1.0 + count / 5000.0,
                       .runs = byExtent(extent, 9, 3, 1),
                       .budget = 10.0,
                       .make = [=] { return ofBalls(count, compileSeconds); }});
  return batches;
}

}  // namespace sdf::chart
