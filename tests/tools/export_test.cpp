// What the program writes and prints when all is well.
// OpenMesh leaves new colours uninitialised before it sets them, and g++ 12 sees it.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cfloat>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "exported.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "support/triangle_meshes.h"

namespace sdf {
namespace export_test {

using Loaded = OpenMesh::TriMesh_ArrayKernelT<>;

Loaded load(const std::string& file) {
  Loaded mesh;
  mesh.request_vertex_colors();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexColor);
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, file, options)) << file;
  return mesh;
}

std::vector<glm::uvec3> trianglesOf(const Loaded& mesh) {
  std::vector<glm::uvec3> triangles;
  for (const auto face : mesh.faces()) {
    glm::uvec3 corners;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face)) corners[k++] = static_cast<unsigned>(vertex.idx());
    triangles.push_back(corners);
  }
  return triangles;
}

MeshStats topologyOf(const Loaded& mesh) {
  MeshStats stats;
  measureTopology(trianglesOf(mesh), mesh.n_vertices(), stats);
  return stats;
}

double volumeOf(const Loaded& mesh) {
  const auto corner = [&](unsigned v) {
    return OpenMesh::Vec3d(mesh.point(OpenMesh::VertexHandle(static_cast<int>(v))));
  };
  double sum = 0.0;
  for (const glm::uvec3& t : trianglesOf(mesh)) sum += (corner(t.x) | (corner(t.y) % corner(t.z))) / 6.0;
  return sum;
}

TEST_F(Export, WritesOnlyTheFileAskedFor) {
  const Outcome outcome = run({scene(kSphere), "-o", out("a.glb")});
  expectSuccess(outcome);
  EXPECT_EQ(written(), std::vector<std::string>{"a.glb"});
}

TEST_F(Export, PrintsATableOfPartsAndTotal) {
  const Outcome outcome = run({scene(kTwoParts), "-o", out("a.glb")});
  expectSuccess(outcome);
  std::istringstream lines(outcome.out);
  std::vector<std::string> words;
  for (std::string line, word; std::getline(lines, line);) {
    std::istringstream(line) >> word;
    words.push_back(word);
  }
  EXPECT_EQ(words, (std::vector<std::string>{out("a.glb"), "part", "ball", "block", "total"}));
  // The tolerance is the column after the names, where there is one.
  EXPECT_NE(outcome.out.find("part   tolerance  triangles"), std::string::npos) << outcome.out;
  const Outcome uniform = run({scene(kTwoParts), "-o", out("a.glb"), "--voxel-size", "0.1"});
  EXPECT_EQ(uniform.out.find("tolerance"), std::string::npos) << uniform.out;
}

TEST_F(Export, PrintsNothingWhenQuiet) {
  const Outcome outcome = run({scene(kSphere), "-o", out("a.glb"), "--quiet"});
  expectSuccess(outcome);
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Export, AnswersQuestions) {
  const Outcome help = run({"--help"}), version = run({"--version"});
  expectSuccess(help);
  expectSuccess(version);
  for (const char* flag :
       {"--output", "--voxel-size", "--bounds", "-D", "--time", "--frames", "--fps", "--only", "--report",
        "--threads", "--max-memory", "--compress", "--keep-going", "--quiet"}) {
    EXPECT_NE(help.out.find(flag), std::string::npos) << flag;
  }
  EXPECT_EQ(version.out.substr(0, 9), "sdf2gltf ");
  EXPECT_EQ(std::count(version.out.begin(), version.out.end(), '\n'), 1);
}

TEST_F(Export, WritesPlainFormatsThatLoadBackClosed) {
  const std::string ball = scene(kSphere);
  for (const char* name : {"a.stl", "a.PLY", "a.obj"}) {
    const Json total = report({ball, "-o", out(name), "--voxel-size", "0.1"})["outputs"][0]["total"];
    OpenMesh::TriMesh_ArrayKernelT<> mesh;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, out(name))) << name;
    EXPECT_EQ(mesh.n_faces(), total["triangles"]) << name;
    EXPECT_EQ(mesh.n_vertices(), total["vertices"]) << name;
    EXPECT_TRUE(std::none_of(mesh.halfedges_begin(), mesh.halfedges_end(),
                             [&](auto h) { return mesh.is_boundary(h); }));
  }
}

/// Two cubes of side 2 that overlap in half of each: 8 + 8 - 4 = 12.
constexpr const char* kOverlappingCubes =
    "part('left', box(1):paint{1, 0, 0}) part('right', box(1):translate(1, 0, 0):paint{0, 0, 1})";

