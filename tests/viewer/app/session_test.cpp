// What the window shows, without the window.
#include <gtest/gtest.h>

#include <sstream>

#include "support/folder.h"
#include "viewer/app/canvas.h"
#include "viewer/app/materials.h"
#include "viewer/headless_test.h"
#include "viewer/shaders/compile_count.h"

namespace sdf::viewer {
namespace session_test {

using test::CompileCount;

constexpr int kSize = 49;  // pixels; odd, for one in the middle

// Clocks of machines that draw whatever is asked at once, and that take long for little.
double stopped() { return 0.0; }
std::function<double()> slow() {
  return [seconds = 0.0]() mutable { return seconds += 0.01; };
}

// Flat red before black; the slider moves it, the clock does nothing that shows.
constexpr const char* kBall = R"(local x = param("x", 0, {min = -2, max = 2})
local size = param("size", 1, {min = 0.5, max = 2})
part("ball", sphere(size):translate(x + 0 * time, 0, 0):paint{color = {0.5, 0, 0}, emission = {1, 0, 0}})
directional_light{direction = {0, 0, 1}}
camera{from = {0, 0, 6}, to = {0, 0, 0}, fov = 40}
gamma(1)
)";

class SessionTest : public HeadlessTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HeadlessTest::SetUp());
    write(kBall);
  }
  std::filesystem::path file() const { return folder / "ball.lua"; }

  /// As an editor does; the time of writing moves even where the clock of the file system is coarse.
  void write(const std::string& text) {
    std::ofstream(file()) << text;
    ++writes;
    std::filesystem::last_write_time(
        file(), std::filesystem::file_time_type::clock::now() + std::chrono::seconds(writes));
  }

  Session open() {
    auto session = Session::open(file(), start);
    if (!session) throw std::runtime_error(session.error().message);
    return std::move(*session);
  }

  static Picture picture(Session& session) {
    session.settle();
    Canvas canvas(stopped);
    if (!canvas.update(session, kSize, kSize, 0.0)) throw std::runtime_error("cannot draw");
    auto drawn = canvas.picture(session);
    if (!drawn) throw std::runtime_error(drawn.error().message);
    return *drawn;
  }

  static glm::ivec3 middle(Session& session) {
    const Picture drawn = picture(session);
    const std::uint8_t* p = &drawn.bytes[3 * (kSize / 2 * kSize + kSize / 2)];
    return {p[0], p[1], p[2]};
  }

  const Folder folder;
  Controls start;
  int writes = 0;
};
using CanvasTest = SessionTest;

// Shaders are relative to a place that the camera stays near to, and follow it when it does not.
TEST_F(SessionTest, FollowsTheCameraToFarPlaces) {
  write(R"(local x = param("x", 6455808, {min = 0, max = 1e7})
part("ball", sphere(1):translate(x, 0, 0):paint{color = {0.5, 0, 0}, emission = {1, 0, 0}})
background(0) directional_light{direction = {0, 0, 1}} gamma(1))");
  Session session = open();
  const int red = middle(session).x;
  EXPECT_GE(red, 250);
  EXPECT_EQ(session.renderer().origin(), glm::dvec3(6455808.0, 0.0, 0.0));
  Eye eye = session.eye();
  eye.from.x += 10.0, eye.to.x += 10.0;
  session.controls.eye = eye;
  session.controls.parameters["x"] = 6455818.0;
  EXPECT_EQ(middle(session).x, red);
  EXPECT_EQ(session.compilations(), 1);
  session.controls.parameters["x"] = 3.0;
  session.controls.eye = Eye{.from = {3.0, 0.0, 6.0}, .to = {3.0, 0.0, 0.0}};
  EXPECT_EQ(middle(session).x, red);
  EXPECT_EQ(session.compilations(), 2);
}

using MaterialsTest = SessionTest;
using WatchTest = SessionTest;

TEST_F(WatchTest, TellsEachWritingOnce) {
  Watch watch(file());
  EXPECT_FALSE(watch.written());
  write(std::string(kBall) + "-- more\n");
  EXPECT_TRUE(watch.written());
  EXPECT_FALSE(watch.written());
  write(std::string(kBall) + "-- less\n");  // as long as before
  EXPECT_TRUE(watch.written());
}

