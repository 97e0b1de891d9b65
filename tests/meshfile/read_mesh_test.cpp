// What readMesh asks of every file, whatever its format.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gltf/synthetic.h"
#include "mesh_files.h"
#include "sdf/export/export.h"
#include "sdf/gltf/glb.h"

namespace sdf {
namespace read_mesh_test {

TEST(ReadMesh, ListsTheExtensionsThatItReads) {
  const Folder folder;
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.stl", "a.ply", "a.PLY"})
    EXPECT_TRUE(checkReadable(name));
  const Result<ReadMesh> read = readMesh("a.fbx");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::Usage);
  EXPECT_EQ(read.error().message,
            "'a.fbx' has the unknown extension '.fbx'; meshes are read from .glb .gltf .obj .stl .ply");
  EXPECT_EQ(readMesh("mesh").error().message,
            "'mesh' has no extension; meshes are read from .glb .gltf .obj .stl .ply");
}

TEST(ReadMesh, SaysWhyAFileCannotBeOpened) {
  const Folder folder;
  EXPECT_EQ(whyNot(folder / "none.obj"), "No such file or directory; check its name");
  EXPECT_EQ(readMesh(folder / "none.obj").error().kind, ErrorKind::Files);
  std::filesystem::create_directory(folder / "b.obj");
  EXPECT_EQ(whyNot(folder / "b.obj"), "it is a folder; name a file in it");
  EXPECT_EQ(whyNot(written(folder / "c.obj", "") / "d.obj"), "Not a directory; check its name");
  EXPECT_EQ(whyNot(folder / "c.obj"), "it is empty");
  ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  EXPECT_EQ(whyNot(folder / "pipe.obj"), "it is no ordinary file; name another");
  if (::geteuid() == 0) return;  // who may read everything
  std::filesystem::permissions(written(folder / "e.obj", "v 0 0 0\n"), std::filesystem::perms::none);
  EXPECT_EQ(whyNot(folder / "e.obj"), "Permission denied; check who may read it");
}

TEST(ReadMesh, RefusesFilesWithoutTriangles) {
  const Folder folder;
  EXPECT_EQ(whyNot(written(folder / "a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), "it has no triangles");
}

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ReadMesh, RefusesCoordinatesThatAreNoFiniteNumbers) {
  const Folder folder;
  for (const char* bad : {"nan", "inf", "-inf", "1e39", "-1e400"}) {
    const auto file =
        written(folder / "a.obj", kPoints + "v 0 " + bad + " 0\nv 0 0 0\nv 1 0 " + bad + "\nf 1 2 3 4 5 6\n");
    EXPECT_EQ(whyNot(file),
              "2 of its 6 vertices have coordinates that are no finite numbers, vertex 3 is the first")
        << bad;
  }
}

TEST(ReadMesh, RefusesCoordinatesFarOut) {
  const Folder folder;
  EXPECT_EQ(whyNot(written(folder / "a.obj", kPoints + "v 0 2e15 0\nf 1 2 4\n")),
            "1 of its 3 vertices have coordinates beyond 1e15 (scale the mesh down), vertex 2 is the first");
  readPlainly(written(folder / "a.obj", kPoints + "v 0 -1e15 0\nf 1 4 2\n"));
  readPlainly(written(folder / "a.obj", kPoints + "v 0 -1e-30 0\nv 1e-30 0 0\nf 1 4 5\n"));
}

TEST(ReadMesh, DropsTrianglesWithoutAreaAndSaysSo) {
  const Folder folder;
  const auto file =
      written(folder / "a.obj", kPoints + "v 2 0 0\nv 1 0 0\nf 1 2 4\nf 1 2 3\nf 2 5 3\nf 4 4 1\n");
  const ReadMesh read = readWell(file);
  EXPECT_EQ(cornersOf(read.mesh), kTriangle);
  EXPECT_EQ(read.mesh.positions.size(), 3u) << "vertices that nothing has are dropped";
  EXPECT_EQ(read.warnings, std::vector<std::string>{"3 of 4 triangles have no area and are left out"});
  EXPECT_EQ(whyNot(written(folder / "b.obj", kPoints + "f 1 1 2\n")), "none of its triangles has an area");
}

TEST(ReadMesh, RefusesMoreTrianglesThanItTakes) {
  const Folder folder;
  GltfDraft draft;
  const std::vector<std::uint8_t> indices(kMostReadTriangles + 3, 0);  // as a strip, one triangle too many
  const int positions = draft.positions(kTriangle);
  draft.node({{"attributes", {{"POSITION", positions}}},
              {"mode", 5},
              {"indices", draft.accessor(indices, "SCALAR", 5121)}});
  draft.json["buffers"] = {{{"byteLength", draft.data.size()}}};
  std::ofstream out(folder / "a.glb", std::ios::binary);
  writeGlb(out, draft.json.dump(), {draft.data.begin(), draft.data.end()});
  out.close();
  const Result<ReadMesh> read = readMesh(folder / "a.glb");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::Limits);
  EXPECT_EQ(read.error().message, "cannot read '" + (folder / "a.glb").string() +
                                      "': it has more than 50000000 triangles; simplify it or split it up");
}

// A sparse file takes no room: what is larger than any that can be read is not looked into.
TEST(ReadMesh, RefusesGigabytesUnread) {
  const Folder folder;
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.glb", "a.gltf"}) {
    const std::filesystem::path file = written(folder / name, "v 0 0 0\n");
    std::filesystem::resize_file(file, std::uintmax_t{4} << 30);
    EXPECT_EQ(whyNot(file),
              "it has 4294 MB, and files of up to 2500 MB are read; simplify it or split it up");
    EXPECT_EQ(readMesh(file).error().kind, ErrorKind::Limits);
    std::filesystem::remove(file);
  }
}

// As a fan all its triangles would meet in one corner, and looking for crossings would take their square.
TEST(ReadMesh, CutsFacesOfManyCornersFromTheirBorderInward) {
  const Folder folder;
  constexpr int kCorners = 100'000;
  std::string points, face = "f", plyPoints;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const std::string at = std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    points += "v " + at, plyPoints += at;
    face += " " + std::to_string(i + 1);
  }
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(kCorners) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                    "property list int int vertex_indices\nend_header\n" +
                    plyPoints + std::to_string(kCorners);
  for (int i = 0; i < kCorners; ++i) ply += " " + std::to_string(i);
  for (const auto& file :
       {written(folder / "a.obj", points + face + "\n"), written(folder / "a.ply", ply + "\n")}) {
    const ReadMesh read = readWell(file);
    EXPECT_GT(read.mesh.triangles.size(), kCorners * 9u / 10u);  // some have no area
    std::vector<int> around(read.mesh.positions.size(), 0);
    for (const glm::uvec3& t : read.mesh.triangles)
      for (int k = 0; k < 3; ++k) ++around[t[k]];
    EXPECT_LE(*std::ranges::max_element(around), 100) << file;
    EXPECT_EQ(read.mesh.materialOf.size(), read.mesh.triangles.size());
  }
}

