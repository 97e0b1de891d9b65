// morph, round, shell, elongate and displace.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "operator_cases.h"

namespace sdf::accuracy {
namespace {

constexpr int kSphereTimes = 6;  // of a sphere's refinement

Shape ballAt(double y, double radius) { return translate(sphere(radius), Vec3E(0.0, y, 0.0)); }

// Of two balls on the y axis the zero set is an oval of Descartes, a spheroid half way, seen whole from the
// origin.
ReferenceCase morphedBalls(double t) {
  const auto g = [=](const glm::dvec3& p) {
    const double low = glm::distance(p, {0, -0.4, 0}) - 1.0, high = glm::distance(p, {0, 0.4, 0}) - 0.7;
    return low + t * (high - low);
  };
  constexpr double kClear = 0.3;  // of the surface from the centres
  return caseOf("of two balls, " + std::to_string(t), morph(ballAt(-0.4, 1.0), ballAt(0.4, 0.7), t),
                tessellatedAboutY({g, 0.3, 2.0, 1.0 / kClear}));
}

std::vector<ReferenceCase> morphs() {
  const Solid a = lopsided(1.0), b = solidL();
  return {morphedBalls(0.5), morphedBalls(0.3),
          caseOf("at its start", {morph(a.shape, b.shape, 0.0), a.mesh}),
          caseOf("at its end", {morph(a.shape, b.shape, 1.0), b.mesh}),
          caseOf("of a shape with itself", {morph(b.shape, b.shape, 0.4), b.mesh})};
}

// All within `radius` of the box: the sphere pulled apart.
Solid grownBox(const glm::dvec3& half, double radius, int times = kSphereTimes) {
  const Tessellation ball = sphereSurface(radius, times);
  return {round(box(Vec3E(half)), radius), pulledApart(ball.mesh, half), ball.chord};
}

constexpr glm::dvec3 kCrossed[] = {{0.8, 0.3, 0.4}, {0.25, 0.9, 0.3}};

// Two crossing boxes, grown.
TriangleMesh crossedBoxes(double by) {
  return united({grownBox(kCrossed[0], by, 5).mesh, grownBox(kCrossed[1], by, 5).mesh});
}

// What of the crossing boxes is farther than `by` from their surface: both boxes less their skins, and of
// what they share all that is not near the notches where they meet.
TriangleMesh crossedHollow(double by) {
  const glm::dvec3 shared = glm::min(kCrossed[0], kCrossed[1]);
  TriangleMesh mesh = united({boxMesh(kCrossed[0] - by), boxMesh(kCrossed[1] - by), boxMesh(shared)});
  const TriangleMesh ball = sphereSurface(by, 5).mesh;
  const TriangleMesh upright = pulledApart(ball, 2, shared.z), level = pulledApart(ball, 0, shared.x);
  for (const double y : {-shared.y, shared.y})
    for (const double side : {-1.0, 1.0}) {
      mesh = corefine(mesh, moved(upright, {side * shared.x, y, 0.0}), Boolean::Difference);
      mesh = corefine(mesh, moved(level, {0.0, y, side * shared.z}), Boolean::Difference);
    }
  return mesh;
}

Shape crossed() { return box(Vec3E(kCrossed[0])) | box(Vec3E(kCrossed[1])); }

std::vector<ReferenceCase> rounds() {
  const Solid ball = solidSphere(1.25);
  const double chord = sphereSurface(0.2, 5).chord;
  return {caseOf("of a box", grownBox({0.8, 0.3, 0.5}, 0.25)),
          caseOf("of a box, turned", placed(grownBox({0.2, 0.7, 0.4}, 0.6), {1, 1, 2}, 1.0, {0.1, 0.2, 0.3})),
          caseOf("of a ball", {round(sphere(1.0), 0.25), ball.mesh, ball.chord}),
          caseOf("of crossed boxes", {round(crossed(), 0.2), crossedBoxes(0.2), chord}),
          caseOf("by nothing", {round(solidL().shape, 0.0), solidL().mesh})};
}

std::vector<ReferenceCase> shells() {
  const glm::dvec3 half(0.8, 0.4, 0.5);
  const Solid skin = grownBox(half, 0.1), outer = solidSphere(1.1), inner = solidSphere(0.9);
  const TriangleMesh hollow = together({skin.mesh, flipped(boxMesh(half - 0.1))});
  const Solid boxShell{shell(box(Vec3E(half)), 0.2), hollow, skin.chord};
  const TriangleMesh skins = together({outer.mesh, flipped(inner.mesh)});
  // The faces that the boxes hide from each other have no skin.
  const TriangleMesh crossedSkins = together({crossedBoxes(0.1), flipped(crossedHollow(0.1))});
  return {caseOf("of a box", boxShell),
          caseOf("of a box, turned", placed(boxShell, {3, 1, 2}, 2.0, {0.3, 0.0, 0.1})),
          caseOf("so thick that nothing is hollow",
                 {shell(box(Vec3E(0.5, 0.1, 0.4)), 0.3), grownBox({0.5, 0.1, 0.4}, 0.15).mesh,
                  sphereSurface(0.15, kSphereTimes).chord}),
          caseOf("of a ball", {shell(sphere(1.0), 0.2), skins, std::max(outer.chord, inner.chord)}),
          caseOf("of crossed boxes", {shell(crossed(), 0.2), crossedSkins, sphereSurface(0.1, 5).chord})};
}

ReferenceCase pulled(const std::string& name, const Solid& s, const glm::dvec3& half) {
  ReferenceCase c = caseOf(name, {elongate(s.shape, Vec3E(half)), pulledApart(s.mesh, half), s.chord});
  for (const double x : {-half.x, 0.0, half.x})
    for (const double y : {-half.y, 0.0, half.y}) c.special.push_back({x, y, half.z});
  return c;
}

std::vector<ReferenceCase> elongations() {
  const Solid a = lopsided(0.8), b = solidBox({0.3, 0.6, 0.4});
  return {pulled("of a lopsided solid", a, {0.5, 0.3, 0.2}),
          pulled("along one axis", a, {0.0, 0.9, 0.0}),
          pulled("of what is all on one side", movedBy(a, {2, 0, 0}), {0.5, 0.0, 0.3}),
          pulled("of an L", placed(solidL(), {1, 0.5, 2}, 0.8, {0.1, 0.0, 0.0}), {0.2, 0.4, 0.6}),
          pulled("of a ball", solidSphere(0.5), {0.7, 0.2, 0.4}),
          pulled("of a difference", b - a, {0.2, 0.1, 0.3})};
}

// The sine of each factor bounds the others' part: a row of the product's second derivatives sums to at most
// sqrt 2 w^2.
ReferenceCase waves(double amplitude, double w) {
  const auto g = [=](const glm::dvec3& p) {
    return glm::length(p) - 1.0 + amplitude * std::sin(w * p.x) * std::sin(w * p.y) * std::sin(w * p.z);
  };
  const double nearest = 0.98 - std::abs(amplitude),
               bending = 1.0 / nearest + std::numbers::sqrt2 * std::abs(amplitude) * w * w;
  return caseOf("of a ball by waves " + std::to_string(amplitude) + ", " + std::to_string(w),
                displace(sphere(1.0), amplitude, w),
                tessellated({g, nearest, 1.02 + std::abs(amplitude), bending}, kSphereTimes + 1));
}

std::vector<ReferenceCase> displacements() {
  // |p| = 1 - y / 2: a spheroid with its focus at the origin.
  const auto g = [](const glm::dvec3& p) { return glm::length(p) - 1.0 + 0.5 * p.y; };
  const Expr y = Expr::variable(Variable::Y);
  return {waves(0.1, 5.0), waves(-0.05, 12.0), waves(0.3, 2.0),
          caseOf("of a ball by a slope", displace(sphere(1.0), 0.5 * y),
                 tessellatedAboutY({g, 0.6, 2.1, 1.0 / 0.6})),
          caseOf("of an L by nothing", {displace(solidL().shape, 0.0, 3.0), solidL().mesh})};
}

}  // namespace

std::vector<OperatorCases> formCases() {
  return {{"morph", morphs},
          {"round", rounds},
          {"shell", shells},
          {"elongate", elongations},
          {"displace", displacements}};
}

}  // namespace sdf::accuracy