TEST_F(WatchTest, WaitsForAFileThatIsBeingReplaced) {
  Watch watch(file());
  std::filesystem::remove(file());
  EXPECT_FALSE(watch.written());
  write(kBall);
  EXPECT_TRUE(watch.written());
}

TEST_F(SessionTest, ASliderTheClockTheLightAndTheCameraCompileNothing) {
  Session session = open();
  const Picture before = picture(session);
  const int compilations = session.compilations();
  const CompileCount count;
  const auto changesThePicture = [&](const char* what) {
    EXPECT_NE(picture(session).bytes, before.bytes) << what;
    session.controls = {};
  };
  session.controls.parameters["x"] = 1.0;
  changesThePicture("slider");
  session.controls.look.lights[0] = session.look().lights[0];
  session.controls.look.lights[0].color = glm::vec4(0.0f, 4.0f, 0.0f, 1.0f);
  session.controls.look.ambient = glm::vec3(0.0f, 0.0f, 1.0f);
  session.controls.look.fogDensity = 0.2f;
  session.controls.look.fogColor = glm::vec3(0.0f, 1.0f, 0.0f);
  changesThePicture("light");
  session.controls.eye = Eye{{0.0, 0.0, 4.0}};
  changesThePicture("camera");
  session.controls.maxSteps = 1;
  changesThePicture("steps");
  session.controls.time = 2.0;
  picture(session);
  EXPECT_EQ(count.value(), 0);
  EXPECT_EQ(count.tapes(), 0u);
  EXPECT_EQ(session.compilations(), compilations);
}

constexpr const char* kBent = R"(local bend, size = param("bend", 5, {min = 0, max = 40}), param("size", 1)
part("bar", box(1, 0.2, 0.3):bend(bend):twist(20 * time):paint{color = {0.5, 0, 0}, emission = {1, 0, 0}})
part("ball", sphere(0.3 * size):translate(0, 1, 0))
directional_light{direction = {0, 0, 1}}
camera{from = {0, 0, 6}, to = {0, 0, 0}, fov = 40}
gamma(1)
)";

TEST_F(SessionTest, ASliderOnWhichSlopesHangCompilesNothing) {
  write(kBent);
  Session session = open();
  const Picture before = picture(session);
  const int compilations = session.compilations();
  {
    const CompileCount count;
    session.controls.parameters["bend"] = 30.0;
    session.controls.time = 1.0;
    EXPECT_NE(picture(session).bytes, before.bytes);
    EXPECT_EQ(count.value(), 0);
  }
  EXPECT_EQ(session.compilations(), compilations);
  EXPECT_EQ(session.message(), "");
  const auto readings = session.measure(kSize, kSize);
  ASSERT_TRUE(readings);
  {
    const CompileCount count;
    session.controls.parameters["size"] = 0.5;
    picture(session);
    EXPECT_EQ(count.tapes(), 0u) << "the ball is exact: the script is not run again for it";
  }

  start.parameters = {{"bend", 30.0}};
  start.time = 1.0;
  Session fresh = open();
  fresh.controls.parameters["size"] = 0.5;
  EXPECT_EQ(picture(session).bytes, picture(fresh).bytes);
  EXPECT_EQ(session.controls.parameters["bend"], 30.0);
  const auto others = fresh.measure(kSize, kSize);
  ASSERT_TRUE(others);
  EXPECT_NEAR(readings->primary, others->primary, 0.1 * others->primary);

  session.controls.parameters["bend"] = 0.0;
  session.controls.time = 0.0;
  session.controls.parameters["size"] = 1.0;
  write(std::string(kBent) + "-- changed\n");
  session.followFile();
  session.controls.parameters["bend"] = 5.0;
  EXPECT_EQ(picture(session).bytes, before.bytes) << "and a file that changes is followed as ever";
}

TEST_F(SessionTest, AnotherViewOrMethodCompilesOnce) {
  Session session = open();
  session.controls.shader.view = View::Normals;
  session.settle();
  EXPECT_EQ(session.compilations(), 2);
  EXPECT_EQ(middle(session), glm::ivec3(128, 128, 255));  // towards the eye: (n + 1) / 2
  session.controls.shader.method = Method::Plain;
  session.settle();
  session.settle();
  EXPECT_EQ(session.compilations(), 3);
}

