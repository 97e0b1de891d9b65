#include "deformed_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <random>
#include <sstream>
#include <utility>

#include "accuracy/check_points.h"
#include "accuracy/solids/meshes.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

constexpr double kFinest = 0.03;  // edges of meshes, scene units
constexpr int kSamples = 800, kSamplesAbout = 1500, kPlacesNear = 600, kCells = 4000;
// Room is looked for up to this share of the smallest half size; no operator here needs more.
constexpr double kMostRoom = 0.5;
// Faces that meet at more than this are an edge; those of a curved face turn by less from one to the next.
constexpr double kEdge = 0.5;
// Of so many vertices one is asked how the map stretches; it changes little from one to the next.
constexpr std::size_t kEvery = 8;

double radians(double degrees) { return degrees * kPi / 180.0; }

std::string call(const char* name, std::initializer_list<double> arguments) {
  std::ostringstream text;
  text << name << "(";
  for (const double* a = arguments.begin(); a != arguments.end(); ++a)
    text << (a == arguments.begin() ? "" : ", ") << *a;
  text << ")";
  return text.str();
}

// The columns of the map's Jacobian.
std::array<glm::dvec3, 3> jacobian(const PointMap& map, const glm::dvec3& p) {
  return derivatives(map, p, 1e-5);
}

// How much more the map stretches one direction than another at p: the quotient of its singular values. Their
// squares are the eigenvalues of J^T J, by the trigonometric solution of its characteristic polynomial.
double unevennessAt(const PointMap& map, const glm::dvec3& p) {
  const auto j = jacobian(map, p);
  glm::dmat3 square;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) square[a][b] = glm::dot(j[a], j[b]);
  const double mean = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
  const glm::dmat3 rest = square - glm::dmat3(mean);
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) sum += glm::dot(rest[a], rest[a]);
  const double spread = std::sqrt(sum / 6.0);
  if (spread < 1e-9 * mean) return 1.0;
  const double angle = std::acos(std::clamp(glm::determinant(rest / spread) / 2.0, -1.0, 1.0)) / 3.0;
  return std::sqrt((mean + 2.0 * spread * std::cos(angle)) /
                   (mean + 2.0 * spread * std::cos(angle + 2.0 * kPi / 3.0)));
}

// Normals go with the cofactors.
SurfacePoint mappedPoint(const PointMap& map, const SurfacePoint& s) {
  const auto [x, y, z] = jacobian(map, s.at);
  const glm::dvec3& n = s.normal;
  return {map(s.at),
          glm::normalize(n.x * glm::cross(y, z) + n.y * glm::cross(z, x) + n.z * glm::cross(x, y))};
}

std::vector<glm::dvec2> finer(const std::vector<glm::dvec2>& corners) {
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const int steps = static_cast<int>(std::ceil(glm::distance(a, b) / kFinest));
    for (int k = 0; k < steps; ++k) points.push_back(glm::mix(a, b, double(k) / steps));
  }
  return points;
}

// The outline in x and z, which the origin sees whole, swept along y; its lids in rings about the axis.
TriangleMesh columnMesh(const std::vector<glm::dvec2>& outline, double halfHeight) {
  double radius = 0.0;
  for (const glm::dvec2& p : outline) radius = std::max(radius, glm::length(p));
  const int rings = static_cast<int>(std::ceil(radius / kFinest)),
            levels = static_cast<int>(std::ceil(2.0 * halfHeight / kFinest));
  std::vector<std::vector<glm::dvec3>> rows;
  const auto add = [&](double share, double y) {
    std::vector<glm::dvec3>& row = rows.emplace_back();
    for (const glm::dvec2& p : outline) row.emplace_back(p.x * share, y, p.y * share);
  };
  for (int i = 0; i < rings; ++i) add(double(i) / rings, -halfHeight);
  for (int i = 0; i <= levels; ++i) add(1.0, halfHeight * (2.0 * i / levels - 1.0));
  for (int i = rings - 1; i >= 0; --i) add(double(i) / rings, halfHeight);
  for (std::vector<glm::dvec3>* lid : {&rows.front(), &rows.back()})
    for (glm::dvec3& p : *lid) p = {0.0, p.y, 0.0};
  return welded(rowsJoined(rows, true));
}

double columnDistance(double side, double lid) {
  return std::min(std::max(side, lid), 0.0) + std::hypot(std::max(side, 0.0), std::max(lid, 0.0));
}

double polygonDistance(const std::vector<glm::dvec2>& corners, const glm::dvec2& p) {
  double nearest = kInfinity;
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()], way = b - a;
    const double along = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, a + along * way));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * way.x) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

const auto kOrigin = [](const glm::dvec3&) { return glm::dvec3(0.0); };

