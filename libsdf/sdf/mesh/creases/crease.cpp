#include "sdf/mesh/creases/crease.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

const float kSmooth = std::cos(kCreaseAngle);

// Halvings of an edge: a bend turns by its share of an edge between the last two points, and a crease by all
// of its angle.
constexpr int kCreaseHalvings = 5;

// Voxels that a point may be moved by: the edge of a wedge that is thinner than a voxel is that far from its
// samples.
constexpr double kCreaseReach = 2.0;
// The same on the first step from an edge, which goes by the planes at its ends: the tip of a wedge of 15
// degrees is this far from where it is a voxel thick.
constexpr double kTip = 4.0;
// Of 1 + cosine: the normals of a wedge of 1 degree.
constexpr double kThinnest = 1.5e-4;
// Voxels from a crease at which its sides are looked at, one reading after the other.
constexpr double kCreaseProbes[] = {0.1, 0.01};
// The same where that met another side. Beyond the tip of a thin wedge, whose place is uncertain by the bend
// of its sides divided by its angle, both sides read as one.
constexpr double kPatientProbes[] = {1.0, 0.5, 0.25, 0.1, 0.05, 0.02, 0.01};
// A side that turns by more between two readings is another one: cos 20 degrees.
constexpr double kSameSide = 0.94;
// Voxels that the surface may be away from a point on it.
constexpr double kOnSurface = 1e-3;

/// A tangent plane of the surface: normal · x + offset = 0.
struct Plane {
  glm::dvec3 normal{0.0};
  double offset = 0.0;

  double at(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
};

/// Values and gradients at points that share their tapes.
struct Reading {
  PointRows points, gradients;
  float value[kBatchPoints];

  void read(const PointRun& run, std::size_t count) {
    run.batch.evaluateGradient(*run.tapes.distance, points.rows(), count, value, gradients.x, gradients.y,
                               gradients.z);
  }
  /// To the first order; its normal is no number where there is no gradient.
  Plane plane(std::size_t i) const {
    const glm::dvec3 g(gradients.at(i)), p(points.at(i));
    const double length = glm::length(g);
    return {g / length, value[i] / length - glm::dot(g, p) / length};
  }
};

// Voxels from where two sides, with this cosine between their normals, are two voxels apart to where they
// meet.
double reachOf(double cosine) { return std::sqrt((1.0 - cosine) / std::max(1.0 + cosine, kThinnest)); }

// Is the surface convex between two points, where it has these normals, with such a way from the second to
// the first?
bool isConvex(const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& way) {
  return glm::dot(first - second, way) > 0.0;
}

// Is what lies between two points all inside, or all outside? So it is up to the edge of a thin wedge, or
// groove, and not beyond a face that cuts that off.
bool isAll(bool inside, const PointRun& run, const glm::dvec3& from, const glm::dvec3& to) {
  Reading r;
  for (int k = 0; k < 3; ++k) r.points.set(k, glm::vec3(glm::mix(from, to, 0.25 * (k + 1))));
  r.read(run, 3);
  return std::all_of(r.value, r.value + 3, [&](float value) { return (value < 0.0f) == inside; });
}

/// The step of least length from p to where two planes meet.
glm::dvec3 toCommonLine(const Plane& a, const Plane& b, const glm::dvec3& p) {
  const double c = glm::dot(a.normal, b.normal), det = 1.0 - c * c, u = a.at(p), v = b.at(p);
  return a.normal * ((c * v - u) / det) + b.normal * ((c * u - v) / det);
}

// Planes whose normals span less than this volume do not meet in a certain point.
constexpr double kFlatCrease = 0.02;

/// The step from p to where three planes meet, or to the common line of the two that differ most.
glm::dvec3 toCommonPoint(const std::array<Plane, 3>& s, const glm::dvec3& p) {
  const glm::dmat3 normals(s[0].normal, s[1].normal, s[2].normal);
  if (std::abs(glm::determinant(normals)) > kFlatCrease)
    return -(glm::dvec3(s[0].at(p), s[1].at(p), s[2].at(p)) * glm::inverse(normals));
  int sharpest = 0;  // the pair without it
  const auto cosine = [&](int k) { return glm::dot(s[(k + 1) % 3].normal, s[(k + 2) % 3].normal); };
  for (int k = 1; k < 3; ++k)
    if (cosine(k) < cosine(sharpest)) sharpest = k;
  return toCommonLine(s[(sharpest + 1) % 3], s[(sharpest + 2) % 3], p);
}

/// The ways from a corner into the middles of its three pieces. A piece is a sector between two creases; on
/// which side of the corner each crease lies is told by the points of the pieces beside it.
std::array<glm::dvec3, 3> waysInto(const std::array<Plane, 3>& s, const CornerPoint& c,
                                   const glm::dvec3& at) {
  std::array<glm::dvec3, 3> crease;  // opposite to the piece of this number
  for (int k = 0; k < 3; ++k)
    crease[k] = glm::normalize(glm::cross(s[(k + 1) % 3].normal, s[(k + 2) % 3].normal));
  std::array<double, 3> along{};
  for (int k = 0; k < 3; ++k) {
    // The piece's point in terms of the two creases beside it.
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const glm::dvec3 p = glm::dvec3(c.on[k]) - at, n = s[k].normal;
    const double area = glm::dot(glm::cross(crease[u], crease[v]), n);
    along[u] += glm::dot(glm::cross(p, crease[v]), n) / area;
    along[v] += glm::dot(glm::cross(crease[u], p), n) / area;
  }
  std::array<glm::dvec3, 3> ways;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    ways[k] =
        glm::normalize(std::copysign(1.0, along[u]) * crease[u] + std::copysign(1.0, along[v]) * crease[v]);
  }
  return ways;
}