TEST_F(SessionTest, RaysStartWhereItIsTold) {
  start.shader.start = Start::Plain;
  Session session = open();
  EXPECT_FALSE(session.renderer().shaders().plan.cones);
  session.controls.shader.start = Start::Raster;
  session.settle();
  EXPECT_EQ(session.compilations(), 2);
  EXPECT_TRUE(session.renderer().shaders().plan.hull);
  session.controls.shader.culling = false;
  session.settle();
  EXPECT_FALSE(session.renderer().shaders().plan.options.culling);
}

TEST_F(SessionTest, TheClockRunsWhilePlaying) {
  start.time = 1.5;
  Session session = open();
  EXPECT_TRUE(session.hasClock());
  session.advance(1.0);
  EXPECT_EQ(session.controls.time, 1.5);
  session.playing = true;
  session.advance(1.0);
  EXPECT_EQ(session.frame().parameters.at("time"), 2.5);
}

TEST_F(SessionTest, BeginsWithWhatItIsGiven) {
  start.parameters = {{"x", 2.0}};
  start.eye = Eye{{0.0, 0.0, 9.0}};
  Session session = open();
  EXPECT_EQ(session.frame().parameters.at("x"), 2.0);
  EXPECT_EQ(session.eye().from, glm::dvec3(0.0, 0.0, 9.0));
  start.parameters = {{"y", 2.0}};
  const auto refused = Session::open(file(), start);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Scene);
}

TEST_F(SessionTest, MovesTheCameraToWhereAllIsInView) {
  Session session = open();
  const Eye before = session.eye();
  ASSERT_TRUE(session.fit());
  const Eye wide = session.eye();
  EXPECT_TRUE(wide.fittedRadius);
  EXPECT_EQ(wide.from.x, 0.0);
  EXPECT_EQ(wide.to, before.to);
  session.controls.parameters["size"] = 2.0;
  ASSERT_TRUE(session.fit());
  EXPECT_NEAR(session.eye().from.z, 2.0 * wide.from.z, 1e-12 * wide.from.z) << "as the ball is now";
  session.aspect = 0.5;
  ASSERT_TRUE(session.fit());
  EXPECT_GT(session.eye().from.z, 3.0 * wide.from.z) << "a narrow picture";

  write("return plane({0, 1, 0}, 0)");
  session.followFile();
  session.controls.eye = before;
  const Status refused = session.fit();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("unbounded"), std::string::npos) << refused.error().message;
  EXPECT_EQ(session.eye(), before);
}

// A tetrahedron around the origin, as large as this.
void writeTetrahedron(const std::filesystem::path& file, int size) {
  std::ofstream out(file);
  for (const char* corner : {"1 1 1", "1 -1 -1", "-1 1 -1", "-1 -1 1"}) {
    std::istringstream in(corner);
    out << 'v';
    for (int x = 0; in >> x;) out << ' ' << size * x;
    out << '\n';
  }
  out << "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
}

TEST_F(SessionTest, FollowsTheMeshesThatItsFileReads) {
  const std::filesystem::path mesh = folder / "solid.obj";
  writeTetrahedron(mesh, 1);
  write(R"(part("solid", mesh("solid.obj", {voxels = 16}))
camera{from = {0, 0, 60}, to = {0, 0, 0}})");
  Session session = open();
  session.followFile();
  EXPECT_EQ(session.compilations(), 1) << "nothing was written";
  EXPECT_EQ(session.scene().files, std::vector{std::filesystem::weakly_canonical(mesh).string()});
  writeTetrahedron(mesh, 10);
  session.followFile();
  EXPECT_EQ(session.compilations(), 2);
  EXPECT_EQ(session.message(), "");
  EXPECT_NEAR(session.scene().whole().bounds.max.x, 10.0, 1e-6);

  std::ofstream(mesh) << "no mesh";
  session.followFile();
  EXPECT_NE(session.message().find("solid.obj"), std::string::npos) << session.message();
  EXPECT_NEAR(session.scene().whole().bounds.max.x, 10.0, 1e-6) << "the scene stays";
  writeTetrahedron(mesh, 100);
  session.followFile();
  EXPECT_EQ(session.message(), "");
  EXPECT_NEAR(session.scene().whole().bounds.max.x, 100.0, 1e-5);
}

