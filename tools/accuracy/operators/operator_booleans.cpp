// Hard booleans of polyhedra against exact corefinement; smooth ones of balls along the y axis against the
// outline of their zero set, found along rays.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "operator_blends.h"
#include "operator_cases.h"

namespace sdf::accuracy {
namespace {

// Of two solids, exactly.
Solid operator|(const Solid& a, const Solid& b) { return {a.shape | b.shape, united({a.mesh, b.mesh})}; }
Solid operator&(const Solid& a, const Solid& b) {
  return {a.shape & b.shape, corefine(a.mesh, b.mesh, Boolean::Intersection)};
}

// Three solids, each pair of which overlaps, and all three.
Solid first() { return solidBox({0.9, 0.5, 0.6}); }
Solid second() { return placed(solidBox({0.4, 0.8, 0.3}), {1, -2, 1}, 0.7, {0.4, 0.3, 0.2}); }
Solid third() { return placed(solidTetrahedron(1.1), {3, 1, -1}, 2.0, {-0.3, 0.1, 0.4}); }
// What meets the first along whole faces: nothing is in general position.
Solid flush() { return movedBy(solidBox({0.5, 0.5, 0.3}), {0.9, 0.5, 0.3}); }
Solid inner() { return placed(solidOctahedron(0.4), {0, 1, 1}, 0.5, {0.1, 0.0, 0.1}); }
Solid apart() { return movedBy(solidOctahedron(0.6), {0.5, 2.0, -0.3}); }

// Balls that stand on the y axis, and a blend of theirs whose zero set is a star about the origin.
struct Ball {
  double y, radius;
  Shape shape() const { return translate(sphere(radius), Vec3E(0.0, y, 0.0)); }
  double distance(const glm::dvec3& p) const { return glm::length(p - glm::dvec3(0, y, 0)) - radius; }
};

constexpr double kWidth = 0.3;  // of the blends

// Where a chamfer's bevel begins and ends.
int pieceOf(double apart, double k) { return apart < -k ? 0 : apart > k ? 2 : 1; }

// Two balls blended, as sideA lower(sideA a, sideB b): a side of -1 takes what is outside of its ball.
struct Pair {
  Ball a, b;
  double sideA, sideB;
  double nearest, farthest;  // the surface's radii lie between
  double clear;              // how near the surface comes to the balls' centres
};

void addBlended(std::vector<ReferenceCase>& cases, const char* name, const Pair& pair,
                Shape (*combine)(const Shape&, const Shape&, const Blend&)) {
  for (const Smooth& s : kSmooths) {
    const auto a = [=](const glm::dvec3& p) { return pair.sideA * pair.a.distance(p); };
    const auto b = [=](const glm::dvec3& p) { return pair.sideB * pair.b.distance(p); };
    Star star{[=](const glm::dvec3& p) { return pair.sideA * s.lower(a(p), b(p), kWidth); }, pair.nearest,
              pair.farthest, 1.0 / pair.clear + 4.0 * s.curvature / kWidth};
    if (s.kind == Blend::Kind::Chamfer)
      star.piece = [=](const glm::dvec3& p) { return pieceOf(a(p) - b(p), kWidth); };
    cases.push_back(caseOf(std::string(s.name) + " " + name,
                           combine(pair.a.shape(), pair.b.shape(), {s.kind, kWidth}),
                           tessellatedAboutY(star)));
  }
}

std::vector<ReferenceCase> unions() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), o = apart(), l = solidL();
  std::vector<ReferenceCase> cases{
      caseOf("two", a | b),
      caseOf("three", {unite({a.shape, b.shape, c.shape}), united({a.mesh, b.mesh, c.mesh})}),
      caseOf("flush faces", a | f),
      caseOf("one inside the other", {a.shape | i.shape, a.mesh}),
      caseOf("apart", {a.shape | o.shape, together({a.mesh, o.mesh})}),
      caseOf("of an L and a difference", l | (a - b))};
  const Ball low{-0.35, 0.8}, high{0.5, 0.6}, top{1.0, 0.3};
  // A blended union lies below both distances: on its surface both are positive.
  addBlended(cases, "of two balls", {low, high, 1.0, 1.0, 0.3, 1.6, high.radius}, unite);
  // Three at once: k log-sum-exp; its second derivative is the variance of the slopes over k, at most 1 / k.
  const Star star{[=](const glm::dvec3& p) {
                    double sum = 0.0;
                    for (const Ball& ball : {low, high, top}) sum += std::exp(-ball.distance(p) / kWidth);
                    return -kWidth * std::log(sum);
                  },
                  0.3, 1.8, 1.0 / top.radius + 1.0 / kWidth};
  cases.push_back(caseOf("exponential of three balls",
                         unite({low.shape(), high.shape(), top.shape()}, Blend::exponential(kWidth)),
                         tessellatedAboutY(star)));
  return cases;
}

