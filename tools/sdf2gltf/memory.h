// What the system says of memory.
#pragma once
#include <optional>
#include <string>

namespace sdf::exporter {

/// Bytes of the machine's memory.
double physicalMemory();

/// Bytes of this process by one of the figures of /proc/self/status (proc(5)): "VmHWM:" are the most that it
/// ever had. Nothing where the system does not tell.
std::optional<double> memoryFigure(const std::string& name);
/// The most, or 0.
inline double peakMemory() { return memoryFigure("VmHWM:").value_or(0.0); }

/// Gives freed memory back to the system, which the allocator keeps where it was freed in small pieces.
void releaseFreedMemory();

}  // namespace sdf::exporter