TEST_F(SessionTest, ShowsTheRestWhereAMeshIsBroken) {
  const std::filesystem::path mesh = folder / "solid.obj";
  std::ofstream(mesh) << "no mesh";
  write(R"(part("ball", sphere(0.5)) part("solid", mesh("solid.obj", {voxels = 16})))");
  Session session = open();
  EXPECT_NE(session.message().find("ball.lua:1: "), std::string::npos) << session.message();
  EXPECT_NE(session.message().find("solid.obj"), std::string::npos) << session.message();
  EXPECT_EQ(session.scene().whole().bounds.max.x, 0.5);
  writeTetrahedron(mesh, 10);
  session.followFile();
  EXPECT_EQ(session.message(), "");
  EXPECT_NEAR(session.scene().whole().bounds.max.x, 10.0, 1e-6);
  std::ofstream(mesh) << "no mesh";
  session.followFile();
  EXPECT_NE(session.message().find("solid.obj"), std::string::npos) << session.message();
  EXPECT_EQ(session.scene().whole().bounds.max.x, 0.5);
}

// The camera of a scene that has none follows the window's shape and the file, and not the clock.
TEST_F(SessionTest, FitsTheSceneWhereItHasNoCamera) {
  write("return sphere(3):translate(time, 0, 0)");
  start.time = 1.5;
  Session session = open();
  const Eye wide = session.eye();
  EXPECT_EQ(wide.to, glm::dvec3(0.0)) << "at time 0";
  session.controls.time = 2.0;
  EXPECT_EQ(session.eye(), wide);
  session.aspect = 0.5;
  EXPECT_GT(session.eye().from.z, 1.5 * wide.from.z);
  session.aspect = kPictureAspect;
  write("return sphere(300)");
  session.followFile();
  EXPECT_NEAR(session.eye().from.z, 100.0 * wide.from.z, 1e-10 * wide.from.z);
}

TEST_F(SessionTest, ReloadsASavedFileAndKeepsSlidersAndCamera) {
  Session session = open();
  session.controls.parameters = {{"x", 1.5}, {"size", 0.7}};
  session.controls.time = 3.0;
  session.controls.eye = Eye{{0.0, 0.0, 9.0}};
  session.controls.look.ambient = glm::vec3(1.0f);
  session.followFile();
  EXPECT_EQ(session.compilations(), 1);

  write(R"(local x = param("x", 0, {min = 0, max = 1})
part("cube", box(x + 0.5))
)");
  session.followFile();
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(session.scene().parts[0].name, "cube");
  EXPECT_EQ(session.controls.parameters, (Values{{"x", 1.0}})) << "kept, within the new range";
  EXPECT_EQ(session.value(session.scene().parameters[0]), 1.0);
  EXPECT_EQ(session.controls.time, 3.0);
  EXPECT_EQ(session.eye().from, glm::dvec3(0.0, 0.0, 9.0));
  EXPECT_FALSE(session.controls.look.ambient);
}

// The scene that is shown lives while the next one is loaded, and both have one formula.
TEST_F(SessionTest, ACorrectedLipschitzInAWatchedFileTakesEffect) {
  const auto fieldOf = [](const char* lipschitz) {
    return std::string(
               "return field(function(x, y, z) return 3 * (length(x, y, z) - 1) end, "
               "{bounds = {{-1, -1, -1}, {1, 1, 1}}, lipschitz = ") +
           lipschitz + "})";
  };
  write(fieldOf("0.5"));
  Session session = open();
  EXPECT_EQ(slopeOf(session.scene().parts[0].shape), 0.5);
  write(fieldOf("3"));
  session.followFile();
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(slopeOf(session.scene().parts[0].shape), 3.0);
}

TEST_F(SessionTest, ABrokenFileLeavesTheSceneAndNamesTheLine) {
  Session session = open();
  session.controls.parameters["x"] = 0.25;
  const Picture before = picture(session);
  write("part(\"ball\",\n  sphere(-1))\n");
  session.followFile();
  EXPECT_NE(session.message().find("ball.lua:2"), std::string::npos) << session.message();
  EXPECT_EQ(picture(session).bytes, before.bytes);

  session.controls.shader.view = View::Normals;  // works, but the file is still broken
  session.settle();
  EXPECT_NE(session.message(), "");
  write(kBall);
  session.followFile();
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(session.controls.parameters.at("x"), 0.25);
}

