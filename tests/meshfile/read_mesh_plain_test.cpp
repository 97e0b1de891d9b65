// OBJ, STL and PLY files as others write them.
#include <gtest/gtest.h>

#include <bit>

#include "mesh_files.h"
#include "sdf/base/srgb.h"

namespace sdf {
namespace read_mesh_plain_test {

const std::vector<glm::vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::string kSquareObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

void expectColor(const glm::vec3& linear, const glm::vec3& shown) {
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(linear[k], linearOf(shown[k]));
}

// --- OBJ ---

TEST(ReadObj, CutsPolygonsIntoTriangles) {
  const Folder folder;
  const TriangleMesh mesh =
      readPlainly(written(folder / "a.obj", "# a square\n" + kSquareObj + "f 1 2 3 4\n"));
  EXPECT_EQ(cornersOf(mesh), kSquare);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(mesh.normals.empty() && mesh.colors.empty() && mesh.textureAt.empty());
}

// As a fan two of its triangles would lie outside of the face, and turned over.
TEST(ReadObj, CutsConcaveFacesAlongDiagonalsInside) {
  const Folder folder;
  const std::string points = "v 0 0 1\nv 3 0 1\nv 3 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n";
  for (int first = 0; first < 6; ++first) {
    std::string face = "f";
    for (int i = 0; i < 6; ++i) face += " " + std::to_string((first + i) % 6 + 1);
    const std::vector<glm::vec3> corners =
        cornersOf(readPlainly(written(folder / "a.obj", points + face + "\n")));
    ASSERT_EQ(corners.size(), 12u);
    float sum = 0.0f;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const glm::vec3 u = corners[i + 1] - corners[i], v = corners[i + 2] - corners[i];
      EXPECT_GT(u.x * v.y - u.y * v.x, 0.0f);
      sum += 0.5f * (u.x * v.y - u.y * v.x);
    }
    EXPECT_FLOAT_EQ(sum, 5.0f);
  }
}

TEST(ReadObj, SaysWhichFacesCrossThemselves) {
  const Folder folder;
  const auto file =
      written(folder / "a.obj", kSquareObj + "v 0.5 -1 0\nf 1 2 3 4\nf 1 2 4 3\nf 1 2 3 5 4\nf 2 1 4 3\n");
  const ReadMesh read = readWell(file);
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{
                "line 7: a face of 4 corners crosses itself, so its triangles overlap; divide it",
                "line 8: a face of 5 corners crosses itself, so its triangles overlap; divide it"}));
  EXPECT_EQ(read.mesh.triangles.size(), 9u);
}

TEST(ReadObj, CountsBackFromWhereItIs) {
  const Folder folder;
  const auto file = written(folder / "a.obj", "v 9 9 9\n" + kSquareObj + "f -4 -3 -2 -1\nv 5 5 5\n");
  EXPECT_EQ(cornersOf(readPlainly(file)), kSquare);
}

TEST(ReadObj, TakesEveryLineEndAndLinesThatGoOn) {
  const Folder folder;
  for (const char* end : {"\n", "\r\n"}) {
    std::string text = kSquareObj + "f 1 2 \\\n  3 4";  // and no end of the last line
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + std::strlen(end)))
      text.replace(at, 1, end);
    EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.obj", text))), kSquare);
  }
}

TEST(ReadObj, GivesCornersTheirOwnNormalsAndTextureCoordinates) {
  const Folder folder;
  const TriangleMesh mesh = readPlainly(
      written(folder / "a.obj", kSquareObj + "vt 0 0\nvt 1 0.25\nvn 0 0 2\nvn 0 1 0\n"
                                             "f 1/1/1 2/2/1 3/2/1\nf 1/1/2 3/2/1 4/1/1\nf 1//1 2 4/1\n"));
  ASSERT_EQ(mesh.positions.size(), 8u);  // 1/1/1, 2/2/1, 3/2/1, 1/1/2, 4/1/1, 1//1, 2, 4/1
  EXPECT_EQ(mesh.normals[mesh.triangles[0].x], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[mesh.triangles[1].x], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[mesh.triangles[2].y], glm::vec3(0, 0, 1)) << "the triangle's own";
  EXPECT_EQ(mesh.textureAt[mesh.triangles[0].x], glm::vec2(0, 1)) << "from the upper left corner";
  EXPECT_EQ(mesh.textureAt[mesh.triangles[0].y], glm::vec2(1, 0.75f));
}

TEST(ReadObj, ReadsColoursOfVertices) {
  const Folder folder;
  const TriangleMesh mesh =
      readPlainly(written(folder / "a.obj", "v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 0 1 0\nf 1 2 3\n"));
  ASSERT_EQ(mesh.colors.size(), 3u);
  EXPECT_EQ(mesh.colors[0], glm::vec3(1.0f));
  expectColor(mesh.colors[1], {1.0f, 0.5f, 0.0f});
  EXPECT_EQ(mesh.materials[0].color, glm::vec3(1.0f)) << "it would darken them";
}

