#include "sdf/mesh/extract/placed_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/solids/triangle_solid.h"

namespace sdf {
namespace {

// Takes places in the file to those in the scene.
struct Placing {
  glm::dmat3 turn;
  glm::dvec3 shift;

  Placing(const PlacedMesh& placed, const Values& values) {
    const Function own({placed.at[0], placed.at[1], placed.at[2]});
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
  glm::dvec3 operator()(const glm::vec3& p) const { return turn * glm::dvec3(p) + shift; }
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

}  // namespace

std::optional<PlacedTriangles> placedTriangles(const Shape& shape, const Values& values) {
  const auto placed = placedMesh(withoutClaims(std::array{shape.distance}).front());
  if (!placed) return {};
  auto surface = placed->field->distance().surface();
  if (!surface) return {};
  const Placing placing(*placed, values);
  PlacedTriangles made;
  FeatureMesh& mesh = made.mesh;
  mesh.positions = placed->field->distance().triangles().points;
  mesh.triangles = std::move(*surface);
  dropUnused(mesh);
  for (glm::vec3& p : mesh.positions) p = made.places.emplace_back(placing(p));
  if (placing.mirrors())
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  mesh.creases = sharpEdges(mesh);
  return made;
}

}  // namespace sdf
