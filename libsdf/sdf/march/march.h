// Sphere tracing and its relatives: where rays first meet a shape. This is the reference that a GPU's shaders
// are tested against, and a bench on which the methods can be compared.
//
// All methods go by the field's step g, so that the ball of radius g around a point (its unbounding sphere)
// is free of the solid, and hit by its distance f, so that a hit is where it is however loose the bound of
// f's slope. Written for one ray, with threshold(t) = epsilon + footprint * t, the first four are
//
//   t = tMin; r = g(tMin);
//   loop: if (max(f(t), r) <= threshold(t)) Hit at t;
//         if (t + r >= tMax) Miss;
//         z = min(relaxed step, tMax - t);             // at least r
//         R = g(t + z);
//         if (z > r && z > r + R) {                    // the balls do not overlap, or g < 0: something may
//           z = r; R = g(t + r);                       // lie between, so the plain step is taken
//         }
//         t += z; r = R;
//
// With `lookBehind` a ray hits where it reads g <= 0 behind the surface. The last slope places the surface:
// from 2 threshold(t) on the ray steps to z = 5/4 max(g, epsilon) / fall, the fall at least 1/16, and hits
// between. Where that step is longer than 8 threshold(t), or the reading is positive and its ball does not
// overlap the one before, the ray steps to max(g, epsilon) / fall first. So a ray that passes beside an edge
// misses, and one through a film of no thickness (a cut that ends in a face leaves one, f = 0 between two of
// one sign) goes on, as meshes have it: what is thinner than about epsilon along the ray is no part of the
// solid. After 64 readings within the threshold, of which rising ones count for an eighth, a ray hits: it
// goes along the surface. They are so many that it hardly depends on where a ray begins which of those that
// just pass a round side are given up.
//
// The four differ in the relaxed step, r' and z' being the radius and the step before:
//
//   Plain        r (Hart 1996)
//   OverRelaxed  overRelaxation * r; after the first failure r (Keinert, Schaefer, Korndoerfer, Ganse,
//                Stamminger 2014)
//   Accelerated  r + acceleration * r (1 + m) / (1 - m) with the slope m = (r - r') / z', -1 at the start:
//                at acceleration 1 the balls just touch if that slope goes on (Balint, Valasek 2018)
//   AutoRelaxed  2 r / (1 - m) with the slope averaged, m += smoothing * ((r - r') / z' - m); m is -1 at
//                the start and after a failure (Ban, Valasek 2023)
//
// Segment steps by min(g / s, l), s being the steepest fall of g along the next l of the ray by interval
// derivatives (and at most 1), l = growth times the last step (Galin, Guerin, Paris, Peytavie 2020). Where g
// may jump it steps by epsilon.
//
// Bisection halves the ray until intervals prove a piece free of the solid, nearest piece first, or the piece
// is no longer than the threshold and not even the Lipschitz constant proves it free (Mitchell 1990): it
// cannot miss.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/march/field.h"
#include "sdf/march/rays.h"

namespace sdf {

/// How far a ray steps, as stated above.
enum class MarchMethod {
  Plain,        ///< by g
  OverRelaxed,  ///< by a constant times g, until that fails once
  Accelerated,  ///< by g and the slope of the step before
  AutoRelaxed,  ///< by g and a mean of the slopes of the steps before
  Segment,      ///< by g and a bound of its fall on the next piece of the ray
  Bisection     ///< by halves, until intervals prove a piece free
};

/// How a ray ended. Up to t (before refinements) no solid was passed, unless it is thinner than float
/// rounding or, by Segment where g may jump, than epsilon.
enum class RayStatus : std::uint8_t {
  Hit,  ///< max(f(t), g(t)) <= threshold(t), or with `lookBehind` the solid begins at t; Bisection: the solid
        ///< begins in [t, t + threshold(t)], or comes so near to it that intervals cannot tell
  Miss,      ///< no solid up to t = tMax
  Budget,    ///< maxSteps were not enough; t is how far it came
  Undefined  ///< f is not a number at t
};

struct MarchOptions {
  MarchMethod method = MarchMethod::Plain;
  double epsilon = 1e-4;   ///< a hit where f and g <= epsilon + footprint * t; scene units, > 0
  double footprint = 0.0;  ///< radius of a pixel's cone at t = 1, >= 0: tan(fov / 2) / rows of pixels
  int maxSteps = 512;  ///< readings of the field a ray may take, > 0; Segment and Bisection may take two more
  bool lookBehind = false;      ///< the first four: only what is read to be solid is hit, as stated above
  int refinements = 0;          ///< secant steps after a hit, >= 0; they move t on by at most 4 threshold(t)
  double overRelaxation = 1.6;  ///< OverRelaxed: in [1, 2)
  double acceleration = 0.9;    ///< Accelerated: in [0, 1]
  double smoothing = 0.3;       ///< AutoRelaxed: in (0, 1]
  double growth = 2.0;          ///< Segment: > 1
};

/// What became of each ray, in the rays' order.
struct Hits {
  std::vector<double> t;
  std::vector<int> steps;  ///< readings of the field: at a point or over a segment
  std::vector<RayStatus> status;
};

/// Marches batches of rays through one field. A ray that starts in the solid hits at tMin. The first four
/// methods read the field in float SIMD batches of up to 512 rays, and again in double where the value is so
/// close to 0 that float could not tell (within 2^-16 of the largest coordinate); t is kept in double, so
/// that t + g == t cannot happen. Segment and Bisection work ray by ray in double and intervals. Rays do not
/// depend on each other. Not thread-safe: one a thread.
class Marcher {
 public:
  /// Errors: Usage (an option out of range), Scene (no known Lipschitz constant, which all methods but
  /// Segment and Bisection need).
  static Result<Marcher> make(MarchField field, const MarchOptions& options);
  /// The same, from marchField(shape).
  static Result<Marcher> make(const Shape& shape, const MarchOptions& options);

  /// Marches the rays. Errors: Usage, where checkRays finds one or a ray is so long that double does not
  /// resolve epsilon at its end. Cost: at most maxSteps readings a ray, and 2 + refinements more for each hit
  /// that is refined.
  Result<Hits> trace(const Rays& rays);

  Marcher(Marcher&&) noexcept;
  Marcher& operator=(Marcher&&) noexcept;
  ~Marcher();

 private:
  struct State;
  explicit Marcher(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sdf
