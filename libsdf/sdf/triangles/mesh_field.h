// Triangle meshes as functions of a point.
#pragma once
#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "sdf/base/result.h"
#include "sdf/expr/payload.h"
#include "sdf/triangles/bricks.h"
#include "sdf/triangles/distance.h"

namespace sdf {

/// The signed distance to a mesh whose holes are closed. Its slope is 1; over a box it is the value in the
/// middle, more or less half the diagonal; in a shader it is interpolated between samples.
class MeshField : public Payload {
 public:
  /// Whether a shader's samples may have so many voxels along the longest side: 16 to 1024. Error: Scene.
  static Status checkVoxels(int voxels);
  /// The distance to a mesh, after `closed`. `voxels` (checkVoxels): how many of them a shader's samples have
  /// along the longest side; they are kept in the folder `cache`, if that is not empty (BrickCache). Errors
  /// (Scene): other voxels, a mesh that encloses nothing. Cost: n log n.
  static Result<std::shared_ptr<const MeshField>> make(TriangleMesh mesh, int voxels = 128,
                                                       const std::filesystem::path& cache = {});

  const TriangleMesh& mesh() const { return mesh_; }
  const TriangleDistance& distance() const { return distance_; }
  /// The samples, which are taken when they are first asked for.
  const Bricks& bricks() const;
  /// How long it took until the distance could be read, and the samples, if they were asked for.
  double seconds() const { return seconds_; }

  double value(const glm::dvec3& p) const override;
  ValueAndGradient gradient(const glm::dvec3& p) const override;
  Interval range(const std::array<Interval, 3>& box) const override;
  double lipschitz() const override { return 1.0; }
  double rounding(const glm::dvec3& p) const override;
  void values(const PayloadRows& p, std::size_t count, float* out) const override;
  void gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const override;
  std::string glsl(const std::string& name) const override { return bricks().glsl(name); }
  std::span<const PayloadVolume> volumes() const override { return bricks().volumes; }

 private:
  MeshField(TriangleMesh mesh, ClosedTriangles triangles, int voxels, std::filesystem::path cache)
      : mesh_(std::move(mesh)), distance_(std::move(triangles)), voxels_(voxels), cache_(std::move(cache)) {}
  TriangleMesh mesh_;
  TriangleDistance distance_;
  int voxels_;
  std::filesystem::path cache_;
  mutable std::once_flag sampled_;
  mutable std::optional<Bricks> bricks_;
  mutable std::atomic<double> seconds_{0.0};
};

}  // namespace sdf