Part boxPart() {
  const glm::dvec3 half(0.4, 1.0, 0.4);
  return {call("box", {half.x, half.y, half.z}),
          box(Vec3E(half.x, half.y, half.z)),
          columnMesh(finer({{0.4, 0.4}, {-0.4, 0.4}, {-0.4, -0.4}, {0.4, -0.4}}), half.y),
          [=](const glm::dvec3& p) {
            const glm::dvec3 q = glm::abs(p) - half;
            return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
          },
          kOrigin,
          0.4};
}

Part cylinderPart() {
  constexpr double kRadius = 0.5, kHalfHeight = 0.8;
  std::vector<glm::dvec2> circle;
  const int steps = 96;
  for (int i = 0; i < steps; ++i)
    circle.push_back(kRadius * glm::dvec2(std::cos(2 * kPi * i / steps), std::sin(2 * kPi * i / steps)));
  return {call("cylinder", {kRadius, kHalfHeight}),
          cylinder(kRadius, kHalfHeight),
          columnMesh(circle, kHalfHeight),
          [](const glm::dvec3& p) {
            return columnDistance(std::hypot(p.x, p.z) - kRadius, std::abs(p.y) - kHalfHeight);
          },
          kOrigin,
          kRadius};
}

Part starPart() {
  constexpr double kOuter = 0.8, kInner = 0.5, kHalfHeight = 0.8;
  std::vector<glm::dvec2> corners;
  for (int i = 0; i < 10; ++i) {
    const double angle = kPi / 5.0 * i;
    corners.push_back((i % 2 ? kInner : kOuter) * glm::dvec2(std::sin(angle), std::cos(angle)));
  }
  return {"star(5, 0.8, 0.5):extrude(0.8):rotate(90, 0, 0)",
          rotate(extrude(star(5, kOuter, kInner), kHalfHeight), Vec3E(kPi / 2.0, 0.0, 0.0)),
          columnMesh(finer(corners), kHalfHeight),
          [=](const glm::dvec3& p) {
            return columnDistance(polygonDistance(corners, {p.x, p.z}), std::abs(p.y) - kHalfHeight);
          },
          kOrigin,
          0.3};
}

const glm::dvec3 kAside{0.3, 0.1, 0.2};

Part spherePart() {
  constexpr double kRadius = 0.5;
  return {call("sphere", {kRadius}) + ":translate(0.3, 0.1, 0.2)",
          translate(sphere(kRadius), Vec3E(kAside.x, kAside.y, kAside.z)),
          moved(sphereMesh(kRadius, 5), kAside),
          [](const glm::dvec3& p) { return glm::distance(p, kAside) - kRadius; },
          [](const glm::dvec3&) { return kAside; },
          kRadius};
}

Part torusPart() {
  constexpr double kMajor = 0.6, kMinor = 0.2;
  constexpr int kAround = 192, kTube = 72;
  std::vector<std::vector<glm::dvec3>> rows;
  for (int i = 0; i < kAround; ++i) {
    const double a = 2.0 * kPi * i / kAround;
    std::vector<glm::dvec3>& row = rows.emplace_back();
    for (int j = 0; j < kTube; ++j) {
      const double b = 2.0 * kPi * j / kTube, r = kMajor + kMinor * std::cos(b);
      row.emplace_back(r * std::cos(a), kMinor * std::sin(b), r * std::sin(a));
    }
  }
  rows.push_back(rows.front());
  return {call("torus", {kMajor, kMinor}) + ":translate(0.3, 0.1, 0.2)",
          translate(torus(kMajor, kMinor), Vec3E(kAside.x, kAside.y, kAside.z)),
          moved(welded(rowsJoined(rows, true)), kAside),
          [](const glm::dvec3& p) {
            const glm::dvec3 q = p - kAside;
            return std::hypot(std::hypot(q.x, q.z) - kMajor, q.y) - kMinor;
          },
          [](const glm::dvec3& p) {
            const glm::dvec3 q(p.x - kAside.x, 0.0, p.z - kAside.z);
            return kAside + q * (kMajor / glm::length(q));
          },
          kMinor};
}

// Rates by what they do at the part's ends, in whole hundredths.
double hundredths(double v) { return std::round(100.0 * v) / 100.0; }
double highest(const Deformed& d) {
  const Box b = boxOf(d.mesh);
  return std::max(std::abs(b.min.y), std::abs(b.max.y));
}
Deformed taperedTo(const Deformed& d, double change) { return tapered(d, hundredths(change / highest(d))); }
Deformed bentTo(const Deformed& d, double fold) {
  return bent(d, std::round(fold / highest(d) * 180.0 / kPi));
}

