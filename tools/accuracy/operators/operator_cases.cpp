#include "operator_cases.h"

#include "sdf/shape/solids/flats.h"

namespace sdf::accuracy {

Solid solidBox(const glm::dvec3& half) { return {box(Vec3E(half)), boxMesh(half)}; }
Solid solidTetrahedron(double radius) { return {tetrahedron(radius), tetrahedronMesh(radius)}; }
Solid solidOctahedron(double radius) { return {octahedron(radius), octahedronMesh(radius)}; }

Solid solidSphere(double radius) {
  const Tessellation t = sphereSurface(radius, 6);
  return {sphere(radius), t.mesh, t.chord};
}

Solid solidL() { return {extrude(polygon(kL), 0.35), prismMesh(kL, {0.1, 0.0}, 0.35)}; }

Solid operator-(const Solid& a, const Solid& b) {
  return {a.shape - b.shape, corefine(a.mesh, b.mesh, Boolean::Difference)};
}

Solid placed(const Solid& s, const glm::dvec3& axis, double angle, const glm::dvec3& offset) {
  return {translate(rotateAbout(s.shape, Vec3E(axis), angle), Vec3E(offset)),
          moved(turned(s.mesh, turn(axis, angle)), offset), s.chord};
}

Solid movedBy(const Solid& s, const glm::dvec3& offset) {
  return {translate(s.shape, Vec3E(offset)), moved(s.mesh, offset), s.chord};
}

Solid lopsided(double radius) {
  return placed(solidTetrahedron(radius), {1, 2, 3}, 1.0, radius * glm::dvec3(0.13, 0.07, -0.11));
}

ReferenceCase caseOf(std::string name, const Solid& s) {
  constexpr std::size_t kFew = 500;
  ReferenceCase c{{s.mesh, s.chord}, std::move(name), s.shape};
  if (s.mesh.points.size() <= kFew) c.special = s.mesh.points;
  return c;
}

ReferenceCase caseOf(std::string name, const Shape& shape, const Tessellation& t) {
  return caseOf(std::move(name), {shape, t.mesh, t.chord});
}

ReferenceCase beyondSeam(double x, ReferenceCase c) {
  c.region.min.x = x + 0x1p-10;
  return c;
}

Row operatorRow(const OperatorCases& cases, std::uint64_t fraction) {
  const std::vector<ReferenceCase> made = cases.make();
  std::vector<std::function<ReferenceCase()>> makers;
  for (const ReferenceCase& c : made) makers.emplace_back([&c] { return c; });
  return rowOf(cases.entry, makers, fraction);
}

std::vector<OperatorCases> operatorCases() {
  std::vector<OperatorCases> all;
  for (const auto& part : {booleanCases(), formCases(), sweepAndWarpCases(), placeCases(), patternCases()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace sdf::accuracy
