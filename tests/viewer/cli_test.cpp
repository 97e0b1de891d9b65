// The command line of sdfview, over the program as it was built: every option, and what goes wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/folder.h"
#include "tools/command.h"
#include "viewer/gpu/read_png.h"

namespace sdf {
namespace cli_test {

using viewer::Picture;

constexpr const char* kBall = "return sphere(1)";
// Moves with time, and grows with its parameter.
constexpr const char* kMoving =
    "camera{from = {3.4, 2.6, 4.6}, to = {0, 0, 0}}\n"
    "part('ball', sphere(param('size', 1, {min = 0.1, max = 2})):translate(time, 0, 0))";
constexpr int kUsage = 2, kScene = 3, kLimits = 4, kFiles = 5, kGraphics = 6;

class Sdfview : public testing::Test {
 protected:
  std::string scene(const std::string& text) {
    const auto file = folder / "scene.lua";
    std::ofstream(file) << text;
    return file.string();
  }
  std::string at(const std::string& name) const { return (folder / name).string(); }

  static Outcome run(std::vector<std::string> arguments, std::vector<std::string> environment = {}) {
    Command command{{"/usr/bin/env"}};
    for (const auto* part : {&environment, &arguments}) {
      command.words.insert(command.words.end(), part->begin(), part->end());
      if (part == &environment) command.words.push_back(SDFVIEW_PROGRAM);
    }
    Outcome outcome = command.run();
    outcome.err = withoutProgress(outcome.err);
    return outcome;
  }

  // What takes longer than a second, as on a busy machine, says how far it is.
  static std::string withoutProgress(const std::string& text) {
    static const std::regex line("sdfview: after [^\n]*\n");
    return std::regex_replace(text, line, "");
  }

  /// The picture that these options draw, without a word.
  Picture drawn(const std::string& text, std::vector<std::string> options,
                const std::string& size = "32x24") {
    const std::string file = at("drawn.png");
    options.insert(options.begin(), {scene(text), "--render", file, "--size", size});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    return read(file);
  }
  static Picture read(const std::string& file) { return test::readPng(file); }

