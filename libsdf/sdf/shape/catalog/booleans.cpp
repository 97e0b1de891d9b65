#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/catalog/entries.h"

namespace sdf {

namespace {

CatalogEntry blending(const std::string& name, std::string doc, std::string claim,
                      Shape (*combine)(const std::vector<Shape>&, const Blend&)) {
  using namespace parameter;
  return entry(name, std::move(doc), std::move(claim),
               {shapes("shapes", "the operands, at least one"),
                optional(number(
                    "k",
                    "width of the blend in scene units: surfaces meet smoothly where their distances differ "
                    "by less than k; walls and gaps that are thin beside k vanish; absent: hard",
                    Rule::Positive)),
                choice("blend", "shape of the blend, where k is given",
                       {"quadratic", "cubic", "exponential", "chamfer"})},
               [name, combine](const std::vector<Shape>& operands, const std::optional<Expr>& k, int blend) {
                 constexpr Blend::Kind kKinds[] = {Blend::Kind::Quadratic, Blend::Kind::Cubic,
                                                   Blend::Kind::Exponential, Blend::Kind::Chamfer};
                 if (k) return combine(operands, {kKinds[blend], *k});
                 if (blend != 0) return Shape::failed(name + ": blend needs k, the width of the blend");
                 return combine(operands, Blend::hard());
               });
}

}  // namespace

std::vector<CatalogEntry> booleanEntries() {
  const std::string bound = "a bound if all operands are; L of the steepest";
  return {
      blending("union",
               "What is in any of the shapes. The nearer shape's material is seen, a later one's on a tie; a "
               "smooth union mixes materials.",
               "hard: exact outside if all operands are; else a bound if all are; L of the steepest operand",
               unite),
      blending("intersection", "What is in all of the shapes. The first shape's material is seen.", bound,
               intersect),
      blending("difference", "The first shape without the others. Its material is seen on the cuts, too.",
               bound, subtract),
      blending("xor", "What is in an odd number of the shapes: of two, in one but not in both.", bound,
               exclude),
  };
}

}  // namespace sdf
