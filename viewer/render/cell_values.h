// The lists of near operands as shaders read them.
#pragma once
#include <vector>

#include "viewer/render/frame.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// CellValues are what the texture sdfRows holds behind the rows in one frame after the other.
class CellValues {
 public:
  /// Takes where each kind's rows lie.
  CellValues(CellSorter sorter, std::vector<RowRange> kinds);

  /// Makes the lists where the scene's inputs have these values, unless they are those of the frame before.
  /// Returns whether it did.
  bool move(const Values& inputs);
  /// Adds what is behind the rows.
  void addTo(std::vector<glm::vec4>& rows) const;

 private:
  CellSorter sorter_;
  std::vector<RowRange> kinds_;
  OwnInputs inputs_;
  CellLists lists_;
};

}  // namespace sdf::viewer
