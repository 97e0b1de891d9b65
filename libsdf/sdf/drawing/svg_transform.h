// Transforms of SVG drawings. Private to drawing/.
#pragma once
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace sdf {

/// p -> turn p + shift.
struct Affine {
  glm::dmat2 turn{1.0};
  glm::dvec2 shift{0.0};
  glm::dvec2 operator()(const glm::dvec2& p) const { return turn * p + shift; }
  /// First the other one.
  Affine operator*(const Affine& other) const { return {turn * other.turn, (*this)(other.shift)}; }
};

/// Numbers that commas or space part; nothing where something else is among them.
std::optional<std::vector<double>> numbersIn(std::string_view text);

/// "translate(1 2) rotate(30)": the product of matrix, translate, scale, rotate, skewX and skewY. Nothing
/// where it is something else.
std::optional<Affine> transformOf(std::string_view text);

}  // namespace sdf
