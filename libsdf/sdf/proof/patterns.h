// Parts of a tape whose value is known better as a whole than by its operations.
#pragma once
#include <array>
#include <vector>

#include "sdf/eval/tape.h"

namespace sdf {

/// What an instruction is the last operation of.
struct Pattern {
  enum Kind {
    None,
    /// |max(p, 0)| + min(max p, 0), exact boxes and cylinders. Where a tape is specialised the length may
    /// lack some p, which are below 0 then, and so may the largest, of which others are larger then.
    BoxDistance,
    Corner,  ///< that of max(x, y) and a min(x, y) - b max(x, y) besides, a² - b² = 1 (shape/formula.h)
    Blend,   ///< min(x, y) - c h² or max(x, y) + c h², h = max(k - |x - y|, 0), 4 c k = 1 (shape/blend.h)
  } kind = None;
  std::array<Operand, 3> parts{};   ///< the p in the length; x and y of a blend
  int count = 0;                    ///< of parts
  std::array<bool, 3> isInside{};   ///< is the part one of those that `most` is the largest of?
  std::array<Operand, 3> others{};  ///< what `most` is the largest of besides
  int otherCount = 0;
  Operand outside{}, inside{}, most{};  ///< of a box: |max(p, 0)|, min(max p, 0), max p
  std::array<Operand, 2> sides{};       ///< x and y of a corner
  double k = 0.0;                       ///< of a blend; b / a of a corner
  bool isMin = false;
};

/// The pattern of each instruction.
void findPatterns(const Tape& tape, std::vector<Pattern>& out);

}  // namespace sdf
