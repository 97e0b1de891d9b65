// Hard booleans of polyhedra against exact corefinement; smooth ones of balls along the y axis against the
// outline of their zero set, found along rays.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "operator_blends.h"
#include "operator_cases.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"

namespace sdf::accuracy {
namespace {

TriangleMesh both(const TriangleMesh& a, const TriangleMesh& b) {
  return corefine(a, b, Boolean::Intersection);
}
TriangleMesh less(const TriangleMesh& a, const TriangleMesh& b) {
  return corefine(a, b, Boolean::Difference);
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

constexpr int kSteps = 128;

ReferenceCase blended(const char* name, const Smooth& smooth, const Shape& shape, Star star) {
  const Tessellation t = tessellatedAboutY(star, kSteps);
  return caseOf(std::string(smooth.name) + " " + name, {shape, t.mesh, t.chord});
}

// Where a chamfer's bevel begins and ends.
int pieceOf(double apart, double k) { return apart < -k ? 0 : apart > k ? 2 : 1; }

std::vector<ReferenceCase> unions() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), o = apart(), l = solidL();
  std::vector<ReferenceCase> cases{
      caseOf("two", {a.shape | b.shape, united({a.mesh, b.mesh})}),
      caseOf("three", {unite({a.shape, b.shape, c.shape}), united({a.mesh, b.mesh, c.mesh})}),
      caseOf("flush faces", {a.shape | f.shape, united({a.mesh, f.mesh})}),
      caseOf("one inside the other", {a.shape | i.shape, a.mesh}),
      caseOf("apart", {a.shape | o.shape, together({a.mesh, o.mesh})}),
      caseOf("of an L and a difference",
             {l.shape | (a.shape - b.shape), united({l.mesh, less(a.mesh, b.mesh)})})};
  const Ball low{-0.35, 0.8}, high{0.5, 0.6}, top{1.0, 0.3};
  constexpr double k = 0.3;
  for (const Smooth& s : kSmooths) {
    // A blended union lies below both distances: on its surface both are positive.
    Star star{[=](const glm::dvec3& p) { return s.lower(low.distance(p), high.distance(p), k); }, 0.3, 1.6,
              1.0 / high.radius + 4.0 * s.curvature / k};
    if (s.kind == Blend::Kind::Chamfer)
      star.piece = [=](const glm::dvec3& p) { return pieceOf(low.distance(p) - high.distance(p), k); };
    cases.push_back(blended("of two balls", s, unite(low.shape(), high.shape(), {s.kind, k}), star));
  }
  // Three at once: k log-sum-exp; its second derivative is the variance of the slopes over k, at most 1 / k.
  const Star star{[=](const glm::dvec3& p) {
                    double sum = 0.0;
                    for (const Ball& ball : {low, high, top}) sum += std::exp(-ball.distance(p) / k);
                    return -k * std::log(sum);
                  },
                  0.3, 1.8, 1.0 / top.radius + 1.0 / k};
  cases.push_back(blended("of three balls", smoothOf(Blend::Kind::Exponential),
                          unite({low.shape(), high.shape(), top.shape()}, Blend::exponential(k)), star));
  return cases;
}

std::vector<ReferenceCase> intersections() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), l = solidL();
  std::vector<ReferenceCase> cases{
      caseOf("two", {a.shape & b.shape, both(a.mesh, b.mesh)}),
      caseOf("three", {intersect({a.shape, b.shape, c.shape}), both(both(a.mesh, b.mesh), c.mesh)}),
      caseOf("flush faces", {a.shape & f.shape, both(a.mesh, f.mesh)}),
      caseOf("one inside the other", {a.shape & i.shape, i.mesh}),
      caseOf("of an L and a union", {l.shape & (a.shape | b.shape), both(l.mesh, united({a.mesh, b.mesh}))})};
  const Ball low{-0.5, 1.0}, high{0.6, 1.0};
  constexpr double k = 0.3;
  // The surface stays this far from the balls' centres, also where an exponential blend takes it inward.
  constexpr double kClear = 0.15;
  for (const Smooth& s : kSmooths) {
    Star star{[=](const glm::dvec3& p) { return -s.lower(-low.distance(p), -high.distance(p), k); }, 0.0, 1.2,
              1.0 / kClear + 4.0 * s.curvature / k};
    if (s.kind == Blend::Kind::Chamfer)
      star.piece = [=](const glm::dvec3& p) { return pieceOf(low.distance(p) - high.distance(p), k); };
    cases.push_back(blended("of two balls", s, intersect(low.shape(), high.shape(), {s.kind, k}), star));
  }
  return cases;
}

std::vector<ReferenceCase> differences() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), l = solidL(), o = apart();
  std::vector<ReferenceCase> cases{
      caseOf("two", {a.shape - b.shape, less(a.mesh, b.mesh)}),
      caseOf("three", {subtract({a.shape, b.shape, c.shape}), less(less(a.mesh, b.mesh), c.mesh)}),
      caseOf("flush faces", {a.shape - f.shape, less(a.mesh, f.mesh)}),
      caseOf("a cavity", {a.shape - i.shape, together({a.mesh, flipped(i.mesh)})}),
      caseOf("of what is apart", {a.shape - o.shape, a.mesh}),
      caseOf("a difference less a difference",
             {l.shape - (a.shape - b.shape), less(l.mesh, less(a.mesh, b.mesh))})};
  const Ball ball{0.4, 1.0}, cutter{2.9, 2.0};
  constexpr double k = 0.3, kClear = 0.25;
  for (const Smooth& s : kSmooths) {
    Star star{[=](const glm::dvec3& p) { return -s.lower(-ball.distance(p), cutter.distance(p), k); }, 0.0,
              1.5, 1.0 / kClear + 4.0 * s.curvature / k};
    if (s.kind == Blend::Kind::Chamfer)
      star.piece = [=](const glm::dvec3& p) { return pieceOf(ball.distance(p) + cutter.distance(p), k); };
    cases.push_back(
        blended("a ball less a ball", s, subtract(ball.shape(), cutter.shape(), {s.kind, k}), star));
  }
  return cases;
}

// The parts of an exclusive or meet along curves, where no mesh is a manifold: they stay meshes of their own.
std::vector<ReferenceCase> exclusions() {
  const Solid a = first(), b = second(), c = third(), f = flush(), i = inner(), o = apart();
  const TriangleMesh abc = both(both(a.mesh, b.mesh), c.mesh);
  std::vector<ReferenceCase> cases{
      caseOf("two", {a.shape ^ b.shape, together({less(a.mesh, b.mesh), less(b.mesh, a.mesh)})}),
      caseOf("three", {exclude({a.shape, b.shape, c.shape}),
                       together({less(less(a.mesh, b.mesh), c.mesh), less(less(b.mesh, a.mesh), c.mesh),
                                 less(less(c.mesh, a.mesh), b.mesh), abc})}),
      caseOf("flush faces", {a.shape ^ f.shape, together({less(a.mesh, f.mesh), less(f.mesh, a.mesh)})}),
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
    const Tessellation out = tessellatedAboutY({f, kMiddle, 1.3, bending}, kSteps),
                       in = tessellatedAboutY(
                           {[=](const glm::dvec3&p) { return -f(p); }, 0.4, kMiddle, bending}, kSteps);
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