TEST(ReadObj, ReadsMaterials) {
  const Folder folder;
  written(folder / "a.mtl",
          "# two\nnewmtl red one\nKd 1 0 0.5\nKe 0 1 0\nPm 1\nPr 0.25\nnewmtl grey\nKd 0.5 0.5 0.5\n");
  const auto file = written(
      folder / "a.obj", "mtllib a.mtl\n" + kSquareObj + "usemtl red one\nf 1 2 3\nusemtl grey\nf 1 3 4\n");
  const TriangleMesh mesh = readPlainly(file);
  const TriangleMaterial &red = mesh.materials.at(mesh.materialOf.at(0)),
                         &grey = mesh.materials.at(mesh.materialOf.at(1));
  EXPECT_EQ(red.name, "red one");
  expectColor(red.color, {1.0f, 0.0f, 0.5f});
  expectColor(red.emission, {0.0f, 1.0f, 0.0f});
  EXPECT_EQ(red.metallic, 1.0f);
  EXPECT_EQ(red.roughness, 0.25f);
  expectColor(grey.color, glm::vec3(0.5f));
  EXPECT_EQ(grey.roughness, 1.0f);
}

TEST(ReadObj, WarnsOfWhatItsMaterialsLack) {
  const Folder folder;
  const auto file = written(folder / "a.obj",
                            "mtllib none.mtl\nusemtl red\n" + kSquareObj + "f 1 2 3\nusemtl red\nf 1 3 4\n");
  EXPECT_EQ(readWell(file).warnings,
            (std::vector<std::string>{"materials left out: cannot read '" + file.string() +
                                          "': the file 'none.mtl' that it names: No such file or directory; "
                                          "put it there",
                                      "the material 'red' is nowhere described"}));
}

TEST(ReadObj, OpensNoMaterialsOutsideItsFolder) {
  const Folder folder;
  std::filesystem::create_directory(folder / "inner");
  written(folder / "a.mtl", "newmtl red\nKd 1 0 0\n");
  for (const std::string& name :
       {std::string("../a.mtl"), (folder / "a.mtl").string(), std::string("b/../../a.mtl")}) {
    const auto file =
        written(folder / "inner/a.obj", "mtllib " + name + "\nusemtl red\n" + kSquareObj + "f 1 2 3\n");
    const ReadMesh read = readWell(file);
    ASSERT_FALSE(read.warnings.empty()) << name;
    EXPECT_NE(read.warnings[0].find("which lies outside its folder; move that beside it"), std::string::npos);
    EXPECT_EQ(read.mesh.materials.size(), 1u);
  }
}

TEST(ReadObj, SaysWhichLineIsWrong) {
  const Folder folder;
  const auto why = [&](const std::string& line) {
    return whyNot(written(folder / "a.obj", kSquareObj + line));
  };
  EXPECT_EQ(why("v 1 2\n"), "line 5: 2 numbers where there should be 3");
  EXPECT_EQ(why("v 1 2 x\n"), "line 5: 'x' is no number");
  EXPECT_EQ(why("f 1 2\n"), "line 5: a face of fewer than 3 corners");
  EXPECT_EQ(why("f 1 2 five\n"), "line 5: 'five' is no corner of a face");
  EXPECT_EQ(why("f 1/2/3/4 2 3\n"),
            "line 5: the corner '1/2/3/4' names texture coordinate 2, and there are 0");
  EXPECT_EQ(why("vt 0 0\nvn 1 0 0\nf 1/1/1/1 2 3\n"), "line 7: '1/1/1/1' is no corner of a face");
  EXPECT_EQ(why("vt 0 0\nf /1 2 3\n"), "line 6: '/1' is no corner of a face");
  EXPECT_EQ(why("f 1 2 5\n"), "line 5: the corner '5' names vertex 5, and there are 4");
  EXPECT_EQ(why("f 0 1 2\n"), "line 5: the corner '0' names vertex 0, and there are 4");
  EXPECT_EQ(why("f -5 1 2\n"), "line 5: the corner '-5' names vertex -5, and there are 4");
  EXPECT_EQ(why("f 99999999999999999999 1 2\n"), "line 5: '99999999999999999999' is no corner of a face");
  EXPECT_EQ(why("f 1//3 2 3\n"), "line 5: the corner '1//3' names normal 3, and there are 0");
}

// --- STL ---

std::string textStl(const std::string& vertices) {
  return "solid a facet\nfacet normal 0 0 1\n outer loop\n" + vertices + " endloop\nendfacet\nendsolid a\n";
}

