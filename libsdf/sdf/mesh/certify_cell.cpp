#include "sdf/mesh/certify_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace sdf {
namespace {

// Far above what double arithmetic on coordinates rounds by, far below what bounds are asked for.
constexpr double kUp = 1.0 + 1e-9;
constexpr double kRounding = 1e-14;  // of coordinates along an axis, as a share of their size
// How much higher than the cell the box is, so that the surface near the mesh is in it.
constexpr double kHeadroom = 0.25;
// Triangles that leave the box by so much of it are no matter for its slopes.
constexpr double kOverhang = 0.5;
constexpr int kQuarterings = 1;
// So many triangles are bounded one by one; a cell with more is divided first, if it can be.
constexpr std::size_t kFewTriangles = 200;
constexpr int kBasePoints = 8;

double magnitudeOf(const glm::dvec3& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z); }

bool overlap(const Box& a, const Box& b) { return !intersect(a, b).empty(); }

// The square of the radius of the smallest circle around a triangle, rounded up.
double enclosingSquare(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  double side[3] = {glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)};
  std::sort(side, side + 3);
  if (side[2] >= side[0] + side[1]) return kUp * side[2] / 4.0;
  // Of an acute triangle the circumscribed one, which is well conditioned.
  const glm::dvec3 n = glm::cross(b - a, c - a);
  return kUp * std::min(side[2] / 3.0, side[0] * side[1] * side[2] / (4.0 * glm::dot(n, n)));
}

// The closest point of a triangle (Ericson 2005, 5.1.5).
glm::dvec3 closest(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  if (d3 >= 0.0 && d4 <= d3) return b;
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / (d4 - d3 + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return sum > 0.0 ? a + vb / sum * ab + vc / sum * ac : a;
}

// Narrows the heights lo.z to hi.z of a triangle to those of its plane over the base, |x| and |y| up to
// `base`.
void narrowHeights(const glm::dvec3 (&c)[3], const glm::dvec3& base, double rounding, glm::dvec3& lo,
                   glm::dvec3& hi) {
  const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
  if (!(std::abs(n.z) > 0.1 * glm::length(n)) ||
      !(glm::length(n) > 1e-3 * glm::dot(c[1] - c[0], c[1] - c[0])))
    return;
  const glm::dvec2 first = glm::max(glm::dvec2(lo), -glm::dvec2(base)),
                   last = glm::min(glm::dvec2(hi), glm::dvec2(base));
  const glm::dvec2 middle = 0.5 * (first + last), half = 0.5 * kUp * (last - first);
  const glm::dvec2 slope = -glm::dvec2(n) / n.z;
  const double height = c[0].z + glm::dot(slope, middle - glm::dvec2(c[0])),
               more = glm::dot(glm::abs(slope), half);
  // The plane's own rounding: of the corners, seen at most 1e3 times as steep, with the slope above.
  const double unsure = 1e5 * rounding;
  lo.z = std::max(lo.z, height - more - unsure);
  hi.z = std::min(hi.z, height + more + unsure);
}

double halfDiagonal(const Box& b) { return kUp * 0.5 * glm::length(b.size()); }

}  // namespace

// A box that stands on the mesh, and the triangles that meet it.
struct CellProver::Upright {
  struct Placed {
    std::uint32_t triangle;
    glm::dvec3 corner[3];  // along the axes
    bool own;              // may meet the cell
    bool inside;           // between floor and ceiling
  };
  glm::dvec3 centre;
  std::array<glm::dvec3, 3> axes;  // the last one is up
  glm::dvec3 radius;
  double wanted;      // the bound that must fit between the cell and the ceiling
  double cellHeight;  // half of the cell's extent upwards
  double rounding;    // of the corners' coordinates
  glm::dvec3 hull;    // radius of the box around the triangles, too
  std::vector<Placed> placed;
  bool isLast;               // the cell is not divided further
  bool throughWalls = true;  // the mesh meets neither floor nor ceiling

  glm::dvec3 along(const glm::dvec3& p) const {
    const glm::dvec3 d = p - centre;
    return {glm::dot(d, axes[0]), glm::dot(d, axes[1]), glm::dot(d, axes[2])};
  }
};

