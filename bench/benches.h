// What bench measures, in three parts: each checks what it can, registers benchmarks, and makes figures of
// them.
#pragma once
#include "figures.h"

namespace sdf::bench {

/// The batch reading against hand-written loops. Do those compute the measuring shapes? Prints what differs
/// by more than float rounding explains.
bool handwrittenAgrees();
void registerBatch();
void addBatchFigures(const Medians& medians, std::vector<Figure>& figures);

/// Sampling and extraction: against a dense baseline, and how the cost grows. Do both meshers find the same
/// surfaces? Prints where their triangle counts differ.
bool meshersAgree();
void registerMeshing();
void addMeshingFigures(const Medians& medians, std::vector<Figure>& figures);
/// What the time of the sharp meshes goes into.
void printStages();

/// The exporter as its users run it: time, and peak memory; also exports each measuring shape once at N = 512
/// for the latter.
void registerTool();
void addToolFigures(const Medians& medians, std::vector<Figure>& figures);

}  // namespace sdf::bench
