// What all that follows the sampling knows of a model: the tapes that hold at a point, and the resolution
// there.
#pragma once
#include <glm/vec3.hpp>
#include <memory>

#include "sdf/eval/tape.h"

namespace sdf {

/// What a region can feel of the scene. Where the distance is no larger than two voxels' slope the tapes say
/// what the whole scene says; elsewhere the sign alone is sure.
struct LocalTapes {
  TapePtr surface;   ///< distance and attributes, by SurfaceOutput
  TapePtr distance;  ///< output 0 alone
};

/// A model cut into regions, each with its tapes and its resolution. Both a band of samples and an adaptive
/// mesher can stand behind it.
class LocalField {
 public:
  struct Local {
    const LocalTapes& tapes;
    double voxel;  ///< length that features are resolved to there, scene units
  };
  /// Finds regions for points that follow one another; one per thread.
  class Finder {
   public:
    virtual ~Finder() = default;
    virtual Local at(const glm::vec3& p) = 0;
  };
  virtual ~LocalField() = default;
  virtual std::unique_ptr<Finder> finder() const = 0;
};

}  // namespace sdf
