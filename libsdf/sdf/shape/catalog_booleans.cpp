#include "sdf/shape/booleans.h"
#include "sdf/shape/entries.h"

namespace sdf {

namespace {

constexpr int kShapes = 0, kWidth = 1, kBlend = 2;

CatalogEntry entry(std::string name, std::string doc, std::string claim,
                   Shape (*combine)(const std::vector<Shape>&, const Blend&)) {
  using namespace parameter;
  CatalogEntry e{name, Group::Boolean, std::move(doc), std::move(claim), {}, {}};
  e.parameters = {
      shapes("shapes", "the operands, at least one"),
      optional(
          number("k",
                 "width of the blend in scene units: surfaces meet smoothly where their "
                 "distances differ by less than k; walls and gaps that are thin beside k vanish; absent: "
                 "hard",
                 Rule::Positive)),
      choice("blend", "shape of the blend, where k is given",
             {"quadratic", "cubic", "exponential", "chamfer"})};
  e.build = [name, combine](const Arguments& a) {
    constexpr Blend::Kind kKinds[] = {Blend::Kind::Quadratic, Blend::Kind::Cubic, Blend::Kind::Exponential,
                                      Blend::Kind::Chamfer};
    const Blend::Kind kind = kKinds[a.integer(kBlend)];
    if (a.given(kWidth)) return combine(a.shapes(kShapes), {kind, a.number(kWidth)});
    if (kind != Blend::Kind::Quadratic)
      return Shape::failed(name + ": blend needs k, the width of the blend");
    return combine(a.shapes(kShapes), Blend::hard());
  };
  return e;
}

}  // namespace

std::vector<CatalogEntry> booleanEntries() {
  return {
      entry("union",
            "What is in any of the shapes. The nearer shape's material is seen, a later one's on a tie; a "
            "smooth union "
            "mixes materials.",
            "hard: exact outside if all operands are, else bound; smooth: bound; L of the steepest operand",
            unite),
      entry("intersection", "What is in all of the shapes. The first shape's material is seen.",
            "bound, L of the steepest operand", intersect),
      entry("difference", "The first shape without the others. Its material is seen on the cuts, too.",
            "bound, L of the steepest operand", subtract),
      entry("xor", "What is in an odd number of the shapes: of two, in one but not in both.",
            "bound, L of the steepest operand", exclude),
  };
}

}  // namespace sdf