TEST_F(Export, UnitesThePartsWhereTheFormatKnowsNone) {
  const std::string cubes = scene(kOverlappingCubes);
  const double h = 0.05;
  // Edges, 28 long together, are cut off within the voxels that they pass.
  const double edges = 28.0 * h * h;
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    SCOPED_TRACE(name);
    const Json output = report({cubes, "-o", out(name), "--voxel-size", std::to_string(h)})["outputs"][0];
    ASSERT_EQ(output["parts"].size(), 1u);
    EXPECT_EQ(output["parts"][0]["name"], "all parts united");
    EXPECT_EQ(output["parts"][0]["united"], (Json{"left", "right"}));
    const Loaded mesh = load(out(name));
    EXPECT_NEAR(volumeOf(mesh), 12.0, edges);
    const MeshStats topology = topologyOf(mesh);
    EXPECT_TRUE(topology.watertight && topology.manifold);
    EXPECT_EQ(topology.components, 1);
    EXPECT_EQ(topology.eulerCharacteristic, 2);
  }
  const Json apart = report({cubes, "-o", out("a.glb")})["outputs"][0]["parts"];
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_EQ(apart[0]["united"], Json::array());
}

TEST_F(Export, ColoursWhatItUnitesAsThePartsAre) {
  expectSuccess(run({scene(kOverlappingCubes), "-o", out("a.ply"), "--voxel-size", "0.1"}));
  const Loaded mesh = load(out("a.ply"));
  // The left cube's surface is seen up to x = 0, where the right one begins; from there to 1 both are.
  for (const auto v : mesh.vertices()) {
    const double x = mesh.point(v)[0];
    if (x < -0.1) {
      EXPECT_EQ(mesh.color(v), Loaded::Color(255, 0, 0)) << "at x = " << x;
    } else if (x > 1.1) {
      EXPECT_EQ(mesh.color(v), Loaded::Color(0, 0, 255)) << "at x = " << x;
    }
  }
}

