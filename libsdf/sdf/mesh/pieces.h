// Parts of a union that lie apart, each of which is meshed alone, and copies once.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/base/result.h"
#include "sdf/expr/motion.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// Some of a union's operands, which no other one comes near to.
struct Piece {
  Shape shape;
  std::size_t like;      ///< the piece that it is a copy of, among all; its own number where it is the first
  RigidMotion motion{};  ///< takes that one's surface, with its paint, to this one's
};

/// The operands of a hard union in groups, by their first ones: the bounds of two groups are farther than
/// `apart` from each other along some axis. Operands without a solid are left out. One piece, the shape
/// itself, where it is no such union or an operand is unbounded. Copies are found as motionBetween finds
/// them. Cost: n log n of the operands where their bounds are spread out, and the size of their graphs.
std::vector<Piece> isolatedPieces(const Shape& shape, double apart);

/// Meshes one piece; an empty mesh where it has no surface. Is called by several threads.
using MeshPiece = std::function<Result<MeshedShape>(const Shape&, Progress&)>;

/// Meshes the first of each kind by `mesh`, several at a time, puts the copies at their places and joins
/// all: `shape` is their union, `values` are its inputs'. Copies have their model's distances, and what
/// rounding adds to them; how the whole hangs together and crosses itself is measured. An empty mesh where no
/// piece has a surface. Errors: the first piece's.
Result<MeshedShape> meshPieces(const Shape& shape, const std::vector<Piece>& pieces, const Values& values,
                               const MeshPiece& mesh, Progress& progress);

}  // namespace sdf
