// STL, PLY and OBJ are read back with OpenMesh's readers.
#include <gtest/gtest.h>

// OpenMesh leaves new colours uninitialised before it sets them, and g++ 12 sees it.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "gltf/synthetic.h"
#include "sdf/export/export.h"
#include "support/folder.h"

namespace sdf {
namespace plain_test {

using Loaded = OpenMesh::TriMesh_ArrayKernelT<>;

Loaded load(const std::filesystem::path& file) {
  Loaded mesh;
  mesh.request_vertex_normals();
  mesh.request_vertex_colors();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::VertexColor);
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, file.string(), options)) << file;
  return mesh;
}

/// Closed: no halfedge without a face.
bool closed(const Loaded& mesh) {
  return std::none_of(mesh.halfedges_begin(), mesh.halfedges_end(),
                      [&](auto h) { return mesh.is_boundary(h); });
}

glm::vec3 toGlm(const OpenMesh::Vec3f& v) { return {v[0], v[1], v[2]}; }

TEST(PlainFormats, HoldAllPartsWeldedAndClosed) {
  const Folder folder;
  const Mesh one = twoColoredSphere(6, 8), two = sphere(5, 9, {4.0f, 0.0f, 0.0f});
  for (const char* name : {"a.stl", "a.ply", "a.obj", "a.STL"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", one), part("b", two)}));
    const Loaded mesh = load(folder / name);
    EXPECT_EQ(mesh.n_vertices(), one.welded + two.welded) << name;
    EXPECT_EQ(mesh.n_faces(), one.triangles.size() + two.triangles.size()) << name;
    EXPECT_TRUE(closed(mesh)) << name;
  }
}

TEST(PlainFormats, KeepPositionsToTheLastBit) {
  const Folder folder;
  const Mesh sent = sphere(6, 8, {0.1f, 1000.3f, -1e-3f});
  for (const char* name : {"a.ply", "a.obj"}) {  // STL names no vertices, so their order is the reader's
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    const Loaded mesh = load(folder / name);
    ASSERT_EQ(mesh.n_vertices(), sent.welded);
    for (std::uint32_t i = 0; i < sent.welded; ++i) {
      EXPECT_EQ(toGlm(mesh.point(mesh.vertex_handle(i))), sent.positions[i]) << name;
    }
  }
}

TEST(PlainFormats, PlyCarriesNormalsAndColours) {
  const Folder folder;
  Mesh sent = sphere(6, 8);
  // sRGB of linear 0.5 is 0.7354 (IEC 61966-2-1), that is 187.5 of 255: both roundings are right.
  for (glm::vec3& color : sent.colors) color = {1.0f, 0.5f, 0.0f};
  ASSERT_TRUE(writeMeshes(folder / "a.ply", Scene{}, {part("a", sent)}));
  const Loaded mesh = load(folder / "a.ply");
  ASSERT_EQ(mesh.n_vertices(), sent.welded);
  for (std::uint32_t i = 0; i < sent.welded; ++i) {
    const auto v = mesh.vertex_handle(i);
    EXPECT_EQ(toGlm(mesh.normal(v)), sent.normals[i]);
    EXPECT_EQ(mesh.color(v)[0], 255);
    EXPECT_NEAR(mesh.color(v)[1], 187.5, 0.5);
    EXPECT_EQ(mesh.color(v)[2], 0);
  }
}

TEST(PlainFormats, KeepTrianglesWhereMoreThanTwoMeetAtAnEdge) {
  const Folder folder;
  Mesh fin = sphere(3, 4);
  // A fin on an edge that has its two triangles already.
  const glm::uvec3 first = fin.triangles[0];
  fin.positions.push_back({2.0f, 2.0f, 2.0f});
  fin.normals.push_back({0.0f, 1.0f, 0.0f});
  fin.colors.push_back(glm::vec3(0.5f));
  fin.triangles.push_back({first.x, first.y, fin.welded++});
  fin.triangleMaterial.push_back(0);
  ASSERT_TRUE(writeMeshes(folder / "a.stl", Scene{}, {part("a", fin)}));
  // Binary STL: 80 bytes of header, a count, 50 bytes a triangle.
  EXPECT_EQ(contents(folder / "a.stl").size(), 84 + 50 * fin.triangles.size());
}

TEST(PlainFormats, ObjNormalsAreTheVertices) {
  const Folder folder;
  const Mesh sent = sphere(3, 4);
  ASSERT_TRUE(writeMeshes(folder / "a.obj", Scene{}, {part("a", sent)}));
  std::ifstream in(folder / "a.obj");
  std::vector<glm::vec3> normals;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    glm::vec3 n;
    if (words >> key >> n.x >> n.y >> n.z && key == "vn") normals.push_back(n);
  }
  EXPECT_EQ(normals, sent.normals);
}

TEST(PlainFormats, ComeWithoutChatter) {
  const Folder folder;
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sphere(3, 4))}));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << name;
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
  }
}

}  // namespace plain_test
}  // namespace sdf
