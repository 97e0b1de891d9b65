#include "memory_peak.h"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace sdf::chart {
namespace {

// A figure of /proc/self/status in bytes.
double statusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word; status.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    double kibibytes = 0.0;
    if (word == name && status >> kibibytes) return kibibytes * 1024.0;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Sets the peak back to what is held now; false where the system does not let us.
bool forgetPeak() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;
  return static_cast<bool>(refs);
}

}  // namespace

MemoryPeak::MemoryPeak() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
  before_ = forgetPeak() ? statusBytes("VmRSS:") : std::numeric_limits<double>::quiet_NaN();
}

double MemoryPeak::bytes() const { return statusBytes("VmHWM:") - before_; }

double MemoryPeak::restart() {
  const double most = bytes();
  forgetPeak();
  return most;
}

}  // namespace sdf::chart
