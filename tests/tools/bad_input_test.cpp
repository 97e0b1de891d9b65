// Every input that cannot work: one line on stderr that says what to change, the right status, and no file.
#include <sys/mount.h>
#include <unistd.h>

#include "sdf2gltf.h"

namespace sdf {
namespace bad_input_test {

constexpr int kUsage = 2, kScene = 3, kLimits = 4, kFiles = 5;

class BadInput : public Sdf2gltf {
 protected:
  /// The program ends with `status` and one line in which every one of `words` is found.
  void expectRefusal(const Outcome& outcome, int status, const std::vector<std::string>& words) const {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    expectLine(outcome.err, "sdf2gltf: ", words);
    EXPECT_EQ(written(), std::vector<std::string>{});
  }

  /// A warning, in a line of its own, comes before the refusal: each with its words.
  void expectRefusalAfterAWarning(const Outcome& outcome, int status, const std::vector<std::string>& warning,
                                  const std::vector<std::string>& words) const {
    const std::size_t end = outcome.err.find('\n') + 1;
    expectLine(outcome.err.substr(0, end), "sdf2gltf: warning: ", warning);
    Outcome refusal = outcome;
    refusal.err.erase(0, end);
    expectRefusal(refusal, status, words);
  }

  static void expectLine(const std::string& line, const std::string& start,
                         const std::vector<std::string>& words) {
    EXPECT_EQ(line.substr(0, start.size()), start) << line;
    EXPECT_EQ(line.find('\n'), line.size() - 1) << line;
    for (const std::string& word : words) {
      EXPECT_NE(line.find(word), std::string::npos) << "'" << word << "' is not in: " << line;
    }
  }

