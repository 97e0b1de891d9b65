// Rays whose first hits are known, for methods of marching to be held to.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sdf/march/march.h"
#include "sdfchart/row.h"

namespace sdf::chart {

/// Steps that the viewer's rays may take (viewer/render/frame.h).
inline constexpr int kViewersSteps = 1024;

/// The name of a scene whose rays may take so many steps.
std::string budgetName(const std::string& scene, int steps);

/// Along a ray, the thinnest solid that the truth is sure to know; scene units.
inline constexpr double kSliver = 1e-5;

/// A scene seen by a camera.
struct MarchedScene {
  std::string name;
  Shape shape;
  glm::dvec3 from;  ///< the camera looks at the origin
  double radius;    ///< of what it sees around the origin
};

/// Smooth, sharp, thin, grazing, far away, steep, and without a known slope; unless all, some of them.
std::vector<MarchedScene> marchedScenes(bool all);

/// A square of rays, `side` a side, that fills what the camera sees of the scene.
Rays cameraRays(const MarchedScene& scene, int side);

/// Where each ray first meets the solid, by steps of `step` in double (marchDensely) and halving, in
/// parallel; nothing where it meets none. What the slope does not prove free between two steps is looked at
/// in ever smaller ones, down to kSliver; without a known slope solids thinner than a step may be passed.
std::vector<std::optional<double>> trueHits(const MarchField& field, const Rays& rays,
                                            const MarchedScene& scene, double step);

/// Rays to a scene, and where they hit.
class KnownRays {
 public:
  /// `side` rays a side. `step` is that of the dense march, scene units. Throws std::runtime_error for shapes
  /// that nothing can be marched through.
  KnownRays(MarchedScene scene, int side, double step);

  const MarchedScene& scene() const { return scene_; }
  int side() const { return side_; }
  const MarchField& field() const { return field_; }
  const Rays& rays() const { return rays_; }
  /// The true hits, found when they are first asked for.
  const std::vector<std::optional<double>>& truth();

 private:
  MarchedScene scene_;
  int side_;
  double step_;
  MarchField field_;
  Rays rays_;
  std::vector<std::optional<double>> truth_;
};

/// Fills error figures from what a method found: rms and max of the depth where both hit, and the shares of
/// all rays that missed what is there, running out of steps included, and hit what is not.
void judgeHits(const Hits& hits, const std::vector<std::optional<double>>& truth, Row& row);

}  // namespace sdf::chart
