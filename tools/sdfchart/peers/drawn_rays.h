// The viewer's rays, marched by OpenGL.
#pragma once
#include <memory>
#include <vector>

#include "sdfchart/measure/measure.h"
#include "sdfchart/truth/march_truth.h"

namespace sdf::chart {

/// Time and readings a ray of frames that show nothing but what rays hit, for each of the places where rays
/// may start (sdfview --start) and for plain steps (--method plain), for shares of a pixel's cone that count
/// as a hit, and for budgets of steps; held to the known rays. Pictures are `times` as wide as there are
/// known rays, an odd number, so that those are rays of pixels. Where OpenGL cannot be had, or the viewer
/// refuses the scene, each fails with the reason.
std::vector<Measurement> drawnRays(const std::shared_ptr<KnownRays>& known, int times,
                                   const std::vector<int>& budgets);

}  // namespace sdf::chart
