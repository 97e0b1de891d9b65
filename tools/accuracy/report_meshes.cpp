#include "report.h"

namespace sdf::accuracy {
namespace {

constexpr const char* kMeshes = R"(
## Meshes

These are meshes by `sdf2gltf` of the measuring shapes (`samples/bench`), 2 to 4 in size. Uniform ones have voxels of 1/64
and 1/128 of a region of 4. Those that keep a tolerance with few triangles begin with 1/64. Distances are in scene units.

- *reported*: the mesher's own measure, the maximum both ways, as the export prints it.
- *to the surface*: from points all over the mesh, and for the maximum its vertices, to the true surface: the same
  solid written by hand as smooth pieces, the nearest point being looked for on them, on their edges and at their
  corners. Nothing of it comes from the library.
- *to the mesh*: from points all over the true surface, where random lines meet it, to the mesh's nearest triangle,
  which CGAL finds. So no missing piece goes unseen.
- *proven*: the bound that `--certify` proves of both. A distance beyond it would show in bold.

S4 and S5 have uniform meshes only, without a proof. S4's walls run out to nothing: proofs fail there, and a tolerance
takes minutes. A proof of S5 takes minutes, and a tolerance of 0.01 is refused where balls meet at the voxels' size.

A mean square over this many points is good to a percent.

What these distances cost, by this mesher and by others, is charted ([charts.md](charts.md)):

![Meshes of S2, time against error](charts/meshing.svg)

![Rays to S3, readings against error](charts/marching.svg)

| shape | asked | triangles | reported RMS | max | to the surface RMS | max | to the mesh RMS | max | proven |
|---|---|---|---|---|---|---|---|---|---|
)";

void writeRow(std::ostream& out, const MeshRow& row) {
  const auto distances = [](double rms, double max) {
    return formatted("%.2e", rms) + " | " + formatted("%.2e", max);
  };
  const double proven = row.stats.provenDistance;
  out << "| " << row.shape << " | " << row.asked << " | " << grouped(row.stats.triangles) << " | "
      << distances(row.stats.rmsDistance, row.stats.maxDistance) << " | "
      << distances(row.toSurface.rms, row.toSurface.max) << " | " << distances(row.toMesh.rms, row.toMesh.max)
      << " | " << (proven > 0.0 ? formatted("%.2e", proven) : "–");
  if (row.refuted()) out << ", **refuted**";
  out << " |\n";
}

}  // namespace

void writeMeshes(std::ostream& out, std::span<const MeshRow> meshes) {
  out << kMeshes;
  for (const MeshRow& row : meshes) writeRow(out, row);
}

}  // namespace sdf::accuracy
