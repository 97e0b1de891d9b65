// Meshes in formats that know triangles alone, through OpenMesh.
#pragma once
#include <ostream>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/gltf/part.h"

namespace sdf {

/// A format that knows triangles alone.
enum class PlainFormat {
  Stl,  ///< binary; positions
  Ply,  ///< binary; positions, normals and sRGB colours
  Obj   ///< text; positions and normals
};
/// Writes the welded triangles of all parts in one list.
Status encodePlain(std::ostream& out, PlainFormat format, const std::vector<ExportPart>& parts);

}  // namespace sdf
