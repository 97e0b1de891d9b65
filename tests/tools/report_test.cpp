// What is said of a mesh, and what to do.
#include "sdf2gltf/report.h"

#include <gtest/gtest.h>

#include <sstream>

namespace sdf::exporter::report_test {

MeshStats kept() {
  MeshStats stats;
  stats.voxelSize = 0.08;
  stats.tolerance = 0.02;
  stats.maxDistance = 0.019;
  stats.farthest = {1.0f, 2.0f, 3.0f};
  return stats;
}

std::string warnings(const MeshStats& stats) {
  FileReport report;
  report.parts.resize(1);
  report.parts[0].name = "a";
  report.parts[0].stats = stats;
  std::ostringstream out;
  printWarnings(out, report);
  return out.str();
}

TEST(Warnings, AreNotGivenOfWhatIsKept) { EXPECT_EQ(warnings(kept()), ""); }

TEST(Warnings, ShowFiguresByAsManyDigitsAsTellThemApart) {
  MeshStats stats = kept();
  stats.tolerance = 0.0387;
  stats.maxDistance = 0.0391;
  EXPECT_EQ(
      warnings(stats),
      "sdf2gltf: warning: part 'a': the tolerance of 0.0387 is not kept everywhere: 0.0391 off near (1, 2, "
      "3); --voxel-size 0.04 may keep it there\n");
}

// Where solids touch the gap between them is thinner than any voxel.
TEST(Warnings, AreNotGivenOfWhatIsThinButNotLost) {
  MeshStats stats = kept();
  stats.unresolved = 48'076;
  stats.resolvingVoxel = 8.7e-7;
  EXPECT_EQ(warnings(stats), "");
  stats.tolerance = 0.0;
  stats.maxDistance = 0.039;
  EXPECT_EQ(warnings(stats), "");
}

TEST(Warnings, SayWhatSeesWhatIsThin) {
  const std::string missed =
      "sdf2gltf: warning: part 'a': solids or gaps thinner than a voxel were missed, the first near (4, 5, "
      "6); ";
  MeshStats stats = kept();
  stats.tolerance = 0.0;
  stats.maxDistance = 1.0;
  stats.unresolved = 3;
  stats.firstUnresolved = {4.0f, 5.0f, 6.0f};
  EXPECT_EQ(warnings(stats), missed + "--voxel-size 0.04 may see them\n");
  stats.resolvingVoxel = 0.0129;
  EXPECT_EQ(warnings(stats), missed + "take --voxel-size 0.012 to see them\n");
  stats.resolvingVoxel = 8.7e-7;
  EXPECT_EQ(warnings(stats), missed + "make them thicker than 0.14, or let what touches there overlap\n");
}

TEST(Warnings, SayWhatMayPartTrianglesThatCross) {
  MeshStats stats = kept();
  stats.crossings = 2;
  EXPECT_NE(warnings(stats).find("; --voxel-size 0.04 may part them\n"), std::string::npos)
      << warnings(stats);
}

}  // namespace sdf::exporter::report_test
