// What the system says of memory.
#pragma once

namespace sdf::exporter {

/// Bytes of the machine's memory.
double physicalMemory();

/// Most bytes that this process ever had in memory (VmHWM, proc(5)); 0 where the system does not tell.
double peakMemory();

/// Gives freed memory back to the system, which the allocator keeps where it was freed in small pieces.
void releaseFreedMemory();

}  // namespace sdf::exporter