std::vector<ReferenceCase> intersections() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), l = solidL();
  std::vector<ReferenceCase> cases{
      caseOf("two", a & b), caseOf("three", {intersect({a.shape, b.shape, c.shape}), (a & b & c).mesh}),
      caseOf("flush faces", a & f), caseOf("one inside the other", {a.shape & i.shape, i.mesh}),
      caseOf("of an L and a union", l & (a | b))};
  // The surface stays this far from the balls' centres, also where an exponential blend takes it inward.
  constexpr double kClear = 0.15;
  addBlended(cases, "of two balls", {{-0.5, 1.0}, {0.6, 1.0}, -1.0, -1.0, 0.0, 1.2, kClear}, intersect);
  return cases;
}

std::vector<ReferenceCase> differences() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), l = solidL(), o = apart();
  std::vector<ReferenceCase> cases{
      caseOf("two", a - b),
      caseOf("three", {subtract({a.shape, b.shape, c.shape}), (a - b - c).mesh}),
      caseOf("flush faces", a - f),
      caseOf("a cavity", {a.shape - i.shape, together({a.mesh, flipped(i.mesh)})}),
      caseOf("of what is apart", {a.shape - o.shape, a.mesh}),
      caseOf("a difference less a difference", l - (a - b))};
  addBlended(cases, "a ball less a ball", {{0.4, 1.0}, {2.9, 2.0}, -1.0, 1.0, 0.0, 1.5, 0.25}, subtract);
  return cases;
}

// The parts of an exclusive or meet along curves, where no mesh is a manifold: they stay meshes of their own.
std::vector<ReferenceCase> exclusions() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), o = apart();
  std::vector<ReferenceCase> cases{
      caseOf("two", {a.shape ^ b.shape, together({(a - b).mesh, (b - a).mesh})}),
      caseOf("three", {exclude({a.shape, b.shape, c.shape}),
                       together({(a - b - c).mesh, (b - a - c).mesh, (c - a - b).mesh, (a & b & c).mesh})}),
      caseOf("flush faces", {a.shape ^ f.shape, together({(a - f).mesh, (f - a).mesh})}),
      caseOf("one inside the other", {a.shape ^ i.shape, together({a.mesh, flipped(i.mesh)})}),
      caseOf("apart", {a.shape ^ o.shape, together({a.mesh, o.mesh})})};
  // One ball within another, nearer than the blend is wide: what is left is a bowl with two surfaces. A
  // chamfer as wide as the wall would take all of it.
  const Ball outer{0.0, 1.0}, core{0.05, 0.7};
  constexpr double kMiddle = 0.85;
  for (const Smooth& s : kSmooths) {
    const double k = s.kind == Blend::Kind::Chamfer ? 0.2 : 0.3;
    const auto f = [=](const glm::dvec3& p) {
      const double either = s.lower(outer.distance(p), core.distance(p), k),
                   both = -s.lower(-outer.distance(p), -core.distance(p), k);
      return -s.lower(-either, both, k);
    };
    // Both blends bend: each by at most the operands' slopes, 2 apart.
    const double bending = 1.0 / 0.3 + 8.0 * s.curvature / k;
    const Tessellation out = tessellatedAboutY({f, kMiddle, 1.3, bending}),
                       in = tessellatedAboutY(
                           {[=](const glm::dvec3&p) { return -f(p); }, 0.4, kMiddle, bending});
    cases.push_back(caseOf(std::string(s.name) + " a ball within a ball",
                           {exclude(outer.shape(), core.shape(), {s.kind, k}),
                            together({out.mesh, flipped(in.mesh)}), std::max(out.chord, in.chord)}));
  }
  return cases;
}

}  // namespace

std::vector<OperatorCases> booleanCases() {
  return {
      {"union", unions}, {"intersection", intersections}, {"difference", differences}, {"xor", exclusions}};
}

}  // namespace sdf::accuracy