// As told by the normals at the points of its pieces.
std::array<Plane, 3> sidesOf(const CornerPoint& c) {
  std::array<Plane, 3> sides;
  for (int k = 0; k < 3; ++k)
    sides[k] = {glm::dvec3(c.normal[k]), -glm::dot(glm::dvec3(c.normal[k]), glm::dvec3(c.on[k]))};
  return sides;
}

// Voxels that a corner may be moved by.
double reachOf(const std::array<Plane, 3>& sides) {
  double sharpest = 1.0;
  for (int k = 0; k < 3; ++k)
    sharpest = std::min(sharpest, glm::dot(sides[k].normal, sides[(k + 1) % 3].normal));
  return std::max(kCreaseReach, reachOf(sharpest));
}

// Moves a corner to where its sides meet; far only where the body, or the gap, that ends in it goes on to
// there.
void startCorner(const PointRun& run, CornerPoint& c) {
  const std::array<Plane, 3> sides = sidesOf(c);
  const glm::dvec3 start(c.at), at = start + toCommonPoint(sides, start);
  const double far = glm::distance(at, start) / run.voxel;
  int convex = 0;
  for (int k = 0; k < 3; ++k)
    if (isConvex(c.normal[k], c.normal[(k + 1) % 3], c.on[k] - c.on[(k + 1) % 3])) ++convex;
  c.placed =
      far <= kCreaseReach || (far <= reachOf(sides) && convex % 3 == 0 && isAll(convex == 3, run, start, at));
  if (c.placed) c.at = glm::vec3(at);
}