TEST_F(SessionTest, ASceneThatCannotBeDrawnLeavesTheOneBefore) {
  Session session = open();
  write("\nreturn field(function(x, y, z) return x * x * y - 1 end)\n");
  session.followFile();
  EXPECT_NE(session.message().find("ball.lua:2: "), std::string::npos) << session.message();
  EXPECT_NE(session.message().find("slope"), std::string::npos) << session.message();
  EXPECT_EQ(session.scene().parts[0].name, "ball");
}

// As many balls as n says, as large as r says.
constexpr const char* kRow = R"(local n, r = param("n", 1, {min = 1, max = 3}), param("r", 0.3)
for i = 1, value(n) do part("ball " .. i, sphere(r):translate(i, 0, 0)) end
assert(value(n) < 3, "three are too many")
)";

TEST_F(SessionTest, ASliderWhoseValueTheScriptReadRunsItAgain) {
  write(kRow);
  Session session = open();
  const CompileCount count;
  session.controls.parameters["r"] = 0.5;
  session.settle();
  EXPECT_EQ(session.compilations(), 1);
  EXPECT_EQ(count.value(), 0) << "the other one stays cheap";

  session.controls.eye = Eye{{0.0, 0.0, 9.0}};
  session.controls.look.ambient = glm::vec3(1.0f);
  session.controls.editedMaterials = {"ball 1"};
  session.controls.parameters["n"] = 2.0;
  session.settle();
  EXPECT_EQ(session.scene().parts.size(), 2u);
  EXPECT_EQ(session.controls.parameters, (Values{{"n", 2.0}, {"r", 0.5}}));
  EXPECT_EQ(session.compilations(), 2) << "at once with the material";
  EXPECT_EQ(session.eye().from, glm::dvec3(0.0, 0.0, 9.0));
  EXPECT_TRUE(session.controls.look.ambient) << "the file is the same, so what was edited stays";
  EXPECT_EQ(session.controls.editedMaterials, std::set<std::string>{"ball 1"});
  session.settle();
  EXPECT_EQ(session.compilations(), 2);
}

TEST_F(SessionTest, AValueThatTheScriptRefusesLeavesTheSceneAndIsTriedOnce) {
  write(kRow);
  Session session = open();
  session.controls.parameters["n"] = 3.0;
  session.settle();
  EXPECT_NE(session.message().find("ball.lua:3: three are too many"), std::string::npos) << session.message();
  EXPECT_EQ(session.scene().parts.size(), 1u);
  std::filesystem::remove(file());  // another run would say so
  session.settle();
  EXPECT_NE(session.message().find("three are too many"), std::string::npos) << session.message();
  write(kRow);
  session.controls.parameters["n"] = 2.0;
  session.settle();
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(session.scene().parts.size(), 2u);
}

TEST_F(SessionTest, AClockWhoseValueTheScriptReadRunsItAgain) {
  write("for i = 1, 1 + value(time) do part('ball ' .. i, sphere(0.3):translate(i, 0, 0)) end");
  Session session = open();
  EXPECT_EQ(session.scene().parts.size(), 1u);
  session.playing = true;
  session.advance(2.0);
  session.settle();
  EXPECT_EQ(session.scene().parts.size(), 3u);
}

// The script makes as many lights as its parameter says; the second one has been edited.
TEST_F(SessionTest, AnEditedLightMayGo) {
  write(R"(for i = 1, value(param("n", 2, {max = 2})) do point_light{position = {0, i, 5}} end
ambient(0.1)
return sphere(1))");
  Session session = open();
  session.controls.look.lights[1] = session.look().lights[1];
  session.controls.parameters["n"] = 1.0;
  session.settle();
  EXPECT_EQ(session.look().lights.size(), 1u);
}

