#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "benches.h"
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

// Runs read(points), which fills their `out`.
template <class Read>
void add(const std::string& name, Read read) {
  constexpr int kRepetitions = 15;
  constexpr double kSeconds = 0.1;
  addBenchmark(name, kRepetitions, [read](benchmark::State& state) {
    Points p;
    for (auto _ : state) {
      read(p);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * kPoints);
  })->MinTime(kSeconds);
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
  for (int i = 0; i < kShapes; ++i) {
    const auto tape = std::make_shared<const Tape>(measuringShape(i).distance);
    const auto batch = std::make_shared<BatchEvaluator>();
    add(oursName(i), [tape, batch](Points& p) {
      batch->evaluate(*tape, {.x = p.x.data(), .y = p.y.data(), .z = p.z.data()}, kPoints, p.out.data());
    });
    const PointLoop loop = handwritten(i).points;
    add(theirsName(i),
        [loop](Points& p) { loop(p.x.data(), p.y.data(), p.z.data(), p.out.data(), kPoints); });
  }
}

void addBatchFigures(const Medians& medians, std::vector<Figure>& figures) {
  constexpr double kAsked = 0.4;
  for (const int i : {1, 2, 4})
    figures.push_back({"batch reading " + shapeName(i) + ", one thread: speed, hand-written = 1", true,
                       kAsked, medians.threadSeconds(theirsName(i)) / medians.threadSeconds(oursName(i))});
}

}  // namespace sdf::bench
