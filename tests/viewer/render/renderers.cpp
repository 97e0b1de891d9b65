#include "viewer/render/renderers.h"

#include "viewer/render/gpu_render.h"

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

// Positions up to 10 from the eye are rounded to 2^-21, and the light's formulas are some roundings of 2^-24
// long, of which pow, exp and sqrt may be several (OpenGL 4.5, 4.7.1, lets drivers err by 2^-11 of pow's
// exponent; those we know keep to a few roundings).
constexpr double kGpuRounding = 0x1p-18;

// The pictures that are held to an offset are 91 pixels high, one picture height away: half a pixel at
// distance 1.
constexpr double kFarthest = 10.0, kPixelRadius = 0.5 / 91.0;

Renderer gpu(const std::string& name, viewer::Method method) {
  const auto render = [method](const Scene& scene, int width, int height) {
    GpuRenderOptions options;
    options.width = width;
    options.height = height;
    options.shader.method = method;
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.color = colors(renderOnGpu(scene, options));
    return picture;
  };
  const GpuRenderOptions defaults;
  const double near = defaults.epsilon + defaults.threshold * kPixelRadius * kFarthest;
  return {name, render, kGpuRounding, near};
}

}  // namespace

std::vector<Renderer> renderers() {
  return {cpu(), gpu("gpu", viewer::Method::AutoRelaxed), gpu("gpuPlain", viewer::Method::Plain)};
}

}  // namespace sdf::test