Box CertifiedMesh::boxOf(std::uint32_t triangle) const {
  const glm::uvec3& t = triangles[triangle];
  const glm::dvec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

bool CellProver::isFree(const Tape& tape, const Box& box, double slope) {
  const auto differs = [](const Interval& v, double from) { return !v.nan && (v.lo > from || v.hi < -from); };
  if (slope < kInfinity) {
    const glm::dvec3 c = box.centre();
    const double reach = kUp * slope * halfDiagonal(box);
    if (differs(evaluate(tape, {c, c}, intervals_), reach)) return true;
  }
  return differs(evaluate(tape, box, intervals_), 0.0);
}

// The axis of a narrow cone around the normals of the triangles near the cell (Badoiu, Clarkson 2003): at a
// crease between its sides.
bool CellProver::standUp(const CertifyCell& cell, Upright& up) const {
  const double headroom = std::max(kHeadroom * cell.box.longestSide(), up.wanted);
  const Box near = cell.box.grown(headroom);
  glm::dvec3 sum(0.0), all(0.0);
  std::vector<glm::dvec3> normals;
  for (const std::uint32_t i : cell.triangles) {
    const glm::uvec3& t = mesh_.triangles[i];
    const glm::dvec3& a = mesh_.positions[t.x];
    const glm::dvec3 n = glm::cross(mesh_.positions[t.y] - a, mesh_.positions[t.z] - a);
    all += n;
    if (!overlap(mesh_.boxOf(i), near)) continue;
    sum += n;
    if (const double length = glm::length(n); length > 0.0) normals.push_back(n / length);
  }
  glm::dvec3 up3 = glm::length(sum) > 0.0 ? sum : all;
  if (!(glm::length(up3) > 0.0)) return false;
  up3 = glm::normalize(up3);
  const auto least = [&] {
    return std::min_element(normals.begin(), normals.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
      return glm::dot(a, up3) < glm::dot(b, up3);
    });
  };
  constexpr double kNarrow = 0.9;  // cosine; a cone that is narrow enough as it is
  constexpr int kSteps = 12;
  for (int k = 2; k < kSteps && !normals.empty() && glm::dot(*least(), up3) < kNarrow; ++k) {
    const glm::dvec3 moved = up3 + (*least() - up3) / static_cast<double>(k);
    if (!(glm::length(moved) > 1e-3)) return false;
    up3 = glm::normalize(moved);
  }
  const glm::dvec3 other = std::abs(up3.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(other, up3));
  up.axes = {u, glm::cross(up3, u), up3};
  up.centre = cell.box.centre();
  const glm::dvec3 half = 0.5 * kUp * cell.box.size();
  for (int k = 0; k < 3; ++k) up.radius[k] = glm::dot(glm::abs(up.axes[k]), half);
  up.cellHeight = up.radius[2];
  up.radius[2] += headroom;
  // All triangles that meet the box must be among the cell's.
  const Box reach = cell.reach(options_.goal);
  for (int i = 0; i < 3; ++i) {
    double extent = 0.0;
    for (int k = 0; k < 3; ++k) extent += std::abs(up.axes[k][i]) * up.radius[k];
    if (up.centre[i] + extent * kUp > reach.max[i] || up.centre[i] - extent * kUp < reach.min[i])
      return false;
  }
  return true;
}

void CellProver::gather(const CertifyCell& cell, Upright& up) const {
  const double size = magnitudeOf(up.centre) + cell.box.longestSide();
  up.rounding = 0.0;
  up.hull = up.radius;
  for (const std::uint32_t i : cell.triangles) {
    Upright::Placed placed{i, {}, false, false};
    double far = size;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3& p = mesh_.positions[mesh_.triangles[i][c]];
      placed.corner[c] = up.along(p);
      far = std::max(far, size + magnitudeOf(p));
    }
    const double rounding = kRounding * far;
    glm::dvec3 lo = glm::min(placed.corner[0], glm::min(placed.corner[1], placed.corner[2])) - rounding;
    glm::dvec3 hi = glm::max(placed.corner[0], glm::max(placed.corner[1], placed.corner[2])) + rounding;
    const glm::dvec3& r = up.radius;
    if (glm::any(glm::greaterThan(lo, r)) || glm::any(glm::lessThan(hi, -r))) continue;
    up.rounding = std::max(up.rounding, rounding);
    up.hull = glm::max(up.hull, glm::max(-lo, hi));
    narrowHeights(placed.corner, r, rounding, lo, hi);
    if (lo.z > r.z || hi.z < -r.z) continue;
    placed.inside = hi.z < r.z && lo.z > -r.z;
    up.throughWalls = up.throughWalls && placed.inside;
    placed.own = overlap(mesh_.boxOf(i), cell.box);
    up.placed.push_back(placed);
  }
}

