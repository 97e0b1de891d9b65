#include "sdf/export/export.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "gltf/synthetic.h"
#include "support/folder.h"

namespace sdf {
namespace export_test {

TEST(CheckExtension, TakesEveryFormatInAnyCase) {
  for (const char* name : {"a.glb", "a.gltf", "a.stl", "a.ply", "a.obj", "A.GLB", "b.Stl", "dir.x/a.b.obj"}) {
    EXPECT_TRUE(checkExtension(name)) << name;
  }
}

TEST(CheckExtension, NamesTheExtensionsItTakes) {
  const Status unknown = checkExtension("out.fbx");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
  EXPECT_EQ(
      unknown.error().message,
      "'out.fbx' has the unknown extension '.fbx'; the output's name must end in one of .glb .gltf .stl "
      ".ply .obj");
  const Status none = checkExtension("out");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("'out' has no extension"), std::string::npos);
}

TEST(WriteMeshes, RefusesAnUnknownExtensionAndWritesNothing) {
  const Folder folder;
  const Status status = writeMeshes(folder / "a.fbx", Scene{}, {part("p", sphere(3, 4))});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Usage);
  EXPECT_TRUE(folder.empty());
}

TEST(WriteMeshes, LeavesNothingInAnyFormatWhenTheFileCannotGrow) {
  const Folder folder;
  for (const char* name : {"a.glb", "a.gltf", "a.stl", "a.ply", "a.obj"}) {
    const pid_t child = ::fork();
    if (child == 0) {
      const rlimit limit{2000, 2000};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      ::signal(SIGXFSZ, SIG_IGN);
      const Status status = writeMeshes(folder / name, Scene{}, {part("p", sphere(20, 20))});
      const bool right = !status && status.error().kind == ErrorKind::Files &&
                         status.error().message.find("File too large") != std::string::npos;
      ::_exit(right ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << name;
    EXPECT_TRUE(folder.empty()) << name;
  }
}

TEST(Combined, SumsCountsAndKeepsTheWorst) {
  ExportPart a = part("a", sphere(3, 4)), b = part("b", sphere(3, 4));
  a.stats.voxels = 10;
  b.stats.voxels = 5;
  b.stats.maxDistance = 2.0;
  b.stats.farthest = {7, 8, 9};
  b.stats.manifold = false;
  b.stats.unresolved = 2;
  b.stats.firstUnresolved = {1, 2, 3};
  b.stats.notNumbers = 4;
  b.stats.firstNotNumber = {5, 6, 7};
  b.stats.crossings = 3;
  b.stats.firstCrossing = glm::vec3(2, 4, 6);
  const MeshStats all = combined({a, b});
  EXPECT_EQ(all.voxels, 15u);
  EXPECT_EQ(all.triangles, a.stats.triangles + b.stats.triangles);
  EXPECT_EQ(all.vertices, a.stats.vertices + b.stats.vertices);
  EXPECT_EQ(all.components, 2);
  EXPECT_EQ(all.eulerCharacteristic, 4);
  EXPECT_EQ(all.maxDistance, 2.0);
  EXPECT_EQ(all.farthest, glm::vec3(7, 8, 9));
  EXPECT_TRUE(all.watertight);
  EXPECT_FALSE(all.manifold);
  EXPECT_EQ(all.unresolved, 2u);
  EXPECT_EQ(all.firstUnresolved, glm::vec3(1, 2, 3));
  EXPECT_EQ(all.crossings, 3u);
  EXPECT_EQ(all.firstCrossing, glm::vec3(2, 4, 6));
  EXPECT_EQ(all.notNumbers, 4u);
  EXPECT_EQ(all.firstNotNumber, glm::vec3(5, 6, 7));
}

TEST(Combined, WeighsTheRmsByTriangles) {
  ExportPart a = part("a", sphere(3, 4)), b = part("b", sphere(3, 4));
  a.stats.triangles = 3;
  a.stats.rmsDistance = 0.0;
  b.stats.triangles = 1;
  b.stats.rmsDistance = 2.0;
  EXPECT_EQ(combined({a, b}).rmsDistance, 1.0);  // sqrt((3 * 0 + 1 * 4) / 4)
}

}  // namespace export_test
}  // namespace sdf
