#include "machine.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "sdf/eval/batch.h"

namespace sdf::bench {

std::string machine() {
  std::string model = "unknown processor", line;
  for (std::ifstream info("/proc/cpuinfo"); std::getline(info, line);)
    if (line.starts_with("model name")) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE) / (1 << 30);
  char text[200];
  std::snprintf(text, sizeof text, "%s, %u cores, %s, %.0f GiB", model.c_str(),
                std::thread::hardware_concurrency(), BatchEvaluator::targetName(), memory);
  return text;
}

}  // namespace sdf::bench
