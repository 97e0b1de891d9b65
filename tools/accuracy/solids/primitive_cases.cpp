#include "primitive_cases.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "accuracy/operators/operator_meshes.h"
#include "command_line/text.h"
#include "meshes.h"
#include "sdf/shape/catalog.h"

namespace sdf::accuracy {
namespace {

// Steps to a circle: some 10,000 triangles for an outline, 260,000 for what is curved both ways.
constexpr int kAround = 512, kQuarter = 512, kTube = 256, kAlongTube = 256, kRounding = 64;

using Numbers = std::vector<double>;

double radians(double degrees) { return degrees * kPi / 180.0; }

// Two equal radii make it a solid of revolution, with a finer reference.
Tessellation ellipsoidMesh(const Numbers& a) {
  const glm::dvec3 r(a[0], a[1], a[2]);
  for (int i = 0; i < 3; ++i) {
    Axis axis;
    axis.direction = glm::dvec3(0.0), axis.direction[i] = 1.0;
    if (r[(i + 1) % 3] == r[(i + 2) % 3]) return turned(halfEllipseOutline(r[(i + 1) % 3], r[i]), axis);
  }
  Tessellation t = ellipsoidSurface(r, kAround);
  // The focal conics and the ends of the medial disc lie in the symmetry planes.
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (r[j] >= r[i]) continue;
      const double square = r[i] * r[i] - r[j] * r[j];
      glm::dvec3 focus(0.0), end(0.0);
      focus[i] = std::sqrt(square), end[i] = square / r[i];
      t.special.insert(t.special.end(), {focus, end});
    }
  return t;
}

Tessellation sphereMesh(double radius) {
  Outline profile;
  return turned(profile.arc({0, 0}, radius, -0.5 * kPi, 0.5 * kPi, 2 * kQuarter));
}

// Where the tube overlaps itself, only what lies outside the axis bounds it.
Tessellation torusMesh(double major, double minor) {
  Outline profile;
  if (minor < major) return turned(profile.arc({major, 0}, minor, 0.0, 2.0 * kPi, 4 * kQuarter));
  const double end = std::acos(-major / minor);
  return turned(profile.arc({major, 0}, minor, -end, end, 4 * kQuarter));
}

Tessellation frustum(double bottom, double top, double half) {
  Outline profile;
  return turned(profile.to({0, -half}).to({bottom, -half}).to({top, half}).to({0, half}));
}

// The inside of an endless cylinder is within its radius of it, and the nearest point to one outside lies at
// its own height: ends are never nearest within `tried` of the middle.
Tessellation endlessCylinder(double radius) {
  const double tried = 2.0 * radius;
  Tessellation t = frustum(radius, radius, tried + 2.0 * radius);
  t.region.min.y = -tried, t.region.max.y = tried;
  return t;
}

Tessellation capsuleMesh(const Numbers& a) {
  const glm::dvec3 from(a[0], a[1], a[2]), to(a[3], a[4], a[5]);
  const double length = glm::length(to - from);
  Outline profile;
  profile.arc({0, 0}, a[6], -0.5 * kPi, 0.0, kQuarter).arc({0, length}, a[6], 0.0, 0.5 * kPi, kQuarter);
  return turned(profile, {from, length > 0.0 ? (to - from) / length : glm::dvec3(0, 1, 0)});
}

// The side touches both balls where their normals rise by the angle of this sine.
Tessellation roundConeMesh(double bottom, double top, double half) {
  const double rise = std::asin((bottom - top) / (2.0 * half));
  Outline profile;
  profile.arc({0, -half}, bottom, -0.5 * kPi, rise, kQuarter).arc({0, half}, top, rise, 0.5 * kPi, kQuarter);
  return turned(profile);
}

Tessellation solidAngleMesh(double angle, double radius) {
  Outline profile;
  return turned(profile.to({0, 0}).arc({0, 0}, radius, 0.5 * kPi - angle, 0.5 * kPi, 2 * kQuarter));
}

Tessellation cutSphereMesh(double radius, double height) {
  Outline profile;
  return turned(
      profile.to({0, height}).arc({0, 0}, radius, std::asin(height / radius), 0.5 * kPi, 2 * kQuarter));
}

Tessellation boxCells(const Numbers& a) {
  return cells({{{-a[0], a[0]}, {-a[1], a[1]}, {-a[2], a[2]}}}, [](const glm::ivec3&) { return true; });
}

Tessellation frameMesh(const Numbers& a) {
  std::array<std::vector<double>, 3> cuts;
  for (int i = 0; i < 3; ++i) {
    cuts[i] = {-a[i], -a[i] + a[3], a[i] - a[3], a[i]};
    if (a[3] == a[i]) cuts[i] = {-a[i], 0.0, a[i]};  // the beams meet
  }
  return cells(cuts, [&](const glm::ivec3& c) {
    int atEnd = 0;
    for (int i = 0; i < 3; ++i) atEnd += c[i] == 0 || c[i] + 2 == static_cast<int>(cuts[i].size());
    return atEnd >= 2;
  });
}

Tessellation column(int sides, double radius, double half) {
  return prism(starOutline(sides, radius), half,
               [](const glm::dvec3& p) { return glm::dvec3(p.x, p.z, p.y); });
}

// Of triangles.
Tessellation polyhedronOf(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> faces;
  for (const glm::ivec3& t : mesh.triangles) faces.push_back({t.x, t.y, t.z});
  return polyhedron(mesh.points, faces);
}

Tessellation pyramidMesh(double w, double h) {
  const std::vector<std::vector<int>> faces{{0, 1, 2, 3}, {0, 3, 4}, {3, 2, 4}, {2, 1, 4}, {1, 0, 4}};
  return polyhedron({{-w, -h, -w}, {w, -h, -w}, {w, -h, w}, {-w, -h, w}, {0, h, 0}}, faces);
}

constexpr int kCellsAPeriod = 36;

// Curvatures: each term of the gyroid has the second derivatives sin(x + y) and sin(x - y) or smaller along
// the diagonals of its plane, and two planes share an axis. P's are the cosines. D is a quarter of sqrt(2)
// times the sum of four waves along the diagonals k of the cube, whose k k^T add up to 4. Slopes: sqrt(3),
// sqrt(3), sqrt(3/2) (lattices.cpp has the proofs).
constexpr Wave kGyroid{[](const glm::dvec3& p) {
                         return std::sin(p.x) * std::cos(p.y) + std::sin(p.y) * std::cos(p.z) +
                                std::sin(p.z) * std::cos(p.x);
                       },
                       std::numbers::sqrt3, 2.0};
constexpr Wave kSchwarzP{[](const glm::dvec3& p) { return std::cos(p.x) + std::cos(p.y) + std::cos(p.z); },
                         std::numbers::sqrt3, 1.0};
constexpr Wave kSchwarzD{[](const glm::dvec3& p) {
                           return std::cos(p.x) * std::cos(p.y) * std::cos(p.z) -
                                  std::sin(p.x) * std::sin(p.y) * std::sin(p.z);
                         },
                         1.224744871391589, std::numbers::sqrt2};
// Along a line a wave's second derivative is no more than half of what lies between its least and its largest
// value, times the square of its highest frequency (Bernstein 1912). Slopes: the tests of the shapes prove
// them.
constexpr Wave kIwp{[](const glm::dvec3& p) {
                      return 2.0 * (std::cos(p.x) * std::cos(p.y) + std::cos(p.y) * std::cos(p.z) +
                                    std::cos(p.z) * std::cos(p.x)) -
                             std::cos(2.0 * p.x) - std::cos(2.0 * p.y) - std::cos(2.0 * p.z);
                    },
                    3.0 * std::numbers::sqrt3, 4.0 * 4.0};
constexpr Wave kNeovius{[](const glm::dvec3& p) {
                          return 3.0 * (std::cos(p.x) + std::cos(p.y) + std::cos(p.z)) +
                                 4.0 * std::cos(p.x) * std::cos(p.y) * std::cos(p.z);
                        },
                        7.0, 3.0 * 13.0};
constexpr Wave kLidinoid{[](const glm::dvec3& p) {
                           return 0.5 * (std::sin(2.0 * p.x) * std::cos(p.y) * std::sin(p.z) +
                                         std::sin(2.0 * p.y) * std::cos(p.z) * std::sin(p.x) +
                                         std::sin(2.0 * p.z) * std::cos(p.x) * std::sin(p.y)) -
                                  0.5 * (std::cos(2.0 * p.x) * std::cos(2.0 * p.y) +
                                         std::cos(2.0 * p.y) * std::cos(2.0 * p.z) +
                                         std::cos(2.0 * p.z) * std::cos(2.0 * p.x)) +
                                  0.15;
                         },
                         1.5 * std::numbers::sqrt3, 8.0 * 1.25};
constexpr Wave kFischerKochS{[](const glm::dvec3& p) {
                               return std::cos(2.0 * p.x) * std::sin(p.y) * std::cos(p.z) +
                                      std::cos(p.x) * std::cos(2.0 * p.y) * std::sin(p.z) +
                                      std::sin(p.x) * std::cos(p.y) * std::cos(2.0 * p.z);
                             },
                             2.443973, 6.0 * std::numbers::sqrt2};

struct Geometry {
  std::function<Tessellation(const Numbers&)> mesh;
  std::vector<Numbers> arguments;  // as the entry lists its numbers; angles in degrees
};

using Table = std::map<std::string, Geometry>;

void addRound(Table& table) {
  table["sphere"] = {[](const Numbers& a) { return sphereMesh(a[0]); }, {{1}, {0.01}, {40}}};
  const std::vector<Numbers> ellipsoids{{1, 0.6, 0.4},  {1, 1, 1},        {0.01, 1, 0.01}, {1, 0.01, 1},
                                        {0.01, 0.5, 1}, {1, 0.7, 0.7001}, {3, 3, 2.9}};
  table["ellipsoid"] = {ellipsoidMesh, ellipsoids};
  table["ellipsoid_bound"] = {ellipsoidMesh, ellipsoids};
  table["torus"] = {[](const Numbers& a) { return torusMesh(a[0], a[1]); },
                    {{1, 0.25}, {2, 0.01}, {0.5, 0.8}, {0.1, 1}, {1, 1}}};
  table["capped_torus"] = {
      [](const Numbers& a) { return bentTube(radians(a[0]), a[1], a[2], kTube, kAlongTube); },
      {{120, 1, 0.25},
       {30, 1, 0.2},
       {180, 1, 0.3},
       {170, 1, 0.3},
       {90, 0.4, 0.5},
       {1, 1, 0.01},
       {150, 1, 2}}};
  table["link"] = {[](const Numbers& a) { return chainLink(a[0], a[1], a[2], kTube, kAlongTube); },
                   {{0.5, 0.5, 0.15}, {0, 1, 0.2}, {2, 0.3, 0.4}, {5, 0.2, 0.01}}};
  table["capsule"] = {capsuleMesh,
                      {{0, -0.5, 0, 0, 0.5, 0, 0.5},
                       {1, 2, 3, -1, 0, 0.5, 0.2},
                       {1, 1, 1, 1, 1, 1, 0.5},
                       {-1, 0, 0, 1, 0, 0, 3},
                       {-5, 0, 1, 5, 0.1, 1, 0.02}}};
  const auto hand = [](double choice) { return choice == 0.0 ? 1.0 : -1.0; };
  table["spring"] = {
      [hand](const Numbers& a) { return helicalTube(a[0], a[1], a[2], a[3], hand(a[4]), kTube, kAlongTube); },
      {{1, 0.5, 2, 0.1, 0}, {0.5, 3, 1.5, 0.2, 1}, {1, 0.05, 2, 0.01, 1}, {1, 6, 0.4, 0.5, 0}}};
  // Long ones, whose ends are never nearest.
  table["thread"] = {[hand](const Numbers& a) {
                       return helicalThread(a[0], a[1], static_cast<int>(a[3]), a[4], hand(a[5]),
                                            4 * kAround);
                     },
                     {{1, 0.2, 10, 1, 0, 0}, {1, 0.4, 10, 3, 0.02, 1}, {3, 0.5, 40, 1, -0.05, 0}}};
  table["solid_angle"] = {[](const Numbers& a) { return solidAngleMesh(radians(a[0]), a[1]); },
                          {{30, 1}, {90, 1}, {140, 0.7}, {10, 2}, {1, 1}, {178, 1}}};
  table["cut_sphere"] = {[](const Numbers& a) { return cutSphereMesh(a[0], a[1]); },
                         {{1, 0}, {1, 0.9}, {1, -0.6}, {3, -2.95}, {1, 0.999}}};
  table["round_cone"] = {[](const Numbers& a) { return roundConeMesh(a[0], a[1], a[2]); },
                         {{0.5, 0.25, 0.5}, {0.1, 0.5, 0.25}, {1, 0.05, 0.48}, {1, 1, 1}, {0.01, 0.02, 3}}};
  table["round_box"] = {[](const Numbers& a) {
                          const glm::dvec3 half(a[0], a[1], a[2]);
                          return a[3] > 0.0 ? roundedBox(half, a[3], kRounding) : boxCells(a);
                        },
                        {{1, 1, 1, 0.1}, {1, 2, 0.5, 0}, {1, 1, 0.4, 0.4}, {1, 1, 1, 1}, {3, 0.2, 1, 0.01}}};
}

void addStraight(Table& table) {
  table["box"] = {boxCells, {{1, 1, 1}, {0.01, 2, 0.5}, {5, 5, 0.1}, {0.001, 0.001, 10}}};
  table["box_frame"] = {frameMesh, {{1, 1, 1, 0.1}, {1, 2, 0.5, 0.5}, {1, 0.6, 2, 0.02}, {1, 1, 1, 1}}};
  table["plane"] = {[](const Numbers& a) {
                      return halfSpace({a[0], a[1], a[2]}, a[3]);
                    },
                    {{0, 1, 0, 0}, {1, 2, -3, 0.5}, {-4, 0, 0, -1}, {1e-3, 1, 0, 7}}};
  table["octahedron"] = {[](const Numbers& a) { return polyhedronOf(octahedronMesh(a[0])); },
                         {{1}, {0.1}, {7}}};
  table["tetrahedron"] = {[](const Numbers& a) { return polyhedronOf(tetrahedronMesh(a[0])); },
                          {{1}, {0.1}, {7}}};
  table["pyramid"] = {[](const Numbers& a) { return pyramidMesh(a[0], a[1]); },
                      {{1, 1}, {2, 0.1}, {0.1, 2}, {1, 0.001}, {0.01, 3}}};
  table["cylinder"] = {[](const Numbers& a) { return frustum(a[0], a[0], a[1]); },
                       {{1, 1}, {0.1, 3}, {3, 0.1}, {1, 0.001}, {0.005, 1}}};
  table["infinite_cylinder"] = {[](const Numbers& a) { return endlessCylinder(a[0]); }, {{1}, {0.1}, {3}}};
  table["cone"] = {[](const Numbers& a) { return frustum(a[0], 0.0, a[1]); },
                   {{1, 1}, {0.1, 3}, {3, 0.1}, {0.01, 1}, {1, 0.005}}};
  table["capped_cone"] = {[](const Numbers& a) { return frustum(a[0], a[1], a[2]); },
                          {{1, 0.5, 1},
                           {0.2, 1.5, 0.3},
                           {0, 1, 1},
                           {1, 1, 0.5},
                           {1, 0.9999, 1},
                           {1, 0.001, 0.01},
                           {0.01, 0.02, 3}}};
  const std::vector<Numbers> prisms{{1, 0.5}, {0.2, 2}, {3, 0.05}, {1, 0.001}};
  table["hex_prism"] = {[](const Numbers& a) { return column(6, a[0], a[1]); }, prisms};
  table["tri_prism"] = {[](const Numbers& a) { return column(3, a[0], a[1]); }, prisms};
  const std::vector<Numbers> walls{{1, 0.1}, {5, 0.15}};
  const auto wallOf = [](const Wave& wave) {
    return [&wave](const Numbers& a) { return wall(wave, a[0], a[1], kCellsAPeriod); };
  };
  table["strut_lattice"] = {[](const Numbers& a) {
                              return strutsMesh(static_cast<Struts>(static_cast<int>(a[0])), a[1], a[2],
                                                kCellsAPeriod / 2);
                            },
                            {{0, 1, 0.12}, {1, 1, 0.3}, {2, 3, 0.5}, {3, 1, 0.1}}};
  table["gyroid"] = {wallOf(kGyroid), walls};
  table["schwarz_p"] = {wallOf(kSchwarzP), walls};
  table["schwarz_d"] = {wallOf(kSchwarzD), walls};
  table["iwp"] = {wallOf(kIwp), walls};
  table["neovius"] = {wallOf(kNeovius), walls};
  table["lidinoid"] = {wallOf(kLidinoid), walls};
  table["fischer_koch_s"] = {wallOf(kFischerKochS), walls};
}

Tessellation ringMesh(double radius, double thickness) {
  return extrudedBand(circleOutline(radius + 0.5 * thickness), circleOutline(radius - 0.5 * thickness));
}

void addFlat(Table& table) {
  table["rectangle"] = {[](const Numbers& a) { return extruded(rectangleOutline(a[0], a[1], 0.0)); },
                        {{1, 0.5}, {0.01, 2}, {5, 5}, {3, 0.001}}};
  table["rounded_rectangle"] = {[](const Numbers& a) { return extruded(rectangleOutline(a[0], a[1], a[2])); },
                                {{1, 0.5, 0.1}, {1, 2, 0}, {1, 0.4, 0.4}, {1, 1, 1}, {2, 1, 0.001}}};
  table["trapezoid"] = {
      [](const Numbers& a) {
        Outline outline;
        outline.to({-a[0], -a[2]}).to({a[0], -a[2]}).to({a[1], a[2]}).to({-a[1], a[2]});
        return extruded(outline);
      },
      {{1, 0.5, 0.5}, {0.2, 1.5, 0.3}, {0, 1, 1}, {1, 0, 0.05}, {1, 0.9999, 1}, {0.01, 0.02, 3}}};
  table["segment"] = {
      [](const Numbers& a) {
        return extruded(segmentOutline({a[0], a[1]}, {a[2], a[3]}, a[4]));
      },
      {{-0.5, 0, 0.5, 0, 0.25}, {1, 2, -1, 0, 0.2}, {1, 1, 1, 1, 0.5}, {-5, 0, 5, 0.1, 0.02}}};
  table["regular_polygon"] = {
      [](const Numbers& a) { return extruded(starOutline(static_cast<int>(a[0]), a[1])); },
      {{6, 1}, {3, 1}, {4, 2}, {5, 0.3}, {7, 1}, {12, 1}, {101, 4}, {1000, 1}}};
  table["star"] = {
      [](const Numbers& a) { return extruded(starOutline(static_cast<int>(a[0]), a[1], a[2])); },
      {{5, 1, 0.4}, {3, 1, 0.2}, {4, 2, 0.01}, {6, 1, 0.95}, {9, 1, 0.6}, {50, 1, 0.1}, {3, 1, 0.001}}};
  table["circle"] = {[](const Numbers& a) { return extruded(circleOutline(a[0])); }, {{1}, {0.01}, {40}}};
  table["ellipse"] = {[](const Numbers& a) { return extruded(ellipseOutline(a[0], a[1])); },
                      {{1, 0.5}, {0.01, 1}, {1, 0.01}, {2, 2}, {3, 2.9}, {1, 0.9999}}};
  table["ring"] = {[](const Numbers& a) { return ringMesh(a[0], a[1]); }, {{1, 0.2}, {1, 1.9}, {3, 0.01}}};
  table["arc"] = {
      [](const Numbers& a) { return bentBand(radians(a[0]), a[1], 0.5 * a[2]); },
      {{120, 1, 0.2}, {30, 1, 0.4}, {180, 1, 0.3}, {170, 1, 0.6}, {90, 0.4, 1}, {60, 1, 3}, {2, 1, 0.01}}};
}

const Table& geometry() {
  static const Table table = [] {
    Table t;
    addRound(t);
    addStraight(t);
    addFlat(t);
    return t;
  }();
  return table;
}

std::vector<std::vector<glm::dvec2>> polygons() {
  std::vector<glm::dvec2> spiral;
  for (int k = 0; k <= 40; ++k)
    spiral.emplace_back(std::cos(0.3 * k) * (0.2 + 0.05 * k), std::sin(0.3 * k) * (0.2 + 0.05 * k));
  for (int k = 40; k >= 0; --k)
    spiral.emplace_back(std::cos(0.3 * k) * (0.1 + 0.05 * k), std::sin(0.3 * k) * (0.1 + 0.05 * k));
  return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
          {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1.5, 0.2}, {1, 1}, {1, 2}, {0, 2}},
          {{0, 0}, {0.3, 1.2}, {0.15, 0.4}, {1, 1}, {1, 0}, {0.5, 0.1}},
          {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}},
          {{0, 0}, {10, 0}, {5, 0.01}},
          spiral};
}

