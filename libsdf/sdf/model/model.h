// Model: a shape made ready for its readings.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"
#include "sdf/eval/rounding.h"
#include "sdf/eval/union_tapes.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// The outputs of the tapes that meshing runs on.
enum class SurfaceOutput {
  Distance,      ///< scene units, negative inside
  Red,           ///< of the diffuse colour, linear
  Green,         ///< of the diffuse colour
  Blue,          ///< of the diffuse colour
  AmbientRed,    ///< of the answer to the ambient light, linear
  AmbientGreen,  ///< of the answer to the ambient light
  AmbientBlue,   ///< of the answer to the ambient light
  MaterialId,    ///< the material's place in Shape::materials
  Count
};

/// A model's tapes at some values of its inputs, whole or for regions. Immutable.
class ModelTapes {
 public:
  /// All of the model. Outputs are those of SurfaceOutput.
  const TapePtr& whole() const { return whole_; }
  /// The places of all operands.
  const std::vector<std::uint32_t>& all() const { return all_; }
  /// Bound of the distance's slope over all of space; infinite where none is known.
  double slope() const { return slope_; }

  /// What an operand of a union is claimed to lie in; everything where the inputs lie out of their ranges, or
  /// there is no union.
  Box boundsOf(std::uint32_t operand) const { return tapes_ ? bounds_[operand].bounds : Box::everything(); }

  /// The operands among these that can matter at points of the box where the model's distance is at most
  /// `most` (>= 0): there the distance is that of these operands alone. An operand is left out if the box is
  /// so far from its bounds that its distance is proven to be larger. In a blend it must be larger by as many
  /// widths as there may be operands in between. Cost: linear in the length of `among`.
  std::vector<std::uint32_t> relevantOperands(const Box& box, double most,
                                              std::span<const std::uint32_t> among) const;
  /// The tape of these operands, as UnionTapes::link.
  TapePtr link(std::span<const std::uint32_t> operands) const;

 private:
  friend class Model;
  struct OperandBounds {
    Box bounds;
    double growth;
  };
  ModelTapes() = default;

  std::optional<UnionTapes> tapes_;    // of a union
  std::vector<OperandBounds> bounds_;  // of its operands
  double blendDepth_ = 0.0;            // the blend lies below the least distance by this at most
  double blendWidth_ = 0.0;            // a distance larger than another by this does not change their blend
  double slope_ = 0.0;
  TapePtr whole_;
  std::vector<std::uint32_t> all_;
};

/// A shape's functions, compiled once for all readings, by the operands of its outer union. Immutable and
/// cheap to copy.
class Model {
 public:
  /// Compiles the shape. Precondition: shape.ok(). Cost: linear in the size of its graph.
  explicit Model(Shape shape);

  const Shape& shape() const { return compiled_->shape; }
  /// The operands of the shape's outer union in their order; the shape alone where it is none.
  std::span<const Shape> operands() const;
  /// Their functions, with the outputs of SurfaceOutput.
  const std::vector<Function>& functions() const { return compiled_->functions; }

  /// The tapes where inputs have these values; no bounds and slopes are known where one lies out of its
  /// range. Where an accuracy is given, operands that floats cannot read that accurately are read in double:
  /// each is looked at where it lies. Cost: linear in the number of constants, and with an accuracy in that
  /// of operations.
  ModelTapes at(const Values& values = {}, const std::optional<Accuracy>& accuracy = {}) const;

 private:
  struct Compiled {
    Shape shape;
    std::vector<Function> functions;  // by operand
    std::optional<Function> blend;    // of a blended union: unionJoin, and its width
  };
  std::shared_ptr<const Compiled> compiled_;
};

/// A shape's distance for two ends. Light reads the distance itself; rays go by the step. The two are one
/// node where the distance's slope is 1.
struct Marchable {
  Expr distance;  ///< how far it is; does not depend on how tight the slope's bound is
  /// How far one may go: the ball of this radius around a point is free of the surface. It has the distance's
  /// sign and zero set. Where the slope is not known it is the distance itself.
  Expr step;
  double slope;       ///< of the distance, over all of space, positive; infinite where it is not known
  double gain = 1.0;  ///< by how much farther regions lead at the surface than the slope; 1 where it is that
};

/// A distance whose slope is known, and what contains its solid.
struct Steep {
  Expr distance;
  double slope;
  Box bounds = Box::everything();
  std::shared_ptr<const Copies> copies{};  ///< what it is copies of, if its steps go by theirs
};

/// A shape's distance, where it is copies of one and steeper than 1 with these.
Steep steepOf(const Shape& shape);

/// What steps go by.
enum class Steps {
  BySlope,   ///< one bound of the slope: they change by no more than one moves
  ByRegion,  ///< bounds by region where these lead farther (model/region_steps.h): they jump
  /// ByRegion also of what hangs on inputs whose values are known, the clock apart, whether these lead
  /// farther or not: so steps for other values differ in numbers alone.
  ByRegionOfSliders,
  ByRegionNow  ///< and of what hangs on a clock whose time is known
};

/// The least of these, at least one, each divided by its own slope. Distances of one slope are joined first,
/// so that they are divided once. Cost: linear in their number but for sorting their slopes, and for the
/// regions of at most three distances, the steepest.
Marchable leastOf(std::span<const Steep> all, Steps steps = Steps::BySlope);

/// Would steps of this kind have to know more inputs? Not where these only move the shape, or where its slope
/// is 1.
bool waitsForInputs(const Shape& shape, Steps steps);

/// The distance and the step by which the shape is marched. The step of one shape is its distance divided by
/// its slope; where the slope is above 1, it is at least the way to its bounds. The step of a hard union is
/// the least of its operands', so that no operand is slowed down by another's slope. Cost: linear in the
/// number of operands, and that of leastOf.
Marchable marchable(const Shape& shape, Steps steps = Steps::BySlope);

}  // namespace sdf
