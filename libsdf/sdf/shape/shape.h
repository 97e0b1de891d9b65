// Shape: a signed distance with its surface, its bounds, and a claim of what the distance is worth.
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/result.h"
#include "sdf/base/shared_list.h"
#include "sdf/expr/expr.h"
#include "sdf/expr/vec.h"
#include "sdf/shape/blend.h"

namespace sdf {

/// How much |f| says, from most to least.
enum class ClaimKind {
  Exact,         ///< |f| is the distance to the surface everywhere
  ExactOutside,  ///< exact where f > 0; inside |f| never exceeds the distance
  Bound,         ///< |f| never exceeds the distance
  Field          ///< only the zero set and the sign are right
};

/// A part of a distance that offsets take as it is, up to a sum and a factor: the distance around edges that
/// an offset made, or a formula that could not be calibrated, each for offsets as far out and in as this.
struct UncalibratedPart {
  Expr part;
  double out, in;
};

/// Proven facts about a shape's distance. Every operator derives its result's claim from its operands'.
struct Claim {
  ClaimKind kind = ClaimKind::Exact;
  double lipschitz = 1.0;  ///< |f(p) - f(q)| <= lipschitz |p - q| for all p and q; infinite where unknown
  /// Proven m: where f <= c for some c >= 0, the point lies in the shape's bounds grown by m c. It says how
  /// far a solid can swell when its distance is lowered (round, smooth union). Infinite where unknown; read
  /// it through growthOf.
  double growth = kInfinity;
  /// Has the distance been divided by its slope already, so that offsets take it as it is?
  bool calibrated = false;
  /// What offsets have tried already, so that n offsets of one another do not try n parts each.
  std::vector<UncalibratedPart> uncalibrated{};
};

/// The claim's growth; exact and exact outside have 1, whatever the field says.
inline double growthOf(const Claim& c) { return c.kind <= ClaimKind::ExactOutside ? 1.0 : c.growth; }

/// The weaker kind, for results that hold what both operands hold.
inline ClaimKind weaker(ClaimKind a, ClaimKind b) { return a > b ? a : b; }

/// Surface attributes: scalars that may depend on position, normal and parameters. Colours are linear RGB.
// clang-format off
enum class Attribute : std::uint8_t {
  Red, Green, Blue,                         // diffuse colour
  AmbientRed, AmbientGreen, AmbientBlue,    // answers the scene's ambient light
  SpecularRed, SpecularGreen, SpecularBlue, // colour of the highlight
  Shininess,                                // Phong exponent
  // Mirror weight: reflectivity * (bias + (1 - cos)^power), at most 1. The share that is the same from all angles
  // is multiplied by specular / its greatest part.
  Reflectivity, FresnelPower, FresnelBias,
  EmissionRed, EmissionGreen, EmissionBlue, // light of its own
  MaterialId,                               // place in Shape::materials of the one that dominates here
  Count
};
// clang-format on
inline constexpr int kAttributeCount = static_cast<int>(Attribute::Count);
using Attributes = std::array<Expr, kAttributeCount>;

/// How a surface looks (Phong 1975). Each field may be an expression of position() and normal().
struct Material {
  std::string name{};  ///< "" becomes "material N" in a mesh, after its place in the shape's list
  Vec3E color{Expr(0.8)};
  std::optional<Vec3E> ambient{};  ///< default: color
  Vec3E specular{Expr(0.0)};
  Expr shininess = 32.0;
  Expr reflectivity = 0.0;
  Expr fresnelPower = 0.0;
  Expr fresnelBias = 0.0;
  Vec3E emission{Expr(0.0)};
};
using MaterialPtr = std::shared_ptr<const Material>;

/// Makes a material to paint with: the triangles of one, and of no other that looks the same, form one
/// primitive of an exported mesh.
MaterialPtr makeMaterial(Material material);
/// The grey that shapes have until they are painted.
const MaterialPtr& defaultMaterial();
/// The material's fields as attribute expressions of a shape that is all in it.
Attributes attributesOf(const Material& material);

struct Union;
struct Copies;

/// A shape is a value: operators return new shapes and share the graph. A shape made from bad arguments
/// carries the first error on through every operator; whoever uses it (Scene, the mesher, the scene language)
/// reports it.
struct Shape {
  Expr distance;  ///< negative inside, scene units
  Attributes surface = attributesOf(*defaultMaterial());
  std::vector<MaterialPtr> materials{defaultMaterial()};  ///< all that can appear, each once, the first first
  Box bounds = Box::everything();  ///< contains the solid (f <= 0); infinite where it is unbounded or unknown
  Claim claim;
  /// The operands where the shape is a union, else nothing. Moving, turning, scaling and painting a union
  /// keeps the list; whatever else is done to it makes one shape of it.
  std::shared_ptr<const Union> outer;
  /// What is repeated where the shape is copies of one, or what inputs move, else nothing. Kept by what keeps
  /// a union's list.
  std::shared_ptr<const Copies> copies;
  /// Where a scene file gives the steepest formula in it whose slope is above 1 or not known, "scene.lua:3";
  /// else "".
  std::string formulaAt;
  bool takesLipschitz = false;  ///< is that formula a field's, whose lipschitz may be stated?
  /// What in a scene file last weakened the claim, "field in line 3"; else "".
  std::string inexactSince;
  int dimension = 3;  ///< 2: a flat shape in x and y (its distance ignores z), to be extruded or revolved
  std::optional<std::string> error;

  bool ok() const { return !error; }
  static Shape failed(std::string message);

  /// This shape all in one material.
  Shape paint(const MaterialPtr& material) const;
  Shape paint(Material material) const { return paint(makeMaterial(std::move(material))); }
};

/// A union as the list of what was united: the least of their distances is the shape's, blended from left to
/// right. Hard unions within hard unions are one list. Materials are numbered as in the whole.
struct Union {
  /// Operands count as much as they take.
  struct Tally {
    explicit Tally(std::size_t operands);
    CountedAsNodes counted;
  };
  using Operands = SharedList<Shape, Tally>;

  Blend blend;
  Operands operands;  ///< at least two; a union of this one and others shares them
};

/// Many copies of a shape, as a point sees them.
struct Copies {
  Shape one;
  std::vector<Vec3E> places;   ///< of the point as the copies near it see it: a ball around it is seen within
                               ///< a ball that is no larger
  std::optional<Expr> others;  ///< how far all other copies are at least, scene units; they matter nowhere if
                               ///< there is none
};

/// Proven bound of the distance's slope over all of space; infinite where none is known.
inline double slopeOf(const Shape& s) { return std::min(s.claim.lipschitz, s.distance.lipschitz()); }

}  // namespace sdf
