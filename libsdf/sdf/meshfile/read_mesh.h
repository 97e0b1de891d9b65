// Reading triangle meshes: .glb and .gltf with their materials and pictures; .obj, .stl and .ply.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/triangles/triangle_mesh.h"

namespace sdf {

/// More triangles than these are refused: they would take gigabytes.
inline constexpr std::size_t kMostReadTriangles = 50'000'000;
/// Larger files are refused before they are read: no binary STL of so many triangles is.
inline constexpr std::uintmax_t kMostReadBytes = 84 + 50 * std::uintmax_t{kMostReadTriangles};
/// Vertices farther than this from the origin along an axis are refused: products of three such lengths
/// leave the range of floats.
inline constexpr float kFarthestCoordinate = 1e15f;

/// Can readMesh read files of this name, by its extension (in upper or lower case)? The error lists the
/// extensions (Usage).
Status checkReadable(const std::filesystem::path& file);

/// Reads the triangles of a file, whose extension says what it holds. Triangles of zero area are dropped, and
/// counted in a warning; polygons are cut along diagonals inside of them, and those that cross themselves are
/// named in a warning; no other triangle is lost, however many meet at an
/// edge. Normals are unit: where some vertices have none that is usable, it is the mean of the
/// triangles' around them, by area. Vertices that no triangle has are dropped.
/// - .glb, .gltf (Khronos, glTF 2.0 Specification, 2021): the default scene, else the first, else all nodes;
///   triangles, strips and fans; sparse accessors; base colour, metalness, roughness, emission, COLOR_0, the
///   texture coordinates that the base colour's texture names. Extensions: EXT_meshopt_compression,
///   KHR_materials_emissive_strength, KHR_mesh_quantization, KHR_texture_transform (of the base colour's
///   texture); others may be used, and must not be required. Skins, morph targets and animations are read at
///   rest. A metal and roughness texture counts as its mean. Buffers and pictures may be other files in the
///   file's folder or below it, and nowhere else.
/// - .obj (Wavefront, and vertices with a colour): polygons, normals, texture coordinates; of a material Kd,
///   Ke, map_Kd, Pm and Pr. Colours are sRGB. The .mtl and pictures lie in the file's folder or below it.
/// - .stl, binary and text: triangles alone; equal corners become one vertex.
/// - .ply, text and binary of either byte order: polygons, normals, colours of vertices (sRGB).
/// A picture or .mtl that cannot be read is a warning. Pictures are PNG or JPEG.
/// Errors: Usage (unknown extension); Files (cannot be read, is cut off, contradicts its format or itself,
/// has no triangles, has coordinates that are not finite or beyond kFarthestCoordinate, requires an extension
/// that is unknown here, names a file outside its folder); Limits (more than kMostReadTriangles or
/// kMostReadBytes, out of memory). Any bytes give a mesh or an error.
Result<ReadMesh> readMesh(const std::filesystem::path& file);

}  // namespace sdf
