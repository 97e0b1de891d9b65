// Triangle meshes that scenes name.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "script/run.h"
#include "script/scene_folder.h"
#include "support/triangle_meshes.h"

namespace sdf::test {
namespace mesh_test {

// An .obj file of these triangles.
void writeObj(const std::filesystem::path& file, const TriangleMesh& mesh, const std::string& first = {}) {
  std::ofstream out(file);
  out << first;
  for (const glm::vec3& p : mesh.positions) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const glm::uvec3& t : mesh.triangles)
    out << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
}

class Meshes : public SceneFolder {
 protected:
  Meshes() {
    std::filesystem::create_directory(folder_ / "elsewhere");
    const TriangleMesh box = boxOf(glm::vec3(-1.0f), glm::vec3(1.0f));
    writeObj(scenes() / "box.obj", box);
    writeObj(scenes() / "open.obj", without(box, [](std::size_t i) { return i < 2; }), "mtllib none.mtl\n");
    writeObj(scenes() / "film.obj", without(box, [](std::size_t i) { return i >= 2; }));
    writeObj(scenes() / "twice.obj", together(box, boxOf(glm::vec3(0.0f), glm::vec3(2.0f))));
    std::ofstream(scenes() / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    std::ofstream(scenes() / "bad.obj") << "f 1 2 3\n";
  }
};

TEST_F(Meshes, AreShapesLikeAnyOther) {
  const Scene scene = sceneOf(R"(return mesh("box.obj"):translate(1, 0, 0):round(0.25) - sphere(0.5))");
  const Shape whole = scene.whole();
  EXPECT_DOUBLE_EQ(at(whole.distance, 3.0, 0.0, 0.0), 0.75);
  EXPECT_DOUBLE_EQ(at(whole.distance, 0.0, 0.0, 0.0), 0.5);
  EXPECT_TRUE(scene.notes.empty());
}

// A field that lives is one node; a file that was read anew is another.
TEST_F(Meshes, AreReadOnceWhileTheyLive) {
  const std::string text = R"(return mesh("box.obj"))";
  const auto distanceOf = [](const Scene& scene) { return scene.parts[0].shape.distance; };
  const Scene first = sceneOf(text), second = sceneOf(text);
  EXPECT_EQ(distanceOf(first), distanceOf(second));
  const Scene finer = sceneOf(R"(return mesh("box.obj", {voxels = 64}))");
  EXPECT_FALSE(distanceOf(finer) == distanceOf(first));
  std::filesystem::last_write_time(scenes() / "box.obj",
                                   std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  const Scene third = sceneOf(text);
  EXPECT_FALSE(distanceOf(third) == distanceOf(first));
}

TEST_F(Meshes, WhatWasMendedIsNoted) {
  auto notes = sceneOf(R"(return mesh("open.obj"))").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].starts_with("open.obj: ") && notes[0].find("none.mtl") != std::string::npos &&
              notes[0].ends_with("; 1 hole was closed"))
      << notes[0];
  notes = sceneOf(R"(return mesh("twice.obj") | mesh("twice.obj"):translate(5, 0, 0))").notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0],
            "twice.obj: its surface crosses or touches itself, or is turned inside out: inside is what it "
            "winds around");
}

