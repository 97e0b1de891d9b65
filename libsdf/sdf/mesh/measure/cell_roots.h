// Points of a surface in a cell of space.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/batch.h"

namespace sdf {

/// Looks for the surface in cells, one after the other.
class CellRoots {
 public:
  /// Of a distance that is nowhere steeper than that, infinite where it is not known, and of a shape as large
  /// as that.
  CellRoots(double slope, double size) : slope_(static_cast<float>(slope)), size_(static_cast<float>(size)) {}

  /// Looks along the lines through the cell's centre: along the axes and, where there is no surface on these,
  /// to the corners. `isolates`: where the slope lets the sign change twice between two readings, that piece
  /// of a line is halved. Films that are thinner than positions are exact, as between solids that touch, are
  /// no surface.
  void find(const Tape& tape, const Box& cell, bool isolates);
  /// Those of the last cell.
  const std::vector<glm::vec3>& points() const { return points_; }
  /// Was nothing found in the last cell, while the slope lets a surface pass it?
  bool isOpen() const { return points_.empty() && mayHold_; }

 private:
  struct Reading {
    glm::vec3 at;
    float value;
  };
  struct Piece {
    Reading from, to;
  };
  // Points to both sides of the surface, and the way from one to the other as it was found.
  struct Bracket {
    glm::vec3 inside, outside, way;
  };

  void read(const Tape& tape, std::vector<Reading>& readings);
  void addLine(const glm::vec3& centre, const glm::vec3& half);
  void follow(const Tape& tape);
  void take(const Piece& piece);
  glm::vec3 middleOf(const Piece& piece) const;
  void isolate(const Tape& tape);
  void bisect(const Tape& tape);
  void takePoints(const Tape& tape);

  float slope_;
  float size_;
  bool isolates_ = false;
  bool mayHold_ = false;
  BatchEvaluator batch_;
  std::vector<Reading> along_;  // lines, each of as many
  std::vector<Piece> pieces_;   // as the two ends tell, the sign may change twice between them
  std::vector<Piece> halved_;   // those of before
  std::vector<Bracket> brackets_;
  std::vector<glm::vec3> points_;
};

}  // namespace sdf
