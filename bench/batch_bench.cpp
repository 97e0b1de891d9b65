#include "batch_bench.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "handwritten.h"
#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "shapes.h"

namespace sdf::bench {
namespace {

constexpr std::size_t kPoints = 4096;  // in and out fit the second cache, as a mesher's would

struct Points {
  std::vector<float> x, y, z, out;

  Points() : x(kPoints), y(kPoints), z(kPoints), out(kPoints) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> coordinate(-kRegion, kRegion);
    for (auto* row : {&x, &y, &z})
      for (float& v : *row) v = coordinate(random);
  }
};

std::string oursName(int i) { return "batch/" + shapeName(i) + "/tape"; }
std::string theirsName(int i) { return "batch/" + shapeName(i) + "/handwritten"; }

void runTape(benchmark::State& state, const Tape& tape) {
  Points p;
  BatchEvaluator batch;
  for (auto _ : state) {
    batch.evaluate(tape, {.x = p.x.data(), .y = p.y.data(), .z = p.z.data()}, kPoints, p.out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kPoints);
}

void runLoop(benchmark::State& state, PointLoop loop) {
  Points p;
  for (auto _ : state) {
    loop(p.x.data(), p.y.data(), p.z.data(), p.out.data(), kPoints);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kPoints);
}

bool agrees(int i, const char* form, const Points& p) {
  // Sums of squares, differences and roots of numbers up to 16, each rounded to float; S3 adds twenty blends
  // in a row.
  constexpr double kRoundings = 60.0, kLargest = 16.0;
  constexpr double kTolerance = kRoundings * 0x1p-24 * kLargest;
  const Tape tape(measuringShape(i).distance);
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double exact = evaluate(tape, glm::dvec3(p.x[k], p.y[k], p.z[k]));
    if (std::abs(exact - p.out[k]) <= kTolerance) continue;
    std::fprintf(stderr, "%s, hand-written %s: %g at (%g, %g, %g), but the tape gives %g\n",
                 shapeName(i).c_str(), form, p.out[k], p.x[k], p.y[k], p.z[k], exact);
    return false;
  }
  return true;
}

}  // namespace

bool handwrittenAgrees() {
  bool all = true;
  Points p;
  for (int i = 0; i < kShapes; ++i) {
    handwritten(i).points(p.x.data(), p.y.data(), p.z.data(), p.out.data(), kPoints);
    all = agrees(i, "points", p) && all;
  }
  for (std::size_t k = 0; k < kPoints; ++k) p.x[k] = p.x[k - k % kBlock], p.y[k] = p.y[k - k % kBlock];
  for (int i = 0; i < kShapes; ++i) {
    for (std::size_t k = 0; k < kPoints; k += kBlock)
      handwritten(i).row(p.x[k], p.y[k], p.z.data() + k, p.out.data() + k, kBlock);
    all = agrees(i, "row", p) && all;
  }
  return all;
}

void registerBatch() {
  constexpr int kRepetitions = 15;
  constexpr double kSeconds = 0.1;
  for (int i = 0; i < kShapes; ++i) {
    const auto tape = std::make_shared<const Tape>(measuringShape(i).distance);
    const auto set = [](benchmark::internal::Benchmark* b) {
      b->UseRealTime()->MinTime(kSeconds)->Repetitions(kRepetitions)->ReportAggregatesOnly();
    };
    set(benchmark::RegisterBenchmark(oursName(i).c_str(),
                                     [tape](benchmark::State& s) { runTape(s, *tape); }));
    const PointLoop loop = handwritten(i).points;
    set(benchmark::RegisterBenchmark(theirsName(i).c_str(),
                                     [loop](benchmark::State& s) { runLoop(s, loop); }));
  }
}

void addBatchFigures(const Medians& medians, std::vector<Figure>& figures) {
  constexpr double kAsked = 0.4;
  for (const int i : {1, 2, 4})
    figures.push_back({"batch reading " + shapeName(i) + ", one thread: speed, hand-written = 1", true,
                       kAsked, medians.threadSeconds(theirsName(i)) / medians.threadSeconds(oursName(i))});
}

}  // namespace sdf::bench
