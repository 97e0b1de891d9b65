#include "measure.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace sdf::chart {
namespace {

struct Running {
  Measurement* measurement;
  std::vector<double> seconds{};
  double spent = 0.0;
  bool ended = false;
};

void runOnce(Running& running) {
  Row& row = running.measurement->row;
  try {
    running.seconds.push_back(running.measurement->run(running.seconds.empty() ? &row : nullptr));
    running.spent += running.seconds.back();
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

// A measurement ends by itself when its runs have taken its share of the budget, so that those that are slow
// do not keep those that are fast from being repeated.
void endThoseThatMay(const Batch& batch, std::vector<Running>& all) {
  double spent = 0.0;
  for (const Running& one : all) spent += one.spent;
  const double share = batch.budget / static_cast<double>(all.size());
  for (Running& one : all)
    one.ended = one.ended || one.measurement->row.failed() ||
                static_cast<int>(one.seconds.size()) >= batch.runs ||
                (batch.together ? spent >= batch.budget : one.spent >= share);
}

// Rows keep their order, which the charts go by: from `first` on those are written before which none is open.
Status writeEnded(const std::vector<Running>& all, std::size_t& first, Results& results) {
  for (; first < all.size() && all[first].ended; ++first) {
    summarise(all[first]);
    if (Status s = results.append(all[first].measurement->row); !s) return s;
  }
  return okStatus();
}

Status runBatch(const Batch& batch, std::vector<Measurement>& pending, Results& results) {
  std::vector<Running> all;
  for (Measurement& m : pending) all.push_back({&m});
  for (std::size_t written = 0; written < all.size();) {
    for (Running& one : all) {
      if (!one.ended) runOnce(one);
      if (RunProgress::toldToEnd()) return Error{ErrorKind::Interrupted, "interrupted"};
    }
    endThoseThatMay(batch, all);
    if (Status s = writeEnded(all, written, results); !s) return s;
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