// From where it was moved to; `start` is where it was.
void approachCorner(const PointRun& run, const glm::dvec3& start, CornerPoint& c) {
  std::array<Plane, 3> sides = sidesOf(c);
  glm::dvec3 at(c.at);
  Reading r;
  for (const double reach : kCreaseProbes) {
    if (!c.placed) return;
    const auto middles = waysInto(sides, c, at);
    for (int k = 0; k < 3; ++k) {
      // Where more than three pieces meet a piece's middle is not between these creases: the way to its
      // point is in it, unless it bends.
      const glm::dvec3 toPoint = glm::normalize(glm::dvec3(c.on[k]) - at);
      r.points.set(2 * k, glm::vec3(at + middles[k] * (reach * run.voxel)));
      r.points.set(2 * k + 1, glm::vec3(at + toPoint * (reach * run.voxel)));
    }
    r.read(run, 6);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 expected(c.normal[k]);
      const Plane middle = r.plane(2 * k);
      sides[k] = glm::dot(middle.normal, expected) > kSameSide ? middle : r.plane(2 * k + 1);
      c.placed = c.placed && glm::dot(sides[k].normal, expected) > kSameSide;
    }
    if (!c.placed) return;
    at += toCommonPoint(sides, at);
    c.placed = glm::distance(at, start) <= reachOf(sides) * run.voxel;
  }
  if (c.placed) c.at = glm::vec3(at);
}

/// The ways into the two sides of a crease, square to it.
std::array<glm::dvec3, 2> waysInto(const CreasePoint& p) {
  const glm::dvec3 a(p.normal[0]), b(p.normal[1]);
  const glm::dvec3 along = glm::normalize(glm::cross(a, b));
  const double convex = isConvex(a, b, glm::dvec3(p.toFirst)) ? 1.0 : -1.0;
  return {convex * glm::cross(a, along), -convex * glm::cross(b, along)};
}

/// Up to kBatchPoints / 2 points on their way to their creases.
class CreasePlacer {
 public:
  CreasePlacer(const PointRun& run, std::span<CreasePoint> points) : run_(run), points_(points) {
    for (CreasePoint& p : points_) p.placed = true, p.corner = false;
  }

  void place(std::span<const double> probes) {
    for (const double reach : probes) approach(reach * run_.voxel);
    readPoints();
    // Beyond the crease's end a third piece is the surface; near it the probes meet one.
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!points_[i].placed || !onSurface(i)) toEnd(i);
    if (std::ranges::none_of(points_, &CreasePoint::corner)) return;
    readPoints();
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i].placed = points_[i].placed && onSurface(i);
  }

 private:
  // One step of Newton's method with planes from so far away.
  void approach(double reach) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto ways = waysInto(points_[i]);
      for (int k = 0; k < 2; ++k)
        r_.points.set(2 * i + k, glm::vec3(glm::dvec3(points_[i].at) + ways[k] * reach));
    }
    r_.read(run_, 2 * points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      CreasePoint& p = points_[i];
      const Plane a = r_.plane(2 * i), b = r_.plane(2 * i + 1);
      p.placed = p.placed && isSame(a, p.normal[0]) && isSame(b, p.normal[1]) &&
                 glm::dot(a.normal, b.normal) < kSmooth && move(p, toCommonLine(a, b, glm::dvec3(p.at)));
      if (p.placed) p.normal = {glm::vec3(a.normal), glm::vec3(b.normal)};
    }
  }

  static bool isSame(const Plane& side, const glm::vec3& normal) {
    return glm::dot(side.normal, glm::dvec3(normal)) > kSameSide;
  }

  bool move(CreasePoint& p, const glm::dvec3& step) const {
    if (!(glm::length(step) <= kCreaseReach * run_.voxel)) return false;
    p.at = glm::vec3(glm::dvec3(p.at) + step);
    return true;
  }

  void toEnd(std::size_t i) {
    CreasePoint& p = points_[i];
    const Plane third = r_.plane(i);
    p.placed = !isSame(third, p.normal[0]) && !isSame(third, p.normal[1]);
    if (!p.placed) return;
    const glm::dvec3 at(p.at), a(p.normal[0]), b(p.normal[1]);
    p.corner = p.placed =
        move(p, toCommonPoint({Plane{a, -glm::dot(a, at)}, Plane{b, -glm::dot(b, at)}, third}, at));
  }

  void readPoints() {
    for (std::size_t i = 0; i < points_.size(); ++i) r_.points.set(i, points_[i].at);
    r_.read(run_, points_.size());
  }

  bool onSurface(std::size_t i) const {
    return std::abs(r_.value[i]) <= kOnSurface * run_.voxel * glm::length(glm::dvec3(r_.gradients.at(i)));
  }

  const PointRun& run_;
  std::span<CreasePoint> points_;
  Reading r_;
};

