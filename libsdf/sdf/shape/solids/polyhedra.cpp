// Solids with flat faces. Each folds the point into one piece of its symmetry, and there measures in the
// frame of the one face left: out of its plane, past its edge, past its corner. The three directions are
// perpendicular, so the distance is the length of what is positive, and inside it is the plane's alone.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;
const double kRoot6 = sqrt2 * sqrt3;

Expr faceDistance(const Expr& out, const Expr& pastEdge, const Expr& pastCorner) {
  const auto above = [](const Expr& height) { return max(height.claimLipschitz(1.0), 0.0); };
  return norm(above(out), above(pastEdge), above(pastCorner)) + min(out.claimLipschitz(1.0), 0.0);
}

Shape prism(const char* name, int sides, const Expr& radius, const Expr& halfHeight) {
  Check c(name);
  if (!c.positive("radius", radius).positive("half_height", halfHeight).ok()) return c.failure();
  const Vec3E p = position();
  const auto [lo, hi] = regularPolygonBounds(sides);
  const double r = upper(radius), h = upper(halfHeight);
  return solid(boxDistance(regularPolygonDistance(p.z, p.x, sides, radius), abs(p.y) - halfHeight),
               {{lo.x * r, -h, lo.y * r}, {hi.x * r, h, hi.y * r}});
}

// (smaller, larger). Where both are equal each takes the gradient of another one.
std::pair<Expr, Expr> sorted(const Expr& a, const Expr& b) { return {min(a, b), max(b, a)}; }

// (larger, smaller) of |a| and |b|, the sign of a * b kept on the smaller: the plane folded about both of its
// diagonals.
std::pair<Expr, Expr> foldDiagonals(const Expr& a, const Expr& b) {
  const Expr sum = abs(a + b), difference = abs(a - b);
  return {(0.5 * (sum + difference)).claimLipschitz(1.0), (0.5 * (sum - difference)).claimLipschitz(1.0)};
}

}  // namespace

Shape hexPrism(const Expr& radius, const Expr& halfHeight) {
  return prism("hex_prism", 6, radius, halfHeight);
}
Shape triPrism(const Expr& radius, const Expr& halfHeight) {
  return prism("tri_prism", 3, radius, halfHeight);
}

Shape octahedron(const Expr& radius) {
  if (Check c("octahedron"); !c.positive("radius", radius).ok()) return c.failure();
  const Vec3E p = abs(position());
  const auto [lowXy, highXy] = sorted(p.x, p.y);
  const auto [low, highLow] = sorted(lowXy, p.z);
  const auto [middle, high] = sorted(highLow, highXy);
  const Expr over = low + middle + high - radius;
  return solid(faceDistance(over * (1.0 / sqrt3), (over - 3.0 * low) * (1.0 / kRoot6),
                            (high - middle - radius) * (1.0 / sqrt2)),
               Box::centred(glm::dvec3(upper(radius))));
}

Shape tetrahedron(const Expr& radius) {
  if (Check c("tetrahedron"); !c.positive("radius", radius).ok()) return c.failure();
  const Vec3E p = position();
  // Folded until x >= y >= |z|. Left are the face through k (1, 1, 1), k (1, -1, -1), k (-1, 1, -1), of it
  // the edge between the first two, and the first.
  const Expr k = radius * (1.0 / sqrt3);
  const auto [x, xy] = foldDiagonals(p.x, p.y);
  const auto [y, z] = foldDiagonals(xy, p.z);
  const auto [ys, xs] = sorted(x, y);
  return solid(faceDistance((xs + ys - z - k) * (1.0 / sqrt3), (2.0 * (xs - k) - ys + z) * (1.0 / kRoot6),
                            (ys + z - 2.0 * k) * (1.0 / sqrt2)),
               Box::centred(glm::dvec3(upper(k))));
}

Shape pyramid(const Expr& halfWidth, const Expr& halfHeight) {
  Check c("pyramid");
  if (!c.positive("half_width", halfWidth).positive("half_height", halfHeight).ok()) return c.failure();
  const Vec3E p = position(), q = abs(p);
  const Expr w = positiveSize(halfWidth), h = positiveSize(halfHeight), y = p.y - h;
  const auto [z, x] = sorted(q.x, q.z);
  const Expr height = h + h, slope = length(w, height), edge = length(w, slope);
  // The sloping face's frame from the tip: out of it, down it, and sideways z.
  const Expr out = (x * (height / slope) + y * (w / slope)).claimLipschitz(1.0);
  const Expr down = (x * (w / slope) - y * (height / slope)).claimLipschitz(1.0);
  // Within the face's plane, past and along the edge that runs from the tip to the base's corner.
  const Expr past = (z * (slope / edge) - down * (w / edge)).claimLipschitz(1.0);
  const Expr along = (z * (w / edge) + down * (slope / edge)).claimLipschitz(1.0);
  const Expr toFace =
      select(less(0.0, past), norm(past, beyond(along, edge)), norm(max(down - slope, 0.0), max(z - w, 0.0)))
          .claimLipschitz(1.0);
  const Expr toBase = norm(max(x - w, 0.0), max(z - w, 0.0), p.y + h);
  const Expr inside = max(out, -h - p.y);
  return solid(insideOr(inside, min(norm(out, toFace), toBase)),
               Box::centred({upper(w), upper(h), upper(w)}));
}

}  // namespace sdf
