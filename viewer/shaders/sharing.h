// The distance of a union whose operands share formulas: read by loops over rows of numbers. Private to
// viewer/shaders.
#pragma once
#include <string>
#include <vector>

#include "viewer/shaders/assemble.h"
#include "viewer/shaders/rows.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {

/// Returns whether what is read has a step that is not its distance.
template <typename Read>
bool hasOwnStep(const Read& m) {
  return m.step != m.distance;
}

/// Three outputs, which make a vec3: the step and the distance.
std::vector<Expr> partsOf(const Marched& m);

/// Returns how many operations the distance's gradient has.
std::size_t gradientSize(const Expr& distance);

Marched marchedOf(const OperandKind& kind, const Box& bounds = Box::everything());

/// The least of the operands, of which there is at least one.
Marched leastOf(const std::vector<NumberedOperand>& operands, Steps steps);

std::vector<NumberedOperand> operandsOf(const std::vector<HalfSpace>& planes);

/// Returns the parts that define the distance and the nearest operand of all, with its gradient if they are
/// few, by loops over the groups of the plan's kinds, whose rows are the first ones and can be taken.
std::string sharing(const Plan& plan, const RowWriter& rows, GlslWriter& writer);

/// Returns whether the gradients of all kinds are so short that sharing() defines sdfNearest(p), the gradient
/// and the number of the operand that is nearest to p.
bool sharesGradients(const Plan& plan);

/// Returns the functions of the scene that these parts use.
Functions sharedFunctions(const Plan& plan);

}  // namespace sdf::viewer
