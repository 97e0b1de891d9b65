#include "measure.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace sdf::chart {
namespace {

struct Running {
  Measurement* measurement;
  std::vector<double> seconds{};
};

void runOnce(Running& running) {
  Row& row = running.measurement->row;
  try {
    running.seconds.push_back(running.measurement->run(running.seconds.empty() ? &row : nullptr));
  } catch (const std::exception& error) {
    row.status = std::string("failed: ") + error.what();
  }
}

void summarise(const Running& running) {
  Row& row = running.measurement->row;
  if (running.seconds.empty()) return;
  row.runs = static_cast<double>(running.seconds.size());
  row.seconds = quantile(running.seconds, 0.5);
  row.quartile1 = quantile(running.seconds, 0.25);
  row.quartile3 = quantile(running.seconds, 0.75);
}

Status runBatch(const Batch& batch, std::vector<Measurement>& pending, Results& results) {
  std::vector<Running> all;
  for (Measurement& m : pending) all.push_back({&m});
  double spent = 0.0;
  for (int run = 0; run < batch.runs && (run == 0 || spent < batch.budget); ++run)
    for (Running& one : all) {
      if (one.measurement->row.failed()) continue;
      runOnce(one);
      if (!one.seconds.empty()) spent += one.seconds.back();
      if (RunProgress::toldToEnd()) return Error{ErrorKind::Interrupted, "interrupted"};
    }
  for (const Running& one : all) {
    summarise(one);
    if (Status s = results.append(one.measurement->row); !s) return s;
  }
  return okStatus();
}

}  // namespace

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], at - static_cast<double>(below));
}

Status runBatches(const std::vector<Batch>& batches, Results& results, const std::string& machine,
                  RunProgress& progress) {
  double weight = 0.0;
  for (const Batch& batch : batches) weight += batch.weight;
  progress.begin(batches.size(), weight);
  for (const Batch& batch : batches) {
    std::vector<Measurement> pending = batch.make();
    std::erase_if(pending, [&](const Measurement& m) { return results.has(m.row); });
    if (pending.empty()) {
      progress.skip(batch.weight);
      continue;
    }
    progress.beginBatch(batch.subject);
    for (Measurement& m : pending) m.row.machine = machine;
    if (Status s = runBatch(batch, pending, results); !s) return s;
    progress.endBatch(batch.weight);
  }
  return okStatus();
}

}  // namespace sdf::chart