// Points of all edges, no farther apart than the mesh is fine.
std::vector<glm::dvec3> sharpEdges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, glm::dvec3> normals;
  std::vector<glm::dvec3> points;
  for (const glm::ivec3& t : mesh.triangles) {
    const glm::dvec3 n =
        glm::normalize(glm::cross(mesh.points[t.y] - mesh.points[t.x], mesh.points[t.z] - mesh.points[t.x]));
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const auto [at, isNew] = normals.try_emplace(std::minmax(a, b), n);
      if (!isNew && glm::dot(at->second, n) < std::cos(kEdge))
        points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    }
  }
  return points;
}

// Uniform over these triangles of the part's surface.
class Surface {
 public:
  explicit Surface(const Part& part, std::vector<glm::ivec3> triangles)
      : part_(part), triangles_(std::move(triangles)), byArea_(part.mesh.points, triangles_) {}

  SurfacePoint any(std::mt19937& random) const {
    std::uniform_real_distribution<> share(0.0, 1.0);
    const glm::ivec3& t = triangles_[byArea_.at(share(random))];
    double u = share(random), v = share(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const auto& p = part_.mesh.points;
    glm::dvec3 s = p[t.x] + u * (p[t.y] - p[t.x]) + v * (p[t.z] - p[t.x]);
    glm::dvec3 normal;
    for (int i = 0; i < 3; ++i) {
      normal = gradient(part_.distance, s);
      s -= part_.distance(s) * normal;
    }
    return {s, glm::normalize(normal)};
  }

 private:
  const Part& part_;
  std::vector<glm::ivec3> triangles_;
  ByArea byArea_;
};

}  // namespace

const std::vector<NamedPart>& deformedParts() {
  static const std::vector<NamedPart> kParts{{"box", boxPart},
                                             {"torus", torusPart},
                                             {"sphere", spherePart},
                                             {"cylinder", cylinderPart},
                                             {"star", starPart}};
  return kParts;
}

Deformed undeformed(const Part& part) {
  return {part.text, part.shape, part.mesh, [](const SurfacePoint& s) { return s; }, part.half};
}

Deformed deformedBy(const Deformed& d, std::string text, Shape shape, const PointMap& map, double thinner) {
  double uneven = 1.0;
  for (std::size_t i = 0; i < d.mesh.points.size(); i += kEvery)
    uneven = std::max(uneven, unevennessAt(map, d.mesh.points[i]));
  return {d.text + ":" + std::move(text),
          std::move(shape),
          mapped(d.mesh, map),
          [map, before = d.map](const SurfacePoint& s) { return mappedPoint(map, before(s)); },
          d.half * thinner,
          d.unevenness * uneven};
}

Deformed twisted(const Deformed& d, double degrees) {
  const double rate = radians(degrees);
  return deformedBy(d, call("twist", {degrees}), twist(d.shape, rate), twistMap(rate), 1.0);
}

Deformed tapered(const Deformed& d, double rate) {
  return deformedBy(d, call("taper", {rate}), taper(d.shape, rate), taperMap(rate),
                    1.0 - std::abs(rate) * highest(d));
}

Deformed bent(const Deformed& d, double degrees) {
  const double k = radians(degrees);
  return deformedBy(d, call("bend", {degrees}), bend(d.shape, k), bendMap(k), 1.0 - std::abs(k) * highest(d));
}

Deformed scaledBy(const Deformed& d, const glm::dvec3& factors) {
  return deformedBy(
      d, call("scale", {factors.x, factors.y, factors.z}),
      scale(d.shape, Vec3E(factors.x, factors.y, factors.z)),
      [=](const glm::dvec3& p) { return factors * p; }, std::min({factors.x, factors.y, factors.z}));
}

Deformed laidDown(const Deformed& d) {
  return deformedBy(
      d, "rotate(0, 0, 90)", rotate(d.shape, Vec3E(0.0, 0.0, kPi / 2.0)),
      [](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z); }, 1.0);
}

Deformed displaced(const Part& part, double amplitude, double frequency) {
  const auto sum = [=, distance = part.distance](const glm::dvec3& p) {
    const glm::dvec3 wave = glm::sin(frequency * p);
    return distance(p) + amplitude * wave.x * wave.y * wave.z;
  };
  const PointMap along = [=, core = part.core](const glm::dvec3& p) {
    const glm::dvec3 from = core(p), way = p - from;
    double inside = 0.5, outside = 1.5;
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (inside + outside);
      (sum(from + middle * way) < 0.0 ? inside : outside) = middle;
    }
    return from + inside * way;
  };
  return {part.text + ":" + call("displace", {amplitude, frequency}),
          displace(part.shape, amplitude, frequency), mapped(part.mesh, along),
          [=](const SurfacePoint& s) {
            const glm::dvec3 at = along(s.at);
            return SurfacePoint{at, glm::normalize(gradient(sum, at))};
          },
          part.half - amplitude};
}

std::vector<SurfacePoint> surfaceOf(const Part& part, const Deformed& d, int count, unsigned seed) {
  std::mt19937 random(seed);
  const Surface surface(part, part.mesh.triangles);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) points.push_back(d.map(surface.any(random)));
  return points;
}

