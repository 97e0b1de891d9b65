#include "dense.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <memory>
#include <vector>

#include "shapes.h"

namespace sdf::bench {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr int kLeaf = 8;
constexpr int kRows = kLeaf * kLeaf;

// Do the 64 rows of 8 samples, `stride` apart, come within `band` of the surface?
bool comesNear(const float* samples, int stride, float band) {
  float least[kLeaf];
  for (float& v : least) v = band;
  for (int r = 0; r < kRows; ++r)
    for (int k = 0; k < kLeaf; ++k) least[k] = std::min(least[k], std::abs(samples[r * stride + k]));
  for (const float v : least)
    if (v < band) return true;
  return false;
}

std::unique_ptr<Leaf> makeLeaf(const float* samples, int stride, const openvdb::Coord& origin) {
  auto leaf = std::make_unique<Leaf>(origin, 0.0f, true);
  float* out = leaf->buffer().data();
  for (int r = 0; r < kRows; ++r) std::copy_n(samples + r * stride, kLeaf, out + r * kLeaf);
  return leaf;
}

RawSurface extract(const openvdb::FloatGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, triangles, quads, 0.0, 0.0);
  RawSurface surface;
  surface.points.resize(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    surface.points[i] = {points[i].x(), points[i].y(), points[i].z()};
  });
  surface.triangles.resize(triangles.size() + 2 * quads.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    surface.triangles[i] = {triangles[i][0], triangles[i][1], triangles[i][2]};
  glm::uvec3* cut = surface.triangles.data() + triangles.size();
  tbb::parallel_for(std::size_t{0}, quads.size(), [&](std::size_t i) {
    const openvdb::Vec4I& q = quads[i];
    cut[2 * i] = {q[0], q[1], q[2]};
    cut[2 * i + 1] = {q[0], q[2], q[3]};
  });
  return surface;
}

}  // namespace

RawSurface meshDensely(RowLoop row, int n, double slope) {
  openvdb::initialize();
  const double h = 2.0 * kRegion / n;
  const float band = static_cast<float>(slope * h * (1.0 + 0x1p-18));  // a voxel, and the samples' rounding
  const int leaves = n / kLeaf, first = -n / 2;
  std::vector<float> z(n);
  for (int k = 0; k < n; ++k) z[k] = static_cast<float>((first + k) * h);

  // A slab is a column of leaves along z, so that it stays in a core's own cache.
  std::vector<std::vector<std::unique_ptr<Leaf>>> kept(static_cast<std::size_t>(leaves) * leaves);
  tbb::enumerable_thread_specific<std::vector<float>> slabs(static_cast<std::size_t>(kRows) * n);
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t column) {
    std::vector<float>& slab = slabs.local();
    const int x0 = first + static_cast<int>(column) / leaves * kLeaf;
    const int y0 = first + static_cast<int>(column) % leaves * kLeaf;
    for (int r = 0; r < kRows; ++r)
      row(static_cast<float>((x0 + r / kLeaf) * h), static_cast<float>((y0 + r % kLeaf) * h), z.data(),
          slab.data() + static_cast<std::size_t>(r) * n, n);
    for (int k = 0; k < n; k += kLeaf)
      if (comesNear(slab.data() + k, n, band))
        kept[column].push_back(makeLeaf(slab.data() + k, n, {x0, y0, first + k}));
  });

  auto grid = openvdb::FloatGrid::create();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(h));
  for (auto& column : kept)
    for (auto& leaf : column) grid->tree().addLeaf(leaf.release());
  openvdb::tools::signedFloodFillWithValues(grid->tree(), static_cast<float>(3 * h),
                                            static_cast<float>(-3 * h));
  return extract(*grid);
}

}  // namespace sdf::bench
