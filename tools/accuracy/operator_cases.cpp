#include "operator_cases.h"

#include "sdf/shape/flats.h"
#include "sdf/shape/operators.h"
#include "sdf/shape/solids.h"

namespace sdf::accuracy {

Solid solidBox(const glm::dvec3& half) { return {box(Vec3E(half)), boxMesh(half)}; }
Solid solidTetrahedron(double radius) { return {tetrahedron(radius), tetrahedronMesh(radius)}; }
Solid solidOctahedron(double radius) { return {octahedron(radius), octahedronMesh(radius)}; }

Solid solidSphere(double radius) {
  const Tessellation t = sphereSurface(radius, 6);
  return {sphere(radius), t.mesh, t.chord};
}

Solid solidL() {
  const std::vector<glm::dvec2> outline{{-0.3, -0.4}, {1, -0.4},  {1, 0.4},
                                        {0.4, 0.4},   {0.4, 1.1}, {-0.3, 1.1}};
  return {extrude(polygon(outline), 0.35), prismMesh(outline, {0.1, 0.0}, 0.35)};
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
  ReferenceCase c{"", std::move(name), s.shape, s.mesh, s.chord};
  if (s.mesh.points.size() <= kFew) c.special = s.mesh.points;
  return c;
}

ReferenceCase beyondSeam(double x, ReferenceCase c) {
  c.region.min.x = x + 0x1p-10;
  return c;
}

std::vector<OperatorCases> operatorCases() {
  std::vector<OperatorCases> all;
  for (const auto& part : {booleanCases(), formCases(), sweepAndWarpCases(), placeCases(), patternCases()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace sdf::accuracy