std::string binaryStl(std::uint32_t promised, const std::vector<glm::vec3>& corners,
                      const std::string& header = "") {
  std::string out = header + std::string(80 - header.size(), ' ');
  out.append(reinterpret_cast<const char*>(&promised), 4);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    out.append(12, '\0');
    out.append(reinterpret_cast<const char*>(&corners[i]), 36);
    out.append(2, '\0');
  }
  return out;
}

TEST(ReadStl, ReadsText) {
  const Folder folder;
  const std::string text = textStl("vertex 0 0 0\nvertex 1.0e0 0 -0\n VERTEX +0 1 0\n");
  EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.stl", text))), kTriangle);
  const TriangleMesh two = readPlainly(written(folder / "b.stl", text + textStl("vertex 0 0 0\nvertex 0 1 0\n"
                                                                                "vertex 0 0 1\n")));
  EXPECT_EQ(two.triangles.size(), 2u);
  EXPECT_EQ(two.positions.size(), 4u) << "equal corners are one vertex";
}

TEST(ReadStl, ReadsBinaryEvenWhereItBeginsWithSolid) {
  const Folder folder;
  for (const char* header : {"", "solid exported by somebody\n  "}) {
    EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.stl", binaryStl(2, kSquare, header)))), kSquare);
    EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.stl", binaryStl(2, kSquare, header) + "more"))),
              kSquare);
  }
}

TEST(ReadStl, LosesNoTriangleWhereManyMeetAtAnEdge) {
  const Folder folder;
  std::vector<glm::vec3> fins;
  for (int i = 0; i < 5; ++i)
    for (const glm::vec3& p :
         {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, static_cast<float>(i), 0)})
      fins.push_back(p);
  EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.stl", binaryStl(5, fins)))), fins);
}

