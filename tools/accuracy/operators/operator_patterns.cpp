// Placing and repeating: the mesh moved, turned, scaled, and copied.
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "operator_cases.h"
#include "sdf/shape/solids/flats.h"

namespace sdf::accuracy {
namespace {

// A solid that is a bound only, without a symmetry.
Solid carved() {
  return solidBox({0.5, 0.3, 0.4}) - placed(solidBox({0.3, 0.2, 0.5}), {1, 2, 1}, 0.9, {0.3, 0.2, 0.1});
}

// Copies made one mesh: together() where they are apart, united() where they overlap.
using Join = TriangleMesh (*)(const std::vector<TriangleMesh>& copies);

std::vector<ReferenceCase> translations() {
  return {caseOf("of an L", movedBy(solidL(), {0.3, -2.0, 0.7})),
          caseOf("of an L, far", movedBy(solidL(), {1000.0, -300.0, 20.0})),
          caseOf("of a difference", movedBy(carved(), {0.1, 0.2, -0.3}))};
}

ReferenceCase rotated(const std::string& name, const Solid& s, const glm::dvec3& angles) {
  const glm::dmat3 all = turn({0, 0, 1}, angles.z) * turn({0, 1, 0}, angles.y) * turn({1, 0, 0}, angles.x);
  return caseOf(name, {rotate(s.shape, Vec3E(angles)), turned(s.mesh, all), s.chord});
}

std::vector<ReferenceCase> rotations() {
  return {rotated("of an L", solidL(), {0.4, -1.1, 2.3}),
          rotated("of an L by quarters", solidL(), {kPi / 2, kPi, -kPi / 2}),
          rotated("of a difference", carved(), {-2.0, 0.3, 0.1}),
          rotated("of a lopsided solid", lopsided(1.0), {5.0, 4.0, 3.0})};
}

ReferenceCase rotatedAbout(const std::string& name, const Solid& s, const glm::dvec3& axis, double angle) {
  return caseOf(name, {rotateAbout(s.shape, Vec3E(axis), angle), turned(s.mesh, turn(axis, angle)), s.chord});
}

std::vector<ReferenceCase> rotationsAbout() {
  return {rotatedAbout("of an L", solidL(), {1, -2, 0.5}, 2.0),
          rotatedAbout("of an L about y", solidL(), {0, -3, 0}, 1.0),
          rotatedAbout("of a difference", carved(), {0.1, 0.2, 0.1}, -4.0)};
}

ReferenceCase scaled(const std::string& name, const Solid& s, const glm::dvec3& by) {
  return caseOf(name, {scale(s.shape, Vec3E(by)),
                       mapped(
                           s.mesh, [=](const glm::dvec3& p) { return p * by; }, by.x * by.y * by.z < 0.0)});
}

std::vector<ReferenceCase> scalings() {
  return {scaled("of an L, alike", solidL(), glm::dvec3(2.5)),
          scaled("of an L, alike, reflected", solidL(), glm::dvec3(-0.01)),
          scaled("of a lopsided solid", lopsided(1.0), {0.5, 3.0, -1.0}),
          scaled("of an L, flat", solidL(), {1.0, 1.0, 0.02}),
          scaled("of a difference", carved(), {-2.0, -1.0, 1.5})};
}

TriangleMesh image(const TriangleMesh& mesh, const glm::dvec3& normal) {
  const glm::dvec3 n = glm::normalize(normal);
  return mapped(
      mesh, [=](const glm::dvec3& p) { return p - 2.0 * glm::dot(p, n) * n; }, true);
}

ReferenceCase mirrored(const std::string& name, const Solid& s, const glm::dvec3& normal, Join join) {
  return caseOf(name, {mirror(s.shape, Vec3E(normal)), join({s.mesh, image(s.mesh, normal)}), s.chord});
}

std::vector<ReferenceCase> mirrors() {
  const Solid l = placed(solidL(), {1, 0.5, 2}, 0.8, {0.1, 0, 0}),
              side = movedBy(solidBox({0.5, 0.3, 0.4}), {0.5, 0.1, 0.0});
  return {mirrored("of an L across itself", l, {1, 0, 0}, united),
          mirrored("of an L across itself, leaning", l, {1, 2, -1}, united),
          mirrored("of an L clear of the plane", movedBy(l, {0, 2.5, 0}), {0, 1, 0}, together),
          mirrored("of an L clear of a leaning plane", movedBy(l, {-3, -3, 0}), {1, 1, 0.2}, together),
          beyondSeam(0.0, caseOf("of a box that stands on the plane",
                                 {mirror(side.shape, Vec3E(-1.0, 0.0, 0.0)),
                                  moved(boxMesh({1.0, 0.3, 0.4}), {0, 0.1, 0})})),
          mirrored("of a difference", carved(), {0, 0, 1}, united),
          mirrored("of a difference clear of the plane", movedBy(carved(), {0, 0, -1}), {0, 0, 1}, together)};
}

// How a grid is laid out; what is endless has as many copies as its region needs.
struct Layout {
  glm::dvec3 cell;
  glm::ivec3 count;
  bool endless = false;
};

std::vector<TriangleMesh> copiesOf(const TriangleMesh& mesh, const Layout& layout) {
  std::vector<TriangleMesh> copies;
  glm::ivec3 i;
  for (i.x = 0; i.x < layout.count.x; ++i.x)
    for (i.y = 0; i.y < layout.count.y; ++i.y)
      for (i.z = 0; i.z < layout.count.z; ++i.z)
        copies.push_back(moved(mesh, layout.cell * (glm::dvec3(i) - 0.5 * glm::dvec3(layout.count - 1))));
  return copies;
}

ReferenceCase grid(const std::string& name, const Solid& s, const Layout& layout, Join join = together) {
  const auto count = layout.endless ? std::nullopt : std::optional(layout.count);
  ReferenceCase c =
      caseOf(name, {repeatGrid(s.shape, Vec3E(layout.cell), count), join(copiesOf(s.mesh, layout)), s.chord});
  // The walls between cells, and their crossings.
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) c.special.push_back(0.5 * layout.cell * glm::dvec3(x, y, z));
  // Five copies stay beyond the region on either side of it: of all, one within three cells is the nearest.
  for (int i = 0; i < 3 && layout.endless; ++i) {
    if (layout.cell[i] == 0.0) continue;
    c.region.max[i] = 0.5 * layout.cell[i] * (layout.count[i] - 10);
    c.region.min[i] = -c.region.max[i];
  }
  return c;
}

std::vector<ReferenceCase> grids() {
  const Solid poking = movedBy(lopsided(0.5), {0.5, 0.3, 0.2}), ball = solidSphere(0.4);
  const Solid beam = placed(solidBox({1.5, 0.2, 0.3}), {0, 0, 1}, kPi / 6, {0.2, 0.1, 0.0});
  const Layout flat{{1.5, 1.7, 0.0}, {4, 3, 1}};
  ReferenceCase extruded = grid("of a flat L, extruded", solidL(), flat);
  extruded.shape = extrude(repeatGrid(polygon(kL), Vec3E(flat.cell), flat.count), 0.35);
  return {grid("of what pokes over its walls", poking, {{1.2, 1.3, 1.4}, {3, 2, 2}}),
          grid("of what pokes over its walls, endless", poking, {{1.2, 1.3, 0.0}, {13, 13, 1}, true}),
          grid("of what is off its cell", movedBy(poking, {3, -2, 1}), {{1.2, 1.3, 1.4}, {2, 3, 1}}),
          grid("of what overlaps", poking, {{0.5, 0.0, 0.0}, {5, 1, 1}}, united),
          grid("of what overlaps, in two rows", lopsided(0.5), {{0.6, 0.5, 0.0}, {3, 2, 1}}, united),
          grid("of beams longer than a cell", beam, {{2.0, 0.0, 0.0}, {4, 1, 1}}),
          grid("of beams longer than a cell, endless", beam, {{2.0, 0.0, 1.0}, {15, 1, 15}, true}),
          grid("of what is even", ball, {{1.0, 1.1, 0.9}, {4, 3, 1}}),
          grid("of what is even, endless", solidBox({0.3, 0.2, 0.4}), {{1.0, 1.1, 0.9}, {13, 13, 13}, true}),
          beyondSeam(0.5, grid("of what touches", solidBox({0.5, 0.4, 0.3}), {{1.0, 0.0, 0.0}, {3, 1, 1}},
                               [](const auto&) {
                                 return boxMesh({1.5, 0.4, 0.3});
                               })),
          grid("of a difference", carved(), {{1.1, 0.9, 1.0}, {3, 2, 3}}),
          grid("of a difference, endless", movedBy(carved(), {0.4, 0.1, 0.0}),
               {{1.1, 0.0, 0.9}, {13, 1, 13}, true}),
          extruded};
}

std::vector<TriangleMesh> around(const TriangleMesh& mesh, int count) {
  std::vector<TriangleMesh> copies;
  for (int i = 0; i < count; ++i) copies.push_back(turned(mesh, turn({0, 1, 0}, 2.0 * kPi * i / count)));
  return copies;
}

ReferenceCase polar(const std::string& name, const Solid& s, int count, Join join = together) {
  ReferenceCase c = caseOf(name + ", " + std::to_string(count),
                           {polarRepeat(s.shape, count), join(around(s.mesh, count)), s.chord});
  for (int i = 0; i < 2 * count; ++i)  // the borders of the sectors, and their middles
    for (const double radius : {0.1, 1.0, 2.0})
      c.special.push_back(turn({0, 1, 0}, kPi * i / count) * glm::dvec3(radius, 0.1, 0.0));
  return c;
}

std::vector<ReferenceCase> polars() {
  const Solid aside = movedBy(lopsided(0.3), {1.0, 0.2, 0.1});
  const Solid leaning = placed(solidBox({0.15, 0.3, 0.6}), {0, 1, 0}, 0.5, {1.2, 0.0, 0.0});
  return {polar("of a lopsided solid", aside, 7),
          polar("of a lopsided solid", aside, 2),
          polar("of a lopsided solid", movedBy(lopsided(0.05), {-0.6, 0, 0.9}), 48),
          polar("of what is even", movedBy(solidBox({0.3, 0.4, 0.2}), {1.1, 0.0, 0.0}), 6),
          polar("of what spans sectors", leaning, 9, united),
          polar("of what overlaps", leaning, 14, united),
          polar("of what reaches across the axis", lopsided(0.8), 3, united),
          polar("of a difference", movedBy(carved(), {1.3, 0.0, 0.2}), 5),
          polar("of one", aside, 1)};
}

}  // namespace

std::vector<OperatorCases> placeCases() {
  return {{"translate", translations},
          {"rotate", rotations},
          {"rotate_about", rotationsAbout},
          {"scale", scalings},
          {"mirror", mirrors}};
}

std::vector<OperatorCases> patternCases() { return {{"repeat_grid", grids}, {"polar_repeat", polars}}; }

}  // namespace sdf::accuracy
