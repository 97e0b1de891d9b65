// The triangles of meshes from files that are nothing but moved.
#pragma once
#include <optional>

#include "sdf/eval/function.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// The surface of a shape that is a mesh from a file, only moved, turned and scaled: its triangles, at their
/// places for these values of inputs. Creases are the edges where two of them meet at more than 30 degrees.
/// Where triangles touch, edges may have more of them. Nothing where the shape is something else, or its
/// triangles cross one another. Cost: n log n.
std::optional<FeatureMesh> placedTriangles(const Shape& shape, const Values& values);

}  // namespace sdf
