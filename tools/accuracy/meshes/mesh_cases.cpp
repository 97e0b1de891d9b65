#include "mesh_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "accuracy/take.h"
#include "bench/shapes.h"

namespace sdf::accuracy {
namespace {

PiecewiseSolid::Piece ballPiece(const glm::dvec3& centre, double radius) {
  return [=](const glm::dvec3& p) { return glm::distance(p, centre) - radius; };
}

// Outside of an endless cylinder about an axis.
PiecewiseSolid::Piece boredPiece(int axis, double radius) {
  return [=](const glm::dvec3& p) { return radius - std::hypot(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
}

PiecewiseSolid ballSolid() { return {.pieces = {ballPiece(glm::dvec3(0.0), 1.0)}, .radius = 1.0}; }

PiecewiseSolid drilledSolid() {
  PiecewiseSolid solid = boxSolid(glm::dvec3(1.0));
  solid.pieces.push_back(ballPiece(glm::dvec3(0.0), 1.3));
  for (int axis = 0; axis < 3; ++axis) solid.pieces.push_back(boredPiece(axis, 0.5));
  solid.radius = 1.3;
  return solid;
}

// Balls joined one after the other by the quadratic minimum (Quilez), which is smooth: one piece.
PiecewiseSolid blendedSolid() {
  struct Ball {
    glm::dvec3 centre;
    double radius;
  };
  std::vector<Ball> balls;
  for (int i = 0; i < 20; ++i)
    balls.push_back({1.2 * glm::dvec3(std::sin(1.3 * i), std::sin(2.1 * i + 1), std::sin(3.7 * i + 2)),
                     0.35 + 0.1 * std::sin(i)});
  return {.pieces = {[balls](const glm::dvec3& p) {
            constexpr double kWidth = 0.2;
            double d = glm::distance(p, balls[0].centre) - balls[0].radius;
            for (std::size_t i = 1; i < balls.size(); ++i) {
              const double e = glm::distance(p, balls[i].centre) - balls[i].radius;
              const double h = std::max(kWidth - std::abs(d - e), 0.0);
              d = std::min(d, e) - h * h / (4.0 * kWidth);
            }
            return d;
          }},
          .radius = 3.0};
}

// Between two levels of the gyroid, in a ball. Its slope is at most 5 / 8 |(1, 1, 1)| sqrt(2).
PiecewiseSolid gyroidSolid() {
  const auto level = [](double side) {
    return [side](const glm::dvec3& p) {
      const glm::dvec3 q = 5.0 * p;
      const double g =
          std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) + std::sin(q.z) * std::cos(q.x);
      return side * g / 8.0 - 0.05;
    };
  };
  return {.pieces = {level(1.0), level(-1.0), ballPiece(glm::dvec3(0.0), 1.5)}, .slope = 1.54, .radius = 1.5};
}

PiecewiseSolid ballsSolid() {
  PiecewiseSolid solid{.united = true, .radius = 3.01};
  for (int i = 0; i < 1000; ++i)
    solid.pieces.push_back(
        ballPiece(1.7 * glm::dvec3(std::sin(12.9898 * i), std::sin(78.233 * i), std::sin(37.719 * i)), 0.06));
  return solid;
}

NamedMeshCase named(int i, const std::string& what, PiecewiseSolid (*solid)(), bool easy) {
  const std::string name = bench::shapeName(i) + ", " + what;
  return {name, [=] { return MeshCase{name, bench::measuringShape(i), solid(), easy}; }};
}

MeshedShape meshed(const MeshCase& c, MeshOptions options) {
  Progress progress;
  options.certify = c.easy;
  return take(meshShape(c.shape, c.name, options, progress));
}

}  // namespace

PiecewiseSolid boxSolid(const glm::dvec3& half) {
  PiecewiseSolid solid{.radius = glm::length(half)};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      solid.pieces.push_back([=](const glm::dvec3& p) { return side * p[axis] - half[axis]; });
  return solid;
}

const std::vector<NamedMeshCase>& meshCases() {
  static const std::vector<NamedMeshCase> all{
      named(0, "a ball", ballSolid, true), named(1, "a drilled box", drilledSolid, true),
      named(2, "20 blended balls", blendedSolid, true), named(3, "a gyroid sheet", gyroidSolid, false),
      named(4, "1000 balls", ballsSolid, false)};
  return all;
}

std::vector<MeshRow> meshRows(const NamedMeshCase& named, std::uint64_t fraction) {
  constexpr std::size_t kPoints = 30'000;
  constexpr unsigned kSeed = 1;
  struct Asked {
    std::string text;
    MeshOptions options;
  };
  const double side = 2.0 * bench::kRegion;
  std::vector<Asked> all{{"64 voxels", {.voxelSize = side / 64}},
                         {"128 voxels", {.voxelSize = side / 128}},
                         {"tolerance 0.01", {.voxelSize = side / 64, .tolerance = 1e-2}},
                         {"tolerance 0.001", {.voxelSize = side / 64, .tolerance = 1e-3}}};
  const MeshCase c = named.make();
  if (!c.easy) std::erase_if(all, [](const Asked& asked) { return asked.options.tolerance > 0.0; });
  if (fraction != 1) all.erase(all.begin() + 1, all.end());
  const std::size_t points = kPoints / fraction + 1;
  const std::vector<glm::dvec3> surface = c.solid.surfacePoints(points, kSeed);
  std::vector<MeshRow> rows;
  for (const Asked& asked : all) {
    const MeshedShape m = meshed(c, asked.options);
    const TriangleMesh mesh = weldedMesh(m.mesh);
    rows.push_back(
        {c.name, asked.text, m.stats, toSurface(mesh, c.solid, points, kSeed), toMesh(surface, mesh)});
  }
  return rows;
}

}  // namespace sdf::accuracy