// What shaders cannot compute is that of the scene that is shown, not of the one before.
TEST_F(SessionTest, SaysOfAnEditedFileWhatFloatsCannotShow) {
  start.shader.doubles = false;
  Session session = open();
  EXPECT_EQ(session.message(), "");
  write(R"(part("row", field(function(x, y, z)
  return length(x - round(x), y, z) - 0.1 - 0.2 * fract(sin(12.9898 * round(x)) * 43758.5453)
end, {lipschitz = 8, bounds = {{-9, -1, -1}, {9, 1, 1}}})))");
  session.followFile();
  EXPECT_NE(session.message().find("part 'row': its formula needs more digits"), std::string::npos)
      << session.message();
  write(kBall);
  session.followFile();
  EXPECT_EQ(session.message(), "");
}

TEST_F(SessionTest, ResettingGivesTheFilesValues) {
  write(R"(local n = param("n", 1, {min = 1, max = 3})
for i = 1, value(n) do part("ball " .. i, sphere(0.3):translate(i, 0, 0)) end
)");
  start.parameters = {{"n", 3.0}};
  Session session = open();
  EXPECT_EQ(session.scene().parts.size(), 3u);
  session.resetParameters();
  EXPECT_EQ(session.scene().parts.size(), 1u);
  EXPECT_EQ(session.value(session.scene().parameters[0]), 1.0);
}

TEST_F(SessionTest, CountsReadingsOnDemand) {
  Session session = open();
  const auto readings = session.measure(kSize, kSize);
  ASSERT_TRUE(readings) << readings.error().message;
  EXPECT_GT(readings->primary, 1.0);
  EXPECT_EQ(readings->reflection, 0.0);
}

TEST_F(MaterialsTest, AnEditedColourShowsAfterOneCompilation) {
  Session session = open();
  EXPECT_EQ(middle(session), glm::ivec3(255, 0, 0));
  session.controls.editedMaterials = {"ball"};
  EXPECT_EQ(middle(session), glm::ivec3(255, 0, 0)) << "being editable changes nothing";
  EXPECT_EQ(session.compilations(), 2);
  const CompileCount count;
  const auto set = [&](Attribute attribute, double value) {
    session.controls.materials[surfaceParameter(session.scene().parts[0], attribute)->name] = value;
  };
  set(Attribute::EmissionRed, 0.0);
  set(Attribute::EmissionGreen, 1.0);
  set(Attribute::Red, 0.0);
  EXPECT_EQ(middle(session), glm::ivec3(0, 255, 0));
  EXPECT_EQ(count.value(), 0);
}

TEST_F(MaterialsTest, AnEditedColourStaysWhereSlopesFollowASlider) {
  write(kBent);
  Session session = open();
  EXPECT_EQ(middle(session), glm::ivec3(255, 0, 0));
  session.controls.editedMaterials = {"bar"};
  const auto info = surfaceParameter(session.scene().parts.front(), Attribute::EmissionRed);
  ASSERT_TRUE(info);
  session.controls.materials[info->name] = 0.0;
  session.settle();
  const glm::ivec3 dark = middle(session);
  EXPECT_LT(dark.x, 255);
  const CompileCount count;
  session.controls.parameters["bend"] = 8.0;
  EXPECT_EQ(middle(session), dark);
  EXPECT_EQ(count.value(), 0);
}

TEST_F(MaterialsTest, AnEditedColourShowsOnAllOfAUnion) {
  write(R"(local red = {color = 0, emission = {1, 0, 0}}
part("row", union(sphere(1), sphere(1):translate(3, 0, 0)):paint(red))
part("other", sphere(1):translate(-3, 0, 0):paint{color = 0, emission = {0, 0, 1}})
camera{from = {0, 0, 6}, to = {0, 0, 0}, fov = 40}
gamma(1)
)");
  Session session = open();
  EXPECT_EQ(middle(session), glm::ivec3(255, 0, 0));
  session.controls.editedMaterials = {"row"};
  const Part& row = session.scene().parts[0];
  session.controls.materials[surfaceParameter(row, Attribute::EmissionRed)->name] = 0.0;
  session.controls.materials[surfaceParameter(row, Attribute::EmissionGreen)->name] = 1.0;
  EXPECT_EQ(middle(session), glm::ivec3(0, 255, 0));
}

