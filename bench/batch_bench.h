// The batch reading against hand-written loops.
#pragma once
#include "figures.h"

namespace sdf::bench {

/// Do the hand-written loops compute the measuring shapes? Prints what differs by more than float rounding
/// explains.
bool handwrittenAgrees();
void registerBatch();
void addBatchFigures(const Medians& medians, std::vector<Figure>& figures);

}  // namespace sdf::bench
