#include "sdf/gltf/part.h"

#include <algorithm>
#include <cmath>

namespace sdf {

MeshStats combined(const std::vector<MeshStats>& meshes) {
  MeshStats all;
  all.watertight = all.manifold = !meshes.empty();
  double squares = 0.0;
  for (const MeshStats& one : meshes) {
    all.voxels += one.voxels;
    all.vertices += one.vertices;
    all.triangles += one.triangles;
    all.voxelSize = std::max(all.voxelSize, one.voxelSize);
    all.tolerance = std::max(all.tolerance, one.tolerance);
    if (one.maxDistance > all.maxDistance) all.maxDistance = one.maxDistance, all.farthest = one.farthest;
    all.surfacePoints += one.surfacePoints;
    all.provenDistance = std::max(all.provenDistance, one.provenDistance);
    all.watertight = all.watertight && one.watertight;
    all.manifold = all.manifold && one.manifold;
    if (all.crossings == 0) all.firstCrossing = one.firstCrossing;
    all.crossings += one.crossings;
    all.components += one.components;
    all.eulerCharacteristic += one.eulerCharacteristic;
    all.area += one.area;
    all.volume += one.volume;
    all.centreOfMass += one.volume * one.centreOfMass;
    if (all.unresolved == 0) all.firstUnresolved = one.firstUnresolved;
    all.unresolved += one.unresolved;
    if (one.resolvingVoxel > 0.0 && !(all.resolvingVoxel > 0.0 && all.resolvingVoxel < one.resolvingVoxel))
      all.resolvingVoxel = one.resolvingVoxel;
    if (all.notNumbers == 0) all.firstNotNumber = one.firstNotNumber;
    all.notNumbers += one.notNumbers;
    squares += one.rmsDistance * one.rmsDistance * static_cast<double>(one.triangles);
  }
  if (all.volume > 0.0) all.centreOfMass /= all.volume;
  if (all.triangles > 0) all.rmsDistance = std::sqrt(squares / static_cast<double>(all.triangles));
  return all;
}

MeshStats combined(const std::vector<ExportPart>& parts) {
  std::vector<MeshStats> meshes;
  for (const ExportPart& part : parts) meshes.push_back(part.stats);
  return combined(meshes);
}

}  // namespace sdf