void placeRun(const PointRun& run, CreasePoint* points) {
  for (std::size_t first = 0; first < run.count; first += kBatchPoints / 2) {
    const std::span<CreasePoint> some(points + first, std::min(run.count - first, kBatchPoints / 2));
    std::vector<CreasePoint> again(some.begin(), some.end());
    CreasePlacer(run, some).place(kCreaseProbes);
    std::vector<std::size_t> missed;
    for (std::size_t i = 0; i < some.size(); ++i)
      if (!some[i].placed) again[missed.size()] = again[i], missed.push_back(i);
    if (missed.empty()) continue;
    again.resize(missed.size());
    CreasePlacer(run, again).place(kPatientProbes);
    for (std::size_t k = 0; k < missed.size(); ++k) some[missed[k]] = again[k];
  }
}

// Can the surface of this formula have creases? What it is made of may be smooth; and what is interpolated
// between samples has a kink wherever two of its cells meet, which are no creases.
bool mayCrease(const Tape& tape) {
  bool kinks = false;
  for (const RegisterInstruction& i : tape.program()) {
    const PayloadPart* const part = tape.payload(i);
    if (part && !part->payload->hasCreases()) return false;
    kinks = kinks || part || info(i.op).smoothness == Smoothness::MayKink;
  }
  return kinks;
}

/// The part of an edge where the gradient turns most.
struct Bend {
  std::size_t candidate;
  std::array<glm::vec3, 2> at;
  std::array<glm::dvec3, 2> normal;
  std::array<Plane, 2> plane;

  double cosine() const { return glm::dot(normal[0], normal[1]); }
  glm::vec3 middle() const { return (at[0] + at[1]) * 0.5f; }
};

/// Halves the edges where the gradient jumps; candidates[i].placed tells where one does.
void halveRun(const PointRun& run, std::vector<Bend>& bends, Crossing* found) {
  Reading r;
  for (int step = 0; step < kCreaseHalvings && !bends.empty(); ++step) {
    for (std::size_t i = 0; i < bends.size(); ++i) r.points.set(i, bends[i].middle());
    r.read(run, bends.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bends.size(); ++i) {
      Bend b = bends[i];
      const Plane middle = r.plane(i);
      const double first = glm::dot(b.normal[0], middle.normal),
                   second = glm::dot(middle.normal, b.normal[1]);
      const int side = first <= second ? 1 : 0;  // the end that the middle replaces
      b.at[side] = r.points.at(i), b.normal[side] = middle.normal, b.plane[side] = middle;
      if (b.cosine() < kSmooth) bends[kept++] = b;
    }
    bends.resize(kept);
  }
  for (const Bend& b : bends) {
    CreasePoint& p = found[b.candidate].point;
    const glm::dvec3 at(b.middle()), step = toCommonLine(b.plane[0], b.plane[1], at);
    const double far = glm::length(step) / run.voxel;
    const bool isInside = isConvex(b.normal[0], b.normal[1], glm::dvec3(p.toFirst));
    if (!(far <= kTip) && !(far <= reachOf(b.cosine()) && isAll(isInside, run, at, at + step))) continue;
    p.at = glm::vec3(at + step);
    p.normal = {glm::vec3(b.normal[0]), glm::vec3(b.normal[1])};
    p.placed = true;
  }
}

}  // namespace

void placeOnCreases(std::span<CreasePoint> points, const LocalField& field, Progress& progress) {
  forEachRun(
      points.size(), [&](std::size_t i) { return points[i].at; }, field, progress,
      [&](const PointRun& run) { placeRun(run, &points[run.first]); });
}

