// One cell of a mesh's certificate: its proof, and what it may not be divided further for.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/certify.h"
#include "sdf/mesh/certify_reading.h"

namespace sdf {

/// A part of space, with what can matter in it.
struct CertifyCell {
  Box box;
  TapePtr tape;                          ///< holds in its reach and all over its triangles
  std::vector<std::uint32_t> operands;   ///< of the model's union, those that the tape is of
  std::vector<std::uint32_t> triangles;  ///< those that may meet its reach
  bool free = false;                     ///< of the surface

  /// What a proof looks at around the cell, where bounds of `goal` are wanted.
  Box reach(double goal) const {
    constexpr double kSides = 1.2, kGoals = 2.1;
    return box.grown(kSides * box.longestSide() + kGoals * goal);
  }
};

/// What is proven of a cell; infinite where nothing is.
struct CellBounds {
  double toSurface = kInfinity;  ///< from the mesh in the cell
  double toMesh = kInfinity;     ///< from the surface in the cell
  double larger() const { return toSurface > toMesh ? toSurface : toMesh; }
};

/// The mesh as proofs see it.
struct CertifiedMesh {
  std::vector<glm::dvec3> positions;
  const std::vector<glm::uvec3>& triangles;
  std::vector<Interval> values;  ///< the field at the positions

  Box boxOf(std::uint32_t triangle) const;
};

/// Proves cells; one per thread.
class CellProver {
 public:
  CellProver(const CertifiedMesh& mesh, const CertifyOptions& options) : mesh_(mesh), options_(options) {}

  /// Forgets what was found of triangles, so that results do not depend on what this prover did before.
  void beginTask() { alone_.clear(); }
  /// By slopes, in a box that stands upright on the mesh and is high enough for a bound of `wanted`.
  CellBounds bySlope(const CertifyCell& cell, double wanted);
  /// By the cell's own size: a change of sign near by, the nearest triangle.
  CellBounds bySize(const CertifyCell& cell);
  /// Is the zero set proven to miss the box? `slope` bounds the tape's.
  bool isFree(const Tape& tape, const Box& box, double slope);

 private:
  struct Upright;
  bool standUp(const CertifyCell& cell, Upright& box) const;
  void gather(const CertifyCell& cell, Upright& box) const;
  bool covers(const Upright& box) const;
  double largestValue(const Tape& tape, const Upright& box, std::size_t i, const PatchBounds& field,
                      double enough);
  double largestAlone(const Tape& tape, std::uint32_t triangle, double enough);
  double largestInTriangle(const Tape& tape, const glm::uvec3& triangle, double enough);

  const CertifiedMesh& mesh_;
  const CertifyOptions& options_;
  struct Alone {
    double largest;  // a bound of |f| over a triangle, by itself
    double enough;   // what it was looked for until
  };
  std::unordered_map<std::uint32_t, Alone> alone_;
  PatchReading patches_;
  ScalarReading<Interval> intervals_;
};

}  // namespace sdf
