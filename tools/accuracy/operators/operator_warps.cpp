// extrude, revolve, twist, bend and taper.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "operator_cases.h"
#include "sdf/shape/solids/flats.h"

namespace sdf::accuracy {
namespace {

using Corners = std::vector<glm::dvec2>;

constexpr int kSteps = 256;    // of a turn about an axis
constexpr int kFaceTimes = 6;  // of a warped face's refinement

Corners regularOutline(int corners, double radius, const glm::dvec2& centre) {
  Corners outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * i / corners;
    outline.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

double chordOfCircle(double radius) { return radius * (1.0 - std::cos(kPi / kSteps)); }

std::vector<ReferenceCase> extrusions() {
  const Corners star{{0.3, 0}, {1, 1}, {0, 0.3}, {-1, 1}, {-0.3, 0}, {-1, -1}, {0, -0.3}, {1, -1}};
  const Corners slim{{0, 0}, {2, 0.01}, {0.1, 0.3}};
  // The L again, as a rectangle less a rectangle: a bound inside and out.
  const Shape whole = translate(rectangle(0.65, 0.75), Vec3E(0.35, 0.35, 0.0)),
              corner = translate(rectangle(0.5, 0.5), Vec3E(0.9, 0.9, 0.0));
  const Shape lower = translate(rectangle(0.65, 0.4), Vec3E(0.35, 0.0, 0.0)),
              upper = translate(rectangle(0.35, 0.5), Vec3E(0.05, 0.6, 0.0));
  return {caseOf("of an L", {extrude(polygon(kL), 0.5), prismMesh(kL, {0.1, 0}, 0.5)}),
          caseOf("of a star", {extrude(polygon(star), 0.05), prismMesh(star, {0, 0}, 0.05)}),
          caseOf("of a splinter", {extrude(polygon(slim), 3.0), prismMesh(slim, {0.5, 0.1}, 3.0)}),
          caseOf("of a circle",
                 {extrude(circle(0.7), 0.4), prismMesh(regularOutline(kSteps, 0.7, {0, 0}), {0, 0}, 0.4),
                  chordOfCircle(0.7)}),
          caseOf("of a flat difference", {extrude(whole - corner, 0.5), prismMesh(kL, {0.1, 0}, 0.5)}),
          caseOf("of a flat union", {extrude(lower | upper, 0.5), prismMesh(kL, {0.1, 0}, 0.5)})};
}

ReferenceCase swept(const std::string& name, const Shape& shape, const Corners& outline, double chord = 0.0) {
  ReferenceCase c = caseOf(name, shape, revolved(outline, kSteps));
  c.chord += chord;
  for (const glm::dvec2& p : outline)
    c.special.insert(c.special.end(), {{p, 0.0}, {-p.x, p.y, 0.0}, {0.0, p.y, 0.0}});
  return c;
}

ReferenceCase partly(const std::string& name, double degrees) {
  Corners far = kL;
  for (glm::dvec2& p : far) p.x += 0.8;
  const double angle = degrees * kPi / 180.0;
  return caseOf(name, revolve(polygon(kL), 0.8, angle), partlyRevolved(far, {0.9, 0.0}, angle, kSteps));
}

std::vector<ReferenceCase> revolutions() {
  Corners far = kL;
  for (glm::dvec2& p : far) p.x += 0.8;
  const Corners across{{-0.5, -0.3}, {1, -0.5}, {0.8, 0.9}, {-0.5, 0.6}},
      kept{{0, -0.3 - 0.2 / 3.0}, {1, -0.5}, {0.8, 0.9}, {0, 0.6 + 0.15 / 1.3}};
  // More of it lies beyond the axis: what is dropped would be nearer.
  const Corners beyond{{-0.9, -0.5}, {0.3, 0}, {-0.9, 0.5}}, tip{{0, -0.125}, {0.3, 0}, {0, 0.125}};
  const Corners onAxis{{0, -1}, {0.6, -0.2}, {0.2, 0.1}, {0.7, 0.9}, {0, 0.5}};
  return {
      swept("of an L about an axis beside it", revolve(polygon(kL), 0.8), far),
      swept("of a circle", revolve(circle(0.3), 1.0), regularOutline(kSteps, 0.3, {1.0, 0.0}),
            chordOfCircle(0.3)),
      beyondSeam(0.0, swept("of what stands on the axis", revolve(polygon(onAxis)), onAxis)),
      swept("of what is even", revolve(rectangle(0.8, 0.5)), {{0, -0.5}, {0.8, -0.5}, {0.8, 0.5}, {0, 0.5}}),
      swept("of what lies across the axis", revolve(polygon(across)), kept),
      swept("of what lies beyond the axis", revolve(polygon(beyond)), tip),
      swept("of a rectangle pushed across the axis", revolve(rectangle(0.8, 0.5), 0.3),
            {{0, -0.5}, {1.1, -0.5}, {1.1, 0.5}, {0, 0.5}}),
      partly("of a part of a turn", 50.0),
      partly("of half a turn", 180.0),
      partly("of most of a turn", 300.0)};
}

double largest(const TriangleMesh& mesh, const std::function<double(const glm::dvec3&)>& of) {
  double most = 0.0;
  for (const glm::dvec3& p : mesh.points) most = std::max(most, of(p));
  return most;
}

// Greatest second derivative along a unit direction of a map that bends by `along` along one axis and shears
// by `mixed` across it: the larger eigenvalue of [[0, mixed], [mixed, along]].
double bendingOf(double along, double mixed) { return 0.5 * (along + std::hypot(along, 2.0 * mixed)); }

ReferenceCase warpedCase(const std::string& name, const Shape& shape, const TriangleMesh& flat,
                         const PointMap& map, double bending) {
  const int times = flat.triangles.size() > 100 ? kFaceTimes - 2 : kFaceTimes;
  ReferenceCase c = caseOf(name, shape, warped(flat, times, map, bending));
  for (const glm::dvec3& p : flat.points) c.special.push_back(map(p));
  return c;
}

ReferenceCase twisted(const std::string& name, const Solid& s, double rate) {
  const double radius = largest(s.mesh, [](const glm::dvec3& p) { return std::hypot(p.x, p.z); });
  return warpedCase(name + ", " + std::to_string(rate), twist(s.shape, rate), s.mesh, twistMap(rate),
                    bendingOf(rate * rate * radius, std::abs(rate)));
}

ReferenceCase bent(const std::string& name, const Solid& s, double k) {
  const double widest = largest(s.mesh, [=](const glm::dvec3& p) { return std::abs(1.0 - k * p.y); });
  return warpedCase(name + ", " + std::to_string(k), bend(s.shape, k), s.mesh, bendMap(k),
                    bendingOf(std::abs(k) * widest, std::abs(k)));
}

ReferenceCase tapered(const std::string& name, const Solid& s, double rate) {
  return warpedCase(name + ", " + std::to_string(rate), taper(s.shape, rate), s.mesh, taperMap(rate),
                    bendingOf(0.0, std::abs(rate)));
}

// A bound only, and not convex.
Solid carvedBox(const glm::dvec3& half) {
  return solidBox(half) - placed(solidBox({0.3, 0.4, 0.2}), {1, 2, 1}, 0.9, 0.7 * half);
}

std::vector<ReferenceCase> twists() {
  return {twisted("of a box", solidBox({0.6, 1.0, 0.3}), 1.5),
          twisted("of a box", solidBox({0.2, 1.0, 0.1}), -3.0),
          twisted("of a box beside the axis", movedBy(solidBox({0.2, 0.8, 0.3}), {0.7, 0.3, 0.0}), 1.0),
          twisted("of a lopsided solid", lopsided(0.9), 2.0),
          twisted("of an L", placed(solidL(), {1, 0, 0}, 1.2, {0, 0, 0}), -1.0),
          twisted("of a difference", carvedBox({0.5, 0.9, 0.4}), 1.2)};
}

std::vector<ReferenceCase> bends() {
  return {bent("of a bar", solidBox({1.0, 0.2, 0.3}), 0.8),
          bent("of a bar", solidBox({1.0, 0.2, 0.3}), -1.2),
          bent("of a bar nearly into a ring", solidBox({2.0, 0.2, 0.2}), 1.45),
          bent("of a bar that nearly folds", solidBox({0.8, 0.6, 0.3}), 1.4),
          bent("of a bar beside the axis", movedBy(solidBox({0.5, 0.2, 0.3}), {0.6, 0.5, 0.2}), 0.7),
          bent("of a bar beside the axis", movedBy(solidBox({0.5, 0.2, 0.3}), {0.6, 0.5, 0.2}), -0.7),
          bent("of a lopsided solid", lopsided(0.9), 0.6),
          bent("of a difference", carvedBox({0.9, 0.4, 0.4}), 0.9)};
}

std::vector<ReferenceCase> tapers() {
  return {tapered("of a box", solidBox({0.5, 1.0, 0.4}), 0.5),
          tapered("of a box", solidBox({0.5, 1.0, 0.4}), -0.9),
          tapered("of a box aside and above", movedBy(solidBox({0.3, 0.5, 0.4}), {0.6, 1.0, 0.2}), -0.4),
          tapered("of a lopsided solid", lopsided(0.9), 0.7),
          tapered("of a difference", carvedBox({0.5, 0.9, 0.4}), -0.5)};
}

}  // namespace

std::vector<OperatorCases> sweepAndWarpCases() {
  return {{"extrude", extrusions},
          {"revolve", revolutions},
          {"twist", twists},
          {"bend", bends},
          {"taper", tapers}};
}

}  // namespace sdf::accuracy