// Two prisms over an L, whose lids are faces of six corners each. As fans they would be webs across the
// corner.
TEST_F(Meshes, OfConcaveFacesAreTheSolidsThatTheseBound) {
  std::ofstream out(scenes() / "concave.obj");
  for (const int x : {0, 5})
    for (const int z : {0, 1})
      for (const auto& [dx, y] :
           std::vector<std::pair<int, int>>{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}})
        out << "v " << x + dx << ' ' << y << ' ' << z << '\n';
  for (const int first : {1, 13}) {
    out << 'f';
    for (int i = 5; i >= 0; --i) out << ' ' << first + i;
    out << "\nf";
    for (int i = 0; i < 6; ++i) out << ' ' << first + 6 + i;
    for (int i = 0; i < 6; ++i) {
      const int next = (i + 1) % 6;
      out << "\nf " << first + i << ' ' << first + next << ' ' << first + 6 + next << ' ' << first + 6 + i;
    }
    out << '\n';
  }
  out.close();
  const Scene read = sceneOf(R"(return mesh("concave.obj"):round(0.1))"), meant = sceneOf(R"(
    local L = polygon{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}:extrude(0.5)
    return (L:translate(0, 0, 0.5) | L:translate(5, 0, 0.5)):round(0.1))");
  EXPECT_EQ(read.notes, std::vector<std::string>());
  const Expr distance = read.whole().distance, right = meant.whole().distance;
  // Volumes by the share of points inside, one to a cell of a grid.
  constexpr int kCells = 24;
  const glm::dvec3 low(-0.2, -0.2, -0.2), size(8.4, 3.4, 1.4);
  std::mt19937 random(1);
  int inside = 0;
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    const glm::dvec3 cell(i % kCells, i / kCells % kCells, i / kCells / kCells);
    const glm::dvec3 p = low + size * (cell + 0.5 + randomIn(random, 0.5)) / double{kCells};
    const double f = at(distance, p.x, p.y, p.z);
    ASSERT_NEAR(f, at(right, p.x, p.y, p.z), 1e-12);
    inside += f < 0.0;
  }
  EXPECT_NEAR(size.x * size.y * size.z * inside / (kCells * kCells * kCells), 14.832, 0.1);
}

TEST_F(Meshes, WithoutAnInsideAreRefused) {
  const std::string film = (std::filesystem::canonical(scenes()) / "film.obj").string();
  EXPECT_EQ(errorOf(R"(return mesh("film.obj"))"),
            here(":1: " + film + ": the triangles of this mesh enclose nothing: it is no solid"));
  EXPECT_NE(errorOf(R"(return mesh("flat.obj"))").find("none of its triangles has an area"),
            std::string::npos);
}

// Nothing is done with these that grows with the square of how many there are.
TEST_F(Meshes, OfTooManyTrianglesOnAnEdgeAreRefused) {
  writeObj(scenes() / "fan.obj", wedgesOnAnEdge(20000));
  const std::string fan = (std::filesystem::canonical(scenes()) / "fan.obj").string();
  EXPECT_EQ(errorOf(R"(return mesh("fan.obj"))"), here(":1: " + fan +
                                                       ": an edge of this mesh, at (0, 0, 0), has 40000 "
                                                       "triangles, and at most 2000 are taken; move some of "
                                                       "them away from it"));
  writeObj(scenes() / "fan.obj", wedgesOnAnEdge(300));
  EXPECT_TRUE(run(R"(return mesh("fan.obj"))").ok());
}

TEST_F(Meshes, TheReadersErrorIsShown) {
  EXPECT_NE(errorOf(R"(return mesh("bad.obj"))").find("bad.obj': line 1: "), std::string::npos);
}

TEST_F(Meshes, FilesElsewhereAreRefused) {
  const std::filesystem::path other = std::filesystem::canonical(folder_ / "elsewhere");
  std::filesystem::copy_file(scenes() / "box.obj", other / "box.obj");
  const std::string outside = (other / "box.obj").string();
  const std::string text = "return mesh(\"" + outside + "\")";
  EXPECT_EQ(errorOf(text), here(":1: mesh: '" + outside +
                                "' lies outside of the scene's folder; move it there, or allow its "
                                "folder with --allow-dir " +
                                other.string()));
  EXPECT_NE(errorOf(R"(return mesh("../box.obj"))").find("lies outside"), std::string::npos);
  std::filesystem::create_symlink(outside, scenes() / "link.obj");
  EXPECT_NE(errorOf(R"(return mesh("link.obj"))").find("lies outside"), std::string::npos);
  options_.folders = {other};
  EXPECT_TRUE(run(text).ok());
}

