// Holds the catalog's shapes to meshes of the same solids and writes what it found as a Markdown page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "operator_rows.h"
#include "primitive_cases.h"
#include "report.h"
#include "sdf/base/file.h"

namespace sdf::accuracy {
namespace {

enum ExitCode { kDone = 0, kRefuted = 1, kUsage = 2, kFiles = 5 };

std::vector<Row> checkPrimitives() {
  std::vector<Row> rows;
  for (const PrimitiveCases& cases : primitiveCases()) {
    std::fprintf(stderr, "%s\n", cases.entry.c_str());
    rows.push_back(rowOf(cases.entry, cases.makers));
  }
  return rows;
}

std::vector<Row> checkOperators() {
  std::vector<Row> rows;
  for (const OperatorCases& cases : operatorCases()) {
    std::fprintf(stderr, "%s\n", cases.entry.c_str());
    rows.push_back(operatorRow(cases));
  }
  return rows;
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

int run(const std::string& output) {
  const auto failed = [](const Error& error) {
    std::fprintf(stderr, "accuracy: %s\n", error.message.c_str());
    return kFiles;
  };
  if (const Status s = checkWritable(output); !s) return failed(s.error());
  const std::vector<Row> primitives = checkPrimitives(), operators = checkOperators();
  const Status written = writeFile(output, [&](std::ostream& out) {
    writeReport(out, primitives, operators);
    return okStatus();
  });
  if (!written) return failed(written.error());
  return hold(primitives) && hold(operators) ? kDone : kRefuted;
}

}  // namespace
}  // namespace sdf::accuracy

int main(int argc, char** argv) {
  CLI::App app(
      "Holds every shape of the catalog to CGAL's geometry and writes the report; takes some minutes.",
      "accuracy");
  std::string output;
  app.add_option("OUT", output, "page to write, such as docs/accuracy.md")->required()->type_name("");
  app.footer("Exit status: 0 all claims hold, 1 one does not, 2 usage, 5 files.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "accuracy: %s; see accuracy --help\n", error.what());
    return sdf::accuracy::kUsage;
  }
  return sdf::accuracy::run(output);
}