// Does the mesh cover the box's base? Precondition: throughWalls. Counts its sheets with sign over one point,
// which is clear of all sides.
bool CellProver::covers(const Upright& up) const {
  using P2 = glm::dvec2;
  const auto flat = [](const glm::dvec3& p) { return P2(p.x, p.y); };
  const auto cross = [](const P2& a, const P2& b) { return a.x * b.y - a.y * b.x; };
  const auto sheets = [&](const P2& at) -> std::optional<int> {
    int count = 0;
    for (const Upright::Placed& t : up.placed) {
      int positive = 0, negative = 0;
      for (int k = 0; k < 3; ++k) {
        const P2 a = flat(t.corner[k]), b = flat(t.corner[(k + 1) % 3]);
        const double turn = cross(b - a, at - a);
        const double unsure = 8.0 * (up.rounding + kRounding * (glm::length(b - a) + glm::length(at - a))) *
                              (glm::length(b - a) + glm::length(at - a));
        positive += turn > unsure;
        negative += turn < -unsure;
      }
      if (positive == 3) ++count;
      if (negative == 3) --count;
      if (positive + negative < 3 && (positive == 0 || negative == 0)) return std::nullopt;
    }
    return count;
  };
  for (int i = 1; i <= kBasePoints; ++i) {
    // Spread by two irrational ratios, so that no mesh has sides under all of them.
    const P2 share(std::fmod(i * 0.7548776662466927, 1.0), std::fmod(i * 0.5698402909980532, 1.0));
    if (const std::optional<int> n = sheets((1.6 * share - 0.8) * P2(up.radius))) return *n != 0;
  }
  return false;
}

// Bounds |f| over part of a triangle by itself, in parts where that is more than enough.
double CellProver::largestInTriangle(const Tape& tape, const glm::uvec3& t, double enough) {
  const std::array<glm::dvec3, 3> corners{mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]};
  const auto over = [&](const auto& self, const std::array<glm::dvec2, 3>& part, int left) -> double {
    const Interval v = patches_.run(tape, Patch::triangle(corners, part), true).value;
    const double largest = v.nan ? kInfinity : v.magnitude();
    if (largest <= enough || left == 0) return largest;
    const glm::dvec2 &a = part[0], &b = part[1], &c = part[2];
    const glm::dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    double most = 0.0;
    for (const auto& piece : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}) {
      most = std::max(most, self(self, piece, left - 1));
      if (most >= largest) break;
    }
    return std::min(most, largest);
  };
  return over(over, {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}, kQuarterings);
}

// The same, remembered: many cells ask.
double CellProver::largestAlone(const Tape& tape, std::uint32_t triangle, double enough) {
  Alone& known = alone_.try_emplace(triangle, Alone{kInfinity, kInfinity}).first->second;
  if (known.largest > enough && known.enough > enough)
    known = {largestInTriangle(tape, mesh_.triangles[triangle], enough), enough};
  return known.largest;
}

// Bounds |f| over a triangle. What it differs from the linear interpolation of the corners' values by is half
// the curvature times the square of the smallest enclosing circle's radius at most (Waldron 1998). Where that
// is more than enough the same is done for its quarters.
double CellProver::largestValue(const Tape& tape, const Upright& up, std::size_t i, const PatchBounds& field,
                                double enough) {
  const Upright::Placed& placed = up.placed[i];
  const glm::uvec3& t = mesh_.triangles[placed.triangle];
  const glm::dvec3* c = placed.corner;
  const bool oneByOne = up.placed.size() <= kFewTriangles || up.isLast;
  const auto byItself = [&] { return oneByOne ? largestAlone(tape, placed.triangle, enough) : kInfinity; };
  const Interval &a = mesh_.values[t.x], &b = mesh_.values[t.y], &d = mesh_.values[t.z];
  if (!field.curved || a.nan || b.nan || d.nan) return byItself();
  const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
  const double square = enclosingSquare(c[0], c[1], c[2]), area = glm::length(n);
  // How steeply the triangle's plane rises at most, the sine of it.
  const double rise = area > 1e-6 * square ? std::min(1.0, kUp * std::hypot(n.x, n.y) / area + 1e-9) : 1.0;
  const auto& h = field.curvature;
  const double skew = kUp * 2.0 * std::hypot(h[2].magnitude(), h[4].magnitude()) * rise +
                      kUp * h[5].magnitude() * rise * rise;
  const double up2 = std::max(0.0, std::max(h[0].hi, h[3].hi) + h[1].magnitude()) + skew;
  const double down = std::max(0.0, std::max(-h[0].lo, -h[3].lo) + h[1].magnitude()) + skew;
  const auto over = [&](const Interval& a, const Interval& b, const Interval& c, double share) {
    const double low = std::min({a.lo, b.lo, c.lo}) - kUp * 0.5 * share * up2 * square;
    const double high = std::max({a.hi, b.hi, c.hi}) + kUp * 0.5 * share * down * square;
    const double largest = std::max({0.0, -low, high});
    return a.nan || b.nan || c.nan || largest != largest ? kInfinity : largest;
  };
  double largest = over(a, b, d, 1.0);
  if (largest <= enough) return largest;
  if (over(a, b, d, 0.25) <= enough) {
    const auto middle = [&](int from, int to) {
      const glm::dvec3 p = 0.5 * (mesh_.positions[t[from]] + mesh_.positions[t[to]]);
      return evaluate(tape, {p, p}, intervals_);
    };
    const Interval ab = middle(0, 1), bd = middle(1, 2), da = middle(2, 0);
    const double quarters = std::max(
        {over(a, ab, da, 0.25), over(ab, b, bd, 0.25), over(da, bd, d, 0.25), over(ab, bd, da, 0.25)});
    largest = std::min(largest, quarters);
    if (largest <= enough) return largest;
  }
  return std::min(largest, byItself());
}