const std::vector<Deformation>& deformations() {
  static const std::vector<Deformation> kAll{
      {"twist", true, [](const Part& p) { return twisted(undeformed(p), 60.0); }},
      {"twist_much", false, [](const Part& p) { return twisted(undeformed(p), 150.0); }},
      {"taper", true, [](const Part& p) { return taperedTo(undeformed(p), 0.4); }},
      {"taper_much", false, [](const Part& p) { return taperedTo(undeformed(p), -0.7); }},
      {"bend", true, [](const Part& p) { return bentTo(laidDown(undeformed(p)), 0.3); }},
      {"bend_much", false, [](const Part& p) { return bentTo(laidDown(undeformed(p)), 0.6); }},
      {"scale", true,
       [](const Part& p) {
         return scaledBy(undeformed(p), {1.0, 0.7, 1.4});
       }},
      {"scale_much", false,
       [](const Part& p) {
         return scaledBy(undeformed(p), {1.0, 1.5, 0.4});
       }},
      {"displace", true, [](const Part& p) { return displaced(p, 0.04, 6.0); }},
      {"displace_much", false, [](const Part& p) { return displaced(p, 0.05, 10.0); }},
      {"taper_twist", true, [](const Part& p) { return twisted(taperedTo(undeformed(p), 0.3), 60.0); }},
      {"twist_bend", true, [](const Part& p) { return bentTo(laidDown(twisted(undeformed(p), 60.0)), 0.3); }},
  };
  return kAll;
}

DeformedSolid::DeformedSolid(const Part& part, Deformed deformed, unsigned seed)
    : deformed_(std::move(deformed)),
      reference_(deformed_.mesh),
      box_(boxOf(deformed_.mesh)),
      edges_(sharpEdges(deformed_.mesh)) {
  std::mt19937 random(seed);
  std::normal_distribution<> normal;
  const auto anyWay = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
  const Surface surface(part, part.mesh.triangles);
  for (int i = 0; i < kSamples; ++i) samples_.push_back(sampleAt(deformed_.map(surface.any(random))));
  for (const Sample& s : samples_) chord_ = std::max(chord_, reference_.distance(s.at));
  roomiest_ = std::ranges::max_element(samples_, {}, &Sample::room) - samples_.begin();
  // Triangles of the part are those of the deformed mesh, in the same order.
  const glm::dvec3 about = roomiest().at;
  std::vector<glm::ivec3> near;
  for (const glm::ivec3& t : part.mesh.triangles)
    if (glm::distance(deformed_.mesh.points[t.x], about) < half() + 2.0 * kFinest) near.push_back(t);
  const Surface patch(part, std::move(near));
  while (samples_.size() < kSamples + kSamplesAbout) {
    const SurfacePoint s = deformed_.map(patch.any(random));
    if (glm::distance(s.at, about) < 0.8 * half()) samples_.push_back(sampleAt(s));
  }
  for (int i = 0; i < kPlacesNear; ++i) places_.push_back(place(samples_[i].at + 0.5 * half() * anyWay()));
  // One in each cell of a lattice, so that no piece that is larger than a cell is missed.
  const Box around = box_.grown(0.3 * size());
  const glm::dvec3 extent = around.size();
  const double cell = std::cbrt(extent.x * extent.y * extent.z / kCells);
  const glm::ivec3 count = glm::ceil(extent / cell);
  std::uniform_real_distribution<> share(0.0, 1.0);
  for (int i = 0; i < count.x * count.y * count.z; ++i) {
    const glm::dvec3 at(i % count.x, i / count.x % count.y, i / count.x / count.y);
    const glm::dvec3 within(share(random), share(random), share(random));
    places_.push_back(place(around.min + extent * (at + within) / glm::dvec3(count)));
  }
}

double DeformedSolid::toEdge(const glm::dvec3& p) const {
  double least = kInfinity;
  for (const glm::dvec3& e : edges_) least = std::min(least, glm::dot(e - p, e - p));
  return std::sqrt(least);
}

DeformedSolid::Sample DeformedSolid::sampleAt(const SurfacePoint& s) const {
  double room = std::min(kMostRoom * half(), toEdge(s.at));
  for (const double way : {-1.0, 1.0}) {
    const auto isNearest = [&](double along) {
      return reference_.distance(s.at + way * along * s.normal) > 0.998 * along - 1e-4 * half();
    };
    if (isNearest(room)) continue;
    double clear = 0.0;
    for (int i = 0; i < 6; ++i) {
      const double middle = 0.5 * (clear + room);
      (isNearest(middle) ? clear : room) = middle;
    }
    room = clear;
  }
  return {s, room};
}

}  // namespace sdf::accuracy
