// What is measured: scenes of known geometry, and scene files.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/meshes/piecewise_solid.h"
#include "sdf/base/result.h"
#include "sdf/shape/shape.h"

namespace sdf::chart {

struct Subject {
  std::string name;
  Shape shape;
  Box bounds;  ///< finite
  /// The same solid written by hand; null for a scene file.
  std::shared_ptr<const accuracy::PiecewiseSolid> solid{};
  bool easy = true;  ///< tolerances are kept and proofs found, and soon
};

/// The scenes that are measured where none is named: a ball, a drilled box, blended balls; unless `quick` a
/// box, a gyroid sheet and a thousand balls, too.
std::vector<Subject> standardSubjects(bool quick);

/// The whole of a scene file as one shape. Errors: Files, Scene (does not load, unbounded, no surface).
Result<Subject> loadSubject(const std::filesystem::path& file);

}  // namespace sdf::chart
