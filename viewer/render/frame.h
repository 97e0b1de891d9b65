// One frame to be drawn, and what of it every shader is told.
#pragma once
#include <optional>
#include <utility>

#include "sdf/eval/function.h"
#include "viewer/gpu/program.h"
#include "viewer/render/look.h"

namespace sdf::viewer {

/// A Frame holds what may change from one frame to the next without compiling, but for the first that takes
/// more than one sample.
struct Frame {
  Values parameters;
  Look look;
  double split = 0.5;   ///< share of the picture's width at which View::Split begins to show the mesh, 0 to 1
  int samples = 1;      ///< a side: a pixel takes its square
  bool filter = true;   ///< patterns are averaged over what a sample covers; see shaders/filter.h
  int maxSteps = 1024;  ///< readings that a ray may take
  double epsilon = 1e-5;    ///< least distance that counts as a hit, in the view's units (ViewLengths)
  double threshold = 0.25;  ///< share of the pixel's cone that counts as a hit, half of it for loose scenes
};

/// Makes the frame of a scene's own look at these values, for pictures of this width by their height.
Frame frameOf(const LookFunction& look, Values parameters = {}, double aspect = kPictureAspect);

/// OwnInputs are those of all inputs that a function takes, in one frame after the other.
class OwnInputs {
 public:
  explicit OwnInputs(const Function& function);
  explicit OwnInputs(std::vector<std::string> names) : names_(std::move(names)) {}

  /// Takes those of a frame, and returns whether they are others than those of the frame before.
  bool move(const Values& inputs);
  /// Returns those of the frame.
  const Values& values() const { return *last_; }

 private:
  std::vector<std::string> names_;  // those that a frame can move
  std::optional<Values> last_;
};

/// UniformValues are what a shader's uniform sdfValues holds in one frame after the other.
class UniformValues {
 public:
  /// Takes the function whose outputs are the uniform's numbers.
  explicit UniformValues(Function numbers);

  /// Computes the values where the scene's inputs have these, unless they are those of the frame before.
  /// Returns whether it did.
  bool move(const Values& inputs);
  /// Returns the values of the frame, as whole vectors; none if there is no such uniform.
  const std::vector<glm::vec4>& vectors() const { return vectors_; }

 private:
  Function numbers_;
  OwnInputs inputs_;
  std::vector<glm::vec4> vectors_;
};

/// BackgroundValues are what a shader's uniform backgroundLight holds in one frame after the other.
class BackgroundValues {
 public:
  explicit BackgroundValues(const Scene& scene);

  /// Computes the values where the scene's inputs have these, unless they are those of the frame before.
  void move(const Values& inputs);
  const std::vector<glm::vec4>& vectors() const { return vectors_; }

 private:
  Function radiance_;
  OwnInputs inputs_;
  std::vector<glm::vec4> vectors_;
};

/// An Extent is what rays need to know of a scene.
struct Extent {
  explicit Extent(const Scene& scene);

  std::optional<Box> bounds;  ///< if they are finite
  bool loose;  ///< distances may be less than the way to the surface, so that rays count as hits farther off

  /// Returns the lengths that the scene is seen with by this eye. One that is fitted sees all of the scene,
  /// however far off it has been moved.
  ViewLengths lengths(const Eye& eye) const;

 private:
  StatedLengths stated_;
};

/// A Shot is a frame's rays through the pixels of a picture of this size. The frame must outlive it.
class Shot {
 public:
  /// Aims the rays, which begin up to a ball around the bounds, if there are any, and end at the lengths'
  /// maxDistance.
  Shot(const Frame& frame, int width, int height, const Extent& extent);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns the lengths that the frame's eye sees the scene with.
  const ViewLengths& lengths() const { return lengths_; }

  int samples() const { return frame_.samples * frame_.samples; }
  /// Returns a sample's share of its pixel.
  double weight() const { return 1.0 / samples(); }
  /// Returns the width of a sample's cone at distance 1 over which patterns are averaged; 0 leaves them
  /// sharp.
  double footprint() const;
  /// Return the sample's places in unit squares, which choose a direction of a glossy mirror, a point of each
  /// light and one of the lens. The places of all samples fill each square evenly, and no choice follows from
  /// another.
  glm::vec2 lobe() const;
  /// Returns the picture's axes, forward as long as its plane is far away in picture heights, and the eye.
  std::pair<Axes, glm::dvec3> view() const { return {axes_, frame_.look.eye.from}; }
  /// Returns where in its pixel the sample is.
  glm::vec2 within() const;
  glm::vec2 lightPlace() const;
  glm::vec2 lensPlace() const;
  /// Draws the rays of the i-th sample from now on.
  void chooseSample(int i) { sample_ = i; }

  /// Sets parts::kCamera's uniforms, and sdfValues.
  void set(const Program& program, const std::vector<glm::vec4>& values) const;

 private:
  double pixelRadius() const;  // of a pixel's cone at distance 1
  glm::vec2 placeBySteps(const glm::dvec2& steps) const;

  const Frame& frame_;
  int width_, height_, sample_ = 0;
  Extent extent_;
  ViewLengths lengths_;
  Axes axes_;     // forward as long as the picture plane is far away, in picture heights
  double ahead_;  // of the eye, where rays begin
};

}  // namespace sdf::viewer