void placeCorners(std::span<CornerPoint> corners, const LocalField& field, Progress& progress) {
  std::vector<glm::vec3> starts;
  for (const CornerPoint& c : corners) starts.push_back(c.at);
  const auto at = [&](std::size_t i) { return corners[i].at; };
  // Each step with the tapes that hold where it is made.
  const auto start = [&](const PointRun& run) {
    for (std::size_t i = 0; i < run.count; ++i) startCorner(run, corners[run.first + i]);
  };
  forEachRun(
      corners.size(), [&](std::size_t i) { return starts[i]; }, field, progress, start);
  const auto approach = [&](const PointRun& run) {
    for (std::size_t i = 0; i < run.count; ++i)
      approachCorner(run, starts[run.first + i], corners[run.first + i]);
  };
  forEachRun(corners.size(), at, field, progress, approach);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (!corners[i].placed) corners[i].at = starts[i];
}

namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;

// Each edge whose ends have different normals, once.
Edges edgesThatTurn(const std::vector<glm::vec3>& normals, const std::vector<glm::uvec3>& triangles) {
  return collected<Edges::value_type>(triangles.size(), [&](std::uint32_t t, Edges& out) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      if (a < b && glm::dot(normals[a], normals[b]) < kSmooth) out.push_back({a, b});
    }
  });
}

// Where both halves of an edge turn by nearly as much, the surface bends and has no crease there.
bool turnsEvenly(const glm::vec3& from, const glm::vec3& middle, const glm::vec3& to) {
  constexpr float kEven = 0.6f;  // of the whole, the larger half at most; angles by their chords
  const float whole = glm::distance(from, to);
  return std::max(glm::distance(from, middle), glm::distance(middle, to)) < kEven * whole;
}

}  // namespace

std::vector<Crossing> findCrossings(const std::vector<glm::vec3>& positions,
                                    const std::vector<glm::vec3>& normals,
                                    const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                    Progress& progress) {
  const Edges edges = edgesThatTurn(normals, triangles);
  const auto middle = [&](const std::array<std::uint32_t, 2>& e) {
    return 0.5f * (positions[e[0]] + positions[e[1]]);
  };
  std::vector<char> jumps(edges.size(), 0);
  forEachRun(
      edges.size(), [&](std::size_t i) { return middle(edges[i]); }, field, progress,
      [&](const PointRun& run) {
        if (!mayCrease(*run.tapes.distance)) return;
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) {
          const auto [a, b] = edges[run.first + i];
          jumps[run.first + i] = !turnsEvenly(normals[a], glm::normalize(g.gradient(i)), normals[b]);
        }
      });
  std::vector<Crossing> found;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (const auto [a, b] = edges[i]; jumps[i])
      found.push_back({edges[i], {{}, {}, positions[a] - positions[b]}});
  const auto plane = [&](std::uint32_t v) {
    return Plane{glm::dvec3(normals[v]), -glm::dot(glm::dvec3(normals[v]), glm::dvec3(positions[v]))};
  };
  forEachRun(
      found.size(), [&](std::size_t i) { return middle(found[i].edge); }, field, progress,
      [&](const PointRun& run) {
        std::vector<Bend> bends;
        for (std::size_t i = 0; i < run.count; ++i) {
          const auto [a, b] = found[run.first + i].edge;
          bends.push_back({i,
                           {positions[a], positions[b]},
                           {glm::dvec3(normals[a]), glm::dvec3(normals[b])},
                           {plane(a), plane(b)}});
        }
        halveRun(run, bends, &found[run.first]);
      });
  std::erase_if(found, [](const Crossing& c) { return !c.point.placed; });
  std::vector<CreasePoint> points;
  for (const Crossing& c : found) points.push_back(c.point);
  placeOnCreases(points, field, progress);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].point = points[i];
  return found;
}

}  // namespace sdf
