// What is built on the distance of a deformed solid, held to the same thing built on its true distance.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "deformed_solids.h"

namespace sdf::accuracy {

/// An operator applied to a deformed solid.
struct OffsetCase {
  std::string name;  ///< of the operator: "round"
  std::string text;  ///< as a scene file says it
  Shape shape;
  double amount = 0.0;  ///< the offset, or the width of the blend, scene units
  /// What the operator makes of the solid's true distance d and of where it is. Monotonic in d where d keeps
  /// its sign.
  std::function<double(double d, const glm::dvec3& p)> truth;
  glm::dvec3 pulled{0.0};  ///< d is that at p - clamp(p, -pulled, pulled)
};

/// Every operator, by little and by much.
std::vector<OffsetCase> offsetCases(const DeformedSolid& solid);

/// What was found. Errors are those of the surface's place along the normal of a smooth face, in amounts.
struct OffsetFigures {
  std::vector<double> errors;  ///< in rising order
  std::string worst;           ///< where the last of them is
  int strays = 0;              ///< places whose side is wrong for any distance within `slack` of the true one
  std::string stray;           ///< the first of them
  double steepest = 0.0;       ///< largest difference quotient near the surface
  std::string steep;           ///< where

  /// All of both.
  void add(const OffsetFigures& more);
  double share(double part) const;  ///< the error that this part of them does not exceed
};

/// `slack`: by which share of itself the distance may differ from the true one where sides are compared.
OffsetFigures measured(const DeformedSolid& solid, const OffsetCase& c, double slack);

/// How far the distance may be from the true one where edges and the medial axis are near, as a share of it.
inline constexpr double kOffsetSlack = 0.35;

/// The samples of every DeformedSolid that is measured.
inline constexpr unsigned kOffsetSeed = 1;

/// What all parts found together under one deformation and one operator.
struct OffsetRow {
  std::string deformation, name;
  OffsetFigures found;
};
/// The rows of one deformation, in the order of the operators, over the first `parts` parts.
std::vector<OffsetRow> offsetRows(const Deformation& deformation, std::size_t parts);

}  // namespace sdf::accuracy
