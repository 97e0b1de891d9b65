// Every figure that the project promises, measured in one run. Exit status 1 if one is missed.
#include <cstdio>
#include <vector>

#include "benches.h"

int main(int argc, char** argv) {
  using namespace sdf::bench;
  // Repetitions of all benchmarks take turns at random, so that a slow spell of the machine hits both sides.
  char interleave[] = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, interleave);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  std::printf("%s\n", machine().c_str());
  if (!handwrittenAgrees() || !meshersAgree()) return 1;
  registerBatch();
  registerMeshing();
  registerTool();
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  std::vector<Figure> figures;
  addBatchFigures(medians, figures);
  addMeshingFigures(medians, figures);
  addToolFigures(medians, figures);
  const bool reached = printFigures(figures);
  printStages();
  return reached ? 0 : 1;
}