  void expectBadFlags(std::vector<std::string> flags, const std::vector<std::string>& words) {
    std::vector<std::string> arguments{scene(kSphere), "-o", out("a.glb")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    SCOPED_TRACE(testing::PrintToString(flags));
    expectRefusal(run(arguments), kUsage, words);
  }

  void expectBadScene(const std::string& text, const std::vector<std::string>& words, int status = kScene,
                      std::vector<std::string> flags = {}) {
    std::vector<std::string> arguments{scene(text), "-o", out("a.glb"), "--report", out("r.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    SCOPED_TRACE(text);
    expectRefusal(run(arguments), status, words);
  }
};

TEST_F(BadInput, MissingArgumentsAreNamed) {
  expectRefusal(run({}), kUsage, {"--help"});
  expectRefusal(run({"-o", out("a.glb")}), kUsage, {"SCENE", "--help"});
  expectRefusal(run({scene(kSphere)}), kUsage, {"--output", "--help"});
}

// Said before any work, with the place and a cure.
TEST_F(BadInput, WhatFloatsCannotHoldIsRefused) {
  const char* thing = "part('thing', (box(1, 0.5, 1) - sphere(0.7)):translate(6455808, 2408, 1920960))";
  expectBadScene(thing, {"part 'thing'", "0.769592 apart", "6.45581e+06 from the origin",
                         "move it nearer to the origin", "at least 3.07"});
  expectBadScene("return sphere(1):translate(1e308, 0, 0)",
                 {"1e+308 from the origin", "move it to the origin"});
  expectBadScene("return sphere(5e-324)", {"part 'part 1'", "scale it up"});
  expectBadScene("return sphere(1):scale(5e-324)", {"scale it up"});
  expectBadScene(kSphere, {"too coarse for a voxel size of", "at least 4.7"}, kScene,
                 {"--voxel-size", "1e-320"});
}

// What is read stays as it is, by whatever name it is to be written.
TEST_F(BadInput, WhatIsReadIsNotWritten) {
  const std::string ball = scene(kSphere);
  expectRefusal(run({ball, "-o", out("a.glb"), "--report", ball}), kFiles, {ball, "choose another name"});
  std::filesystem::create_symlink(ball, folder / "link.json");
  expectRefusal(run({ball, "-o", out("a.glb"), "--report", (folder / "link.json").string()}), kFiles,
                {"link.json", ball});
  EXPECT_EQ(contents(ball), kSphere);
  const std::string model = (folder / "m.glb").string();
  ASSERT_EQ(run({ball, "-o", model, "--voxel-size", "0.2", "-q"}).status, 0);
  const std::string before = contents(model), reader = scene("return mesh('m.glb')");
  expectRefusal(run({reader, "-o", model}), kFiles, {model, "choose another name"});
  expectRefusal(run({reader, "-o", out("a.glb"), "--report", model}), kFiles, {model});
  EXPECT_EQ(contents(model), before);
}

TEST_F(BadInput, TheReportIsNotTheMesh) {
  expectRefusal(run({scene(kSphere), "-o", out("a.glb"), "--report", out("a.glb")}), kUsage,
                {"--report", "a name of its own"});
  expectRefusal(run({scene(kSphere), "-o", out("a.glb"), "--lod", "2", "--report", out("../out/a_lod1.glb")}),
                kUsage, {"--report", "a name of its own"});
}

TEST_F(BadInput, FlagsThatDoNotExistAreNamed) {
  expectBadFlags({"--voxel"}, {"--voxel", "--help"});
  expectBadFlags({"surplus.lua"}, {"surplus.lua"});
  expectBadFlags({"--voxel-size"}, {"--voxel-size takes one value"});
  expectBadFlags({"-o", out("b.glb")}, {"--output takes one value"});
}

TEST_F(BadInput, FlagsSayWhichValuesTheyTake) {
  for (const char* size : {"0", "-1", "nan", "inf", "thin", "1mm", ""}) {
    expectBadFlags({"--voxel-size", size},
                   {"--voxel-size needs a number above 0, got '" + std::string(size) + "'"});
    expectBadFlags({"--tolerance", size}, {"--tolerance needs a number above 0, of scene units or with %",
                                           "got '" + std::string(size) + "'"});
  }
  for (const char* share : {"%", "0%", "1%%", "1 %"})
    expectBadFlags({"--tolerance", share},
                   {"--tolerance needs a number above 0", "got '" + std::string(share) + "'"});
  for (const char* bounds : {"1,2,3", "0,0,0,1,1,nan", "1,1,1,0,0,0", "0,0,0,1,1,1,", "0 0 0 1 1 1"}) {
    expectBadFlags({"--bounds=" + std::string(bounds)},
                   {"--bounds needs six numbers x0,y0,z0,x1,y1,z1", bounds});
  }
  expectBadFlags({"--triangles", "0"}, {"--triangles needs a whole number from 1", "'0'"});
  expectBadFlags({"--triangles", "9", "--tolerance", "1"}, {"--triangles finds the tolerance"});
  expectBadFlags({"--triangles", "9", "--animate", "--frames", "2"}, {"--triangles counts", "--animate"});
  expectBadFlags({"--keep-going"}, {"--keep-going", "say --tolerance", "leave --keep-going out"});
  expectBadFlags({"--lod", "17", "--tolerance", "1"}, {"--lod needs a whole number from 1 to 16", "'17'"});
  expectBadFlags({"--lod", "2", "--voxel-size", "0.1"},
                 {"--lod takes four times the tolerance", "say --tolerance", "leave --voxel-size out"});
  expectBadFlags({"--lod", "2", "--tolerance", "1", "--animate", "--frames", "2"},
                 {"--lod: leave --animate"});
  expectBadFlags({"--time", "noon"}, {"--time needs a finite number", "noon"});
  expectBadFlags({"--frames", "0"}, {"--frames needs a whole number from 1", "'0'"});
  expectBadFlags({"--frames", "2.5"}, {"--frames", "2.5"});
  expectBadFlags({"--frames", "2", "--fps", "0"}, {"--fps needs a number above 0"});
  expectBadFlags({"--fps", "24"}, {"--frames"});
  expectBadFlags({"--threads", "0"}, {"--threads needs a whole number from 1"});
  expectBadFlags({"--max-memory", "-1"}, {"--max-memory needs a number above 0"});
}

TEST_F(BadInput, ParametersNeedANameAndAFiniteNumber) {
  for (const char* word : {"k", "k=", "=1", "k=nan", "k=inf", "k=red", "k=1;2"}) {
    expectBadFlags({"-D", word}, {"-D needs name=value with a finite number", word});
  }
  expectBadFlags({"-D", "k=1", "-D", "k=2"}, {"-D sets 'k' twice"});
}

TEST_F(BadInput, AParameterThatTheSceneLacksIsNamedWithThoseItHas) {
  expectBadScene("param('size', 0.5) return sphere(1)", {"sise", "size"}, kScene, {"-D", "sise=1"});
}

TEST_F(BadInput, UnknownExtensionsAreAnsweredWithTheKnownOnes) {
  expectRefusal(run({scene(kSphere), "-o", out("a.fbx")}), kUsage, {"'.fbx'", ".glb .gltf .stl .ply .obj"});
  expectRefusal(run({scene(kSphere), "-o", out("a")}), kUsage, {"no extension", ".glb"});
}

TEST_F(BadInput, LightIsBakedIntoMaterialsOnly) {
  for (const char* name : {"a.stl", "a.PLY", "a.obj"})
    expectRefusal(run({scene(kSphere), "-o", out(name), "--bake"}), kUsage,
                  {"--bake", "emission", "write .glb or .gltf"});
}

TEST_F(BadInput, OnlyGltfIsCompressed) {
  for (const char* name : {"a.stl", "a.PLY", "a.obj"})
    expectRefusal(run({scene(kSphere), "-o", out(name), "--compress"}), kUsage,
                  {"--compress", "write .glb or .gltf", "leave --compress out"});
}

TEST_F(BadInput, WhatCannotBeProvenIsSaidWithItsPlace) {
  // Two cubes that touch in an edge at x = y = 1, where ten times what is measured is more than three voxels;
  // and a ball by a jump instead of a zero, where it is less.
  expectBadScene("return union(box(1), box(1):translate(2, 2, 0))",
                 {"part 'part 1': no distance below 0.86", "cells, the first of side", "around (",
                  "elsewhere it is", "measured", "Take a smaller voxel size, or leave --certify out"},
                 kLimits, {"--certify", "--voxel-size", "0.2"});
  expectBadScene(
      "bounds({-2, -2, -2}, {2, 2, 2}) return field(function(x, y, z)"
      " return floor(x * x + y * y + z * z) - 0.5 end)",
      {"no distance below 0.6 is proven"}, kLimits, {"--certify", "--voxel-size", "0.2"});
}

TEST_F(BadInput, WhatStoodInTheWayOfAProofIsNamedWithItsLine) {
  expectBadScene("local tip = cone(0.5, 1)\nreturn tip:translate(1, 0, 0)",
                 {". There the cone at ", ".lua:1 stood in the way: intervals do not tell if it rises. "},
                 kLimits, {"--certify", "--voxel-size", "0.1"});
}

TEST_F(BadInput, BakedOcclusionNeedsAKnownSlope) {
  expectBadScene(
      "ambient_occlusion { kind = 'taps' } bounds({-1, -1, -1}, {1, 1, 1})"
      "return field(function(x, y, z) return x * x * x + y * y * z + z * x end)",
      {"ambient occlusion", "slope", "lipschitz"}, kScene, {"--bake"});
}

TEST_F(BadInput, AnAnimationNeedsFramesAndAFormatThatHoldsIt) {
  expectBadFlags({"--animate"}, {"--animate puts frames into one file", "--frames N"});
  for (const char* name : {"a.stl", "a.PLY", "a.obj"})
    expectRefusal(run({scene(kSphere), "-o", out(name), "--animate", "--frames", "2"}), kUsage,
                  {"--animate", "files hold no animation", "write .glb or .gltf"});
}

TEST_F(BadInput, ASequenceNeedsOnePlaceForItsNumber) {
  expectRefusal(run({scene(kSphere), "-o", out("a_%d_%04d.glb"), "--frames", "2"}), kUsage,
                {"%d_%04d", "keep one"});
}

TEST_F(BadInput, MissingSceneFilesAreNamed) {
  expectRefusal(run({out("none.lua"), "-o", out("a.glb")}), kFiles, {"none.lua", "cannot be read"});
  expectRefusal(run({folder.path().string(), "-o", out("a.glb")}), kFiles, {"folder"});
}

TEST_F(BadInput, SceneErrorsNameFileAndLine) {
  expectBadScene("return sphere(1", {"scene1.lua:1", "')' expected"});
  expectBadScene("\nreturn spere(1)", {"scene2.lua:2", "spere"});
  expectBadScene("return sphere('large')", {"scene3.lua:1", "sphere", "number", "large"});
  expectBadScene("return sphere(-1)", {"scene4.lua:1", "sphere", "positive", "-1"});
  expectBadScene("return sphere(0/0)", {"scene5.lua:1", "sphere", "finite", "NaN"});
  expectBadScene("", {"scene6.lua", "empty", "part"});
  expectBadScene("error('no\\nway')", {"no way"});
}

TEST_F(BadInput, SmoothnessMustBePositive) {
  for (const char* k : {"0", "-1"}) {
    expectBadScene(std::string("return union(sphere(1), box({1, 1, 1}), {k = ") + k + "})",
                   {".lua:1", "union", "k", "positive", k});
  }
}

TEST_F(BadInput, ParametersInTheSceneMustBeFinite) {
  expectBadScene("local r = param('r', 0/0) return sphere(r)",
                 {"scene1.lua:1", "param 'r'", "finite", "NaN"});
}

TEST_F(BadInput, NoSurfaceInTheBoundsIsSaid) {
  expectBadScene(kSphere, {"bounds"}, kScene, {"--bounds", "5,5,5,6,6,6"});
  expectBadScene("bounds({5, 5, 5}, {6, 6, 6}) return sphere(1)", {"bounds"});
  expectBadScene("return sphere(1) & sphere(1):translate({9, 0, 0})", {"no surface"});
}

TEST_F(BadInput, UnboundedPartsAreNamed) {
  const std::string open = "part('ball', sphere(1)) part('floor', plane({0, 1, 0}))";
  expectBadScene(open, {"'floor'", "unbounded", "bounds"});
  for (const char* name : {"a.glb", "a.stl"})
    expectRefusal(run({scene(open), "-o", out(name), "--voxel-size", "0.1"}), kScene,
                  {"'floor'", "unbounded"});
}

TEST_F(BadInput, MeshesThatContradictWhatIsStatedOfAFieldAreNotWritten) {
  const std::string ball = "function(x, y, z) return (sqrt(x * x + y * y + z * z) - 1)";
  const auto part = [&](const std::string& formula, const std::string& stated) {
    return "part('ball', field(" + ball + formula + " end, {" + stated + "}))";
  };
  expectBadScene(
      part("", "bounds = {{-1, -1, -1}, {1, 1, 0.9}}"),
      {"part 'ball': the surface leaves the bounds (-1, -1, -1) to (1, 1, 0.9)", "at (", "enlarge"});
  const auto steeper = [&](const std::string& text, const std::string& slope,
                           const std::vector<std::string>& words, std::vector<std::string> flags = {}) {
    std::vector<std::string> arguments{scene(text), "-o", out("a.glb"), "--report", out("r.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    SCOPED_TRACE(text);
    expectRefusalAfterAWarning(run(arguments), kScene,
                               {"field: the formula's slope is " + slope, "more than the lipschitz of 1"},
                               words);
  };
  steeper(part(" * 2", "bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = 1"), "2 at (",
          {"part 'ball': the mesh is torn open at (", "the distance changes by 1.98",
           "allows 1. Enlarge the lipschitz"});
  steeper(part(" * (1 + 20 * exp(-200 * ((x - 0.6) ^ 2 + (y - 0.6) ^ 2 + (z - 0.53) ^ 2)))",
               "bounds = {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, lipschitz = 1"),
          "7.7", {"part 'ball': the mesh is off by about 0.074", "voxels, at (0.6", "Enlarge the lipschitz"},
          {"--voxel-size", "0.02"});
}

TEST_F(BadInput, TooSmallVoxelsAreRefusedBeforeTheWorkStarts) {
  const Outcome outcome =
      run({scene(kSphere), "-o", out("a.glb"), "--voxel-size", "1e-5", "--max-memory", "0.5"});
  expectRefusal(outcome, kLimits,
                {"a voxel size of 1e-05 needs about ",
                 "GiB, more than the limit of 0.5 GiB; "
                 "take a voxel size of 0.00",
                 ", smaller bounds or a higher limit"});
  constexpr double kAnEstimate =
      5.0;  // seconds; filling half a GiB of voxels takes longer even where nothing else runs
  EXPECT_LT(outcome.seconds, kAnEstimate);
}

TEST_F(BadInput, PartsThatDoNotExistAreAnsweredWithThoseThatDo) {
  expectRefusal(run({scene(kTwoParts), "-o", out("a.glb"), "--only", "bal"}), kUsage,
                {"'bal'", "ball, block"});
}

TEST_F(BadInput, TargetsThatCannotBeWrittenAreRefusedBeforeTheWorkStarts) {
  const std::string slow = scene("return gyroid(40) & sphere(10)");
  expectRefusal(run({slow, "-o", out("none/a.glb")}), kFiles,
                {"none/a.glb", "No such file", "make the folder"});
  expectRefusal(run({slow, "-o", out("a.glb"), "--report", out("none/r.json")}), kFiles, {"none/r.json"});
  std::filesystem::create_directory(folder / "folder.glb");
  expectRefusal(run({slow, "-o", (folder / "folder.glb").string()}), kFiles, {"Is a directory"});
}

TEST_F(BadInput, FoldersThatMayNotBeWrittenToAreRefused) {
  using std::filesystem::perms;
  const std::string ball = scene(kSphere);
  Command command = BadInput::command({ball, "-o", out("a.glb")});
  command.asNobody = true;
  std::filesystem::permissions(
      folder / "out", perms::owner_read | perms::owner_exec | perms::others_read | perms::others_exec);
  const Outcome outcome = runCommand(command);
  std::filesystem::permissions(folder / "out", perms::owner_all);
  expectRefusal(outcome, kFiles, {"Permission denied", "choose a folder that you may write to"});
}

// Of a scene's meshes: what is not there, is broken, or lies elsewhere.
TEST_F(BadInput, MeshesThatCannotBeReadAreRefused) {
  const auto refuse = [&](const std::string& name, int status, const std::vector<std::string>& words) {
    expectRefusal(run({scene("return mesh('" + name + "')"), "-o", out("a.glb")}), status, words);
  };
  refuse("nowhere.glb", kScene, {":1: ", "nowhere.glb"});
  std::ofstream(folder / "broken.glb") << "glTF and no more";
  refuse("broken.glb", kScene, {":1: ", "broken.glb"});
  std::ofstream(folder / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  refuse("flat.obj", kScene, {"flat.obj: the triangles of this mesh enclose nothing"});
  refuse("flat.xyz", kScene, {"flat.xyz", ".glb"});
  refuse("/etc/passwd.obj", kScene, {"lies outside of the scene's folder", "--allow-dir /etc"});
}

TEST_F(BadInput, AllowedFoldersAreReadToo) {
  std::filesystem::create_directory(folder / "models");
  std::ofstream(folder / "models" / "tip.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  std::filesystem::create_directory(folder / "scenes");
  const std::string file = (folder / "scenes/a.lua").string(), models = (folder / "models").string();
  std::ofstream(file) << "return mesh('../models/tip.obj')";
  expectRefusal(run({file, "-o", out("a.glb")}), kScene, {"--allow-dir"});
  const Outcome allowed = run({file, "-o", out("a.glb"), "--allow-dir", models, "--voxel-size", "0.05"});
  EXPECT_EQ(allowed.status, 0) << allowed.err;
  EXPECT_NE(allowed.err.find("warning: ../models/tip.obj: 1 hole was closed"), std::string::npos)
      << allowed.err;
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
  const std::string disk = out("");
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting needs root";
  for (const char* name : {"a.glb", "a.gltf", "a.stl", "a.ply", "a.obj"}) {
    expectRefusal(run({scene(kSphere), "-o", out(name), "--voxel-size", "0.02"}), kFiles,
                  {name, "No space left on device", "free some space"});
  }
  ::umount(disk.c_str());
}

TEST_F(BadInput, AFileBeyondTheSizeLimitLeavesNothing) {
  Command command = BadInput::command({scene(kSphere), "-o", out("a.glb")});
  command.fileSizeLimit = 10'000;
  expectRefusal(runCommand(command), kFiles, {"a.glb", "File too large", "ulimit"});
}

}  // namespace bad_input_test
}  // namespace sdf
