// Samples kept in files: the same as if they had just been taken, or taken again.
#include "sdf/triangles/brick_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>

#include "sdf/triangles/mesh_field.h"
#include "support/folder.h"
#include "support/triangle_meshes.h"

namespace sdf {
namespace brick_cache_test {

TriangleMesh cube(float side) { return test::boxOf(glm::vec3(0.0f), glm::vec3(side)); }

void expectEqual(const Bricks& a, const Bricks& b) {
  EXPECT_EQ(a.voxel, b.voxel);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.worst, b.worst);
  EXPECT_EQ(a.rms, b.rms);
  ASSERT_EQ(a.volumes.size(), b.volumes.size());
  for (std::size_t i = 0; i < a.volumes.size(); ++i) {
    EXPECT_EQ(a.volumes[i].name, b.volumes[i].name);
    EXPECT_EQ(a.volumes[i].size, b.volumes[i].size);
    EXPECT_EQ(a.volumes[i].channels, b.volumes[i].channels);
    EXPECT_EQ(a.volumes[i].halves, b.volumes[i].halves);
    EXPECT_EQ(a.volumes[i].values, b.volumes[i].values);
  }
}

std::size_t filesIn(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

class BrickCacheTest : public testing::Test {
 protected:
  const Folder folder;
  const std::filesystem::path kept = folder / "cache";
  const BrickCache cache{kept};
  const TriangleDistance solid{closed(cube(1.0f))};
  const Bricks taken = bricksOf(solid, 32);
};

TEST_F(BrickCacheTest, KeepsThemBitForBit) {
  expectEqual(cache.bricks(solid, 32), taken);
  ASSERT_EQ(filesIn(kept), 1u);
  const auto file = cache.fileOf(solid, 32);
  const auto when = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  std::filesystem::last_write_time(file, when);
  expectEqual(cache.bricks(solid, 32), taken);
  EXPECT_GT(std::filesystem::last_write_time(file), when) << "it was not used";
}

TEST_F(BrickCacheTest, TellsTrianglesAndVoxelsApart) {
  const TriangleDistance larger(closed(cube(1.5f)));
  EXPECT_NE(cache.fileOf(solid, 32), cache.fileOf(larger, 32));
  EXPECT_NE(cache.fileOf(solid, 32), cache.fileOf(solid, 33));
  cache.bricks(solid, 32);
  expectEqual(cache.bricks(larger, 32), bricksOf(larger, 32));
  EXPECT_EQ(filesIn(kept), 2u);
}

TEST_F(BrickCacheTest, TakesThemAgainWhereAFileIsBroken) {
  cache.bricks(solid, 32);
  const auto file = cache.fileOf(solid, 32);
  const auto size = std::filesystem::file_size(file);
  const std::function<void()> harms[] = {
      [&] { std::filesystem::resize_file(file, size / 2); },
      [&] { std::filesystem::resize_file(file, 3); },
      [&] { std::filesystem::resize_file(file, size + 8); },
      [&] {
        std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
        out.seekp(static_cast<std::streamoff>(size - 100));
        out.put('\x7f');
      },
  };
  for (const auto& harm : harms) {
    harm();
    expectEqual(cache.bricks(solid, 32), taken);
    EXPECT_EQ(std::filesystem::file_size(file), size) << "it was not mended";
  }
}

TEST_F(BrickCacheTest, DoesWithoutWhereNothingCanBeKept) {
  std::ofstream(folder / "file") << "no folder";
  expectEqual(BrickCache(folder / "file" / "below").bricks(solid, 32), taken);
}

TEST_F(BrickCacheTest, RemovesWhatWasNotUsedForLongest) {
  std::filesystem::create_directories(kept);
  const auto old = kept / "old.bricks", other = kept / "other.txt";
  std::ofstream(other) << "not its own";
  std::ofstream(old) << "x";
  std::filesystem::resize_file(old, BrickCache::kMost);  // sparse
  std::filesystem::last_write_time(old,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  cache.bricks(solid, 32);
  EXPECT_FALSE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(other));
  EXPECT_TRUE(std::filesystem::exists(cache.fileOf(solid, 32)));
}

TEST_F(BrickCacheTest, IsUsedByFieldsThatAreGivenAFolder) {
  const auto field = MeshField::make(cube(1.0f), 32, kept);
  ASSERT_TRUE(field);
  EXPECT_FALSE(std::filesystem::exists(kept)) << "before samples are asked for";
  expectEqual((*field)->bricks(), taken);
  EXPECT_TRUE(std::filesystem::exists(cache.fileOf((*field)->distance(), 32)));
}

TEST(UsersFolder, IsNamedByTheEnvironment) {
  const auto with = [](const char* cache, const char* home) {
    const auto set = [](const char* name, const char* value) {
      value ? ::setenv(name, value, 1) : ::unsetenv(name);
    };
    set("XDG_CACHE_HOME", cache);
    set("HOME", home);
    return BrickCache::usersFolder();
  };
  EXPECT_EQ(with("/c", "/h"), "/c/libsdf");
  EXPECT_EQ(with(nullptr, "/h"), "/h/.cache/libsdf");
  EXPECT_EQ(with("", "/h"), "/h/.cache/libsdf");
  EXPECT_EQ(with("relative", nullptr), "");
}

}  // namespace brick_cache_test
}  // namespace sdf
