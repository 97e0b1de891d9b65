#include "report.h"

#include "sdf/shape/catalog.h"

namespace sdf::accuracy {
namespace {

constexpr const char* kIntroduction = R"(# How accurate the distances are

Every shape and operator of the catalog is compared with geometry that was computed another way. This page is
written by `accuracy docs/accuracy.md`; the tests labelled `accuracy` make the same comparison and fail where a
claim does not hold.

## What is compared

- *f* is the shape's distance at a point, read in double. *d* is the signed distance to a triangle mesh of the
  same solid: [CGAL](https://www.cgal.org) finds the nearest triangle and decides the side with exact predicates.
- The meshes come from the solids' definitions — corners, profiles, parametric surfaces — never from the distance
  functions. A flat shape stands for its outline; a solid of revolution is compared in the plane of its profile,
  which is a finer mesh than one of the whole solid. A wall (gyroid and the like) is meshed from its trigonometric
  formula by root finding on a lattice; so are struts, from a list of them, with a chord as wide as that lattice's cells:
  a test of its own holds them to the list. Operators are compared with the same operation on meshes.
- A mesh of a curved solid is off by at most its *chord*: the sources in `tools/accuracy` derive it for each. It is
  0 where the solid has flat faces only.
- Each shape is tried at several arguments, extreme ones among them: needles, discs, tubes that overlap themselves.
- Points lie near the surface at distances from one millionth of the size up, inside, around, up to 100 sizes away,
  on symmetry planes and axes, at corners, on edges and on the medial axis. All coordinates are floats.

A claim holds at a point if it is broken by no more than the chord plus four float ulps of the point; an ulp is the
step from the largest coordinate to the next float. Where *d* is larger than that the sign must be right, too. An exact
claim means that |f − d| is no larger than this allowance; a bound, that |f| exceeds |d| by no more. Difference quotients
may not exceed the claimed L.

## Reading the tables

- *error*: largest |f − d| where the claim says exact, in scene units, over all arguments; `–` for a bound.
- *chord*: largest chord of the meshes. An error of about that size is the mesh's.
- *ulps*: how far an error went beyond its chord, in float ulps of the point; 4 are allowed.
- *tightness*: least f / d, given the allowance, where d is at least 20 times that; 1 is exact.
- *L*: the claimed bound of the slope, and the largest difference quotient that was met.
- *float*: largest difference of the float SIMD reading from the double one, in float ulps of the point or of the
  solid's size, whichever is larger.
- *points*: how many were tried. A claim that a point refutes would show here in bold.
)";

constexpr const char* kOffsets = R"(
## Built on deformed solids

Operators applied to a deformed solid's distance are compared with the same operators applied to the true distance. The
true one is the distance to a mesh of a box, a torus, a sphere, a cylinder and a column over a star, each vertex moved as
the deformation's definition says. An *error* is the distance of the resulting surface from its place, along the normal of
a smooth face at least 1.5 offsets from its edges and its medial axis, in offsets (for a blend: in widths); 3 means that
no surface was found up to there. Offsets are 5 % and 25 % of the smallest half size. *astray* counts points on the wrong
side by more than 35 % of the offset, or by more than a first-order distance may be off at an edge.

| deformation | operator | median error | 99 % | worst | astray | lines |
|---|---|---|---|---|---|---|
)";

constexpr const char* kFailures = R"(
## Known failures

Each row is a case in which a method in common use fails, beside libsdf's figure. The tests labelled `stability` run each
case twice: the naive method must show the failure, or the case would not be real, and ours must hold to its limit. Where
no method can do better, ours counts errors that are not reported. Without an error a figure is 0 or less, but for
rounding.

| case | what is measured | naive method | naive | ours | measured | limit | why these limits |
|---|---|---|---|---|---|---|---|
)";

std::string brief(double value) { return value == 0.0 ? "0" : formatted("%.1e", value); }

/// As the text of a table's cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

void writeRow(std::ostream& out, const Row& row) {
  const CatalogEntry& entry = *findEntry(row.entry);
  const Checked& c = row.found;
  const auto limit = [](double l) { return l == kInfinity ? "∞" : formatted("%.6g", l); };
  out << "| `" << row.entry << "` | " << cell(entry.claim) << " | " << (row.exact ? brief(c.maxError) : "–")
      << " | " << brief(row.chord) << " | " << (row.exact ? formatted("%.2f", c.maxUlps) : "–") << " | "
      << formatted("%.3f", c.tightness) << " | " << limit(row.lipschitz) << " | "
      << formatted("%.4f", c.lipschitz) << " | " << formatted("%.1f", c.floatUlps) << " | "
      << grouped(c.points);
  if (c.refuted > 0) out << ", **" << grouped(c.refuted) << " refuted**";
  out << " |\n";
}

void writeTable(std::ostream& out, const char* what, std::span<const Row> rows) {
  out << "| " << what << " | claim | error | chord | ulps | tightness | L | L measured | float | points |\n"
      << "|---|---|---|---|---|---|---|---|---|---|\n";
  std::uint64_t points = 0;
  for (const Row& row : rows) {
    writeRow(out, row);
    points += row.found.points;
  }
  out << "\n" << grouped(points) << " points.\n";
}

void writeOffset(std::ostream& out, const OffsetRow& row) {
  const auto error = [&](double part) { return formatted("%.3f", row.found.share(part)); };
  out << "| " << row.deformation << " | " << row.name << " | " << error(0.5) << " | " << error(0.99) << " | "
      << error(1.0) << " | " << row.found.strays << " | " << grouped(row.found.errors.size()) << " |\n";
}

void writeFailure(std::ostream& out, const FailureRow& row) {
  const FailureCase& c = row.failure;
  const auto figure = [](double v) { return v == kInfinity ? "∞" : formatted("%.3g", v); };
  out << "| " << cell(c.name) << " | " << cell(c.figure) << " | " << cell(c.naive.what) << " | "
      << figure(row.figures.naive) << " | " << cell(c.ours.what) << " | " << figure(row.figures.ours) << " | "
      << figure(c.ours.limit) << " | " << cell(c.reason);
  if (!c.isReal(row.figures) || !c.isHeld(row.figures)) out << ", **refuted**";
  out << " |\n";
}

}  // namespace

void writeReport(std::ostream& out, std::span<const Row> primitives, std::span<const Row> operators,
                 std::span<const OffsetRow> offsets, std::span<const MeshRow> meshes,
                 std::span<const FailureRow> failures) {
  out << kIntroduction << "\n## Solids and flat shapes\n\n";
  writeTable(out, "shape", primitives);
  out << "\n## Operators\n\n";
  writeTable(out, "operator", operators);
  out << kOffsets;
  for (const OffsetRow& row : offsets) writeOffset(out, row);
  writeMeshes(out, meshes);
  out << kFailures;
  for (const FailureRow& row : failures) writeFailure(out, row);
}

}  // namespace sdf::accuracy
