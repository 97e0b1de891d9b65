// What stands for OpenGL where the viewer is not built: failures that say so.
#include "drawn_rays.h"

namespace sdf::chart {

namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error("sdfchart was built without the viewer, for want of what it needs");
}

}  // namespace

std::vector<Measurement> drawnRays(const std::shared_ptr<KnownRays>& known, int, const std::vector<int>&) {
  const Row row{.kind = "marching",
                .scene = known->scene().name + ", OpenGL",
                .method = "OpenGL",
                .setting = "the viewer's frames"};
  return {{row, [](Row*) -> double { refuse(); }}};
}

}  // namespace sdf::chart