TEST_F(MaterialsTest, WhatVariesOverAPartIsNoParameter) {
  write(R"(part("floor", plane():paint{color = checkerboard(0.2, 0.4), shininess = 7}))");
  const Session session = open();
  const Part& part = session.scene().parts[0];
  EXPECT_FALSE(surfaceParameter(part, Attribute::Red));
  EXPECT_FALSE(surfaceParameter(part, Attribute::MaterialId));
  EXPECT_EQ(surfaceParameter(part, Attribute::Shininess)->value, 7.0);
}

TEST_F(CanvasTest, AMovingPictureIsCoarseAndAStillOneWhole) {
  start.samples = 2;
  Session session = open();
  Canvas canvas(stopped);
  EXPECT_TRUE(*canvas.update(session, kSize, kSize, 0.0)) << "the first is whole";
  EXPECT_TRUE(canvas.whole());
  EXPECT_EQ(canvas.statistics().samples, 2);
  EXPECT_EQ(canvas.statistics().outOfSteps, 0.0);
  ASSERT_TRUE(canvas.picture(session));
  EXPECT_TRUE(canvas.resting());
  EXPECT_FALSE(*canvas.update(session, kSize, kSize, 10.0)) << "nothing changed";

  session.controls.parameters["x"] = 1.0;
  EXPECT_TRUE(*canvas.update(session, kSize, kSize, 20.0));
  EXPECT_FALSE(canvas.whole());
  EXPECT_EQ(canvas.statistics().samples, 1);
  EXPECT_FALSE(canvas.statistics().outOfSteps);
  EXPECT_FALSE(*canvas.update(session, kSize, kSize, 20.0 + 0.5 * Canvas::kStill)) << "it may move on";
  EXPECT_TRUE(*canvas.update(session, kSize, kSize, 20.0 + 1.5 * Canvas::kStill));
  EXPECT_TRUE(canvas.whole());
}

// The same samples as of a picture that is drawn at once, in another order: of 36 terms the sum moves by some
// ulps, which is less than a step of bytes but where it decides how one is rounded.
TEST_F(CanvasTest, AStillPictureIsRefinedToTheOneOfAllItsSamples) {
  Session session = open();
  Canvas canvas(stopped);
  ASSERT_TRUE(*canvas.update(session, kSize, kSize, 0.0));
  EXPECT_EQ(canvas.statistics().refined, 0);
  EXPECT_FALSE(canvas.resting());
  for (double now = 1.0; !canvas.resting(); now += 1.0) {
    const int before = canvas.statistics().refined;
    ASSERT_TRUE(*canvas.update(session, kSize, kSize, now));
    ASSERT_GT(canvas.statistics().refined, before);
  }
  EXPECT_FALSE(*canvas.update(session, kSize, kSize, 1000.0)) << "it rests";
  const auto refined = canvas.picture(session);

  auto target = Target::create(kSize, kSize, {PixelFormat::Rgba8});
  Frame frame = session.frame();
  frame.samples = usefulSamples(session.renderer().shaders().plan);
  ASSERT_EQ(frame.samples * frame.samples, canvas.samplesAtRest());
  ASSERT_TRUE(session.renderer().draw(frame, *target));
  const auto expected = target->picture();
  ASSERT_TRUE(refined && expected);
  for (std::size_t i = 0; i < refined->bytes.size(); ++i)
    ASSERT_NEAR(refined->bytes[i], expected->bytes[i / 3 * 4 + i % 3], 1) << i;
}

// Where nothing spreads 36 samples smooth the edges; what spreads takes 256; --samples may ask for more.
TEST_F(CanvasTest, HowFarItIsRefinedFollowsFromTheScene) {
  const auto atRest = [&](const std::string& settings, View view = View::Picture) {
    write(settings + "return sphere(1):paint{reflectivity = 0.5}");
    start.shader.view = view;
    Session session = open();
    Canvas canvas(stopped);
    EXPECT_TRUE(*canvas.update(session, 4, 4, 0.0));
    return canvas.samplesAtRest();
  };
  EXPECT_EQ(atRest(""), 36);
  EXPECT_EQ(atRest("reflections{glossy = true}\n"), 256);
  EXPECT_EQ(atRest("camera{aperture = 0.1}\n"), 256);
  EXPECT_EQ(atRest("camera{aperture = 0.1}\n", View::Normals), 36);
  EXPECT_EQ(atRest("point_light{radius = 0.1}\n"), 36) << "without shadows";
  EXPECT_EQ(atRest("point_light{radius = 0.1} shadows{}\n"), 256);
  start.samples = 20;
  EXPECT_EQ(atRest(""), 400);
}

