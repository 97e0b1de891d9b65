// Holds the catalog to meshes of the same solids and our meshes to their definitions, runs the known
// failures, and writes what it found as a Markdown page.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "accuracy/meshes/mesh_cases.h"
#include "accuracy/operators/operator_cases.h"
#include "accuracy/solids/primitive_cases.h"
#include "report.h"
#include "sdf/base/file.h"

namespace sdf::accuracy {
namespace {

enum ExitCode { kDone = 0, kRefuted = 1, kUsage = 2, kFiles = 5 };

/// All rows in one list.
template <class R>
std::vector<R> joined(std::vector<std::vector<R>> lists) {
  std::vector<R> all;
  for (std::vector<R>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Runs one after the other, naming each first, since some take long.
template <class Case, class Run>
auto runAll(const std::vector<Case>& cases, std::string Case::*name, Run run) {
  std::vector<decltype(run(cases[0]))> rows;
  for (const Case& c : cases) {
    std::fprintf(stderr, "%s\n", (c.*name).c_str());
    rows.push_back(run(c));
  }
  return rows;
}

bool hold(std::span<const FailureRow> rows) {
  bool all = true;
  for (const FailureRow& row : rows) {
    if (row.failure.isReal(row.figures) && row.failure.isHeld(row.figures)) continue;
    std::fprintf(stderr, "accuracy: not as known: %s: naive %g, at least %g; ours %g, at most %g\n",
                 row.failure.name.c_str(), row.figures.naive, row.failure.naive.limit, row.figures.ours,
                 row.failure.ours.limit);
    all = false;
  }
  return all;
}

bool hold(std::span<const MeshRow> rows) {
  bool all = true;
  for (const MeshRow& row : rows) {
    if (!row.refuted()) continue;
    std::fprintf(stderr, "accuracy: refuted: %s, %s: proven %g, found %g\n", row.shape.c_str(),
                 row.asked.c_str(), row.stats.provenDistance, row.farthest());
    all = false;
  }
  return all;
}

bool hold(std::span<const Row> rows) {
  bool all = true;
  for (const Row& row : rows) {
    if (row.found.refuted == 0) continue;
    std::fprintf(stderr, "accuracy: refuted: %s\n", row.found.worst.c_str());
    all = false;
  }
  return all;
}

int run(const std::string& output, std::uint64_t fraction) {
  const auto failed = [](const Error& error) {
    std::fprintf(stderr, "accuracy: %s\n", error.message.c_str());
    return kFiles;
  };
  if (const Status s = checkWritable(output); !s) return failed(s.error());
  const auto failures = runAll(failureCases(), &FailureCase::name, [](const FailureCase& c) {
    return FailureRow{c, c.run()};
  });
  // A page that is only tried does with one case of each, as making their meshes takes longer than a few
  // points.
  const bool isTried = fraction > 1;
  const auto primitives = runAll(primitiveCases(), &PrimitiveCases::entry, [&](const PrimitiveCases& c) {
    return rowOf(c.entry, std::span(c.makers).first(isTried ? 1 : c.makers.size()), fraction);
  });
  const auto operators = runAll(operatorCases(), &OperatorCases::entry,
                                [&](const OperatorCases& c) { return operatorRow(c, fraction); });
  const std::size_t parts = isTried ? 1 : deformedParts().size();
  const auto offsets = joined(
      runAll(deformations(), &Deformation::name, [&](const Deformation& d) { return offsetRows(d, parts); }));
  const auto meshes = joined(runAll(meshCases(), &NamedMeshCase::name,
                                    [&](const NamedMeshCase& c) { return meshRows(c, fraction); }));
  const Status written = writeFile(output, [&](std::ostream& out) {
    writeReport(out, primitives, operators, offsets, meshes, failures);
    return okStatus();
  });
  if (!written) return failed(written.error());
  const bool held[] = {hold(primitives), hold(operators), hold(meshes), hold(failures)};
  return held[0] && held[1] && held[2] && held[3] ? kDone : kRefuted;
}

}  // namespace
}  // namespace sdf::accuracy

int main(int argc, char** argv) {
  CLI::App app(
      "Holds every shape and operator of the catalog to CGAL's geometry, runs the known failures and writes "
      "the "
      "report; takes some minutes.",
      "accuracy");
  std::string output;
  app.add_option("OUT", output, "page to write, such as docs/accuracy.md")->required()->type_name("");
  std::uint64_t fraction = 1;
  app.add_option("--fraction", fraction,
                 "try only one Nth of the points, and if N is more than 1, one case of each primitive; 1 if "
                 "not given")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.footer("Exit status: 0 all claims hold, 1 one does not, 2 usage, 5 files.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "accuracy: %s; see accuracy --help\n", error.what());
    return sdf::accuracy::kUsage;
  }
  return sdf::accuracy::run(output, fraction);
}
