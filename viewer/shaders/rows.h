// Rows of numbers that shaders look up in one texture. Private to viewer/shaders.
#pragma once
#include <string>
#include <vector>

#include "sdf/eval/glsl.h"
#include "sdf/model/groups.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// A RowWriter lays rows out side by side, and writes how shaders take one of them.
class RowWriter {
 public:
  explicit RowWriter(bool es) : es_(es) {}
  /// Adds rows, whose place is their number among all.
  void add(const NumberRows& rows);
  /// Returns how many texels they take.
  std::size_t texels() const { return numbers_.size() / 4; }
  /// Returns whether every driver has room for all.
  bool fits() const;

  /// Writes the variables of the rows at the first so many places, and for each `void sdfTake<place>(int
  /// at)`, which sets its variables from the row whose texels begin there. A writer then reads them in the
  /// parameters' places.
  std::string taking(std::size_t places, GlslWriter& writer) const;
  /// Writes the variables of one row at this place, and `void sdfTake()`, which sets them from the uniform
  /// sdfRow: faster than the texture where all pixels take the same.
  std::string takingOne(std::size_t place, GlslWriter& writer) const;
  /// Returns where the rows of a place are.
  const RowRange& rangeOf(std::size_t place) const { return tables_[place].range; }
  /// Writes `void sdfTake<name>(int at)`, which sets the first `count` of one place's variables from the
  /// texels from `at` on.
  std::string takingFirst(std::size_t place, std::size_t count, const std::string& name) const;

  /// Returns what the texture holds first, four numbers a texel. In GLSL ES texel i lies in column
  /// i % kRowTexels of row i / kRowTexels.
  Function numbers() const { return Function(numbers_); }

 private:
  std::string variables(std::size_t place, GlslWriter& writer) const;
  struct Table {
    RowRange range;
    std::vector<Expr> parameters;
  };
  bool es_;  // GLSL ES has no samplerBuffer
  std::vector<Table> tables_;
  std::vector<Expr> numbers_;
};

}  // namespace sdf::viewer
