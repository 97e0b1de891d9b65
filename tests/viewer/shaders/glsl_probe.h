// Expressions read by a shader at any points.
#pragma once
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::test {

struct Place {
  glm::vec3 p, n;
};

/// Values of the expressions at the places, in the current context: one row of as many floats as there are
/// outputs, up to 4 or from 17 to 20, for each place. Throws std::runtime_error where the driver refuses.
std::vector<std::vector<float>> readByShader(std::span<const Expr> outputs, std::span<const Place> places,
                                             const std::map<std::string, double>& parameters = {});

}  // namespace sdf::test
