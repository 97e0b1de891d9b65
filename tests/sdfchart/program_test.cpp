// The program as its users run it: from the command line to the page.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "support/folder.h"
#include "tools/command.h"

namespace sdf {
namespace program_test {

constexpr int kUsage = 2, kScene = 3, kFiles = 5, kNotDrawn = 7, kInterrupted = 130;

class SdfChart : public testing::Test {
 protected:
  Outcome run(std::vector<std::string> arguments) const { return command(std::move(arguments)).run(); }
  static Command command(std::vector<std::string> arguments) {
    Command c;
    c.words = {SDFCHART_PROGRAM};
    c.words.insert(c.words.end(), arguments.begin(), arguments.end());
    return c;
  }
  std::string scene(const std::string& text) const {
    std::ofstream(folder / "scene.lua") << text;
    return (folder / "scene.lua").string();
  }
  std::string out() const { return (folder / "out").string(); }
  std::string written(const std::string& name) const { return contents(folder / ("out/" + name)); }

  void expectRefusal(const Outcome& outcome, int status, const std::vector<std::string>& words) const {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.err.substr(0, 10), "sdfchart: ") << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << "'" << word << "' is not in: " << outcome.err;
  }

  const Folder folder;
};

TEST_F(SdfChart, SaysWhatItNeeds) {
  expectRefusal(run({}), kUsage, {"--output", "--help"});
  expectRefusal(run({"-o", out(), "--only", "colours"}), kUsage, {"--only", "meshing", "'colours'"});
  expectRefusal(run({"-o", out(), "--quick", "--trial"}), kUsage, {"--quick", "--trial"});
  const std::string ball = scene("return sphere(1)");
  expectRefusal(run({ball, "-o", out(), "--only", "marching", "--only", "normals"}), kUsage,
                {"--only normals", "scenes of its own"});
  expectRefusal(run({"-o", out(), "--draw"}), kUsage, {"--draw", "results.csv", "-o"});
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(SdfChart, AScriptThatDoesNotRunIsNamed) {
  expectRefusal(run({scene("return spere(1)"), "-o", out(), "-q"}), kScene, {"scene.lua", "spere"});
  expectRefusal(run({(folder / "none.lua").string(), "-o", out(), "-q"}), kFiles, {"none.lua"});
}

TEST_F(SdfChart, ScenesOfOneNameAreToldApart) {
  std::filesystem::create_directories(folder / "other");
  const std::string ball = scene("return sphere(1)"), other = (folder / "other/scene.lua").string();
  std::ofstream(other) << "return box({1, 1, 1})";
  expectRefusal(run({ball, other, "-o", out(), "-q", "--trial", "--only", "meshing", "--packages", "/none"}),
                kNotDrawn, {"/none"});
  for (const std::string& file : {ball, other})
    EXPECT_NE(written("results.csv").find("\nmeshing," + file + ",tolerance"), std::string::npos) << file;
}

TEST_F(SdfChart, AChangedSceneIsNotGoneOnWith) {
  const auto measure = [&](const char* text) {
    return run({scene(text), "-o", out(), "-q", "--trial", "--only", "meshing", "--packages", "/none"});
  };
  expectRefusal(measure("return sphere(1)"), kNotDrawn, {"/none"});
  expectRefusal(measure("return sphere(1)"), kNotDrawn, {"/none"});
  expectRefusal(measure("return sphere(2)"), kUsage, {"results.csv", "scene.lua (", "-o"});
}

TEST_F(SdfChart, ASceneWithoutASurfaceIsNamed) {
  expectRefusal(
      run({scene("return intersection(sphere(1), sphere(1):translate({9, 0, 0}))"), "-o", out(), "-q"}),
      kScene, {"scene.lua", "no"});
  expectRefusal(run({scene("return plane({0, 1, 0}, 0)"), "-o", out(), "-q"}), kScene,
                {"scene.lua", "unbounded"});
}

TEST_F(SdfChart, AFolderThatCannotBeWrittenToIsNamed) {
  std::ofstream(folder / "file") << "";
  expectRefusal(run({"-o", (folder / "file/out").string(), "-q"}), kFiles, {"file/out", "-o"});
  if (::geteuid() != 0) return;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  Command c = command({"-o", folder.path().string(), "-q"});
  c.asNobody = true;
  expectRefusal(c.run(), kFiles, {folder.path().string()});
}

// What was measured is kept where it cannot be drawn.
TEST_F(SdfChart, WithoutTheLibraryOrNodeTheFiguresAreKept) {
  const std::string ball = scene("return sphere(1)");
  expectRefusal(run({ball, "-o", out(), "-q", "--trial", "--only", "meshing", "--packages", "/none"}),
                kNotDrawn, {"/none", "bootstrap", "results.csv"});
  EXPECT_NE(written("results.csv").find("meshing,scene,tolerance"), std::string::npos);

  std::filesystem::create_directories(folder / "packages/node_modules/echarts");
  Command without = command({"-o", out(), "-q", "--draw", "--packages", (folder / "packages").string()});
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Outcome outcome = without.run();
  ::setenv("PATH", path.c_str(), 1);
  expectRefusal(outcome, kNotDrawn, {"'node'", "nodejs", "--draw"});
}

// Rows say so, and the other methods are measured.
TEST_F(SdfChart, WithoutOpenGlTheRestIsMeasured) {
  const std::string ball = scene("return sphere(1)");
  Command without =
      command({ball, "-o", out(), "-q", "--trial", "--only", "marching", "--packages", "/none"});
  without.words.insert(without.words.begin(), {"/usr/bin/env", "-u", "DISPLAY",
                                               "__EGL_VENDOR_LIBRARY_FILENAMES=/no/such/driver.json"});
  expectRefusal(without.run(), kNotDrawn, {"/none"});
  const std::string rows = written("results.csv");
  EXPECT_NE(rows.find("failed: there is no OpenGL 3.3 to draw with"), std::string::npos) << rows;
  const std::string marched = "\"auto-relaxed, looks behind\",threshold 1e-05,1e-05,1,";
  const std::size_t at = rows.find(marched);
  ASSERT_NE(at, std::string::npos) << rows;
  EXPECT_NE(rows[at + marched.size()], ',') << "no time";
}

TEST_F(SdfChart, GoesOnWhereItWasInterrupted) {
  const std::vector<std::string> words{"-o", out(), "--quick", "--only", "shadows", "--packages", "/none"};
  Command first = command(words);
  first.signalAfter = 1.0;
  first.signal = SIGINT;
  const Outcome outcome = first.run();
  EXPECT_EQ(outcome.status, kInterrupted) << outcome.err;
  EXPECT_NE(outcome.err.find("call it again"), std::string::npos) << outcome.err;
  const std::string kept = written("results.csv");
  EXPECT_GT(std::count(kept.begin(), kept.end(), '\n'), 2);
  expectRefusal(run({"-o", out(), "-q", "--trial"}), kUsage, {"results.csv", "--quick"});
  EXPECT_EQ(written("results.csv"), kept);

  EXPECT_EQ(run(words).status, kNotDrawn);
  const std::string whole = written("results.csv");
  EXPECT_TRUE(whole.starts_with(kept.substr(0, kept.rfind('\n') + 1)));
  std::filesystem::rename(folder / "out", folder / "interrupted");
  EXPECT_EQ(run(words).status, kNotDrawn);
  const std::string atOnce = written("results.csv");
  EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), std::count(atOnce.begin(), atOnce.end(), '\n'));
}

