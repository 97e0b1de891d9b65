// Which of a union's groups can be the nearest where: cells of space with lists, for readings of unions of
// many operands.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/eval/function.h"
#include "sdf/model/groups.h"

namespace sdf {

/// A CellGrid divides space into cubes: those of level 0 fill a box around all bounds, those of level 1,
/// twice as large, the space around it as far as `reach`. What lies beyond is one cell more, the last.
struct CellGrid {
  static constexpr int kLevels = 2;
  struct Level {
    glm::dvec3 half;  ///< of all that it and those before fill
    double size;      ///< the side of its cubes
    glm::ivec3 side;  ///< cubes along each axis
    int first;        ///< the number of its first cell
  };
  glm::dvec3 middle{0.0};
  double reach = 1.0;
  double margin = 0.0;  ///< how far the box goes beyond the bounds
  std::array<Level, kLevels> levels{};

  int cells() const { return levels.back().first + count(levels.back().side) + 1; }
  static int count(const glm::ivec3& side) { return side.x * side.y * side.z; }
  /// Returns the number of a level's cell, counted along each axis.
  int cell(int level, const glm::ivec3& c) const;
  /// Returns the number of the cell that the point lies in.
  int cellAt(const glm::dvec3& p) const;
  /// Returns what a level's cell covers.
  Box boxOf(int level, const glm::ivec3& c) const;
};

/// CellLists name for each cell of a grid, kind by kind, the groups that may be the nearest somewhere in it,
/// or leave the least step.
struct CellLists {
  struct List {
    int begin, count;  ///< among the entries of its kind
  };
  /// By cell, and then by kind; like lists are one. Those of one cell more, behind the grid's, are empty.
  std::vector<List> lists;
  std::vector<std::vector<int>> entries;  ///< by kind: groups, in each list ascending
};

/// A CellSorter makes the lists for some kinds of operands, at any values of the scene's parameters.
class CellSorter {
 public:
  /// So many operands may be worth lists: the formula of fewer is read faster, and lists of more grow too
  /// long.
  static constexpr std::size_t kFewest = 24, kMost = 24'000;
  /// Returns whether lists are worth their making: there are dozens of groups, each a single operand with
  /// finite bounds and quick to read. Those that are given by data are not.
  static bool worthwhile(const std::vector<OperandKind>& kinds);

  /// Kinds for which it is worthwhile. The grid follows from their bounds.
  explicit CellSorter(const std::vector<OperandKind>& kinds);

  const CellGrid& grid() const { return grid_; }
  std::size_t kinds() const { return kinds_.size(); }
  /// The names of the scene's parameters that the lists depend on, some more than once.
  std::vector<std::string> inputs() const;
  /// Returns the lists where the scene's parameters have these values: what they leave out is in its cell
  /// neither the nearest nor leaves the least step, for slopes bound both from their values at the cell's
  /// middle. Cost: a reading of some operands for each cell.
  CellLists lists(const Values& values) const;

 private:
  struct Kind {
    Function read;  // the distance, and the step
    std::vector<std::string> names;
    int groups;
    double slope;
  };
  std::vector<Kind> kinds_;
  Function numbers_;  // of all groups of all kinds
  CellGrid grid_;
};

}  // namespace sdf
