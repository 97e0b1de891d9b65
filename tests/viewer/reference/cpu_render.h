// The CPU's picture of a scene, which the shaders' pictures are held to: in double, from sdf/march, without
// any of what makes the shaders fast.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/march/march.h"
#include "sdf/scene/scene.h"

namespace sdf::test {

/// What a pixel shows, rows from the top. Depth, status and normal are those of one sample of the pixel: its
/// middle one, of an even number the next to the right and below.
struct Picture {
  int width = 0, height = 0;
  std::vector<glm::dvec3> color;   ///< linear RGB, the mean of the samples, not clamped
  std::vector<double> depth;       ///< along the ray; maxDistance where nothing was hit
  std::vector<RayStatus> status;   ///< Hit, Miss, or why neither is known
  std::vector<glm::dvec3> normal;  ///< unit length; 0 where nothing was hit

  std::size_t at(int column, int row) const { return static_cast<std::size_t>(row) * width + column; }
  bool hit(int column, int row) const { return status[at(column, row)] == RayStatus::Hit; }
};

/// By default no hit is farther than a millionth from the surface, and no ray runs out of steps.
struct CpuRenderOptions {
  int width = 160, height = 90;
  int samples = 1;  ///< samples x samples rays a pixel, > 0
  /// How rays march; Plain where occlusion counts their steps, Bisection where the slope is unknown.
  MarchOptions march{
      .method = MarchMethod::AutoRelaxed, .epsilon = 1e-6, .maxSteps = 100'000, .lookBehind = true};
};

/// The picture, with the lighting that viewer/shaders draw. Parameters and time stand at their present
/// values. Rays that run out of steps or meet what is not a number show the background. Throws
/// std::runtime_error where sdf/march refuses the scene. Cost: about a second for 160 x 90 rays of a scene
/// with shadows; the rows are shared out among the machine's threads.
Picture renderOnCpu(const Scene& scene, const CpuRenderOptions& options);

/// A linear colour on the scene's tone curve.
glm::dvec3 toned(const glm::dvec3& linear, Tone tone);

/// A linear colour as it is shown, each part in [0, 1]: by sRGB's curve, or by the power 1 / gamma.
glm::dvec3 encode(const glm::dvec3& linear, const std::optional<double>& gamma);
std::vector<glm::dvec3> encode(const std::vector<glm::dvec3>& linear, const std::optional<double>& gamma);

}  // namespace sdf::test
