#include "memory.h"

#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <limits>

namespace sdf::exporter {

double physicalMemory() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

std::optional<double> memoryFigure(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word; status.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    double kibibytes = 0.0;
    if (word == name && status >> kibibytes) return kibibytes * 1024.0;
  }
  return std::nullopt;
}

void releaseFreedMemory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace sdf::exporter
