#include "viewer/render/gpu_render.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "sdf/expr/vec.h"
#include "viewer/gpu/context.h"

namespace sdf::test {
namespace {

template <class T>
T take(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

// Never closed: at the end of the process the driver's own threads may be gone already.
void makeContextCurrent() {
  static viewer::Context* const context = take(viewer::Context::headless()).release();
  if (const Status s = context->makeCurrent(); !s) throw std::runtime_error(s.error().message);
}

struct Drawn {
  viewer::Renderer renderer;
  viewer::Target target;
};

Drawn draw(const Scene& scene, const GpuRenderOptions& options) {
  makeContextCurrent();
  auto target = take(
      viewer::Target::create(options.width, options.height, {options.format, viewer::PixelFormat::Rgba32f}));
  viewer::Frame frame = viewer::frameOf(viewer::LookFunction(scene), options.parameters,
                                        static_cast<double>(options.width) / options.height);
  viewer::ShaderOptions shader = options.shader;
  shader.origin = viewer::originFor(frame.look.eye);
  auto renderer = take(viewer::Renderer::make(scene, shader));
  frame.samples = options.samples;
  frame.filter = options.filter;
  frame.maxSteps = options.maxSteps;
  frame.epsilon = options.epsilon;
  frame.threshold = options.threshold;
  frame.split = options.split;
  if (options.mesh)
    if (const Status s = renderer.showMesh(*options.mesh, options.errorLimit); !s)
      throw std::runtime_error(s.error().message);
  if (const Status s = renderer.draw(frame, target); !s) throw std::runtime_error(s.error().message);
  return {std::move(renderer), std::move(target)};
}

}  // namespace

std::vector<glm::vec4> renderOnGpu(const Scene& scene, const GpuRenderOptions& options) {
  return take(draw(scene, options).target.pixels());
}

viewer::Readings readingsOnGpu(const Scene& scene, GpuRenderOptions options) {
  options.shader.countReadings = true;
  const Drawn drawn = draw(scene, options);
  return take(drawn.renderer.readings(drawn.target));
}

double hitThreshold(const Scene& scene, const GpuRenderOptions& options, double distance) {
  const double pixelRadius = std::tan(0.5 * glm::radians(uniformValue(scene.camera.fov))) / options.height;
  return options.epsilon + options.threshold * pixelRadius * distance;
}

std::vector<glm::dvec3> colors(const std::vector<glm::vec4>& pixels) {
  std::vector<glm::dvec3> shown;
  for (const glm::vec4& p : pixels) shown.push_back(glm::clamp(glm::dvec3(p), 0.0, 1.0));
  return shown;
}

}  // namespace sdf::test
