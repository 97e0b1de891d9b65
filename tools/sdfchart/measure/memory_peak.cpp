#include "memory_peak.h"

#include <fstream>

#include "sdf2gltf/memory.h"
#include "sdfchart/row.h"

namespace sdf::chart {
namespace {

using exporter::memoryFigure;

// Sets the peak back to what is held now; false where the system does not let us.
bool forgetPeak() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;
  return static_cast<bool>(refs);
}

}  // namespace

MemoryPeak::MemoryPeak() {
  exporter::releaseFreedMemory();
  before_ = forgetPeak() ? memoryFigure("VmRSS:").value_or(kNone) : kNone;
}

double MemoryPeak::bytes() const { return memoryFigure("VmHWM:").value_or(kNone) - before_; }

double MemoryPeak::restart() {
  const double most = bytes();
  forgetPeak();
  return most;
}

}  // namespace sdf::chart
