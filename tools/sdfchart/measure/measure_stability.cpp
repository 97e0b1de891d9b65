// The known failures (tools/accuracy/failures): who holds, who degrades, who fails.
#include <cmath>

#include "accuracy/failures/failure_case.h"
#include "measurements.h"

namespace sdf::chart {
namespace {

using accuracy::FailureCase;

// One run of a case gives both figures.
struct SharedCase {
  FailureCase failure;
  std::optional<accuracy::Figures> figures{};
  double seconds = 0.0;

  const accuracy::Figures& now() {
    if (!figures) seconds = secondsOf([&] { figures = failure.run(); });
    return *figures;
  }
};

// Within what is promised of ours it holds; as bad as the naive method must be for the case to be real it
// fails.
const char* verdict(const FailureCase& c, double figure) {
  if (figure <= c.ours.limit) return "holds";
  return figure < c.naive.limit ? "degrades" : "fails";
}

Measurement measurement(const std::shared_ptr<SharedCase>& shared, bool ours) {
  const FailureCase& c = shared->failure;
  const accuracy::Method& method = ours ? c.ours : c.naive;
  Row row{.kind = "stability",
          .scene = c.name,
          .method = ours ? "libsdf" : "common method",
          .setting = method.what + " (" + c.figure + ")",
          .size = method.limit};
  return {row, [shared, ours](Row* judged) {
            const accuracy::Figures& figures = shared->now();
            if (judged) {
              judged->max = ours ? figures.ours : figures.naive;
              judged->verdict = verdict(shared->failure, judged->max);
            }
            return shared->seconds;
          }};
}

}  // namespace

std::vector<Batch> stabilityBatches(Extent extent) {
  std::vector<FailureCase> cases;
  const auto add = [&](std::vector<FailureCase> some) {
    cases.insert(cases.end(), some.begin(), some.end());
  };
  add(accuracy::formulaFailures());
  if (extent != Extent::Trial) {
    add(accuracy::marchingFailures());
    add(accuracy::blendFailures());
  }
  if (extent == Extent::Full) {
    add(accuracy::warpFailures());
    add(accuracy::shadingFailures());
    add(accuracy::meshingFailures());
  }
  std::vector<Batch> batches;
  for (const FailureCase& c : cases)
    batches.push_back(
        {.subject = "stability, " + c.name, .weight = 0.5, .runs = 1, .make = [c] {
           const auto shared = std::make_shared<SharedCase>(c);
           return std::vector<Measurement>{measurement(shared, false), measurement(shared, true)};
         }});
  return batches;
}

}  // namespace sdf::chart
