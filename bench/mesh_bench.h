// Sampling and extraction: against a dense baseline, and how the cost grows.
#pragma once
#include "figures.h"

namespace sdf::bench {

/// Do both meshers find the same surfaces? Prints where their triangle counts differ.
bool meshersAgree();
void registerMeshing();
void addMeshingFigures(const Medians& medians, std::vector<Figure>& figures);

}  // namespace sdf::bench
