// Noises that hang on random numbers at the nodes of a lattice.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "sdf/expr/payload.h"

namespace sdf {

/// A random function of a point, the same in double, in float and in shaders, as its random numbers come from
/// whole numbers. Beyond 2^30 it goes on as it is there.
class LatticeNoise : public Payload {
 public:
  enum class Kind {
    Value,     ///< between random values at the nodes, smooth; in [-1, 1]
    Gradient,  ///< 0 at the nodes, with random slopes there, smooth (Perlin 2002); in [-1, 1]
    Nearest,   ///< the distance to the nearest of random points, one in each cell (Worley 1996)
    Second,    ///< that to the second nearest
    Border     ///< how much farther that is: 0 on the borders between the points' cells
  };
  /// Another seed makes another function. Equal ones are the same one as long as there is one.
  static std::shared_ptr<const LatticeNoise> of(Kind kind, std::uint32_t seed = 0);

  double value(const glm::dvec3& p) const override;
  ValueAndGradient gradient(const glm::dvec3& p) const override;
  /// The value in the middle, more or less half the diagonal times the slope, and within all values.
  Interval range(const std::array<Interval, 3>& box) const override;
  /// Value noise: with u = t^3 (10 - 15 t + 6 t^2) along each axis it is the mean of the nodes' values v,
  /// taken independently with the odds u along each. By Parseval's equation for these odds the squared slopes
  /// d by each axis have sum u (1 - u) d^2 / u'^2 <= mean v^2 <= 1, and u'^2 / (u (1 - u)) is 3.75^2 at most.
  /// Gradient noise: its tests prove 3.84 by intervals. Distances: 1 each.
  double lipschitz() const override;
  bool hasCreases() const override { return kind_ >= Kind::Nearest; }
  /// Shaders compute in float, within a cell.
  double rounding(const glm::dvec3&) const override { return 0x1p-18; }
  std::string glsl(const std::string& name) const override;

 private:
  LatticeNoise(Kind kind, std::uint32_t seed) : kind_(kind), seed_(seed) {}
  template <bool kWithGradient>
  ValueAndGradient read(const glm::dvec3& p) const;
  double most() const;

  Kind kind_;
  std::uint32_t seed_;
};

}  // namespace sdf
