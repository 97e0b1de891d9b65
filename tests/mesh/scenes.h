// Shapes and small measurements that the tests of the mesher share.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {

inline constexpr double kPi = 3.14159265358979323846;
/// Half an ulp of numbers in [1, 2), as a share of 1: the most that one float operation rounds by.
inline constexpr double kRoundoff = 0x1p-24;
inline constexpr double kPlentyOfMemory = 4.0 * (1ull << 30);

inline Box region(double half) { return Box::centred(glm::dvec3(half)); }

/// A box less three bored holes, its corners rounded off by a sphere: creases and five handles.
inline Shape boredBox() {
  const Shape bore = infiniteCylinder(0.5);
  return subtract({box(Vec3E(1.0)) & sphere(1.3), bore, rotate(bore, {kPi / 2, 0.0, 0.0}),
                   rotate(bore, {0.0, 0.0, kPi / 2})});
}

inline Shape melt() {
  std::vector<Shape> balls;
  for (int i = 0; i < 20; ++i)
    balls.push_back(
        translate(sphere(0.35 + 0.1 * std::sin(i)),
                  {1.2 * std::sin(1.3 * i), 1.2 * std::sin(2.1 * i + 1.0), 1.2 * std::sin(3.7 * i + 2.0)}));
  return unite(balls, Blend::quadratic(0.2));
}

/// A wall along a gyroid inside a ball; nothing but the formula is known of it.
inline Shape latticeBall() {
  const Vec3E p = position(), q = p * 5.0;
  const Expr g = sin(q.x) * cos(q.y) + sin(q.y) * cos(q.z) + sin(q.z) * cos(q.x);
  return field(max(abs(g) / 8.0 - 0.05, length(p) - 1.5));
}

/// Balls strewn over the cube of half size 1.7; each in a colour of its own where asked.
inline Shape strewn(int count, double radius, bool painted = false) {
  std::vector<Shape> balls;
  for (int i = 0; i < count; ++i) {
    const Vec3E at{1.7 * std::sin(12.9898 * i), 1.7 * std::sin(78.233 * i), 1.7 * std::sin(37.719 * i)};
    Shape ball = translate(sphere(radius), at);
    if (painted) ball = ball.paint({.color = {Expr((i + 1.0) / count), Expr(1.0 - (i + 1.0) / count), 0.5}});
    balls.push_back(ball);
  }
  return unite(balls);
}

/// A ring through a sheet that is thinner than most voxels.
inline Shape ringAndSheet() { return torus(1.2, 0.05) | box({1.5, 1.5, 0.01}); }

inline TapePtr tapeOf(const Shape& s) { return Model(s).at().whole(); }
inline LocalTapes wholeTapes(const TapePtr& tape) { return {tape, tape->firstOutputOnly()}; }

inline Result<NarrowBand> tryBand(const Shape& s, const Box& bounds, double voxel, Progress& progress,
                                  double maxMemory = kPlentyOfMemory) {
  return sampleNarrowBand(Model(s).at(), {voxel, bounds, maxMemory}, progress);
}

inline NarrowBand bandOf(const Shape& s, const Box& bounds, double voxel) {
  Progress progress;
  return tryBand(s, bounds, voxel, progress).value();
}

/// A shape's mesh with its creases, sound and without crossings; of a tolerance, if one is given, which it
/// keeps.
inline MeshedShape meshed(const Shape& shape, double voxel, double tolerance = 0.0) {
  Progress progress;
  Result<MeshedShape> mesh = meshShape(shape, "part", {.voxelSize = voxel, .tolerance = tolerance}, progress);
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  if (!mesh) return {};
  EXPECT_TRUE(mesh->stats.watertight && mesh->stats.manifold);
  EXPECT_EQ(mesh->stats.crossings, 0u);
  if (tolerance > 0.0) {
    EXPECT_LE(mesh->stats.maxDistance, tolerance);
  }
  return std::move(*mesh);
}

/// How far the vertex that is nearest to a point is from it.
inline double nearestVertex(const std::vector<glm::vec3>& positions, const glm::dvec3& p) {
  double nearest = kInfinity;
  for (const glm::vec3& v : positions) nearest = std::min(nearest, glm::distance(glm::dvec3(v), p));
  return nearest;
}

/// Volume inside a closed mesh; positive where its triangles run counter-clockwise seen from outside.
inline double signedVolume(const std::vector<glm::vec3>& p, const std::vector<glm::uvec3>& triangles) {
  double sum = 0.0;
  for (const glm::uvec3& t : triangles)
    sum += glm::dot(glm::dvec3(p[t.x]), glm::cross(glm::dvec3(p[t.y]), glm::dvec3(p[t.z]))) / 6.0;
  return sum;
}

/// How far a dual mesh with voxel h may lie off a surface that bends no more than a ball of radius r, given
/// an exact distance f (so that |f''| <= 1 / (r - 3h) within the cells concerned). With points spread by at
/// most d, the mean of n has variance at most d²/2, a point of a triangle d²/3, and f there differs from the
/// mean of f by |f''| / 2 times that: a crossing by linear interpolation is off by h²/8 |f''|, a vertex (mean
/// of the crossings of a cell, d = sqrt(3) h) by 3/4 h² |f''|, a point of a triangle (vertices in four cells
/// around an edge, d = 3h) by 3/2 h² |f''|.
inline double dualMeshError(double h, double r) { return (0.125 + 0.75 + 1.5) * h * h / (r - 3.0 * h); }

}  // namespace sdf::test
