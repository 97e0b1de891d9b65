// Meshes in formats that know triangles alone, through OpenMesh.
#pragma once
#include <ostream>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/gltf/part.h"

namespace sdf {

enum class PlainFormat { Stl, Ply, Obj };
/// Welded triangles of all parts in one list: binary STL; binary PLY with normals and sRGB colours; OBJ with
/// normals.
Status encodePlain(std::ostream& out, PlainFormat format, const std::vector<ExportPart>& parts);

}  // namespace sdf
