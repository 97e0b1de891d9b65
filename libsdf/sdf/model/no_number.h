// Where a distance is no number, and what makes it none.
#pragma once
#include <optional>
#include <string>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// Places that are looked at: of a formula that is no number in a fiftieth of the box one in two hundred is
/// missed.
inline constexpr int kNoNumberPlaces = 256;

struct NoNumber {
  glm::dvec3 at;       ///< one of the places
  double share;        ///< of the places that were looked at
  std::string origin;  ///< of the innermost operation that is none there (originOf); "" where it is not known
};

/// Looks for places of a finite box where the expression, or an argument on which it depends there, is no
/// number: a minimum or maximum depends on both, a select on what it chooses. At these values of inputs.
/// Places are the same every time, and fewer in large graphs. Nothing where there is none among them. Cost:
/// some million readings of nodes at most; none where intervals show that every node is a number everywhere.
std::optional<NoNumber> findNoNumber(const Expr& e, const Box& box, const Values& values,
                                     int places = kNoNumberPlaces);

/// What is wrong, and what to do: "the formula at scene.lua:2 is no number at (1, 2, 3) …".
std::string textOf(const NoNumber& found, const std::string& place);

}  // namespace sdf
