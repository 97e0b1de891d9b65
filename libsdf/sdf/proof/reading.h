// Enclosures of a field over prisms that stand on triangles, and over boxes: what proofs are made of.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "sdf/base/box.h"
#include "sdf/eval/tape.h"
#include "sdf/number/interval.h"

namespace sdf {

/// The points m(l) + t o(l), where m and o are the means of the corners' positions and offsets by weights l,
/// |t| <= 1. For one l and all t they are a line of the prism.
struct Prism {
  std::array<glm::dvec3, 3> corners;
  std::array<glm::dvec3, 3> offsets;
};

/// What is known of a field over a prism. Where something may be no number, nothing is known.
struct PrismBounds {
  Interval values{-HUGE_VAL, HUGE_VAL};  ///< of f over the triangle, t = 0
  Interval all{-HUGE_VAL, HUGE_VAL};     ///< of f over the prism
  double least = -HUGE_VAL;              ///< f rises by this at least as t rises by 1, on each line
  double most = HUGE_VAL;                ///< and by this at most
};

/// Runs a tape's output 0 over eight prisms or boxes at once, or as many as the machine's vectors hold, all
/// numbers intervals of double that are rounded outward. Over a triangle each instruction's value is narrowed
/// by its values at the corners and its curvature (after Waldron 1998), so that a minimum's or a maximum's is
/// as tight as its branches'; over the prism by its slopes along the lines; over a box by those along the
/// axes (the mean value form, Moore 1966). Slopes enclose difference quotients, creases included. Where one
/// of two branches is proven to win it alone counts. Not thread-safe; keeps its memory.
class ProofReading {
 public:
  ProofReading();
  ~ProofReading();
  ProofReading(ProofReading&&) noexcept;

  /// Bounds for each prism. Corners and offsets may be off by a few ulps of their size.
  void prisms(const Tape& tape, std::span<const Prism> prisms, PrismBounds* out);
  /// The values of a field over each box; `nan` where they may be no number.
  void boxes(const Tape& tape, std::span<const Box> boxes, Interval* out);

  struct Memory;

 private:
  std::unique_ptr<Memory> memory_;
};

}  // namespace sdf