TEST_F(Export, KeepsAToleranceWithFewTriangles) {
  const std::string file = scene(
      "part('plain', box(1)) part('striped', sphere(0.5):translate(0, 3, 0):paint{color = function(x, y, z)"
      " return x, 0, 0 end})");
  const Outcome outcome = run(
      {file, "-o", out("a.glb"), "--voxel-size", "0.1", "--tolerance", "0.001", "--report", out("a.json")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream in(out("a.json"));
  const Json parts = Json::parse(in)["outputs"][0]["parts"];
  EXPECT_EQ(parts[0]["triangles"], 12);
  for (const Json& part : parts) {
    EXPECT_EQ(part["tolerance"], 0.001);
    EXPECT_LE(part["max_distance"], 0.001);
  }
}

TEST_F(Export, TakesATolerancesShareOfTheDiagonal) {
  // Both balls' box is 2 by 2 by 6, of the diagonal sqrt(44).
  const std::string file = scene("part('a', sphere(1)) part('b', sphere(1):translate(0, 0, 4))");
  for (const char* only : {"a", ""}) {
    std::vector<std::string> arguments{file, "-o", out("a.glb"), "--tolerance", "0.1%"};
    if (*only) arguments.insert(arguments.end(), {"--only", only});
    const double tolerance = 0.001 * std::sqrt(*only ? 12.0 : 44.0);
    const Json parts = report(arguments)["outputs"][0]["parts"];
    for (const Json& part : parts) {
      EXPECT_DOUBLE_EQ(part["tolerance"], tolerance);
      EXPECT_LE(part["max_distance"], tolerance);
    }
  }
}

TEST_F(Export, SpendsABudgetOfTriangles) {
  const std::string file = scene("part('ball', sphere(1)) part('box', box(1):translate(3, 0, 0))");
  const Json output =
      report({file, "-o", out("a.glb"), "--voxel-size", "0.05", "--triangles", "1000"})["outputs"][0];
  EXPECT_LE(output["total"]["triangles"], 1000);
  EXPECT_GE(output["total"]["triangles"], 850);
  EXPECT_EQ(output["parts"].size(), 2u);
  EXPECT_EQ(output["parts"][1]["triangles"], 12);
  // 0.1925 times the integral of the curvature, 4 pi, by the tolerance is the fewest that a ball needs.
  EXPECT_LE(output["parts"][0]["max_distance"], 1.3 * 0.1925 * 4.0 * std::numbers::pi / 850.0);
}

// Walls between two bores that run out to nothing: no tolerance that a large budget would pay for is kept.
TEST_F(Export, SpendsWhatItCanOfABudget) {
  const std::string file = scene(
      "return box(1, 0.1, 1) - cylinder(0.5, 2):translate(0.501, 0, 0) - cylinder(0.5, 2):translate(-0.501, "
      "0, 0)");
  const Outcome fine = run({file, "-o", out("a.glb"), "--voxel-size", "0.5", "--tolerance", "0.003"});
  EXPECT_EQ(fine.status, 4);
  EXPECT_NE(fine.err.find("could not be kept"), std::string::npos) << fine.err;
  const Outcome outcome = run({file, "-o", out("a.glb"), "--voxel-size", "0.5", "--triangles", "1000"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(written(), std::vector<std::string>{"a.glb"});
}

TEST_F(Export, BudgetsOfAFewTrianglesAreMet) {
  const Json output = report({scene("return sphere(1)"), "-o", out("a.glb"), "--voxel-size", "0.05",
                              "--triangles", "10"})["outputs"][0];
  EXPECT_EQ(output["total"]["triangles"], 10);
}

TEST_F(Export, SaysHowFewTrianglesAreTooFew) {
  const Outcome outcome =
      run({scene("return box(1)"), "-o", out("a.glb"), "--voxel-size", "0.1", "--triangles", "11"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find(
                "--triangles: 11 are too few for what is exported; the fewest that were reached are 12"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(written().empty());
}

TEST_F(Export, WritesLevelsOfDetail) {
  const Json outputs = report({scene(kSphere), "-o", out("a.glb"), "--voxel-size", "0.05", "--tolerance",
                               "0.002", "--lod", "3"})["outputs"];
  ASSERT_EQ(outputs.size(), 3u);
  EXPECT_EQ(written(), (std::vector<std::string>{"a.glb", "a_lod1.glb", "a_lod2.glb", "report.json"}));
  double tolerance = 0.002;
  for (const Json& output : outputs) {
    const Json& part = output["parts"][0];
    EXPECT_DOUBLE_EQ(part["tolerance"], tolerance);
    EXPECT_LE(part["max_distance"], tolerance);
    // As many as a ball needs, and no more than half as many again.
    EXPECT_LE(part["triangles"], 1.5 * 0.1925 * 4.0 * std::numbers::pi / tolerance);
    tolerance *= 4.0;
  }
}

// Of a ring of 512 triangles.
TEST_F(Export, LeavesAFilesMeshAsItCameUnlessFewerTrianglesAreAskedFor) {
  const std::string file = scene("return mesh('ring.obj'):rotate(10, 20, 30)");
  const TriangleMesh ring = test::bumpyTorus(16);
  std::ofstream obj(std::filesystem::path(file).parent_path() / "ring.obj");
  for (const glm::vec3& p : ring.positions) obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const glm::uvec3& t : ring.triangles)
    obj << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
  obj.close();
  const auto triangles = [&](const std::vector<std::string>& asked) {
    std::vector<std::string> words{file, "-o", out("a.glb")};
    words.insert(words.end(), asked.begin(), asked.end());
    return report(words)["outputs"].back()["total"]["triangles"].get<int>();
  };
  EXPECT_EQ(triangles({}), 512);
  EXPECT_LT(triangles({"--tolerance", "5%"}), 400);
}

TEST_F(Export, UnitesOnlyThePartAskedFor) {
  const Json output = report({scene(kOverlappingCubes), "-o", out("a.stl"), "--only", "right"})["outputs"][0];
  EXPECT_EQ(output["parts"][0]["name"], "right");
  EXPECT_NEAR(volumeOf(load(out("a.stl"))), 8.0, 24.0 * 0.01 * 0.01);  // 24: its edges; 1/200 of its side
}

TEST_F(Export, ReportsEveryFigureOfEachPartAndInTotal) {
  const Json all = report({scene(kTwoParts), "-o", out("a.glb"), "--voxel-size", "0.0625"});
  EXPECT_EQ(all["outputs"].size(), 1u);
  const Json& output = all["outputs"][0];
  EXPECT_EQ(output["file"], out("a.glb"));
  ASSERT_EQ(output["parts"].size(), 2u);
  EXPECT_EQ(output["parts"][0]["name"], "ball");
  EXPECT_EQ(output["parts"][1]["name"], "block");
  std::vector<Json> lines(output["parts"].begin(), output["parts"].end());
  lines.push_back(output["total"]);
  for (const Json& line : lines) {
    EXPECT_EQ(line["voxel_size"], 0.0625);
    for (const char* key : {"seconds", "peak_memory_bytes", "voxels", "vertices", "triangles"}) {
      EXPECT_GT(line[key].get<double>(), 0.0) << key;
    }
    if (line["name"] != "block") {  // whose faces and edges are met exactly
      EXPECT_GT(line["rms_distance"].get<double>(), 0.0);
    }
    EXPECT_LE(line["rms_distance"], line["max_distance"]);
    EXPECT_LT(line["max_distance"].get<double>(),
              0.0625);  // vertices lie on the surface and edges are voxels long
    EXPECT_EQ(line["farthest"].size(), 3u);
    EXPECT_EQ(line["watertight"], true);
    EXPECT_EQ(line["manifold"], true);
    EXPECT_EQ(line["self_intersections"], 0);
    EXPECT_TRUE(line["first_self_intersection"].is_null());
    EXPECT_FALSE(line["stage_seconds"].empty());
  }
  EXPECT_EQ(output["parts"][0]["components"], 1);
  EXPECT_EQ(output["parts"][0]["euler_characteristic"], 2);
  const auto volumeOf = [](const Json& line) { return line["volume"].get<double>(); };
  const Json &ball = output["parts"][0], &block = output["parts"][1];
  EXPECT_EQ(volumeOf(output["total"]), volumeOf(ball) + volumeOf(block));
  EXPECT_NEAR(volumeOf(ball), 4.0 / 3.0 * std::numbers::pi, 0.03);
  EXPECT_NEAR(volumeOf(block), 1.0, 1e-5);
  EXPECT_NEAR(block["area"].get<double>(), 6.0, 1e-5);
  EXPECT_NEAR(block["centre_of_mass"][0].get<double>(), 2.0, 1e-5);
  EXPECT_EQ(output["total"]["components"], 2);
  EXPECT_EQ(output["total"]["euler_characteristic"], 4);
  for (const char* stage : {"script", "writing"})
    EXPECT_TRUE(output["total"]["stage_seconds"].contains(stage)) << stage;
  double stages = 0.0;
  for (const auto& [name, seconds] : output["total"]["stage_seconds"].items())
    stages += seconds.get<double>();
  EXPECT_LE(stages,
            output["total"]["seconds"].get<double>() * (1.0 + 1e-12));  // sums of doubles, in another order
}

TEST_F(Export, WarnsOfWhatFallsBetweenTheSamples) {
  // Four tenths of a voxel thick, midway between two planes of samples.
  const std::string file =
      scene("part('pair', union({sphere(0.5), box({0.02, 0.4, 0.4}):translate({0.75, 0, 0})}))");
  const std::vector<std::string> arguments{file, "-o", out("a.glb"), "--voxel-size", "0.1"};
  const std::string warned = run(arguments).err;
  EXPECT_NE(
      warned.find("sdf2gltf: warning: part 'pair': solids or gaps thinner than a voxel were missed, the "
                  "first near ("),
      std::string::npos)
      << warned;
  const std::string before = "take --voxel-size ";
  ASSERT_NE(warned.find(before), std::string::npos) << warned;
  const std::string rest = warned.substr(warned.find(before) + before.size());
  EXPECT_EQ(rest.substr(rest.find(' ')), " to see them\n");
  const std::string named = rest.substr(0, rest.find(' '));
  EXPECT_NEAR(std::stod(named), 0.04 / std::sqrt(3.0), 0.001) << "two digits";

  EXPECT_EQ(
      run({file, "-o", out("a.glb"), "--voxel-size", "0.1", "--quiet", "--report", out("report.json")}).err,
      "");
  const Json part = Json::parse(contents(out("report.json")))["outputs"][0]["parts"][0];
  EXPECT_EQ(part["components"], 1);
  EXPECT_GT(part["unresolved"], 0);
  EXPECT_NEAR(part["first_unresolved"][0].get<double>(), 0.75, 0.1);  // a voxel
  EXPECT_NEAR(part["resolving_voxel_size"].get<double>(), 0.04 / std::sqrt(3.0),
              16 * FLT_EPSILON);  // of positions near 1

  const Json fine = report({file, "-o", out("a.glb"), "--voxel-size", named})["outputs"][0]["parts"][0];
  EXPECT_EQ(fine["components"], 2);
  EXPECT_EQ(fine["unresolved"], 0);
  EXPECT_TRUE(fine["first_unresolved"].is_null());
  EXPECT_TRUE(fine["resolving_voxel_size"].is_null());
}

TEST_F(Export, WarnsOfAnOffsetThatIsOff) {
  const std::string file = scene("return ellipsoid_bound(1, 0.5, 0.3):round(0.1)");
  const Outcome outcome = run({file, "-o", out("a.glb"), "--voxel-size", "0.1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("sdf2gltf: warning: " + file + ":1: round: the surface is 0.1 to 0.2"))
      << outcome.err;
}

// The wall's two sides are 0.1 apart, not 0.025: each cube by powers grown or shrunk by 0.05.
TEST_F(Export, MakesTheWallOfAFieldAsThickAsAskedFor) {
  const std::string file = scene(
      "return field(function(x, y, z) return x^4 + y^4 + z^4 - 1 end,\n"
      "  {bounds = {{-1, -1, -1}, {1, 1, 1}}}):shell(0.1)");
  const Outcome outcome =
      run({file, "-o", out("a.glb"), "--voxel-size", "0.04", "--report", out("report.json")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
  const Json part = Json::parse(contents(out("report.json")))["outputs"][0]["parts"][0];
  EXPECT_EQ(part["components"], 2);
  const Json position = glbJson(out("a.glb"))["accessors"][1];
  EXPECT_NEAR(position["max"][0].get<double>(), 1.05, 0.01);
}

TEST_F(Export, WarnsOfADistanceThatIsNotANumber) {
  // In half of space the ball's formula has a root of a negative number.
  const std::string file = scene(
      "part('half', field(function(x, y, z) return sqrt(x * x + y * y + z * z) - 1 + 0 * sqrt(x) end,"
      " {bounds = {{-2, -2, -2}, {2, 2, 2}}}))");
  const std::vector<std::string> arguments{file, "-o", out("a.glb"), "--voxel-size", "0.1"};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("sdf2gltf: warning: part 'half': the distance is not a number at "),
            std::string::npos)
      << outcome.err;
}

// Beyond the circle the dome's formula is no number, and a maximum takes the box alone.
TEST_F(Export, RefusesAMeshOfWhatIsNoNumberByItsFormula) {
  const std::string file = scene(
      "local dome = field(function(x, y, z)\n"
      "  return y - sqrt(1 - x * x - z * z) end, {bounds = {{-1.5, -0.5, -1.5}, {1.5, 1.5, 1.5}}})\n"
      "return dome & box(2, 1.2, 2):translate(0, 1.2, 0)");
  const Outcome outcome = run({file, "-o", out("a.glb")});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("the formula at " + file + ":2 is no number at ("), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("leaves the bounds"), std::string::npos) << outcome.err;
}

// A note is there before the work that may take long, and once for all moments.
TEST_F(Export, SaysWhatIsWrongWithASceneBeforeItIsMeshed) {
  const std::string noted = scene(
      "local ring = torus(0.42, 0.1):scale(1, 1.15, 1):translate(0.82, 0, 0)\n"
      "return union(cylinder(0.72, 0.8), ring, {k = 0.14}):difference(cylinder(0.6, 0.7), {k = 0.05})");
  const Outcome refused = run({noted, "-o", out("a.glb"), "--tolerance", "1e-9%"});
  EXPECT_NE(refused.status, 0);
  const std::size_t note = refused.err.find("sdf2gltf: warning: " + noted + ":2: difference: what it blends");
  ASSERT_NE(note, std::string::npos) << refused.err;
  EXPECT_LT(note, refused.err.find("a tolerance of")) << refused.err;
  const Outcome sequence = run(
      {noted, "-o", out("b.glb"), "--report", out("report.json"), "--voxel-size", "0.2", "--frames", "2"});
  EXPECT_EQ(sequence.status, 0);
  const auto noteAt = [&](std::size_t from) { return sequence.err.find("what it blends", from); };
  ASSERT_NE(noteAt(0), std::string::npos) << sequence.err;
  EXPECT_EQ(noteAt(noteAt(0) + 1), std::string::npos) << sequence.err;
  for (const auto& file : nlohmann::json::parse(contents(out("report.json")))["outputs"])
    EXPECT_EQ(file["warnings"].size(), 1u);
  EXPECT_EQ(run({noted, "-o", out("c.glb"), "--voxel-size", "0.2", "--quiet"}).err, "");
}

// Letters, drawings and strokes that are only extruded have their own walls.
TEST_F(Export, WritesTheSampleOfDrawingsWithoutWarnings) {
  const Outcome outcome = run({SDF_SOURCE_DIR "/samples/drawings/sign.lua", "-o", out("a.glb"), "--report",
                               out("report.json"), "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  const auto file = nlohmann::json::parse(contents(out("report.json")))["outputs"][0];
  EXPECT_EQ(file["warnings"].size(), 0u);
  for (const auto& part : file["parts"]) {
    EXPECT_LE(part["max_distance"].get<double>(), part["tolerance"].get<double>()) << part["name"];
    EXPECT_EQ(part["self_intersections"], 0) << part["name"];
  }
}

// Between balls that touch there is a gap thinner than any voxel, of which nothing is lost.
TEST_F(Export, DoesNotWarnOfWhatTouches) {
  const std::string file = scene("return sphere(1) | sphere(1):translate(2, 0, 0)");
  const Outcome outcome = run({file, "-o", out("a.glb"), "--report", out("report.json")});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

TEST_F(Export, SamplesAllPartsAlikeUnlessToldOtherwise) {
  const Json output = report({scene(kTwoParts), "-o", out("a.glb")})["outputs"][0];
  // Both together reach from -1 to 2.5.
  EXPECT_DOUBLE_EQ(output["parts"][0]["voxel_size"].get<double>(), 3.5 / 200);
  EXPECT_DOUBLE_EQ(output["parts"][1]["voxel_size"].get<double>(), 3.5 / 200);
}

TEST_F(Export, KeepsATwoThousandthOfTheDiagonalUnlessToldOtherwise) {
  const std::string file = scene(kTwoParts);
  const Json output = report({file, "-o", out("a.glb")})["outputs"][0];
  const double diagonal = std::sqrt(3.5 * 3.5 + 2.0 * 2.0 + 2.0 * 2.0);
  for (const Json& part : output["parts"]) {
    EXPECT_DOUBLE_EQ(part["tolerance"].get<double>(), diagonal / 2000);
    EXPECT_LE(part["max_distance"], part["tolerance"]);
  }
  EXPECT_EQ(output["parts"][1]["triangles"], 12);
  const Json uniform = report({file, "-o", out("a.glb"), "--voxel-size", "0.05"})["outputs"][0]["parts"][1];
  EXPECT_TRUE(uniform["tolerance"].is_null());
  EXPECT_GT(uniform["triangles"], 1000);
}

// A crescent runs out to nothing at its horns.
TEST_F(Export, SaysWhereTheToleranceOfItsOwnIsNotKept) {
  const std::string file = scene("return sphere(0.5) - sphere(0.5):translate(0.01, 0, 0)");
  const Outcome outcome = run({file, "-o", out("a.glb"), "--report", out("report.json")});
  EXPECT_EQ(outcome.status, 0);
  for (const char* words :
       {"sdf2gltf: warning: part 'part 1': the tolerance of 0.00087 is not kept everywhere: ", " off near (",
        "; --voxel-size 0.0025 may keep it there\n"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  const Json part = Json::parse(contents(out("report.json")))["outputs"][0]["parts"][0];
  EXPECT_TRUE(part["watertight"]);
  EXPECT_EQ(part["self_intersections"], 0);
  EXPECT_GT(part["max_distance"], part["tolerance"]);
  // The mesh ends where the crescent is too thin for it, 0.066 before its rim; points are found over most of
  // that.
  EXPECT_GT(part["max_distance"].get<double>(), 0.03);
  EXPECT_LT(part["max_distance"].get<double>(), 0.07);
}

TEST_F(Export, GoesOnWhereAToleranceIsNotKept) {
  const std::string file = scene("return sphere(0.5) - sphere(0.5):translate(0.01, 0, 0)");
  const Outcome refused = run({file, "-o", out("a.glb"), "--tolerance", "0.001"});
  EXPECT_EQ(refused.status, 4);
  EXPECT_NE(refused.err.find("(sdf2gltf: --keep-going)"), std::string::npos) << refused.err;
  EXPECT_TRUE(written().empty());
  const Outcome outcome = run({file, "-o", out("a.glb"), "--tolerance", "0.001", "--keep-going"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("the tolerance of 0.001 is not kept everywhere: "), std::string::npos)
      << outcome.err;
  EXPECT_EQ(written(), std::vector<std::string>{"a.glb"});
  // Elsewhere nothing changes.
  const std::string ball = scene("return sphere(0.5)");
  expectSuccess(run({ball, "-o", out("a.glb"), "--tolerance", "0.001"}));
  expectSuccess(run({ball, "-o", out("b.glb"), "--tolerance", "0.001", "--keep-going"}));
  EXPECT_TRUE(contents(out("a.glb")) == contents(out("b.glb")));
}

TEST_F(Export, MeshesAnySizeAlike) {
  const auto totalAt = [&](const std::string& size) {
    const std::string file = scene("local s = " + size + " return box(s, 0.51 * s, 0.33 * s)");
    return report({file, "-o", out("a.glb")})["outputs"][0]["total"];
  };
  const Json one = totalAt("1");
  for (const char* size : {"1e-6", "1e6"}) {
    const Json other = totalAt(size);
    for (const char* figure : {"watertight", "unresolved", "components", "euler_characteristic"})
      EXPECT_EQ(other[figure], one[figure]) << size << " " << figure;
    // Rounding decides on which side of an edge a vertex lies that is right on it.
    EXPECT_NEAR(other["triangles"].get<double>(), one["triangles"].get<double>(),
                1e-3 * one["triangles"].get<double>());
    const double scale = std::stod(size), voxel = one["voxel_size"];
    EXPECT_NEAR(other["voxel_size"].get<double>() / scale, voxel, 1e-12 * voxel) << size;
  }
}

TEST_F(Export, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::string file = scene(kTwoParts);
  for (const char* extension : {".glb", ".stl"}) {
    std::vector<std::string> bytes;
    for (const char* threads : {"1", "2", "7"}) {
      const std::string name = out(std::string("t") + threads + extension);
      expectSuccess(run({file, "-o", name, "--threads", threads}));
      bytes.push_back(contents(name));
    }
    EXPECT_FALSE(bytes[0].empty());
    EXPECT_TRUE(bytes[0] == bytes[1] && bytes[1] == bytes[2]) << extension;
  }
}

// The second is done long before the first.
constexpr const char* kSlowAndQuick =
    "part('slow', union{sphere(1), sphere(0.8):translate(1, 0.4, 0), k = 0.3}) part('quick', box(0.3))\n";

TEST_F(Export, KeepsTheOrderOfPartsThatAreMeshedBesideOneAnother) {
  const Json parts =
      report({scene(kSlowAndQuick), "-o", out("a.glb"), "--threads", "2"})["outputs"][0]["parts"];
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0]["name"], "slow");
  EXPECT_EQ(parts[1]["name"], "quick");
  EXPECT_EQ(parts[1]["triangles"], 12);
  EXPECT_LT(parts[1]["seconds"].get<double>(), parts[0]["seconds"].get<double>());
  EXPECT_EQ(glbJson(out("a.glb"))["meshes"][0]["name"], "slow");
}

TEST_F(Export, ShowsTheFirstPartThatIsNotDone) {
  Command command = Export::command({scene(kSlowAndQuick), "-o", out("a.glb"), "--threads", "2"});
  command.terminal = true;
  const Outcome outcome = command.run();
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("part 'slow' (1 of 2): simplifying"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("part 'quick'"), std::string::npos) << outcome.err;
}

TEST_F(Export, NamesTheFirstPartThatCannotBeMeshed) {
  const std::string file = scene(std::string(kSlowAndQuick) +
                                 "part('hollow', box(1) - box(1.2)) part('void', sphere(0.3) - sphere(0.4))");
  for (const char* threads : {"1", "2", "7"}) {
    const Outcome outcome = run({file, "-o", out("a.glb"), "--threads", threads});
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("part 'hollow': no surface inside"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("part 'void'"), std::string::npos) << outcome.err;
  }
  EXPECT_TRUE(written().empty());
}

TEST_F(Export, StopsAllPartsWhenInterrupted) {
  Command command =
      Export::command({scene("for i = 1, 3 do part('p' .. i, gyroid(0.2, 0.05) & sphere(2)) end"), "-o",
                       out("a.glb"), "--threads", "2"});
  command.signal = SIGINT;
  command.signalAfter = 0.0;  // once there is a line
  const Outcome outcome = command.run();
  ASSERT_FALSE(outcome.endedBeforeSignal) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\nsdf2gltf: interrupted\n")) << outcome.err;
  EXPECT_TRUE(written().empty());
}

TEST_F(Export, OnlyExportsThePartAskedFor) {
  expectSuccess(run({scene(kTwoParts), "-o", out("a.glb"), "--only", "block"}));
  const Json gltf = glbJson(out("a.glb"));
  EXPECT_EQ(gltf["meshes"].size(), 1u);
  EXPECT_EQ(gltf["nodes"][0]["name"], "block");
}

TEST_F(Export, ParametersChangeTheScene) {
  const std::string file = scene("local r = param('r', 1, {min = 0.1, max = 3}) return sphere(r)");
  const Json report = Export::report({file, "-o", out("a.glb"), "-D", "r=2", "--voxel-size", "0.25"});
  EXPECT_EQ(report["parameters"]["r"], 2.0);
  const Json position = glbJson(out("a.glb"))["accessors"][1];
  EXPECT_NEAR(position["max"][0].get<double>(), 2.0, 0.25);
}

TEST_F(Export, BoundsClipTheSceneClosed) {
  const Json total = report({scene("return plane({0, 1, 0})"), "-o", out("a.glb"), "--bounds",
                             "-1,-1,-1,1,1,1", "--voxel-size", "0.1"})["outputs"][0]["total"];
  EXPECT_EQ(total["watertight"], true);
  EXPECT_EQ(total["euler_characteristic"], 2);
}

TEST_F(Export, FramesAreNumberedFilesAtTheirTimes) {
  const std::string moving = scene("return sphere(1):translate({time, 0, 0})");
  const Json report = Export::report({moving, "-o", out("a.glb"), "--frames", "3", "--fps", "2", "-t", "1"});
  EXPECT_EQ(written(), (std::vector<std::string>{"a_0001.glb", "a_0002.glb", "a_0003.glb", "report.json"}));
  ASSERT_EQ(report["outputs"].size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const Json& output = report["outputs"][i];
    EXPECT_EQ(output["time"], 1.0 + i / 2.0);
    const double voxelSize = output["total"]["voxel_size"];
    EXPECT_EQ(voxelSize, report["outputs"][0]["total"]["voxel_size"]);
    const Json position = glbJson(output["file"])["accessors"][1];
    EXPECT_NEAR(position["max"][0].get<double>(), 2.0 + i / 2.0, voxelSize);
  }
}

TEST_F(Export, FramesNameTheirMaterialsAsASingleRunDoes) {
  const std::string file = scene(
      "part('a', sphere(1):paint('#f00') | sphere(time):paint{name = 'b'}:translate(0, 1, 0))"
      "part('c', sphere(1):paint{shininess = 4}:translate(3, 0, 0))");
  expectSuccess(
      run({file, "-o", out("f.glb"), "-t", "0.5", "--frames", "2", "--fps", "1", "--voxel-size", "0.2"}));
  expectSuccess(run({file, "-o", out("s.glb"), "-t", "1.5", "--voxel-size", "0.2"}));
  for (const char* name : {"f_0001.glb", "f_0002.glb", "s.glb"}) {
    const Json materials = glbJson(out(name))["materials"];
    ASSERT_EQ(materials.size(), 3u) << name;
    EXPECT_EQ(materials[0]["name"], "material 1") << name;
    EXPECT_EQ(materials[1]["name"], "b") << name;
    EXPECT_EQ(materials[2]["name"], "material 3") << name;
  }
  EXPECT_TRUE(contents(out("f_0002.glb")) == contents(out("s.glb")));
}

TEST_F(Export, FramesTakeTheirPlaceInAPattern) {
  const std::string file = scene(kSphere);
  expectSuccess(run({file, "-o", out("b_%03d_%x.ply"), "--frames", "2", "--voxel-size", "0.5"}));
  expectSuccess(run({file, "-o", out("%d.ply"), "--frames", "1", "--voxel-size", "0.5"}));
  EXPECT_EQ(written(), (std::vector<std::string>{"1.ply", "b_001_%x.ply", "b_002_%x.ply"}));
}

TEST_F(Export, TellsOfItsProgressInLinesElsewhere) {
  Command command = Export::command({scene("return gyroid(0.5, 0.1) & sphere(3)"), "-o", out("a.glb"),
                                     "--voxel-size", "0.02", "--threads", "1"});
  command.signal = SIGINT;
  command.signalAfter = 0.0;  // once there is a line
  const Outcome outcome = command.run();
  ASSERT_FALSE(outcome.endedBeforeSignal) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("sdf2gltf: after 1 s: part 'part 1' (1 of 1): ")) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("\nsdf2gltf: interrupted\n")) << outcome.err;
}

TEST_F(Export, ShowsItsProgressInPlaceOnATerminal) {
  const std::string file = scene(kTwoParts);
  Command command = Export::command({file, "-o", out("a.glb"), "--voxel-size", "0.01"});
  command.terminal = true;
  const Outcome outcome = command.run();
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("part 'ball' (1 of 2): "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("part 'block' (2 of 2): "), std::string::npos);
  EXPECT_EQ(outcome.err.find('\n'), std::string::npos);
  EXPECT_EQ(outcome.err.substr(outcome.err.size() - 4), "\r\x1b[K");  // nothing stays on the line
  command.words.push_back("--quiet");
  EXPECT_EQ(command.run().err, "");
}

}  // namespace export_test
}  // namespace sdf
