// Samples of meshes kept in files from one run to the next.
#pragma once
#include <cstdint>
#include <filesystem>
#include <utility>

#include "sdf/triangles/bricks.h"

namespace sdf {

/// A folder of samples. Files are named by what they were taken of, and read again only if every byte is as
/// it was written.
class BrickCache {
 public:
  /// The bytes that all files together may take; those that were not used for longest are removed.
  static constexpr std::uintmax_t kMost = std::uintmax_t{1} << 30;

  /// The folder is made when something is first kept in it.
  explicit BrickCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The user's: libsdf in $XDG_CACHE_HOME, or in .cache of $HOME; empty where neither is named.
  static std::filesystem::path usersFolder();

  /// bricksOf(distance, voxels), from the folder if they are there; else they are taken, and kept if that can
  /// be. Bit for bit the same either way.
  Bricks bricks(const TriangleDistance& distance, int voxels) const;

  /// The file of these samples: named by a hash of the triangles and of the voxels.
  std::filesystem::path fileOf(const TriangleDistance& distance, int voxels) const;

 private:
  void makeRoom() const;

  std::filesystem::path folder_;
};

}  // namespace sdf
