// The readers behind readMesh, one for each format. What they return is put in order by tidy.
#pragma once
#include "sdf/meshfile/mesh_file.h"
#include "sdf/meshfile/read_mesh.h"

namespace sdf {

/// readMesh for a file whose bytes are at hand; no file but what it names is opened.
Result<ReadMesh> readMesh(const MeshFile& file);

/// glTF 2.0, binary or text. Vertices that no triangle has are left out.
Result<ReadMesh> readGltf(const MeshFile& file);
Result<ReadMesh> readObj(const MeshFile& file);
Result<ReadMesh> readPly(const MeshFile& file);
Result<ReadMesh> readStl(const MeshFile& file);

/// Checks a mesh that a reader made: refuses coordinates that are not finite or too large and meshes without
/// a triangle, drops triangles of zero area and vertices without a triangle, makes normals unit and colours
/// within [0, 1]. Normals of length 0 stand for those that a file lacks. Precondition: indices in range, and
/// arrays of one length each.
Status tidy(const std::filesystem::path& file, ReadMesh& read);

/// Where a file has a face, for messages: "line" 7.
struct FacePlace {
  const char* unit;
  std::size_t number;
};

/// Cuts a polygon into triangles (cutPolygon), and warns of one that crosses itself; the mesh has its
/// vertices, and a material for each triangle so far. False where there are too many triangles then.
bool addPolygon(const std::vector<std::uint32_t>& corners, std::uint32_t material, const FacePlace& place,
                ReadMesh& read);

}  // namespace sdf
