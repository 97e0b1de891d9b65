#include "viewer/renderers.h"

namespace sdf::test {
namespace {

// Gradients are read in float: off by some roundings.
constexpr double kCpuRounding = 0x1p-20;

Renderer cpu() {
  const auto render = [](const Scene& scene, int width, int height) {
    return renderOnCpu(scene, {.width = width, .height = height});
  };
  return {"cpu", render, kCpuRounding, CpuRenderOptions{}.march.epsilon};
}

}  // namespace

std::vector<Renderer> renderers() { return {cpu()}; }

}  // namespace sdf::test
