// How far an offset surface is from the surface that it is an offset of, measured.
#pragma once
#include <optional>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"

namespace sdf {

/// An offset to be looked at. Both distances are negative inside.
struct OffsetToCheck {
  Expr of;            ///< the distance whose zeros are the surface
  Expr offset;        ///< the one whose zeros should be `amount` away from it
  Expr amount;        ///< scene units, positive; uniform
  Box bounds;         ///< of the surface
  bool out = true;    ///< does it have zeros outside of the surface?
  bool in = false;    ///< inside of it?
  bool edges = true;  ///< does it matter how far it is from edges?
};

/// The least and the greatest distance that was found, and how far it should be; scene units.
struct OffsetFigures {
  double least, most, wanted;
  /// Is any of the distances off by more than a tenth of what they should be?
  bool wrong() const { return least < 0.9 * wanted || most > 1.1 * wanted; }
};

/// The distances to the surface from points of the offset, at these values of inputs. Neither depends on what
/// the distances say but at their zeros. Points of the surface are found on seeded lines through the bounds,
/// edges by halving between two that face elsewhere; those of the offset along normals from there, and away
/// from edges between the faces' normals. The nearest point of the surface is sought from the nearest ones
/// that are known, by steps along the surface; so a distance may be found too large, by some hundredths.
/// Nothing where no point was found. Cost: some ten thousand readings.
std::optional<OffsetFigures> checkOffset(const OffsetToCheck& offset, const Values& values = {});

}  // namespace sdf
