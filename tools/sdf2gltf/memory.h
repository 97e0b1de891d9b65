// What the system says of memory.
#pragma once

namespace sdf {

/// Bytes of the machine's memory.
double physicalMemory();

/// Most bytes that this process ever had in memory (VmHWM, proc(5)); 0 where the system does not tell.
double peakMemory();

}  // namespace sdf