TEST_F(CanvasTest, WhatTakesLongIsDrawnInPieces) {
  constexpr int kLarge = 300;
  start.samples = 8;
  Session session = open();
  Canvas canvas(slow());
  int pieces = 1;
  for (double share = 0.0; !*canvas.update(session, kLarge, kLarge, 0.0); ++pieces) {
    ASSERT_TRUE(canvas.working());
    ASSERT_FALSE(canvas.whole());
    if (canvas.statistics().samples == 1) continue;
    ASSERT_GE(*canvas.drawnShare(), share);
    share = *canvas.drawnShare();
  }
  EXPECT_GT(pieces, 5);
  EXPECT_EQ(canvas.statistics().samples, 1) << "a coarse one comes first";
  for (double now = 1.0; !canvas.whole(); now += 1.0)
    ASSERT_TRUE(canvas.update(session, kLarge, kLarge, now));
  EXPECT_FALSE(canvas.drawnShare());
  EXPECT_EQ(canvas.statistics().samples, 8);
  auto target = Target::create(kLarge, kLarge, {PixelFormat::Rgba8});
  ASSERT_TRUE(session.renderer().draw(session.frame(), *target));
  const auto expected = target->picture();
  const auto saved = canvas.picture(session);
  ASSERT_TRUE(expected && saved);
  for (std::size_t i = 0; i < saved->bytes.size(); ++i)  // refined in another order
    ASSERT_NEAR(saved->bytes[i], expected->bytes[i / 3 * 4 + i % 3], 1) << i;
}

TEST_F(CanvasTest, AChangeEndsAnUnfinishedPictureAndAFastOneComesFirst) {
  constexpr int kLarge = 300;
  Session session = open();
  Canvas canvas(slow());
  while (!*canvas.update(session, kLarge, kLarge, 0.0)) ASSERT_TRUE(canvas.working());
  session.controls.samples = 3;
  while (!*canvas.update(session, kLarge, kLarge, 1.0)) ASSERT_TRUE(canvas.working());
  ASSERT_FALSE(*canvas.update(session, kLarge, kLarge, 2.0));
  ASSERT_TRUE(canvas.drawnShare());
  session.controls.parameters["x"] = 1.0;
  for (int i = 0; !*canvas.update(session, kLarge, kLarge, 2.1); ++i) ASSERT_LT(i, 100);
  EXPECT_EQ(canvas.statistics().samples, 1);
  EXPECT_FALSE(canvas.whole());
  EXPECT_FALSE(canvas.working());
  EXPECT_FALSE(*canvas.update(session, kLarge, kLarge, 2.1 + 0.5 * Canvas::kStill)) << "it may move on";
}

TEST_F(CanvasTest, CountsPixelsThatRanOutOfSteps) {
  Session session = open();
  session.controls.maxSteps = 1;
  Canvas canvas(stopped);
  ASSERT_TRUE(canvas.update(session, kSize, kSize, 0.0));
  EXPECT_GT(canvas.statistics().outOfSteps.value(), 0.0);
}

TEST_F(CanvasTest, AMinimisedWindowKeepsItsPicture) {
  Session session = open();
  Canvas canvas(stopped);
  EXPECT_FALSE(*canvas.update(session, 0, 0, 0.0));
  EXPECT_FALSE(canvas.picture(session)) << "there is none yet";
  EXPECT_TRUE(*canvas.update(session, kSize, 1, 1.0));
  EXPECT_FALSE(*canvas.update(session, 0, 0, 2.0));
  EXPECT_EQ(canvas.picture(session)->height, 1);
}

TEST_F(CanvasTest, ASizeBeyondTheDriverIsAnError) {
  Session session = open();
  Canvas canvas(stopped);
  const auto drawn = canvas.update(session, currentDriver().mostWidth + 1, kSize, 0.0);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().kind, ErrorKind::Limits);
}

}  // namespace session_test
}  // namespace sdf::viewer
