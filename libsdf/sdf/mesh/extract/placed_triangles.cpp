#include "sdf/mesh/extract/placed_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "sdf/eval/scalar_reading.h"
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

// Corner i of the polygon is vertex i below, and above the one that is as many farther as there are corners.
std::optional<PlacedTriangles> trianglesOf(const PlacedPrism& prism, const Values& values) {
  if (!prism.field->distance().isPolygon()) return {};
  const std::vector<PolygonSide>& sides = prism.field->distance().sides();
  const auto n = static_cast<std::uint32_t>(sides.size());
  std::vector<glm::vec3> outline;
  for (const PolygonSide& side : sides) outline.push_back(glm::vec3(side.from, 0.0));
  std::vector<std::uint32_t> corners(n);
  std::iota(corners.begin(), corners.end(), 0u);
  PlacedTriangles made;
  FeatureMesh& mesh = made.mesh;
  if (!cutPolygon(outline, corners, mesh.triangles)) return {};
  const std::size_t lid = mesh.triangles.size();
  for (std::size_t i = 0; i < lid; ++i) {
    mesh.triangles.push_back(mesh.triangles[i] + n);
    std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  }
  const double tangent = std::tan(0.5 * kCreaseAngle);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{i, next, n + next}, {i, n + next, n + i}});
    const auto [low, high] = std::minmax(i, next);
    mesh.creases.insert(mesh.creases.end(), {{low, high}, {n + low, n + high}});
    if (std::abs(sides[i].atFrom) > tangent) mesh.creases.push_back({i, n + i});
  }
  std::ranges::sort(mesh.creases);
  const Placing placing(prism.at, values);
  const double half = evaluate(*Function(prism.halfHeight).at(values), glm::dvec3(0.0));
  for (const double z : {-half, half})
    for (const PolygonSide& side : sides) made.places.push_back(placing(glm::dvec3(side.from, z)));
  mesh.positions.assign(made.places.begin(), made.places.end());
  if (placing.mirrors())
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return made;
}

}  // namespace

std::optional<PlacedTriangles> placedTriangles(const Shape& shape, const Values& values) {
  const Expr f = withoutClaims(std::array{shape.distance}).front();
  if (const auto mesh = placedMesh(f)) return trianglesOf(*mesh, values);
  if (const auto prism = placedPrism(f)) return trianglesOf(*prism, values);
  return {};
}

}  // namespace sdf