  void expectRefused(int status, const std::string& words, const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    std::string line;
    for (const std::string& a : arguments) line += a + " ";
    EXPECT_EQ(outcome.status, status) << line << outcome.err;
    EXPECT_EQ(outcome.out, "") << line;
    EXPECT_EQ(outcome.err.rfind("sdfview: ", 0), 0u) << line << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << line << outcome.err;
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  const Folder folder;
};

TEST_F(Sdfview, SaysWhatItCanDo) {
  const Outcome help = run({"--help"}), version = run({"--version"});
  EXPECT_EQ(help.status, 0);
  for (const char* word :
       {"SCENE",        "--render",
        "--size",       "--time",
        "--samples",    "--seconds",
        "--steps",      "--view",
        "--method",     "--start",
        "--no-culling", "--no-cache",
        "--compare",    "-D",
        "--camera",     "--fit",
        "--frames",     "--fps",
        "--bench",      "--glsl",
        "--version",    "--tolerance",
        "--voxel-size", "--mesh",
        "--split",      "0 done, 2 usage, 3 scene, 4 limits, 5 files, 6 graphics, 130 interrupted"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("sdfview ", 0), 0u) << version.out;
  EXPECT_EQ(help.err + version.err, "");
}

// As sdf2gltf says it.
TEST_F(Sdfview, RefusesWhatFloatsCannotHold) {
  const struct {
    const char* scene;
    const char* words;
  } cases[] = {
      {"part('far', sphere(1):translate(1e308, 0, 0))", "part 'far': it reaches 1e+308 from the origin"},
      {"part('small', sphere(5e-324))", "part 'small': its bounds are 9.88"},
      {"part('small', sphere(1):scale(5e-324))", "part 'small': its bounds are 9.88"},
      {"camera{from = {0, 1, 3}, to = {0, 0, 0}} part('floor', plane({0, 1, 0}, 1e40))",
       "part 'floor': it reaches 1e+40 from the origin"}};
  for (const auto& c : cases)
    for (const auto& [option, name] : {std::pair("--render", "a.png"), std::pair("--glsl", "a.glsl")})
      expectRefused(kScene, c.words, {scene(c.scene), option, at(name)});
}

TEST_F(Sdfview, NamesWhatIsWrongWithAnOption) {
  const std::string s = scene(kBall), png = at("a.png");
  const struct {
    std::vector<std::string> options;
    const char* words;
  } cases[] = {
      {{"--size", "10"}, "--size needs WIDTHxHEIGHT in whole pixels from 1, got '10'"},
      {{"--size", "10x"}, "got '10x'"},
      {{"--size", "0x10"}, "got '0x10'"},
      {{"--size", "10x-3"}, "got '10x-3'"},
      {{"--size", "1.5x3"}, "got '1.5x3'"},
      {{"--size", "nanxinf"}, "got 'nanxinf'"},
      {{"--size", "9x9x9"}, "got '9x9x9'"},
      {{"--size", "99999999999x1"}, "got '99999999999x1'"},
      {{"--samples", "2"}, "--samples needs a square from 1 to 1024 (1, 4, 9, ...), got '2'"},
      {{"--samples", "0"}, "got '0'"},
      {{"--samples", "-4"}, "got '-4'"},
      {{"--samples", "1089"}, "got '1089'"},
      {{"--samples", "four"}, "got 'four'"},
      {{"--seconds", "0"}, "--seconds needs a number above 0, got '0'"},
      {{"--seconds", "soon"}, "got 'soon'"},
      {{"--steps", "0"}, "--steps needs a whole number from 1 to 100000, got '0'"},
      {{"--steps", "2.5"}, "got '2.5'"},
      {{"--steps", "1e6"}, "got '1e6'"},
      {{"--time", "soon"}, "--time needs a finite number of seconds, got 'soon'"},
      {{"-t", "inf"}, "got 'inf'"},
      {{"--frames", "0"}, "--frames needs a whole number from 1 to 100000, got '0'"},
      {{"--frames", "2", "--fps", "0"}, "--fps needs a number above 0, got '0'"},
      {{"--fps", "24"}, "--fps says how fast --frames N go by; add --frames or leave --fps out"},
      {{"--bench", "0"}, "--bench needs a whole number from 1 to 100000, got '0'"},
      {{"--view", "front"},
       "--view needs picture, normals, steps, slice, gradient, material, occlusion, shadow, mesh, wire, "
       "split "
       "or error"},
      {{"--tolerance", "0"}, "--tolerance needs a number above 0, of scene units or with % of the diagonal"},
      {{"--view", "mesh", "--tolerance", "much%"}, "got 'much%'"},
      {{"--view", "mesh", "--voxel-size", "-1"}, "--voxel-size needs a number above 0, got '-1'"},
      {{"--view", "split", "--split", "1"}, "--split needs a share of the width between 0 and 1, got '1'"},
      {{"--view", "split", "--split", "left"}, "got 'left'"},
      {{"--tolerance", "0.01"},
       "--tolerance is about a mesh, which --view picture does not show; add --view mesh, wire, split or "
       "error, or leave --tolerance out"},
      {{"--view", "normals", "--voxel-size", "0.1"}, "--voxel-size is about a mesh, which --view normals"},
      {{"--view", "steps", "--mesh", "a.glb"}, "--mesh is about a mesh, which --view steps does not show"},
      {{"--view", "mesh", "--split", "0.3"},
       "--split says where --view split is divided; add that, or leave --split out"},
      {{"--view", "mesh", "--mesh", "a.glb", "--voxel-size", "0.1"},
       "--voxel-size is of the scene's own mesh, and --mesh shows a file's; leave one of them out"},
      {{"--view", "error", "--mesh", "a.glb", "--tolerance", "1%"}, "say it in scene units"},
      {{"--view", "wire", "--mesh", "a.glb", "--tolerance", "0.1"},
       "--tolerance beside --mesh says what --view error compares the file with"},
      {{"--view", "mesh", "--mesh", "a.fbx"}, "'a.fbx' has the unknown extension '.fbx'"},
      {{"--view", "error", "--glsl", "a.glsl"},
       "--glsl writes a shader that marches the scene, which --view error does not; leave one of them out"},
      {{"--method", "fast"}, "--method needs auto or plain, got 'fast'"},
      {{"--start", "mesh"}, "--start needs raster, cone or plain, got 'mesh'"},
      {{"--camera", "0,0,5"}, "--camera needs six numbers x,y,z,x,y,z, or seven with the field of view"},
      {{"--camera", "0,0,5,0,0,0,"}, "got '0,0,5,0,0,0,'"},
      {{"--camera", "0,0,5,0,0,up"}, "got '0,0,5,0,0,up'"},
      {{"--camera", "1,2,3,1,2,3"}, "--camera needs two different places"},
      {{"--camera", "0,0,5,0,0,0,180"}, "--camera needs a field of view between 0 and 180 degrees"},
      {{"--camera", "0,0,5,0,0,0,0"}, "between 0 and 180"},
      {{"-D", "size"}, "-D needs name=value with a finite number, got 'size'"},
      {{"-D", "=1"}, "got '=1'"},
      {{"-D", "a=nan"}, "got 'a=nan'"},
      {{"-D", "a=1", "-D", "a=2"}, "-D sets 'a' twice; keep one"},
      {{"--view", "steps", "--view", "slice"}, "--view takes one value and can be given once"},
      {{"--size"}, "--size"},
      {{"--nothing"}, "--nothing"},
      {{"second.lua"}, "second.lua"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> all{s, "--render", png};
    all.insert(all.end(), c.options.begin(), c.options.end());
    expectRefused(kUsage, c.words, all);
  }
  expectRefused(kUsage, "SCENE is required; see sdfview --help", {});
  expectRefused(kUsage, "add --render", {s, "--frames", "2", "--glsl", at("a.glsl")});
  expectRefused(kUsage, "--seconds says how long --render OUT.png refines; add --render",
                {s, "--seconds", "2"});
  // Nothing of the scene is looked at before.
  for (const char* name : {"a.jpg", "a.png.jpeg", "a%04d.exr"})
    expectRefused(kUsage,
                  "'" + at(name) + "' has the unknown extension '" +
                      std::filesystem::path(name).extension().string() +
                      "'; the output's name must end in .png",
                  {at("nowhere.lua"), "--render", at(name)});
  expectRefused(kUsage, "has no extension; the output's name must end in .png", {s, "--render", at("a")});
  expectRefused(kUsage, "more than one place for the frame's number",
                {s, "--frames", "2", "--render", at("%d_%d.png")});
  EXPECT_EQ(files(), std::vector<std::string>{"scene.lua"});
}

TEST_F(Sdfview, DrawsMeshes) {
  const std::string camera = "camera{from = {0, 0, 5}, to = {0, 0, 0}}\n";
  const std::string ball = camera + kBall;
  const Picture picture = drawn(ball, {}), mesh = drawn(ball, {"--view", "mesh"});
  const auto column = [](const Picture& p, int x) {
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < p.height; ++y)
      for (int k = 0; k < p.channels; ++k)
        bytes.push_back(p.bytes[static_cast<std::size_t>(p.channels * (y * p.width + x) + k)]);
    return bytes;
  };
  const Picture coarse = drawn(ball, {"--view", "mesh", "--voxel-size", "0.5"}),
                tolerant = drawn(ball, {"--view", "mesh", "--tolerance", "5%"});
  EXPECT_NE(coarse.bytes, mesh.bytes);
  EXPECT_NE(tolerant.bytes, mesh.bytes);
  EXPECT_NE(drawn(ball, {"--view", "wire", "--voxel-size", "0.5"}).bytes, coarse.bytes);
  const Picture split = drawn(ball, {"--view", "split", "--voxel-size", "0.5", "--split", "0.25"});
  for (int x = 0; x < split.width; ++x)
    EXPECT_EQ(column(split, x), column(4 * x < split.width ? picture : coarse, x)) << x;
  EXPECT_EQ(drawn(ball, {"--view", "split", "--voxel-size", "0.5"}).bytes,
            drawn(ball, {"--view", "split", "--voxel-size", "0.5", "--split", "0.5"}).bytes);
}

TEST_F(Sdfview, DrawsErrorsWithALegend) {
  const Picture error = drawn(kBall, {"--view", "error", "--tolerance", "0.01"}, "480x360");
  // The colour of what is beyond the tolerance is in the legend only: the mesh keeps it.
  int beyond = 0;
  for (std::size_t i = 0; i < error.bytes.size(); i += 4)
    beyond += error.bytes[i] == 255 && error.bytes[i + 1] == 217 && error.bytes[i + 2] == 0;
  EXPECT_GE(beyond, 20);
  EXPECT_LE(beyond, 200);
}

TEST_F(Sdfview, ShowsAMeshFromAFileAgainstTheScene) {
  std::ofstream(folder / "tip.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string tip = at("tip.obj");
  const Picture own = drawn(kBall, {"--view", "mesh"});
  EXPECT_NE(drawn(kBall, {"--view", "mesh", "--mesh", tip}).bytes, own.bytes);
  drawn(kBall, {"--view", "error", "--mesh", tip, "--tolerance", "0.5"});
  // A scene that has no end cannot be meshed, but a file can be held against it.
  drawn("return plane()", {"--view", "error", "--mesh", tip});
  const auto refuse = [&](int status, const std::string& words, const std::string& text,
                          std::vector<std::string> options) {
    options.insert(options.begin(), {scene(text), "--render", at("a.png"), "--size", "32x24"});
    expectRefused(status, words, options);
  };
  refuse(kFiles, "none.glb", kBall, {"--view", "mesh", "--mesh", at("none.glb")});
  std::ofstream(folder / "broken.glb") << "no mesh";
  refuse(kFiles, "broken.glb", kBall, {"--view", "error", "--mesh", at("broken.glb")});
  // What is read stays as it is.
  expectRefused(kFiles, "choose another name", {scene(kBall), "--glsl", scene(kBall)});
  EXPECT_EQ(contents(scene(kBall)), kBall);
  refuse(kScene, "part 'part 1': unbounded in x, y and z; give bounds(", "return plane()",
         {"--view", "mesh"});
  refuse(kScene, "surface", "return sphere(1) - sphere(2)", {"--view", "error"});
}

TEST_F(Sdfview, MeshesEveryFrameOfASceneThatMoves) {
  const std::string png = at("f.png");
  const Outcome outcome =
      run({scene("camera{from = {0, 0, 5}, to = {0, 0, 0}}\nreturn sphere(1 - 0.5 * time)"), "--render", png,
           "--size", "32x24", "--view", "mesh", "--frames", "2", "--fps", "1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(read(at("f_0001.png")).bytes, read(at("f_0002.png")).bytes);
}

TEST_F(Sdfview, NamesWhatIsWrongWithAScene) {
  const std::string png = at("a.png");
  const auto refuse = [&](const std::string& text, const char* words, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {scene(text), "--render", png});
    expectRefused(kScene, words, options);
  };
  refuse("return sphere(", "scene.lua:1:");
  refuse("return sphere(-1)", "radius must be positive");
  refuse("", "scene.lua");
  const std::string cube = " return x * x * x - 1 end", root = " return sqrt(abs(x)) - 1 end";
  const std::string unknown =
      "the slope of this distance is not known, so rays cannot be marched to it; give its field() a "
      "lipschitz, "
      "or bounds within which the formula has one";
  const std::string box = ", {bounds = {{-1, -1, -1}, {1, 1, 1}}}";
  for (const auto& [text, line] : std::initializer_list<std::pair<std::string, int>>{
           {"return field(function(x)" + cube + ")", 1},
           {"return plane(), field(function(x)" + root + box + ")", 1},
           {"local f = field(function(x)" + cube + ")\npart('a', sphere(1))\npart('b', f:translate(1, 2, 3))",
            1},
           {"\nlocal f = field(function(x)" + cube + ")\nreturn union(sphere(1), f, {k = 0.1}):twist(3)", 2},
           {"part('a', sphere(1) | (\nfield(function(x)" + cube + ") - sphere(1)))", 2},
           {"local good = field(function(x)" + cube + box + ")\nreturn good |\nfield(function(x)" + cube +
                ")",
            3}})
    refuse(text, ("scene.lua:" + std::to_string(line) + ": " + unknown).c_str());
  const std::string displaced =
      "scene.lua:1: the slope of this distance is not known, so rays cannot be marched to it; let the "
      "formula have one for all places and all values of parameters: ";
  refuse("return sphere(1):displace(function(x) return x * x end)", displaced.c_str());
  refuse(kBall, "-D size: the scene has no parameter 'size'", {"-D", "size=2"});
  refuse(kMoving, "-D time: set the scene's clock with --time", {"-D", "time=2"});
  expectRefused(kFiles, "nowhere.lua: cannot be read", {at("nowhere.lua"), "--render", png});
  EXPECT_EQ(files(), std::vector<std::string>{"scene.lua"});
}

TEST_F(Sdfview, SaysWhichFormulaIsNoNumber) {
  const Outcome outcome = run({scene("return field(function(x, y, z) return length(x, y, z) - sqrt(x)\n"
                                     "end, {bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = 9})"),
                               "--render", at("a.png"), "--size", "16x16"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("sdfview: warning: part 'part 1': the formula at " + at("scene.lua") +
                                      ":1 is no number at (-"))
      << outcome.err;
}

// A blink: between 0.1 and 1, for all times.
TEST_F(Sdfview, DrawsWhatIsScaledBySmoothstep) {
  const Outcome outcome =
      run({scene("return box(1):scale(1, 1 - 0.9 * smoothstep(0.93, 0.97, sin(2 * time)), 1)"), "--render",
           at("a.png"), "--size", "16x16"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Sdfview, ReadsMeshesFromFoldersThatAreAllowed) {
  std::filesystem::create_directory(folder / "models");
  std::ofstream(folder / "models" / "tip.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  std::filesystem::create_directory(folder / "scenes");
  const std::string file = at("scenes/a.lua"), png = at("a.png");
  std::ofstream(file) << "return mesh('../models/tip.obj')";
  expectRefused(kScene, "--allow-dir", {file, "--render", png});
  const Outcome outcome = run({file, "--render", png, "--size", "32x24", "--allow-dir", at("models")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "sdfview: warning: ../models/tip.obj: 1 hole was closed\n");
  std::filesystem::remove_all(folder / "models");
  std::filesystem::remove_all(folder / "scenes");
}

TEST_F(Sdfview, ShowsTheRestWhereAMeshIsBroken) {
  const std::string rest = "camera{from = {3, 2, 4}, to = {0, 0, 0}} part('ball', sphere(1))";
  const Picture ball = drawn(rest, {});
  std::ofstream(folder / "empty.glb");
  std::ofstream(folder / "nan.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 nan 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream(folder / "draco.gltf")
      << R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"],
    "extensionsRequired": ["KHR_draco_mesh_compression"]})";
  for (const auto& [name, why] : std::initializer_list<std::pair<const char*, const char*>>{
           {"empty.glb", "it is empty"},
           {"nan.obj", "1 of its 4 vertices have coordinates that are no finite numbers"},
           {"draco.gltf", "it requires 'KHR_draco_mesh_compression', which is unknown here"},
           {"gone.stl", "No such file"},
           {"../up.glb", "lies outside of the scene's folder"}}) {
    const std::string file = scene(rest + "\npart('mesh', mesh('" + name + "'):round(0.1) | sphere(0.5))");
    const Outcome outcome = run({file, "--render", at("a.png"), "--size", "32x24"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("sdfview: warning: " + file + ":2: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with("; the rest is shown\n")) << outcome.err;
    EXPECT_EQ(read(at("a.png")).bytes, ball.bytes) << name;
  }
}

TEST_F(Sdfview, DrawsAFieldWithBoundsBesideWhatHasNone) {
  const std::string ball =
      "field(function(x, y, z) return x * x + y * y + z * z - 1 end, "
      "{bounds = {{-1, -1, -1}, {1, 1, 1}}})";
  const std::string floor = "part('floor', plane{offset = -1}) ambient(1) ";
  const Picture field = drawn(floor + "part('ball', " + ball + ")", {"--view", "material"}),
                sphere = drawn(floor + "part('ball', sphere(1))", {"--view", "material"});
  EXPECT_EQ(field.bytes, sphere.bytes);
}

TEST_F(Sdfview, RefinesForAsLongAsItIsTold) {
  const std::string lit =
      "point_light{position = {2, 3, 4}, radius = 1} shadows{} part('floor', plane{offset = -1}) "
      "part('ball', sphere(1))";
  const auto refined = [&](const std::string& text, std::vector<std::string> options) {
    options.insert(options.begin(), {scene(text), "--render", at("a.png"), "--size", "32x24"});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  const std::string told = "sdfview: " + at("a.png") + ": ";
  EXPECT_EQ(refined(kBall, {"--seconds", "100"}), told + "36 of 36 samples a pixel\n");
  const Picture settled = read(at("a.png")), expected = drawn(kBall, {"--samples", "36"});
  for (std::size_t i = 0; i < settled.bytes.size(); ++i)  // the sum's order decides how one is rounded
    ASSERT_NEAR(settled.bytes[i], expected.bytes[i], 1) << i;
  EXPECT_EQ(refined(lit, {"--seconds", "100"}), told + "256 of 256 samples a pixel\n");
  EXPECT_EQ(refined(lit, {"--seconds", "1e-9"}), told + "1 of 256 samples a pixel\n");
  EXPECT_EQ(refined(kBall, {"--seconds", "1e-9", "--samples", "400"}), told + "1 of 400 samples a pixel\n");
  EXPECT_EQ(refined(kBall, {"--seconds", "1e-9", "--samples", "4"}), told + "1 of 36 samples a pixel\n");
}

TEST_F(Sdfview, NamesPicturesThatAreTooLarge) {
  expectRefused(kLimits, "cannot draw 65536 x 1 pixels: this driver draws from 1 x 1 to",
                {scene(kBall), "--render", at("a.png"), "--size", "65536x1"});
}

TEST_F(Sdfview, NamesFilesThatCannotBeWritten) {
  const std::string s = scene(kBall);
  for (const char* flag : {"--render", "--glsl"}) {
    expectRefused(kFiles, "no/such/folder", {s, flag, at("no/such/folder/a.png"), "--size", "8x8"});
    const std::string taken = at("folder.png");
    std::filesystem::create_directory(taken);
    expectRefused(kFiles, taken, {s, flag, taken, "--size", "8x8"});
    std::filesystem::remove(taken);
  }
  EXPECT_EQ(files(), std::vector<std::string>{"scene.lua"});
}

TEST_F(Sdfview, NamesWhatGraphicsItLacks) {
  const std::vector<std::string> bare{"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY",
                                      "__EGL_VENDOR_LIBRARY_FILENAMES=/no/such/driver.json"};
  const std::string s = scene(kBall);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{s, "--render", at("a.png")}, {s, "--bench", "1"}, {s}}) {
    const Outcome outcome = run(arguments, bare);
    EXPECT_EQ(outcome.status, kGraphics) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("sdfview: ", 0), 0u) << outcome.err;
  }
  // A shader is text.
  EXPECT_EQ(run({s, "--glsl", at("a.glsl")}, bare).status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.glsl", "scene.lua"}));
}

TEST_F(Sdfview, DrawsThePictureAsLargeAsAsked) {
  for (const auto& [size, width, height] :
       {std::tuple("1x1", 1, 1), {"64x3", 64, 3}, {"3x64", 3, 64}, {"1280x720", 1280, 720}}) {
    const Picture picture = drawn(kBall, {}, size);
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4) ASSERT_EQ(picture.bytes[i], 255);
  }
}

TEST_F(Sdfview, DrawsTheSamePictureTwice) { EXPECT_EQ(drawn(kMoving, {}).bytes, drawn(kMoving, {}).bytes); }

// Every option that ought to change the picture does.
TEST_F(Sdfview, HeedsItsOptions) {
  const auto plain = drawn(kMoving, {}).bytes;
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--time", "0.5"},
                                                  {"-t", "0.5"},
                                                  {"-D", "size=0.5"},
                                                  {"--samples", "4"},
                                                  {"--camera", "0,0,5,0,0,0"},
                                                  {"--camera", "0,1.5,6,0,0,0,60"},
                                                  {"--view", "normals"},
                                                  {"--view", "steps"},
                                                  {"--view", "slice"},
                                                  {"--view", "gradient"},
                                                  {"--view", "material"},
                                                  {"--view", "occlusion"},
                                                  {"--view", "shadow"}})
    EXPECT_NE(drawn(kMoving, options).bytes, plain) << options[0] << " " << options[1];
  EXPECT_NE(drawn(kMoving, {"--view", "steps"}).bytes,
            drawn(kMoving, {"--view", "steps", "--method", "plain"}).bytes);
}

// A scene without a camera of its own fills its picture, whatever its size. An animation has one camera.
TEST_F(Sdfview, FitsTheCameraWhereTheSceneHasNone) {
  const auto shown = [](const Picture& picture) {
    double count = 0.0;
    const std::uint8_t* corner = picture.bytes.data();
    for (std::size_t i = 4; i < picture.bytes.size(); i += 4)
      count += !std::equal(corner, corner + 4, corner + i);
    return count / (picture.width * picture.height);
  };
  for (const char* text :
       {"background(0) return box(50, 20, 30)", "background(0) return box(0.05, 0.02, 0.03)"}) {
    EXPECT_GT(shown(drawn(text, {})), 0.3) << text;
    EXPECT_LT(shown(drawn(text, {})), 0.9) << text;
  }
  const char* moving = "background(0) return sphere(1):translate(time, 0, 0)";
  EXPECT_GT(shown(drawn(moving, {})), 0.15);  // the corners of its bounds are in view
  EXPECT_NE(drawn(moving, {"--time", "0.5"}).bytes, drawn(moving, {}).bytes);
  EXPECT_EQ(drawn("return sphere(param('size', 1, {min = 0.5, max = 9}))", {"-D", "size=4"}).bytes,
            drawn("return sphere(4)", {}).bytes);
}

TEST_F(Sdfview, MovesTheCameraToWhereAllIsInView) {
  const std::string ball = "return sphere(10)", camera = "camera{from = {3.4, 2.6, 4.6}, to = {0, 0, 0}}\n";
  const auto free = drawn(ball, {}).bytes;
  EXPECT_NE(drawn(camera + ball, {}).bytes, free) << "the camera is in the ball";
  EXPECT_EQ(drawn(camera + ball, {"--fit"}).bytes, free) << "along the default camera's direction";
  EXPECT_EQ(drawn(ball, {"--fit"}).bytes, free);
  EXPECT_EQ(drawn(ball, {"--fit", "--camera", "4.4,3.6,5.6,1,1,1"}).bytes, free) << "direction of --camera";
  EXPECT_NE(drawn(ball, {"--fit", "--camera", "5,0,0,0,0,0"}).bytes, free);
  expectRefused(kScene, "scene.lua: the scene is unbounded, so it cannot all be in view; give bounds(",
                {scene("return plane()"), "--fit", "--render", at("a.png")});
}

// As people look at plans: straight down, and up.
TEST_F(Sdfview, LooksStraightDown) {
  const auto above = drawn(kBall, {"--camera", "0,5,0,0,0,0", "--view", "normals"}, "33x33");
  const std::size_t middle = 4 * (16 * 33 + 16);
  EXPECT_NEAR(above.bytes[middle], 128, 1);  // n = (0, 1, 0) as (n + 1) / 2
  EXPECT_NEAR(above.bytes[middle + 1], 255, 1);
  EXPECT_NEAR(above.bytes[middle + 2], 128, 1);
  const std::size_t high = 4 * (14 * 33 + 16), right = 4 * (16 * 33 + 18);
  EXPECT_LT(above.bytes[high + 2], 128) << "north, -z, is up";
  EXPECT_GT(above.bytes[right], 128) << "and +x to the right";
  const char* scene = "camera { from = {0, 5, 0}, to = {0, 0, 0} }\npart('ball', sphere(1))";
  EXPECT_EQ(drawn(scene, {"--view", "normals"}, "33x33").bytes, above.bytes);
  const auto below = drawn(kBall, {"--camera", "0,-5,0,0,0,0", "--view", "normals"}, "33x33");
  EXPECT_NEAR(below.bytes[middle + 1], 0, 1);
}

TEST_F(Sdfview, NumbersItsFrames) {
  const std::string s = scene(kMoving);
  EXPECT_EQ(run({s, "--render", at("a.png"), "--size", "32x24", "--frames", "3", "--fps", "2"}).status, 0);
  EXPECT_EQ(run({s, "--render", at("%02d-b.png"), "--size", "32x24", "--frames", "2", "-t", "0.5"}).status,
            0);
  EXPECT_EQ(files(), (std::vector<std::string>{"01-b.png", "02-b.png", "a_0001.png", "a_0002.png",
                                               "a_0003.png", "scene.lua"}));
  EXPECT_EQ(read(at("a_0001.png")).bytes, drawn(kMoving, {}).bytes);
  EXPECT_EQ(read(at("a_0003.png")).bytes, drawn(kMoving, {"--time", "1"}).bytes) << "half a second a frame";
  EXPECT_EQ(read(at("01-b.png")).bytes, read(at("a_0002.png")).bytes);
  const double second = 0.5 + 1.0 / 24.0;
  char time[32];
  std::snprintf(time, sizeof time, "%.17g", second);
  EXPECT_EQ(read(at("02-b.png")).bytes, drawn(kMoving, {"--time", time}).bytes) << "24 frames a second";
}

TEST_F(Sdfview, RunsAScriptThatReadsTheClockForEveryFrame) {
  const char* growing = "return sphere(0.5 + 0.5 * value(time))";
  ASSERT_EQ(
      run({scene(growing), "--render", at("a.png"), "--size", "32x24", "--frames", "2", "--fps", "1"}).status,
      0);
  EXPECT_EQ(read(at("a_0001.png")).bytes, drawn(growing, {}).bytes);
  EXPECT_EQ(read(at("a_0002.png")).bytes, drawn(growing, {"--time", "1"}).bytes);
  EXPECT_NE(read(at("a_0001.png")).bytes, read(at("a_0002.png")).bytes);
}

// Over an hour's range of the clock the slope of a twist has no end.
TEST_F(Sdfview, DrawsEveryFrameWithTheSlopesOfItsMoment) {
  const char* twisting =
      "camera{from = {2, 2, 4}, to = {0, 0, 0}, fov = 34}\n"
      "part('bar', box(0.3, 0.8, 0.3):twist(param('rate', 30, {min = 0, max = 90}) * time))";
  const Outcome outcome = run({scene(twisting), "--render", at("a.png"), "--size", "32x24", "--frames", "2",
                               "--fps", "1", "--time", "1", "-D", "rate=40"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "") << "no ray runs out of steps";
  EXPECT_EQ(read(at("a_0002.png")).bytes, drawn(twisting, {"--time", "2", "-D", "rate=40"}).bytes);
  const Outcome bench =
      run({scene(twisting), "--bench", "1", "--size", "32x24", "--time", "2", "--compare", "rate=80"});
  ASSERT_EQ(bench.status, 0) << bench.err;
  const auto report = nlohmann::json::parse(bench.out);
  EXPECT_EQ(report["pixels_out_of_steps"], 0);
  EXPECT_LT(report["readings_a_ray"]["primary"], 20.0);
  EXPECT_LT(report["compared"][0]["other_readings_a_ray"]["primary"], 40.0);
}

TEST_F(Sdfview, TakesAPicturesEndingInUpperCaseToo) {
  ASSERT_EQ(run({scene(kBall), "--render", at("A.PNG"), "--size", "8x8"}).status, 0);
  EXPECT_EQ(read(at("A.PNG")).width, 8);
}

TEST_F(Sdfview, LeavesAPercentSignAloneInASinglePicture) {
  ASSERT_EQ(run({scene(kBall), "--render", at("a%04d.png"), "--size", "8x8"}).status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"a%04d.png", "scene.lua"}));
}

TEST_F(Sdfview, SaysWhichFormulaTakesTheSteps) {
  const std::string quartic =
      "local f = field(function(x, y, z) return x^4 + y^4 + z^4 - 0.1 end, "
      "{bounds = {{-1, -1, -1}, {1, 1, 1}}})\n";
  const Outcome outcome = run({scene(quartic + "return sphere(0.1) | f:repeat_grid(3, 3, 3)"), "--render",
                               at("a.png"), "--size", "64x48", "--steps", "9"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(
      outcome.err.find("pixels ran out of steps; the formula in " + at("scene.lua:1 has a slope of up to ")),
      std::string::npos)
      << outcome.err;
  EXPECT_NE(
      outcome.err.find(", for which rays go in short steps: give its field() the lipschitz that it has, "
                       "if that is less; give more with --steps"),
      std::string::npos)
      << outcome.err;
}

TEST_F(Sdfview, WarnsOfPixelsThatRanOutOfSteps) {
  const std::string png = at("a.png");
  const Outcome outcome = run({scene(kBall), "--render", png, "--size", "64x48", "--steps", "3"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err.rfind("sdfview: warning: ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find(" pixels ran out of steps; give more with --steps"), std::string::npos);
  const Picture picture = read(png);
  for (std::size_t i = 3; i < picture.bytes.size(); i += 4) ASSERT_EQ(picture.bytes[i], 255);
}

// Under a light that grazes the floor two readings bring no ray to its end.
constexpr const char* kGrazed = R"(
  camera{from = {0, 3, 4}, to = {0, 0, 0}}
  directional_light{direction = {1, 0.05, 0}}
  part("floor", box({2, 0.5, 2}) | sphere(1):translate({0, 0.6, 0}))
  shadows{kind = "hard", steps = value(param("n", 500, {min = 1, max = 500}))}
)";

TEST_F(Sdfview, WarnsOfShadowsThatRanOutOfSteps) {
  const std::string png = at("a.png");
  for (const char* samples : {"1", "4", "9"}) {
    const Outcome outcome =
        run({scene(kGrazed), "--render", png, "--size", "64x48", "--samples", samples, "-D", "n=2"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(std::regex_match(outcome.err,
                                 std::regex("sdfview: warning: in \\d+ pixels the ray of a shadow ran out of "
                                            "steps and is taken for dark; the scene has shadows\\{steps = "
                                            "2\\}: give it more\n")))
        << outcome.err;
    const Picture picture = read(png);
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4) ASSERT_EQ(picture.bytes[i], 255);
  }
  EXPECT_EQ(run({scene(kGrazed), "--render", png, "--size", "64x48"}).err, "");
}

// Rays take fewer readings of all parts in turn, which are counted by the share of the parts that they look
// at.
TEST_F(Sdfview, ReadsAllPartsIfToldTo) {
  const auto primary = [&](std::vector<std::string> more) {
    std::vector<std::string> all{std::string(SDF_SOURCE_DIR) + "/samples/bench/v_balls.lua", "--bench", "1",
                                 "--size", "64x64"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["readings_a_ray"]["primary"].get<double>();
  };
  EXPECT_GT(primary({}), 2.0 * primary({"--no-culling"}));
}

TEST_F(Sdfview, KeepsWhatItSamplesOfMeshesUnlessToldNotTo) {
  const std::filesystem::path kept = folder / "cache" / "libsdf";
  std::ofstream(folder / "tip.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string cut = scene("part('cut', mesh('tip.obj', {voxels = 32}) - sphere(0.3))");
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> all{cut, "--render", at("cut.png"), "--size", "64x48"};
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(run(all, {"XDG_CACHE_HOME=" + at("cache")}).status, 0);
    return read(at("cut.png")).bytes;
  };
  const auto plain = drawn({"--no-cache"});
  EXPECT_FALSE(std::filesystem::exists(kept));
  EXPECT_EQ(drawn({}), plain);
  EXPECT_FALSE(std::filesystem::is_empty(kept));
  EXPECT_EQ(drawn({}), plain);
}

TEST_F(Sdfview, TellsWhatMeshesCostAndHowFarOffTheirSamplesAre) {
  std::ofstream(folder / "tip.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const Outcome outcome = run({scene("local tip = mesh('tip.obj', {voxels = 32}) part('drawn', tip) "
                                     "part('cut', tip:translate(2, 0, 0) - sphere(0.3)) shadows{}"),
                               "--bench", "1", "--size", "64x48", "--no-cache"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["drawn_triangles"], 4);
  EXPECT_GT(report["triangles_ms"].get<double>(), 0.0);
  ASSERT_EQ(report["fields"].size(), 1u);
  const auto& field = report["fields"][0];
  EXPECT_EQ(field["triangles"], 4);
  EXPECT_DOUBLE_EQ(field["voxel"].get<double>(), 1.0 / 32.0);
  EXPECT_GT(field["ready_ms"].get<double>(), 0.0);
  EXPECT_GT(field["bricks"].get<int>(), 0);
  EXPECT_GT(field["error_rms"].get<double>(), 0.0);
  EXPECT_LE(field["error_rms"].get<double>(), field["error_max"].get<double>());
  EXPECT_LE(field["error_max"].get<double>(), 0.1);
}

// Two like pictures, and one of fewer parts, which is not held against it.
TEST_F(Sdfview, ComparesWaysToDrawAScene) {
  const Outcome outcome = run({std::string(SDF_SOURCE_DIR) + "/samples/bench/v_parts.lua", "--bench", "3",
                               "--size", "160x120", "--compare", "no-culling", "--compare", "count=10"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(report["lists"]);
  const auto& compared = report["compared"];
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_EQ(compared[0]["with"], "no-culling");
  EXPECT_EQ(compared[1]["with"], "count=10");
  for (const auto& one : compared)
    EXPECT_DOUBLE_EQ(one["ratio"], one["frame_ms"].get<double>() / one["other_frame_ms"].get<double>());
  EXPECT_LE(compared[0]["rms"], 0.02) << "of a few pixels at edges";
  EXPECT_FALSE(compared[1].contains("rms"));

  const std::string ball = scene(kBall);
  const Outcome starts =
      run({ball, "--bench", "1", "--size", "160x120", "--compare", "raster", "--compare", "plain"});
  ASSERT_EQ(starts.status, 0) << starts.err;
  const auto byStart = nlohmann::json::parse(starts.out);
  ASSERT_EQ(byStart["compared"].size(), 2u);
  const double own = byStart["readings_a_ray"]["primary"];
  EXPECT_GT(byStart["compared"][1]["other_readings_a_ray"]["primary"], 1.5 * own) << "from the eye";
  EXPECT_NE(byStart["compared"][0]["other_readings_a_ray"]["primary"], own);
  for (const auto& one : byStart["compared"]) EXPECT_LE(one["rms"], 1e-3) << one["with"];
  expectRefused(kUsage, "--compare needs no-culling, raster, cone, plain or name=value, got 'lists'",
                {ball, "--bench", "1", "--compare", "lists"});
  expectRefused(kUsage, "add --bench or leave --compare out", {ball, "--compare", "no-culling"});
  expectRefused(kScene, "count", {ball, "--bench", "1", "--size", "8x8", "--compare", "count=3"});
}

TEST_F(Sdfview, ReportsWhatFramesCost) {
  const Outcome outcome = run({std::string(SDF_SOURCE_DIR) + "/samples/lighting_stack.lua", "--bench", "2",
                               "--size", "40x30", "--samples", "4"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["width"], 40);
  EXPECT_EQ(report["height"], 30);
  EXPECT_EQ(report["samples"], 4);
  EXPECT_EQ(report["rays"], 40.0 * 30.0 * 4.0);
  EXPECT_EQ(report["pixels_out_of_steps"], 0);
  EXPECT_EQ(report["pixels_out_of_shadow_steps"], 0);
  EXPECT_NE(report["driver"].get<std::string>().find("OpenGL"), std::string::npos);
  for (const char* key : {"compile_ms", "first_frame_ms", "frame_ms", "cpu_ms", "shader_bytes"})
    EXPECT_GT(report[key].get<double>(), 0.0) << key;
  for (const char* ray : {"primary", "shadow", "occlusion", "reflection"})
    EXPECT_GT(report["readings_a_ray"][ray].get<double>(), 0.0) << ray;
  EXPECT_FALSE(report["lists"]);
  EXPECT_EQ(report.size(), 14u);
}

// Above a floor all taps see nothing but the floor, which the farthest tells; in a corner none tells of the
// others.
TEST_F(Sdfview, ReadsOcclusionOnceWhereNothingIsNear) {
  const auto readings = [&](const std::string& walls) {
    const std::string text = "part('floor', plane())\n" + walls +
                             "camera{from = {0, 3, 0.1}, to = {0, 0, 0}, fov = 40}\n"
                             "ambient_occlusion{kind = 'taps', spacing = 0.5, count = 5}\n";
    const Outcome outcome = run({scene(text), "--bench", "1", "--size", "40x30"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["readings_a_ray"]["occlusion"].get<double>();
  };
  EXPECT_DOUBLE_EQ(readings(""), 1.0);
  EXPECT_GT(readings("part('wall', box{0.2, 3, 3}:translate(0.5, 0, 0))\n"), 1.5);
}

TEST_F(Sdfview, DrawsBenchesAndWritesTheShaderAtOnce) {
  const Outcome outcome =
      run({scene(kBall), "--render", at("a.png"), "--glsl", at("a.glsl"), "--bench", "1", "--size", "16x16"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(nlohmann::json::accept(outcome.out));
  EXPECT_EQ(files(), (std::vector<std::string>{"a.glsl", "a.png", "scene.lua"}));
}

TEST_F(Sdfview, WritesAShaderThatCompiles) {
  const std::string file = at("a.frag");
  ASSERT_EQ(run({scene(kMoving), "--glsl", file, "--view", "normals", "--method", "plain"}).status, 0);
  const std::string text = contents(file);
  EXPECT_EQ(text.rfind("#version 330 core\n", 0), 0u);
  EXPECT_NE(text.find("#define STEP r\n"), std::string::npos);
  if (std::string(SDF_GLSLANG).empty()) GTEST_SKIP() << "glslangValidator is not installed";
  const Outcome outcome = Command{{SDF_GLSLANG, file}}.run();
  EXPECT_EQ(outcome.status, 0) << outcome.out;
}

// A sanitizer needs more addresses than there are.
#ifndef SDF_SANITIZED
TEST_F(Sdfview, SaysWhenTheMemoryIsUsedUp) {
  Command command{
      {SDFVIEW_PROGRAM, scene(kBall), "--render", at("a.png"), "--view", "wire", "--voxel-size", "0.002"}};
  command.memoryLimit = 1L << 30;
  const Outcome outcome = command.run();
  EXPECT_EQ(outcome.status, kLimits);
  EXPECT_EQ(
      withoutProgress(outcome.err),
      "sdfview: the memory is used up; take smaller pictures, meshes of fewer voxels, or fewer shapes\n");
  EXPECT_EQ(files(), std::vector<std::string>{"scene.lua"});
}
#endif

TEST_F(Sdfview, SaysWhatTakesLongerThanASecond) {
  std::vector<std::string> words{SDFVIEW_PROGRAM, scene("part('a', sphere(1))"),
                                 "--render",      at("long.png"),
                                 "--seconds",     "1.1",
                                 "--size",        "640x480",
                                 "--samples",     "1024"};
  const Outcome told = Command{words}.run();
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(told.err.rfind("sdfview: after 1 s: ", 0), 0u) << told.err;
}

}  // namespace cli_test
}  // namespace sdf
