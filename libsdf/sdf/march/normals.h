// Normals of a field's level sets, by differences or exactly.
#pragma once
#include "sdf/base/result.h"
#include "sdf/march/field.h"
#include "sdf/march/rays.h"

namespace sdf {

/// How the gradient is taken, with a step h, in the float reading:
///
///   Forward      f(p + h e) - f(p) along each axis e: 4 readings, error about h * curvature / 2
///   Central      f(p + h e) - f(p - h e): 6 readings, error about h^2 times a sixth of the third derivative
///   Tetrahedron  sum of k f(p + h k) over the corners k = (1, -1, -1), (-1, -1, 1), (-1, 1, -1), (1, 1, 1)
///                (Quilez, "Normals for an SDF", 2015): 4 readings, error about h * curvature
///   Gradient     exact derivatives by dual numbers: the price of about 4 readings, and no h
///
/// Rounding adds about 2^-24 s / h to a difference, s being the size of the coordinates.
enum class NormalMethod { Forward, Central, Tetrahedron, Gradient };

struct NormalOptions {
  NormalMethod method = NormalMethod::Gradient;
  double step = 0x1p-7;  ///< h in scene units, > 0; Gradient does not use it
};

/// The h at which rounding and the error of the formula are about equal, for coordinates and radii of
/// curvature of the size `scale`: 2^-11 scale (Forward, Tetrahedron), 2^-7 scale (Central).
double bestNormalStep(NormalMethod method, double scale);

/// Unit normals at the points, pointing to where f grows. Where the gradient vanishes, is not finite, or
/// where a difference is no larger than its own rounding may be (2^-22 of the largest coordinate or value),
/// the result is `otherwise` at that point, e.g. the way back along the ray: never NaN, if `otherwise` is
/// not. At a crease Gradient takes one side's normal. Errors (Usage): a step that is not positive and finite,
/// rows of different length.
Result<Vectors> normals(const MarchField& field, const Vectors& points, const Vectors& otherwise,
                        const NormalOptions& options);

}  // namespace sdf
