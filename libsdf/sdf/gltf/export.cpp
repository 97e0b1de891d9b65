#include "sdf/gltf/export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "sdf/base/file.h"
#include "sdf/gltf/formats.h"

namespace sdf {
namespace {

struct Format {
  std::string_view extension;
  std::variant<GltfContainer, PlainFormat> encoding;
};

constexpr std::array kFormats{Format{".glb", GltfContainer::Binary}, Format{".gltf", GltfContainer::Text},
                              Format{".stl", PlainFormat::Stl}, Format{".ply", PlainFormat::Ply},
                              Format{".obj", PlainFormat::Obj}};

const Format* findFormat(const std::filesystem::path& target) {
  const auto found = std::ranges::find(kFormats, lowerExtension(target), &Format::extension);
  return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace

Status checkExtension(const std::filesystem::path& target) {
  std::vector<std::string_view> known;
  for (const Format& format : kFormats) known.push_back(format.extension);
  return checkExtension(target, known);
}

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
    all.provenDistance = std::max(all.provenDistance, one.provenDistance);
    all.watertight = all.watertight && one.watertight;
    all.manifold = all.manifold && one.manifold;
    if (all.crossings == 0) all.firstCrossing = one.firstCrossing;
    all.crossings += one.crossings;
    all.components += one.components;
    all.eulerCharacteristic += one.eulerCharacteristic;
    if (all.unresolved == 0) all.firstUnresolved = one.firstUnresolved;
    all.unresolved += one.unresolved;
    if (one.resolvingVoxel > 0.0 && !(all.resolvingVoxel > 0.0 && all.resolvingVoxel < one.resolvingVoxel))
      all.resolvingVoxel = one.resolvingVoxel;
    if (all.notNumbers == 0) all.firstNotNumber = one.firstNotNumber;
    all.notNumbers += one.notNumbers;
    squares += one.rmsDistance * one.rmsDistance * static_cast<double>(one.triangles);
  }
  if (all.triangles > 0) all.rmsDistance = std::sqrt(squares / static_cast<double>(all.triangles));
  return all;
}

bool isGltf(const std::filesystem::path& target) {
  return std::holds_alternative<GltfContainer>(findFormat(target)->encoding);
}

MeshStats combined(const std::vector<ExportPart>& parts) {
  std::vector<MeshStats> meshes;
  for (const ExportPart& part : parts) meshes.push_back(part.stats);
  return combined(meshes);
}

std::vector<Part> exportedParts(const Scene& scene, const std::filesystem::path& target) {
  if (isGltf(target) || scene.parts.size() < 2) return scene.parts;
  return {Part{"all parts united", scene.whole()}};
}

Status writeAnimation(const std::filesystem::path& target, const Animation& animation) {
  if (Status known = checkExtension(target); !known) return known;
  const auto* container = std::get_if<GltfContainer>(&findFormat(target)->encoding);
  if (!container)
    return Error{
        ErrorKind::Usage,
        lowerExtension(target) + " files hold no animation; write .glb or .gltf, or a file for each frame"};
  return writeFile(target, [&](std::ostream& out) { return encodeAnimation(out, *container, animation); });
}

Status writeMeshes(const std::filesystem::path& target, const Scene& scene,
                   const std::vector<ExportPart>& parts) {
  if (Status known = checkExtension(target); !known) return known;
  const auto& encoding = findFormat(target)->encoding;
  return writeFile(target, [&](std::ostream& out) {
    if (const auto* plain = std::get_if<PlainFormat>(&encoding)) return encodePlain(out, *plain, parts);
    return encodeGltf(out, std::get<GltfContainer>(encoding), scene, parts);
  });
}

}  // namespace sdf