TEST(ReadStl, SaysWhatIsWrong) {
  const Folder folder;
  const auto why = [&](const std::string& bytes) { return whyNot(written(folder / "a.stl", bytes)); };
  EXPECT_EQ(why("nothing"), "it is no STL: neither text nor as long as a binary one's header");
  EXPECT_EQ(why(binaryStl(3, kSquare)),
            "it is cut off, or no STL: 3 triangles are promised, and 2 are there");
  EXPECT_EQ(why(binaryStl(4'000'000'000u, kSquare)),
            "it is cut off, or no STL: 4000000000 triangles are promised, and 2 are there");
  EXPECT_EQ(why(textStl("vertex 0 0 0\nvertex 1 0\n")), "line 5: '' is no coordinate");
  EXPECT_EQ(why(textStl("vertex 0 0 0\nvertex 1 0 0\n")), "line 6: a facet of 2 corners");
  EXPECT_EQ(why(textStl("corner 0 0 0\n")), "line 4: 'corner' is no word of an STL");
  const std::string whole = textStl("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
  EXPECT_EQ(why(whole.substr(0, whole.find("endfacet"))), "it is cut off within a facet");
  EXPECT_EQ(readWell(written(folder / "b.stl", whole.substr(0, whole.find("endsolid")))).warnings,
            std::vector<std::string>{"its solid does not end, so it may be cut off"});
  EXPECT_EQ(why("solid\nendsolid\n"), "it has no triangles");
}

// --- PLY ---

const std::string kPlyVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPlyBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::string kTextPly = "ply\nformat ascii 1.0\ncomment by hand\n";

/// A value's bytes, from the last one on where they are to be big-endian.
template <class T>
std::string bytesOf(T value, bool swapped) {
  std::string out(reinterpret_cast<const char*>(&value), sizeof value);
  if (swapped) std::reverse(out.begin(), out.end());
  return out;
}

TEST(ReadPly, ReadsText) {
  const Folder folder;
  EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.ply", kTextPly + kPlyVertices + kPlyFaces + kPlyBody))),
            kSquare);
}

TEST(ReadPly, ReadsEveryTypeInEitherByteOrder) {
  const Folder folder;
  for (const bool swapped : {false, true}) {
    std::string bytes =
        std::string("ply\r\nformat binary_") + (swapped ? "big" : "little") +
        "_endian 1.0\r\nobj_info none\r\nelement vertex 4\r\nproperty double x\r\nproperty short y\r\n"
        "property list uint16 float extra\r\nproperty uint8 z\r\nelement face 1\r\nproperty int8 flag\r\n"
        "property list uint ushort vertex_index\r\nproperty list uchar float texcoord\r\nend_header\r\n";
    for (const glm::vec3& p : {kSquare[0], kSquare[1], kSquare[2], kSquare[5]}) {
      bytes += bytesOf(static_cast<double>(p.x), swapped) + bytesOf(static_cast<std::int16_t>(p.y), swapped);
      bytes += bytesOf(std::uint16_t{2}, swapped) + bytesOf(7.0f, swapped) + bytesOf(8.0f, swapped) + '\0';
    }
    bytes += '\1' + bytesOf(std::uint32_t{4}, swapped);
    for (std::uint16_t i = 0; i < 4; ++i) bytes += bytesOf(i, swapped);
    bytes += '\1' + bytesOf(9.0f, swapped);
    EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.ply", bytes))), kSquare);
  }
}

TEST(ReadPly, ReadsNormalsAndColours) {
  const Folder folder;
  const std::string more = "property float nx\nproperty float ny\nproperty float nz\n";
  const auto colors = [](const std::string& type) {
    return "property " + type + " red\nproperty " + type + " green\nproperty " + type + " blue\n";
  };
  const std::string body = "0 0 0 0 0 3 #\n1 0 0 0 0 3 #\n1 1 0 0 0 3 #\n0 1 0 0 0 3 #\n4 0 1 2 3\n";
  const auto file = [&](const std::string& type, const std::string& color) {
    std::string text = kTextPly + kPlyVertices + more + colors(type) + kPlyFaces + body;
    for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#')) text.replace(at, 1, color);
    return written(folder / "a.ply", text);
  };
  for (const auto& [type, color] :
       {std::pair<std::string, std::string>("uchar", "255 51 0"), {"float", "1 0.2 0"}}) {
    const TriangleMesh mesh = readPlainly(file(type, color));
    ASSERT_EQ(mesh.colors.size(), 4u);
    expectColor(mesh.colors[2], {1.0f, 0.2f, 0.0f});
    EXPECT_EQ(mesh.normals.at(2), glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.materials[0].color, glm::vec3(1.0f)) << "it would darken them";
  }
}

TEST(ReadPly, PassesOverOtherElements) {
  const Folder folder;
  const std::string other = "element camera 2\nproperty float a\nproperty list uchar int b\n";
  const auto file =
      written(folder / "a.ply", kTextPly + other + kPlyVertices + kPlyFaces + "1 2 5 6\n3 0\n" + kPlyBody);
  EXPECT_EQ(cornersOf(readPlainly(file)), kSquare);
}

TEST(ReadPly, SaysWhatIsWrong) {
  const Folder folder;
  const auto why = [&](const std::string& text) { return whyNot(written(folder / "a.ply", text)); };
  const auto whyHeader = [&](const std::string& line) { return why(kTextPly + line + "\nend_header\n"); };
  EXPECT_EQ(why("plyx\n"), "it is no PLY: it does not begin with 'ply'");
  EXPECT_EQ(why(kTextPly + kPlyVertices), "it is cut off: its header does not end");
  EXPECT_EQ(why("ply\nend_header\n"), "its header names no format");
  EXPECT_EQ(why("ply\nformat ebcdic 1.0\n"), "line 2: 'format' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("element vertex -1"), "line 4: 'element' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("property float x"), "line 4: 'property' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("element face 1\nproperty list real int i"),
            "line 5: 'property' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("element face 1\nproperty real i"), "line 5: 'property' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("elephant vertex 1"), "line 4: 'elephant' is not as in a PLY's header");
  EXPECT_EQ(whyHeader("element vertex 0\nproperty float x"), "its vertices have no x, y and z");
  EXPECT_EQ(whyHeader("element vertex 4000000000\nproperty float x"),
            "it is cut off: 4000000000 elements 'vertex' are promised, and fewer are there");
  const auto whyBody = [&](const std::string& body) {
    return why(kTextPly + kPlyVertices + kPlyFaces + body);
  };
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n"),
            "a face names vertex 4, and there are 4, numbered from 0");
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -1\n"),
            "a face names vertex -1, and there are 4, numbered from 0");
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 1.5\n"),
            "a face names vertex 1.5, and there are 4, numbered from 0");
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2"),
            "it is cut off: 1 elements 'face' are promised, and fewer are there");
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4294967295 0 1 2\n"),
            "it is cut off: 1 elements 'face' are promised, and fewer are there");
  EXPECT_EQ(whyBody("0 0 0\n1 0 0\n1 one 0\n0 1 0\n3 0 1 2\n"), "'one' is no number, in 'vertex' 2");
  EXPECT_EQ(why(kTextPly + kPlyVertices + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), "it has no triangles");
}

TEST(ReadPly, SaysWhichFacesCrossThemselves) {
  const Folder folder;
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const auto file = written(folder / "a.ply", kTextPly + kPlyVertices + faces +
                                                  "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n4 0 1 3 2\n");
  EXPECT_EQ(readWell(file).warnings,
            std::vector<std::string>{
                "face 1: a face of 4 corners crosses itself, so its triangles overlap; divide it"});
}

}  // namespace read_mesh_plain_test
}  // namespace sdf
