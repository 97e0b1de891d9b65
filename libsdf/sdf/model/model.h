// Model: a shape made ready for its readings.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"
#include "sdf/eval/union_tapes.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// The outputs of the tapes that meshing runs on: the distance, then what colouring needs of the attributes.
enum class SurfaceOutput { Distance, Red, Green, Blue, MaterialId, Count };

/// A model's tapes at some values of its inputs, whole or for regions. Immutable.
class ModelTapes {
 public:
  /// All of the model. Outputs are those of SurfaceOutput.
  const TapePtr& whole() const { return whole_; }
  /// The places of all operands.
  const std::vector<std::uint32_t>& all() const { return all_; }
  /// Bound of the distance's slope over all of space; infinite where none is known.
  double slope() const { return slope_; }

  /// Which of the operands `among` can have a part in distances of at most `most` (>= 0) at points of the
  /// box: where the model's distance is no larger, it is that of these operands alone. An operand is passed
  /// over where the box is so far from its bounds that its distance is proven to be larger; in a blend by as
  /// many widths more as there may be operands in between. Cost: linear in the length of `among`.
  std::vector<std::uint32_t> near(const Box& box, double most, std::span<const std::uint32_t> among) const;
  /// The tape of these operands, as UnionTapes::link.
  TapePtr link(std::span<const std::uint32_t> operands) const;

 private:
  friend class Model;
  struct Reach {
    Box bounds;
    double growth;
  };
  ModelTapes() = default;

  std::optional<UnionTapes> tapes_;  // of a union
  std::vector<Reach> reaches_;       // of its operands
  double sink_ = 0.0;                // how far the blend may lie below the least distance
  double width_ = 0.0;  // by how much larger a distance has no part in the blend with a lesser one
  double slope_ = 0.0;
  TapePtr whole_;
  std::vector<std::uint32_t> all_;
};

/// What stands between a shape and its readings: its functions, compiled once, by the operands of its outer
/// union. Immutable and cheap to copy.
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
  /// range. Cost: linear in the number of constants.
  ModelTapes at(const Values& values = {}) const;

 private:
  struct Compiled {
    Shape shape;
    std::vector<Function> functions;  // by operand
    std::optional<Function> blend;    // of a blended union: unionJoin, and its width
  };
  std::shared_ptr<const Compiled> compiled_;
};

/// Bound of the slope of the shape's distance in a box: the one that holds everywhere, or else the one that
/// the formula has there by interval arithmetic; infinite where neither is known.
double slopeIn(const Shape& shape, const Box& box);

/// A distance that rays can be marched through: divided by its slope it never exceeds the way to the surface.
struct Marchable {
  Expr distance;
  double slope;  ///< over all of space, positive; infinite where it is not known
};

/// The shape's distance, if its slope is known everywhere. Else that of a hard union is the least of its
/// operands', each made marchable by itself; that of any other shape, if its slope is known near its finite
/// bounds, the distance there and the way to the bounds, times the slope, beyond.
Marchable marchable(const Shape& shape);

}  // namespace sdf
