// The shaders' picture of a scene, in a context that the whole process shares.
#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "sdf/scene/scene.h"
#include "viewer/render/renderer.h"

namespace sdf::test {

struct GpuRenderOptions {
  int width = 160, height = 90;
  viewer::ShaderOptions shader;
  int samples = 1;  ///< samples x samples rays a pixel
  bool filter = true;
  int maxSteps = viewer::Frame{}.maxSteps;
  double epsilon = viewer::Frame{}.epsilon;
  double threshold = viewer::Frame{}.threshold;
  viewer::PixelFormat format = viewer::PixelFormat::Rgba32f;  ///< of what is drawn into
  const viewer::ShownMesh* mesh = nullptr;                    ///< that a view of one shows
  double errorLimit = 1.0;                                    ///< of its colours
  double split = viewer::Frame{}.split;
  Values parameters;  ///< those that do not stand at their present values
};

/// Encoded as the scene asks, in floats, rows from the top; alpha 0 where steps ran out, 1/2 where only those
/// of a shadow did. Throws std::runtime_error where there is no OpenGL or the scene is refused.
std::vector<glm::vec4> renderOnGpu(const Scene& scene, const GpuRenderOptions& options);

/// What the picture's rays read of the distance. Throws as renderOnGpu.
viewer::Readings readingsOnGpu(const Scene& scene, GpuRenderOptions options);

/// How far from the surface these options let a hit be at a distance from the eye, scene units.
double hitThreshold(const Scene& scene, const GpuRenderOptions& options, double distance);

/// As they are shown: each part in [0, 1], without alpha.
std::vector<glm::dvec3> colors(const std::vector<glm::vec4>& pixels);

}  // namespace sdf::test
