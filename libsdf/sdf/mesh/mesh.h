// Triangle meshes as the exporter writes them, and what is measured of them.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sdf {

/// Phong numbers of one material, resolved for export: attribute values averaged over the triangles that wear
/// it.
struct MeshMaterial {
  std::string name;
  glm::vec3 color{0.8f};
  glm::vec3 specular{0.0f};
  float shininess = 32.0f;
  float reflectivity = 0.0f;  ///< with the next two as in shape.h
  float fresnelPower = 0.0f;
  float fresnelBias = 0.0f;
  glm::vec3 emission{0.0f};
  int number = 0;  ///< among the shape's materials
};

/// Counter-clockwise triangles seen from outside, indices into the vertex arrays. Vertices [0, welded) are
/// distinct points; later ones repeat an earlier one (copyOf[i - welded]) with another material's colour or,
/// at a crease, another side's normal.
struct Mesh {
  std::vector<glm::vec3> positions;             ///< scene units
  std::vector<glm::vec3> normals;               ///< unit
  std::vector<glm::vec3> colors;                ///< linear RGB in [0, 1]
  std::vector<glm::vec3> ambient;               ///< answer to the ambient light, linear RGB, not negative
  std::vector<glm::uvec3> triangles;            ///< ordered by material
  std::vector<std::uint32_t> triangleMaterial;  ///< index into materials
  std::vector<MeshMaterial> materials;
  std::uint32_t welded = 0;
  std::vector<std::uint32_t> copyOf;

  /// The distinct point that a vertex is at, by its first vertex.
  std::uint32_t pointOf(std::uint32_t vertex) const {
    return vertex < welded ? vertex : copyOf[vertex - welded];
  }
};

/// Of a voxel: a finer one takes more than a thousand times as many samples, and is no advice.
inline constexpr double kFinestAdvised = 1.0 / 32.0;

/// What was measured of one mesh.
struct MeshStats {
  std::uint64_t voxels = 0;    ///< distance samples taken
  std::uint64_t vertices = 0;  ///< distinct points
  std::uint64_t triangles = 0;
  double voxelSize = 0.0;
  double tolerance = 0.0;           ///< that maxDistance was to keep; 0: none
  double rmsDistance = 0.0;         ///< of samples on the mesh to the scene's surface, scene units
  double maxDistance = 0.0;         ///< of these, and of points of the surface to the mesh
  glm::vec3 farthest{0.0f};         ///< the sample of maxDistance, or the point
  std::uint64_t surfacePoints = 0;  ///< of the surface, that were found from the function alone
  double provenDistance =
      0.0;                  ///< bound on the two-sided distance to the surface; 0 where none was asked for
  bool watertight = false;  ///< every edge has as many triangles one way as the other
  bool manifold = false;    ///< every edge has two triangles and every vertex one fan
  std::uint64_t crossings = 0;  ///< pairs of triangles that intersect beyond what they share
  glm::vec3 firstCrossing{0.0f};
  int components = 0;
  int eulerCharacteristic = 0;
  double area = 0.0;             ///< square scene units
  double volume = 0.0;           ///< of what a watertight mesh encloses, cubic scene units; else 0
  glm::dvec3 centreOfMass{0.0};  ///< of the same
  std::uint64_t unresolved = 0;  ///< places where solids or gaps thinner than a voxel were passed unseen
  glm::vec3 firstUnresolved{0.0f};
  double resolvingVoxel = 0.0;   ///< size of voxels that would see the thinnest of them; 0 where not known
  std::uint64_t notNumbers = 0;  ///< samples near the surface that are no numbers; they count as outside
  glm::vec3 firstNotNumber{0.0f};
};

}  // namespace sdf
