// A program that makes a scene in C++, meshes it and writes a glTF file.
#include <cstdio>

#include "sdf/export/export.h"
#include "sdf/mesh/mesher.h"
#include "sdf/scene/scene.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

int main() {
  sdf::Scene scene;
  const sdf::Shape cube = sdf::box(sdf::Vec3E(1.0));
  const sdf::Shape dome = sdf::translate(sdf::sphere(0.7), sdf::Vec3E(0.0, 1.0, 0.0));
  scene.add("body",
            sdf::unite(cube, dome, sdf::Blend::quadratic(0.2)).paint({.color = sdf::Vec3E(0.8, 0.3, 0.2)}));

  sdf::Progress progress;
  sdf::MeshOptions options;
  options.voxelSize = 0.1;
  const auto meshed = sdf::meshShape(scene.parts[0].shape, "body", options, progress);
  if (!meshed) {
    std::fprintf(stderr, "%s\n", meshed.error().message.c_str());
    return 1;
  }
  const sdf::Status written =
      sdf::writeMeshes("body.glb", scene, {{"body", meshed.value().mesh, meshed.value().stats}});
  if (!written) {
    std::fprintf(stderr, "%s\n", written.error().message.c_str());
    return 1;
  }
  const sdf::MeshStats& stats = meshed.value().stats;
  std::printf("%llu triangles, Euler characteristic %d\n", static_cast<unsigned long long>(stats.triangles),
              stats.eulerCharacteristic);
  return stats.watertight && stats.eulerCharacteristic == 2 ? 0 : 1;
}
