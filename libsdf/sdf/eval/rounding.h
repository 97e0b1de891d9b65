// How far the float readings of a tape may be off, and the tape that keeps a tolerance all the same.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/tape.h"

namespace sdf {

/// Bounds, by the promises of eval/promise.h, how far the batch reading of a tape at a point may be from the
/// double one. An instruction is off by its own rounding, and by what the errors of its arguments make of it:
/// the larger change of its value as one argument is moved to either end of its error, the others held. So a
/// step counts in full where an argument's error reaches across it. The changes by several arguments are
/// added up, which holds to first order (Higham, "Accuracy and Stability of Numerical Algorithms", 2002, 3.3:
/// running error analysis). What may be any number counts as 1e200.
class RoundingBounds {
 public:
  /// Cost: some times that of a reading in double.
  void run(const Tape& tape, const std::array<double, kVariableCount>& variables);

  double value(Operand a) const;
  /// How far off it may be.
  double error(Operand a) const;
  /// What the rounding of each instruction itself, and of its constants, adds to an operand's error: these
  /// shares make up all of it.
  std::vector<double> shares(Operand of) const;

 private:
  struct Step {
    double value, error;
    double own;                       // by its own rounding and its constants'
    std::array<double, 3> inherited;  // by its arguments' errors
  };
  const Tape* tape_ = nullptr;
  std::array<double, kVariableCount> variables_{};
  std::vector<Step> steps_;
};

/// How far the values that are read in a box may be off.
struct Accuracy {
  Box region;
  /// Scene units: how far the surface may seem to be from where it is, by output 0.
  double distance;
  /// Of the other outputs, which are colours and the like.
  double others = 0x1p-9;  ///< half a step of a byte
};

/// The tape with those instructions marked (Instruction::exact) whose rounding to float would break the
/// accuracy, so that the batch readings of any tape that keeps one of them are in double. It is the same tape
/// where none has to be. It is tried at 16 points that fill the region evenly; a distance counts where it is
/// within 4096 errors of 0, for cells are left out that are farther from the surface than a voxel, and are
/// some thousand voxels large at most. Cost: that of about 100 readings in double.
TapePtr withAccuracy(const TapePtr& tape, const Accuracy& accuracy);

/// The same of graphs, tried at 4 points: the nodes whose value would have to be computed in double.
/// Parameters are at their defaults.
std::vector<Expr> exactNodes(std::span<const Expr> outputs, const Accuracy& accuracy);

}  // namespace sdf