// What a broken mesh is part of goes on without it, as if there were nothing where it is.
TEST_F(Meshes, ThatAreMissingAreLeftOutWhereThatIsAllowed) {
  options_.withoutMissing = true;
  const auto sameAs = [&](const std::string& text, const std::string& other) {
    const Scene scene = sceneOf(text);
    ASSERT_EQ(scene.missing.size(), 1u) << text;
    EXPECT_EQ(scene.missing[0],
              here(":1: cannot read '" + (std::filesystem::canonical(scenes()) / "bad.obj").string() +
                   "': line 1: the corner '1' names vertex 1, and there are 0"));
    EXPECT_EQ(scene.whole().distance, sceneOf(other).whole().distance) << text;
    EXPECT_EQ(scene.parts.size(), sceneOf(other).parts.size()) << text;
  };
  const std::string bad = R"(local bad = mesh("bad.obj") )";
  sameAs(bad + "part('a', bad) part('b', box(1))", "part('b', box(1))");
  sameAs(bad + "part('a', bad:translate(1, 2, 3):round(0.1):twist(10):paint('#f00')) return box(1)",
         "return box(1)");
  sameAs(bad + "return bad | box(1) | sphere(2), bad", "return box(1) | sphere(2)");
  sameAs(bad + "return union({bad, box(1), bad:scale(2), sphere(2)}, 0.2)",
         "return union({box(1), sphere(2)}, 0.2)");
  sameAs(bad + "return box(1) - bad, bad - box(1)", "return box(1)");
  sameAs(bad + "return box(1) ~ bad, box(1) & bad", "return box(1)");
  sameAs(bad + "part('a', bad:displace(function(x, y, z) return 0.1 * sin(x) end)) part('b', box(1))",
         "part('b', box(1))");
  sameAs(bad + "return box(1):translate(2, 0, 0), morph(bad, box(1), 0.5)",
         "return box(1):translate(2, 0, 0)");
}

TEST_F(Meshes, ThatAreMissingAreErrorsWhereNothingIsLeft) {
  options_.withoutMissing = true;
  EXPECT_EQ(errorOf(R"(return mesh("../box.obj"))"),
            here(":1: mesh: '../box.obj' lies outside of the scene's folder; move it there, or allow its "
                 "folder with --allow-dir " +
                 std::filesystem::canonical(folder_.path()).string()));
  EXPECT_NE(errorOf(R"(return mesh("film.obj"), mesh("flat.obj"))").find("enclose nothing"),
            std::string::npos);
  EXPECT_NE(errorOf(R"(return box(1), mesh("box.obj", {voxels = 8}))")
                .find("voxels must be from 16 to 1024, got 8"),
            std::string::npos)
      << "a slip of the script's own";
}

TEST_F(Meshes, ThatAreMissingAreFollowed) {
  options_.withoutMissing = true;
  EXPECT_EQ(sceneOf(R"(return box(1), mesh("bad.obj"))").files,
            std::vector{(std::filesystem::canonical(scenes()) / "bad.obj").string()});
}

TEST_F(Meshes, ThatTakeTooLongAreNamed) {
  writeObj(scenes() / "large.obj", bumpyTorus(200));
  options_.timeLimit = 0.01;
  EXPECT_EQ(
      errorOf("local large = mesh('large.obj')\nreturn large:translate(1, 0, 0)"),
      here(":2: ran longer than 0.01 seconds, most of them to read 'large.obj'; give it fewer triangles"));
}

TEST_F(Meshes, BadArgumentsAreNamed) {
  EXPECT_NE(errorOf("return mesh(1)").find("mesh: the file must be a text"), std::string::npos);
  EXPECT_NE(errorOf(R"(return mesh("box.obj", {voxels = 8}))").find("voxels must be from 16 to 1024, got 8"),
            std::string::npos);
  EXPECT_NE(errorOf(R"(return mesh("box.obj", {fine = 8}))").find("unknown field 'fine'"), std::string::npos);
}

}  // namespace mesh_test
}  // namespace sdf::test
