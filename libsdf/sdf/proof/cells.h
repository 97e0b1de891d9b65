// Proofs that there is no surface outside a mesh's shell.
#pragma once
#include <cstdint>
#include <vector>

#include "sdf/proof/prisms.h"
#include "sdf/proof/reading.h"
#include "sdf/proof/shell.h"

namespace sdf {

struct CellProof {
  std::uint64_t cells = 0;     ///< that were looked at
  std::uint64_t unproven = 0;  ///< that may hold surface outside the shell
  glm::dvec3 first{0.0};       ///< centre and side of the first of these
  double size = 0.0;
};

/// Divides a box into cells. In some there is no surface. In the others |f| is smaller than on the sides of
/// all prisms that may be there; so the sides do not pass them, and where cells touch, the shell's degree is
/// the same in all: it is looked at in one of them. Where they are outside the shell they are divided on.
class CellProver {
 public:
  CellProver(const Shell& shell, const ShellDegree& degree, const std::vector<PrismProof>& proofs,
             ProofReading& reading)
      : shell_(shell), degree_(degree), proofs_(proofs), reading_(reading) {}

  /// `triangles` are those whose prisms may meet the box; the tape holds in the box. `finest` is the voxel
  /// size that cells are divided down to some part of.
  CellProof prove(const Tape& tape, const Box& box, const std::vector<std::uint32_t>& triangles,
                  double finest);

 private:
  struct Cell {
    glm::ivec3 at;  // in cells of its depth
    int depth;
  };
  Box boxOf(const Cell& cell) const;
  void findSides(const std::vector<std::uint32_t>& triangles);
  double sidesAt(const Cell& cell) const;
  void look(const Tape& tape, const std::vector<Cell>& cells, std::vector<Cell>& inside,
            std::vector<Cell>& next);
  void divide(const Cell& cell, bool isHopeless, std::vector<Cell>& parts);
  void fail(const Cell& cell);
  // Those that the shell's degree is 0 in, and what touches them.
  std::vector<Cell> outsideOf(const std::vector<Cell>& inside) const;

  const Shell& shell_;
  const ShellDegree& degree_;
  const std::vector<PrismProof>& proofs_;
  ProofReading& reading_;
  Box box_;
  double finest_ = 0.0;
  std::vector<double> sides_;  // least |f| on the sides of the prisms in each part of the box
  CellProof proof_;
};

}  // namespace sdf
