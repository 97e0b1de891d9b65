// Sampling a distance tape into an OpenVDB narrow band, and extracting its surface.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/progress.h"
#include "sdf/base/result.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/model/model.h"

namespace sdf {

/// Triangles and quads of an extracted surface, counter-clockwise from outside.
struct RawSurface {
  std::vector<glm::vec3> points;  ///< scene units
  std::vector<glm::uvec3> triangles;
};

/// A band of samples around the zero set of a tape's output 0, on the lattice of the multiples of the voxel
/// size.
class NarrowBand {
 public:
  NarrowBand();
  ~NarrowBand();
  NarrowBand(NarrowBand&&) noexcept;
  NarrowBand& operator=(NarrowBand&&) noexcept;

  double voxelSize() const;
  /// Distance samples taken, those of coarse cells included.
  std::uint64_t sampleCount() const;
  /// Samples next to which the surface may lie whose value is not a number, and the first of them.
  struct NotNumbers {
    std::uint64_t count = 0;
    glm::vec3 first{0.0f};
  };
  const NotNumbers& notNumbers() const;

  /// A sample next to which the surface may pass unseen between samples of one sign.
  struct Suspect {
    glm::vec3 at;           ///< the sample's place
    glm::vec3 along{0.0f};  ///< edge of the lattice that may be crossed twice; 0: any direction
    float share = 0.0f;     ///< of the edge, where the samples let one expect the surface
    float value = 0.0f;     ///< the sample
  };
  /// Samples that bound how close the surface comes, yet see no change of sign: those within half a cell's
  /// diagonal of it all of whose 26 neighbours have their sign, and the ends of lattice edges towards which
  /// the distance falls from both sides to less than the edge's length (the tips of edges seen nearby left
  /// out). What is thinner than a voxel, solid or gap, shows up here. Cost: some look-ups for each sample
  /// next to the surface.
  std::vector<Suspect> suspects() const;

  /// The zero set by dual marching cubes (Nielson 2004), leaf by leaf. Call once: the samples are released on
  /// the way.
  RawSurface extract();

  struct Grid;

 private:
  friend class BandField;
  friend class BandSampler;
  void settleZeros();
  std::unique_ptr<Grid> grid_;
};

/// A band's tapes, at one resolution: those of the leaf of 8³ voxels at or next to a point, which hold two
/// voxels around it, too; far from every leaf those of the whole model. The band must outlive it; its samples
/// may be gone.
class BandField : public LocalField {
 public:
  BandField(const NarrowBand& band, LocalTapes whole) : band_(band), whole_(std::move(whole)) {}
  std::unique_ptr<Finder> finder() const override;

 private:
  const NarrowBand& band_;
  LocalTapes whole_;
};

struct BandOptions {
  double voxelSize;
  Box bounds;        ///< finite; samples are taken in it
  double maxMemory;  ///< bytes
};

/// Works down from the bounds to leaves of 8³ voxels, four ways along each axis at each step. A cell whose
/// Lipschitz ball or interval excludes the surface is dropped; a surviving one gets the tape specialised to
/// it (Duff 1992; Keeter 2020), or linked from those operands of a union that can matter there. The work
/// grows with the surface, not with the volume. Runs in parallel; the result does not depend on the number of
/// threads. Errors: Limits (memory), Interrupted.
Result<NarrowBand> sampleNarrowBand(const ModelTapes& model, const BandOptions& options, Progress& progress);

}  // namespace sdf