// One that is too far behind, and one that is not, among rows that were written by hand.
TEST_F(SdfChart, DefaultsAreHeldToTheParetoFront) {
  std::filesystem::create_directories(out());
  const auto fill = [&](const char* triangles) {
    std::ofstream(folder / "out/results.csv")
        << "# by hand\nkind,scene,method,setting,default,seconds,items,error_rms,triangles,status,machine\n"
        << "meshing,ball,tolerance,fine,1,1,1,0.001," << triangles << ",ok,\n"
        << "meshing,ball,other,coarse,0,1,1,0.0009,100,ok,\n";
  };
  const Command check = [] {
    Command c;
    c.words = {"/usr/bin/env", "node", SDF_SOURCE_DIR "/tools/sdfchart/charts/check.mjs"};
    return c;
  }();
  const auto outcome = [&] {
    Command c = check;
    c.words.push_back(out() + "/results.csv");
    return c.run();
  };
  fill("150");
  EXPECT_EQ(outcome().status, 0);
  fill("250");
  const Outcome behind = outcome();
  EXPECT_EQ(behind.status, 1);
  for (const char* words : {"ball", "tolerance, fine", "2.5 times the triangles", "other, coarse"})
    EXPECT_NE(behind.err.find(words), std::string::npos) << behind.err;
}

class Charts : public SdfChart {
 protected:
  void SetUp() override {
    const Outcome outcome = run({scene("return sphere(1)"), "-o", out(), "-q", "--trial"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

// One run for all that can be seen in its page: a run takes seconds.
TEST_F(Charts, AreFilesOfTheirOwnAndAPageThatNeedsNoOther) {
  const std::string page = written("index.html");
  EXPECT_NE(page.find("<html"), std::string::npos);
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "<link"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.find("CGAL make_surface_mesh"), std::string::npos);
  const std::string svg = written("meshing-scene-time-error-root-mean-square.svg");
  for (const char* words : {"<svg", "time (s)", "scene units", "better", "uniform", "default"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(written("meshing-scene-time-error-root-mean-square.png").substr(1, 3), "PNG");

  const std::string browser = SDF_CHROMIUM;
  if (browser.empty()) return;
  Command open;
  open.words = {"/usr/bin/env",  browser,
                "--headless",    "--no-sandbox",
                "--disable-gpu", "--virtual-time-budget=5000",
                "--dump-dom",    "file://" + out() + "/index.html"};
  const Outcome opened = open.run();
  EXPECT_EQ(opened.status, 0) << opened.err;
  // The script has come to its end and has drawn into each box.
  EXPECT_NE(opened.out.find("<body data-drawn=\""), std::string::npos);
  EXPECT_NE(opened.out.find("<svg"), std::string::npos);
}

}  // namespace program_test
}  // namespace sdf
