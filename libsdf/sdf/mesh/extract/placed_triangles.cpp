#include "sdf/mesh/extract/placed_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/extract/rims.h"
#include "sdf/shape/solids/polygon_prism.h"
#include "sdf/shape/solids/triangle_solid.h"
#include "sdf/triangles/polygon.h"

namespace sdf {
namespace {

// Takes places in the shape's own coordinates to those in the scene.
struct Placing {
  glm::dmat3 turn;
  glm::dvec3 shift;

  Placing(const std::array<Expr, 3>& coordinates, const Values& values) {
    const Function own({coordinates[0], coordinates[1], coordinates[2]});
    const TapePtr tape = own.at(values);
    const auto at = [&](const glm::dvec3& p) {
      const std::vector<double> all = evaluateAll(*tape, p);
      return glm::dvec3(all[0], all[1], all[2]);
    };
    const glm::dvec3 zero = at(glm::dvec3(0.0));
    glm::dmat3 back;
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 unit(0.0);
      unit[k] = 1.0;
      back[k] = at(unit) - zero;
    }
    turn = glm::inverse(back);
    shift = -(turn * zero);
  }
  glm::dvec3 operator()(const glm::dvec3& p) const { return turn * p + shift; }
  bool mirrors() const { return glm::determinant(turn) < 0.0; }
};

glm::dvec3 normalOf(const FeatureMesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

// Those of more than two triangles, too.
std::vector<std::array<std::uint32_t, 2>> sharpEdges(const FeatureMesh& mesh) {
  constexpr double kSmooth = 0.8660254037844387;  // the cosine of 30 degrees
  using Edge = std::array<std::uint32_t, 2>;
  std::vector<std::pair<Edge, glm::dvec3>> sides;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      sides.push_back({{low, high}, normalOf(mesh, t)});
    }
  std::ranges::stable_sort(sides, {}, &std::pair<Edge, glm::dvec3>::first);
  std::vector<Edge> sharp;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    while (next < sides.size() && sides[next].first == sides[i].first) ++next;
    const glm::dvec3 &m = sides[i].second, &n = sides[next - 1].second;
    const bool isSmooth = next == i + 2 && glm::dot(m, n) >= kSmooth * glm::length(m) * glm::length(n);
    if (!isSmooth) sharp.push_back(sides[i].first);
  }
  return sharp;
}

std::optional<PlacedTriangles> trianglesOf(const PlacedMesh& placed, const Values& values) {
  auto surface = placed.field->distance().surface();
  if (!surface) return {};
  const Placing placing(placed.at, values);
  PlacedTriangles made;
  FeatureMesh& mesh = made.mesh;
  mesh.positions = placed.field->distance().triangles().points;
  mesh.triangles = std::move(*surface);
  dropUnused(mesh);
  for (glm::vec3& p : mesh.positions) p = made.places.emplace_back(placing(p));
  if (placing.mirrors())
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  mesh.creases = sharpEdges(mesh);
  return made;
}

// The lids of a prism: point i is vertex i below, and above the one that is as many farther as there are
// points.
bool addLids(const std::vector<Rim>& rims, FeatureMesh& mesh) {
  std::vector<glm::vec3> points;
  for (const Rim& rim : rims)
    for (const RimPoint& p : rim) points.push_back(glm::vec3(p.at, 0.0));
  const auto polygons = bridgedRims(rims);
  if (!polygons) return false;
  for (const std::vector<std::uint32_t>& polygon : *polygons)
    if (!cutPolygon(points, polygon, mesh.triangles)) return false;
  const auto n = static_cast<std::uint32_t>(points.size());
  const std::size_t lid = mesh.triangles.size();
  for (std::size_t i = 0; i < lid; ++i) {
    mesh.triangles.push_back(mesh.triangles[i] + n);
    std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  }
  return true;
}

// The walls, and which edges are sharp.
void addWalls(const std::vector<Rim>& rims, FeatureMesh& mesh) {
  std::uint32_t n = 0, first = 0;
  for (const Rim& rim : rims) n += static_cast<std::uint32_t>(rim.size());
  for (const Rim& rim : rims) {
    const auto count = static_cast<std::uint32_t>(rim.size());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t i = first + k, next = first + (k + 1) % count;
      mesh.triangles.insert(mesh.triangles.end(), {{i, next, n + next}, {i, n + next, n + i}});
      const auto [low, high] = std::minmax(i, next);
      mesh.creases.insert(mesh.creases.end(), {{low, high}, {n + low, n + high}});
      if (rim[k].isSharp) mesh.creases.push_back({i, n + i});
    }
    first += count;
  }
  std::ranges::sort(mesh.creases);
}

std::optional<PlacedTriangles> trianglesOf(const PlacedPrism& prism, const Values& values, double tolerance) {
  const Placing placing(prism.at, values);
  const double factor = std::max(glm::length(placing.turn[0]), glm::length(placing.turn[1]));
  const std::vector<Rim> rims = rimsOf(prism.field->distance(), tolerance / factor);
  if (std::ranges::any_of(rims, [](const Rim& rim) { return rim.size() < 3; })) return {};
  PlacedTriangles made;
  made.offBy = prism.field->distance().hasArcs() ? tolerance : 0.0;
  FeatureMesh& mesh = made.mesh;
  if (!addLids(rims, mesh)) return {};
  addWalls(rims, mesh);
  const double half = evaluate(*Function(prism.halfHeight).at(values), glm::dvec3(0.0));
  for (const double z : {-half, half})
    for (const Rim& rim : rims)
      for (const RimPoint& p : rim) made.places.push_back(placing(glm::dvec3(p.at, z)));
  mesh.positions.assign(made.places.begin(), made.places.end());
  if (placing.mirrors())
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return made;
}

}  // namespace

std::optional<PlacedTriangles> placedTriangles(const Shape& shape, const Values& values, double tolerance) {
  const Expr f = withoutClaims(std::array{shape.distance}).front();
  if (const auto mesh = placedMesh(f)) return trianglesOf(*mesh, values);
  if (const auto prism = placedPrism(f)) return trianglesOf(*prism, values, tolerance);
  return {};
}

}  // namespace sdf
