#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <memory>

#include "peers.h"
#include "sdf/eval/batch.h"

namespace sdf::chart {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr std::size_t kLeafVoxels = Leaf::SIZE;

// The leaf's values, or none where all are farther than the band from the surface.
std::unique_ptr<Leaf> readLeaf(const Tape& distance, const openvdb::Coord& origin, double h, float band,
                               BatchEvaluator& batch) {
  static_assert(kLeafVoxels <= kBatchPoints);
  PointRows rows;
  auto leaf = std::make_unique<Leaf>(origin, 0.0f, true);
  for (openvdb::Index i = 0; i < kLeafVoxels; ++i) {
    const openvdb::Coord at = leaf->offsetToGlobalCoord(i);
    rows.set(i, glm::vec3(glm::dvec3(at.x(), at.y(), at.z()) * h));
  }
  float* values = leaf->buffer().data();
  batch.evaluate(distance, rows.rows(), kLeafVoxels, values);
  const bool near = std::any_of(values, values + kLeafVoxels, [&](float v) { return std::abs(v) < band; });
  return near ? std::move(leaf) : nullptr;
}

accuracy::TriangleMesh extracted(const openvdb::FloatGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, triangles, quads, 0.0, 0.0);
  accuracy::TriangleMesh mesh;
  for (const auto& p : points) mesh.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& t : triangles) mesh.triangles.emplace_back(t[0], t[1], t[2]);
  for (const auto& q : quads) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

}  // namespace

accuracy::TriangleMesh meshDenselyByOpenVdb(const Subject& subject, const Tape& distance, double h) {
  openvdb::initialize();
  constexpr double kMargin = 3.0;  // voxels around the bounds
  const glm::ivec3 low(glm::floor((subject.bounds.min / h - kMargin) / 8.0));
  const glm::ivec3 high(glm::floor((subject.bounds.max / h + kMargin) / 8.0));
  const glm::ivec3 size = high - low + 1;
  const float band = static_cast<float>(2.0 * h * std::min(double{distance.lipschitz()}, 4.0));
  tbb::enumerable_thread_specific<BatchEvaluator> batches;
  std::vector<std::unique_ptr<Leaf>> leaves(static_cast<std::size_t>(size.x) * size.y * size.z);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    const int n = static_cast<int>(i);
    const openvdb::Coord origin(8 * (low.x + n / (size.y * size.z)), 8 * (low.y + n / size.z % size.y),
                                8 * (low.z + n % size.z));
    leaves[i] = readLeaf(distance, origin, h, band, batches.local());
  });
  auto grid = openvdb::FloatGrid::create();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(h));
  for (auto& leaf : leaves)
    if (leaf) grid->tree().addLeaf(leaf.release());
  openvdb::tools::signedFloodFillWithValues(grid->tree(), static_cast<float>(3.0 * h),
                                            static_cast<float>(-3.0 * h));
  return extracted(*grid);
}

}  // namespace sdf::chart