CellBounds CellProver::bySlope(const CertifyCell& cell, double wanted) {
  CellBounds bounds{0.0, cell.free ? 0.0 : kInfinity};
  const auto failed = CellBounds{kInfinity, bounds.toMesh};
  Upright up;
  up.wanted = 1.01 * wanted;
  up.isLast = cell.box.longestSide() <= options_.finest;
  if (!standUp(cell, up)) return failed;
  gather(cell, up);
  const PatchBounds field = patches_.run(*cell.tape, Patch::box(up.centre, up.axes, up.hull), true);
  double slope = field.slope[2].nan ? 0.0 : field.slope[2].lo;
  if (!(slope > 0.0) || glm::any(glm::greaterThan(up.hull, (1.0 + kOverhang) * up.radius)))
    slope = patches_.leastSlope(*cell.tape, Patch::box(up.centre, up.axes, up.radius), 2);
  if (!(slope > 0.0)) return failed;
  const bool covered = !cell.free && up.throughWalls && covers(up);
  double own = 0.0, inside = 0.0;
  const double enough = wanted * slope / (kUp * kUp);
  for (std::size_t i = 0; i < up.placed.size(); ++i) {
    if (!up.placed[i].own && !covered) continue;
    const double f = largestValue(*cell.tape, up, i, field, enough);
    if (f > enough && !up.isLast) return failed;  // will be divided
    if (up.placed[i].own) own = std::max(own, f);
    if (up.placed[i].inside) inside = std::max(inside, f);
  }
  bounds.toSurface = kUp * own / slope;
  // The surface must be met inside the box.
  if (!(bounds.toSurface < up.radius.z - up.cellHeight)) bounds.toSurface = kInfinity;
  if (covered) bounds.toMesh = kUp * inside / slope;
  return bounds;
}

CellBounds CellProver::bySize(const CertifyCell& cell) {
  CellBounds bounds{kInfinity, cell.free ? 0.0 : kInfinity};
  const glm::dvec3 c = cell.box.centre();
  const double half = halfDiagonal(cell.box);
  double nearest = kInfinity;
  const double rounding = kRounding * (magnitudeOf(c) + options_.bounds.longestSide());
  bool own = false;
  for (const std::uint32_t i : cell.triangles) {
    const glm::uvec3& t = mesh_.triangles[i];
    const auto& p = mesh_.positions;
    nearest = std::min(nearest, kUp * glm::length(closest(c, p[t.x], p[t.y], p[t.z]) - c) + rounding);
    own = own || overlap(mesh_.boxOf(i), cell.box);
  }
  if (!cell.free) bounds.toMesh = nearest + half;
  if (!own) bounds.toSurface = 0.0;
  if (!own) return bounds;
  // A continuous field that has both signs has a zero in between: all along the axes are tried.
  Upright up;
  up.wanted = options_.goal;
  if (!standUp(cell, up)) return bounds;
  for (double reach = 0.25 * half; reach <= half; reach *= 2.0) {
    const auto at = [&](double way) {
      const glm::dvec3 p = c + way * up.axes[2];
      return evaluate(*cell.tape, {p, p}, intervals_);
    };
    const Interval above = at(reach), below = at(-reach);
    if (above.nan || below.nan || !(above.lo > 0.0) || !(below.hi < 0.0)) continue;
    const Box around{c - reach, c + reach};
    if (cell.tape->lipschitz() < kInfinity || lipschitzOver(*cell.tape, around) < kInfinity)
      bounds.toSurface = kUp * (half + reach);
    break;
  }
  return bounds;
}

}  // namespace sdf