std::string text(const Numbers& numbers) {
  std::string result;
  for (const double n : numbers) result += command_line::formatted("%s%.6g", result.empty() ? " " : ", ", n);
  return result;
}

std::vector<Argument> argumentsOf(const CatalogEntry& entry, const Numbers& numbers) {
  std::vector<Argument> result;
  std::size_t at = 0;
  for (const Parameter& p : entry.parameters) {
    if (p.kind == ArgumentKind::Integer || p.kind == ArgumentKind::Choice) {
      result.emplace_back(static_cast<int>(numbers.at(at++)));
    } else if (p.kind == ArgumentKind::Number) {
      result.emplace_back(Expr(numbers.at(at++)));
    } else {
      const bool flat = p.kind == ArgumentKind::Vector2;
      result.emplace_back(Vec3E{numbers.at(at), numbers.at(at + 1), flat ? 0.0 : numbers.at(at + 2)});
      at += flat ? 2 : 3;
    }
  }
  return result;
}

ReferenceCase caseOf(const CatalogEntry& entry, std::string name, std::vector<Argument> arguments,
                     Tessellation t) {
  return {std::move(t), std::move(name), build(entry, std::move(arguments))};
}

PrimitiveCases casesOf(const CatalogEntry& entry) {
  PrimitiveCases cases{entry.name, {}};
  if (entry.name == "polygon") {
    for (const std::vector<glm::dvec2>& points : polygons())
      cases.makers.push_back([&entry, points] {
        return caseOf(entry, "polygon of " + std::to_string(points.size()) + " corners", {points},
                      extruded(polygonOutline(points)));
      });
    return cases;
  }
  const auto found = geometry().find(entry.name);
  if (found == geometry().end()) return cases;
  for (const Numbers& numbers : found->second.arguments)
    cases.makers.push_back([&entry, &numbers, &mesh = found->second.mesh] {
      return caseOf(entry, entry.name + text(numbers), argumentsOf(entry, numbers), mesh(numbers));
    });
  return cases;
}

}  // namespace

const std::vector<PrimitiveCases>& primitiveCases() {
  static const std::vector<PrimitiveCases> all = [] {
    std::vector<PrimitiveCases> list;
    for (const CatalogEntry& entry : catalog()) {
      if (entry.group != Group::Solid && entry.group != Group::Flat) continue;
      if (PrimitiveCases cases = casesOf(entry); !cases.makers.empty()) list.push_back(std::move(cases));
    }
    return list;
  }();
  return all;
}

}  // namespace sdf::accuracy
