// From the largest voxels to smaller ones, to those whose mesh can be simplified to a tolerance.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/last_measured.h"
#include "sdf/mesh/measure/witnesses.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// A shape's samples at one resolution, and the mesh that is made of them.
struct Lattice {
  Lattice(NarrowBand samples, LocalTapes whole) : band(std::move(samples)), field(band, std::move(whole)) {}
  NarrowBand band;
  BandField field;
  FeatureMesh mesh;
  std::vector<glm::vec3> borders;  ///< points of the borders of its paint
  bool isResolved = true;          ///< is nothing known that is thinner than its voxels?
};

/// Is it closed, and has it triangles?
bool isClosed(const FeatureMesh& mesh);

/// Makes lattices of one shape.
class LatticeSource {
 public:
  /// One with these voxels (scene units), without a mesh yet; null where there is none.
  virtual std::unique_ptr<Lattice> lattice(double voxel) = 0;
  /// Its mesh, whose vertices lie on the surface. False: it has none that is closed.
  virtual bool makeMesh(Lattice& lattice) = 0;

 protected:
  ~LatticeSource() = default;
};

/// The coarsest voxels that are tried, times those that were asked for. Measured on the samples: with larger
/// ones simplifying fails or leaves more triangles than with half of them.
inline constexpr double kCoarsest = 16.0;

struct LadderOptions {
  double tolerance;  ///< distance between mesh and surface, both ways, scene units; positive
  double size;       ///< the longest side of the shape's bounds, scene units
  bool strict;       ///< is it to be kept everywhere? Otherwise it is a goal.
  bool painted;      ///< does what is seen on the surface change from place to place?
};

/// Replaces a lattice's mesh by one with few triangles, simplified (simplify.h) from the largest voxels that
/// do. What the lattice sees none may miss: the vertices of its mesh are points of the surface, which are to
/// be met within the tolerance, and where paint has borders larger voxels are to have them that near, too.
class Ladder {
 public:
  enum class End {
    Simplified,  ///< the mesh is replaced
    NeedsFiner,  ///< none keeps the tolerance, and finer voxels are to be tried
    Failed       ///< these voxels are too coarse for the shape
  };

  /// `surface` are points of the surface, to which those come that are found.
  Ladder(const LadderOptions& options, LatticeSource& source, std::vector<glm::vec3>& surface,
         LastMeasured& measured, Progress& progress)
      : options_(options), source_(source), surface_(surface), measured_(measured), progress_(progress) {}

  /// Once for each size of voxels, the largest first. `fromCoarse`: are larger voxels tried, too, where the
  /// lattice sees all? `mayRefine`: may finer ones be? The lattice has a mesh. The one that is left may be
  /// another one, by whose field normals are to be read.
  End climb(std::unique_ptr<Lattice>& fine, bool fromCoarse, bool mayRefine);

  /// How far the mesh that is left is from points of the surface that the lattice had.
  const SurfaceDistance& witnessed() const { return witnessed_; }

 private:
  bool simplifyCoarse(double share, std::unique_ptr<Lattice>& fine);
  End simplifyFinest(Lattice& fine, bool mayRefine);
  bool simplifyWithin(double share, FeatureMesh& mesh, const Lattice& lattice, const BandField& fine);
  bool simplifyTo(double tolerance, FeatureMesh& mesh, const Lattice& lattice, const BandField& fine,
                  bool painted);
  template <class Simplify>
  bool withColors(FeatureMesh& mesh, const BandField& fine, const Simplify& simplify);
  bool blursColors(const Lattice& fine);
  double offBy(const Lattice& lattice);
  std::vector<glm::vec3> placesBeyondTolerance(const FeatureMesh& mesh, const BandField& field);
  std::vector<glm::vec3> witness(const FeatureMesh& mesh, const BandField& field);

  const LadderOptions options_;
  LatticeSource& source_;
  std::vector<glm::vec3>& surface_;
  LastMeasured& measured_;
  Progress& progress_;
  std::optional<Witnesses> witnesses_;
  SurfaceDistance witnessed_;
  double coarsest_ = 1.0;   // voxels, times the lattice's
  bool isBlurred_ = false;  // do colours need more triangles than the shape?
  double exceeded_ = 0.0;   // tolerances that the mesh that was looked at last is off
  double missed_ = 0.0;     // the least of what did not keep it
};

}  // namespace sdf
