// What a mesh goes through between its samples and the file.
#pragma once
#include "sdf/mesh/feature_mesh.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/narrow_band.h"
#include "sdf/mesh/surface_points.h"

namespace sdf {

/// Looks at the band's suspects (NarrowBand::suspects) and counts those beside which the surface does pass
/// unseen: solids and gaps thinner than a voxel. Of a distance that never exceeds the true one, each point of
/// the surface lies within half a cell's diagonal of a sample that is a suspect or has a neighbour of the
/// other sign; a suspect is confirmed by seven probes. How thick it is there is measured along the gradient:
/// what holds a ball holds a sample too where voxels are 1 / sqrt(3) as long as the ball is wide. Call before
/// NarrowBand::extract. Fills stats.unresolved, stats.firstUnresolved and stats.resolvingVoxel.
void findUnresolved(const NarrowBand& band, const LocalField& field, Progress& progress, MeshStats& stats);

/// Newton's method along the gradient, at most three steps and no farther than a voxel from where
/// extraction put the vertex; steps below 4 ulps of a float end it, and the best position met is kept.
/// `normals` receives the unit gradient there (exact derivatives).
void refineVertices(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
                    const LocalField& field, Progress& progress);

/// Unit gradients (exact derivatives) at the points; where there is none the y axis.
void gradientNormals(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                     std::vector<glm::vec3>& normals);

/// Unit gradients at points of facets, whose unit normals are given (0: of none) and which keep the
/// `tolerance`: one that is 60 degrees or more from its facet's normal, for the point is nearer to the other
/// side of an edge, becomes that of a point two tolerances in front of or behind the facet, if one agrees.
void faceGradients(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& facets,
                   float tolerance, const LocalField& field, Progress& progress,
                   std::vector<glm::vec3>& gradients);

/// Fills positions, triangles, welded, copyOf and normals from a mesh with creases. A vertex on a crease is
/// repeated for each of the fans of triangles that the creases leave around it, with the gradient a little
/// inside the fan; any other has the gradient at its place. Normals are fitted (fitNormals), of a mesh with a
/// `tolerance` (0: none), whose triangles span more than voxels, to the gradients all over the triangles
/// (fitToGradients).
void splitAtCreases(const FeatureMesh& features, const LocalField& field, float tolerance, Progress& progress,
                    Mesh& mesh);

/// The normals that, interpolated, are nearest to the unit gradients all over the triangles, in the mean
/// square over the area; from `normals`. A large triangle beside a small rounding is then as flat or as round
/// as it should be, where the gradient at the corner that both share would run through all of it. `shared`
/// is, by vertex, the vertex whose normal it has; the mesh keeps the `tolerance`. Cost: linear; some 4 to 64
/// gradients for each triangle.
void fitToGradients(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const std::vector<std::uint32_t>& shared, float tolerance, const LocalField& field,
                    Progress& progress, std::vector<glm::vec3>& normals);

/// How far a vertex's normal may be from the mean of the facets around it, in radians: 30 degrees. A facet
/// whose side is d long is asin(d / 2r) from the normal of a surface that bends as a ball of radius r does:
/// what bends less than a ball as large as the facets keeps its normals.
inline constexpr double kFittingAngle = 0.5235987755982988;

/// Where a normal is farther than kFittingAngle from the mean of the facets around its vertex, slivers but
/// for, weighted by their angles there (Thuermer, Wuethrich 1998), it becomes that mean: the mesh does not
/// show what the gradient tells of, an edge that it cuts off or detail below a voxel. Cost: linear.
void fitNormals(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                std::vector<glm::vec3>& normals);

/// Voxels from any point of a mesh to a sample of the lattice on the surface's other side, at most, where the
/// samples are the shape's. A triangle lies in the cells around a lattice edge that the surface crosses:
/// sqrt(3) to the edge's farther end. Refinement moves it by one.
inline constexpr double kFarthestVoxels = 3.0;

/// Root mean square (weighted by area) and maximum of the first-order distance to the zero set, read at every
/// vertex and at four points inside each triangle (its centroid, and midway from there to each corner). The
/// mean square over a triangle is that of the quadratic function through these seven readings. One-sided:
/// from the mesh to the surface. Where the first-order figure exceeds half a voxel or is no number, the
/// surface is looked for along the gradient, and where it is not met there, at the samples of the lattice up
/// to kFarthestVoxels away. Triangles with more than a tenth of a voxel, under which the surface has an edge,
/// are looked at in 36 points for the maximum. A mesh whose maximum is beyond kFarthestVoxels is not the
/// shape's. Fills stats.rmsDistance, stats.maxDistance and stats.farthest; returns the vertices' distances.
std::vector<float> measureDistance(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                   Progress& progress, MeshStats& stats);

/// Watertight, manifold, components (by shared vertices) and Euler characteristic of an indexed mesh. Cost: n
/// log n.
void measureTopology(const std::vector<glm::uvec3>& triangles, std::size_t vertices, MeshStats& stats);

/// By vertex, the least vertex that triangles connect it with; one that no triangle has is alone. Cost: about
/// linear.
std::vector<std::uint32_t> piecesOf(const std::vector<glm::uvec3>& triangles, std::size_t vertices);

/// A vertex on an edge that is not balanced: with more triangles one way than the other. Precondition: there
/// is one (measureTopology: not watertight).
std::uint32_t openVertex(const std::vector<glm::uvec3>& triangles, std::size_t vertices);

/// Fills colors, ambient, triangleMaterial and materials, orders the triangles by material, and repeats
/// vertices where materials meet (copyOf), each copy coloured on its own side of the border. positions,
/// normals, triangles and welded are given; `materials` are FeatureMesh's, `values` the inputs' that the
/// field was made for. Once progress is stopped the mesh may be left unfinished.
void colorMesh(const Shape& shape, const std::vector<int>& materials, const Values& values,
               const LocalField& field, Progress& progress, Mesh& mesh);

}  // namespace sdf
