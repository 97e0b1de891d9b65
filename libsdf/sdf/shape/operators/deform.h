// Operators that change a shape's form: offsets, mixtures, sweeps of flat shapes, and warps of space.
//
// The distance of a warped shape (twist, taper, bend, and scale with unlike factors) is calibrated: divided
// by its slope where it is asked for, so that it can be rounded, shelled, blended and lit like any other.
// Near flat faces, and near what is round by a radius (balls, cylinders, tori, rounded boxes) as far as half
// that radius outside and a quarter inside, it is the distance but for the bend of the warp, some hundredths
// of what it measures. Near other curved surfaces, and near round ones under strong warps, it may be off by
// as much as the warp's shear. Beside edges it may fall short. Its proven constant is a bound over the shape
// and half its radius around, and may be well above 1. Attributes follow the warped position; normals stay
// those of the world. Angles in radians. A failed operand is passed on; numbers must be finite and must not
// depend on the position, unless said otherwise.
#pragma once
#include <numbers>

#include "sdf/shape/shape.h"

namespace sdf {

/// (1 - t) a + t b, t in [0, 1]: a at 0, b at 1. A bound if both are. Attributes are mixed alike. Fails
/// outside [0, 1]; a parameter's range is clamped to it.
Shape morph(const Shape& a, const Shape& b, const Expr& t);

/// Everything within `radius` >= 0 of the shape: f - radius. Exact outside stays so. Of a shape that is less,
/// f is calibrated first where that can be proven (calibrate/offset.h): a formula is divided by its
/// gradient's length, and outside of the edges and corners of intersections and differences f becomes the
/// distance to them. Formulas are then off by some hundredths of the radius where they curve alike along it.
Shape round(const Shape& shape, const Expr& radius);

/// The skin of the shape, `thickness` > 0, half of it on either side of the surface: |f| - thickness / 2.
/// Exact outside for an exact shape; else f is calibrated as for round, inside as well, where the edges are
/// those of unions.
Shape shell(const Shape& shape, const Expr& thickness);

/// Cut at the coordinate planes and pulled apart by `half` >= 0 either way along each axis, the gaps filled
/// with the cross sections: f(p - clamp(p, -half, half)). A bound if the shape is.
Shape elongate(const Shape& shape, const Vec3E& half);

/// f + offset: positive offsets carve, negative ones raise. `offset` may depend on the position. A field
/// whose constant is the sum of both.
Shape displace(const Shape& shape, const Expr& offset);
/// The same with amplitude sin(wx) sin(wy) sin(wz), w = frequency in radians a scene unit. Its steepest slope
/// is |amplitude| w. Solids only.
Shape displace(const Shape& shape, const Expr& amplitude, const Expr& frequency);

/// The flat shape swept along z from -halfHeight to halfHeight. As exact as the flat shape.
Shape extrude(const Shape& flat, const Expr& halfHeight);

/// The flat shape, moved by `offset` along x, swept around the y axis. What lies at x < 0 is dropped. As
/// exact as the flat shape if that keeps to x > 0 or is its own mirror image; at most exact outside if it
/// touches the axis, where it may have an edge that the solid has not; else a bound. Fails if all of it lies
/// at x < 0. `angle` radians of a turn, 0 < angle <= 2 pi, its middle on +x; a part of a turn ends in the
/// flat shape, and is exact outside where a whole turn of a shape that keeps to x >= 0 is exact.
Shape revolve(const Shape& flat, const Expr& offset = 0.0, const Expr& angle = 2.0 * std::numbers::pi);

/// Turned about the y axis by `rate` radians for each unit of y. The shear is (a + sqrt(a^2 + 4)) / 2 for a =
/// |rate| r at the radius r. Beyond one and a half times the radius of the bounds the shape is looked up on
/// that cylinder. A shape unbounded in x or z becomes a field without a constant.
Shape twist(const Shape& shape, const Expr& rate);

/// The x axis bent into a circle of this curvature (1 / radius) towards +y; lengths along the x axis stay.
/// Material at height y is stretched by 1 / (1 - curvature y). Fails where the shape would fold (curvature y
/// >= 1 within its bounds) or its ends would pass each other (curvature |x| >= pi), and if it is unbounded
/// there. Towards the circle's centre and half a turn away the distance is capped, which keeps it continuous.
/// A constant curvature below 1e-30 bends nothing.
Shape bend(const Shape& shape, const Expr& curvature);

/// The cross section at height y scaled by 1 + rate y in x and z. Fails where that factor is not positive
/// within the bounds, and if the shape is unbounded in y. A shape unbounded in x or z becomes a field without
/// a constant.
Shape taper(const Shape& shape, const Expr& rate);

}  // namespace sdf
