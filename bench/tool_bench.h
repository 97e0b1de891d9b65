// The exporter as its users run it: time, and peak memory.
#pragma once
#include "figures.h"

namespace sdf::bench {

void registerTool();
/// Also exports each measuring shape once at N = 512, for its peak memory.
void addToolFigures(const Medians& medians, std::vector<Figure>& figures);

}  // namespace sdf::bench