// Only what ends a file in vain may be missing: the last line's end, or an STL's endsolid.
TEST(ReadMesh, NoticesFilesThatAreCutOffAnywhere) {
  const Folder folder;
  for (const char* name : {"a.glb", "a.gltf", "a.stl", "a.ply"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sphere(2, 3))}));
    const std::string whole = contents(folder / name);
    for (std::size_t length = 1; length + 1 < whole.size(); ++length) {
      const Result<ReadMesh> read = readMesh(written(folder / name, whole.substr(0, length)));
      ASSERT_FALSE(read) << name << ", " << length << " of " << whole.size() << " bytes";
      ASSERT_EQ(read.error().kind, ErrorKind::Files);
    }
  }
}

TEST(ReadMesh, ShowsWhatAFileSaysOnOneLine) {
  const Folder folder;
  EXPECT_EQ(whyNot(written(folder / "a.obj", "v 0 0 \x01\xff" + std::string(100, 'x') + "\n")),
            "line 1: '?\xEF\xBF\xBD" + std::string(78, 'x') + "…' is no number");
}

TEST(ReadMesh, KeepsWarningsFew) {
  const Folder folder;
  std::string text = kPoints;
  for (int i = 0; i < 100; ++i) text += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  const std::vector<std::string> warnings = readWell(written(folder / "a.obj", text)).warnings;
  ASSERT_EQ(warnings.size(), 21u);
  EXPECT_EQ(warnings.back(), "there are more warnings, left out here");
}

}  // namespace read_mesh_test
}  // namespace sdf
