// Meshes that are made while the window goes on, and what a session does with them.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "sdf/meshfile/read_mesh.h"
#include "support/folder.h"
#include "viewer/app/canvas.h"
#include "viewer/app/mesh_job.h"
#include "viewer/app/session.h"
#include "viewer/gpu/context.h"
#include "viewer/shaders/compile_count.h"

namespace sdf::viewer {
namespace mesh_test {

constexpr double kPatience = 120.0;  // seconds; sanitizers and other tests share the cores
constexpr const char* kBall =
    "camera{from = {0, 0, 5}, to = {0, 0, 0}}\n"
    "part('ball', sphere(param('size', 1, {min = 0.5, max = 2})):translate(0 * time, 0, 0))\n";
// Takes far longer to mesh, at voxels of a thousandth, than it takes to be told to stop.
constexpr const char* kLong = "return sphere(1):twist(3) | box({1, 0.2, 1})";

template <class Condition>
bool until(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

class MeshJobTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  MeshOrder order(const std::string& text, double voxelSize) {
    return {.file = write("scene.lua", text), .request = {{.voxelSize = voxelSize}, {}, false}};
  }
  static MeshJob::Made wait(MeshJob& job) {
    std::optional<MeshJob::Made> made;
    if (!until([&] { return (made = job.take()).has_value(); })) throw std::runtime_error("nothing was made");
    return std::move(*made);
  }
  const Folder folder;
};

TEST_F(MeshJobTest, MakesWhatWasOrdered) {
  MeshJob job;
  EXPECT_FALSE(job.working());
  EXPECT_FALSE(job.take());
  EXPECT_EQ(job.stage(), "");
  job.order(order(kBall, 0.2));
  const auto made = wait(job);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(job.working());
  EXPECT_FALSE(job.take()) << "what was made is taken once";
  EXPECT_EQ((*made)->own->parts.at(0).stats.voxelSize, 0.2);
  EXPECT_FALSE((*made)->errors);
  job.order(order(kBall, 0.2));
  EXPECT_FALSE(job.working()) << "the same order is no other work";
  job.again();
  EXPECT_TRUE(wait(job).ok());
}

TEST_F(MeshJobTest, MakesTheSceneAtItsValuesAndItsTime) {
  MeshJob job;
  MeshOrder large = order("part('b', sphere(param('size', 1, {min = 0.5, max = 9}) + time))", 0.5);
  large.values = {{"size", 2.0}};
  large.time = 3.0;
  job.order(large);
  const auto made = wait(job);
  ASSERT_TRUE(made) << made.error().message;
  float farthest = 0.0f;
  for (const glm::vec3& p : (*made)->own->parts.at(0).mesh.positions) farthest = std::max(farthest, p.x);
  EXPECT_NEAR(farthest, 5.0f, 0.1f);
}

TEST_F(MeshJobTest, TheLastOrderTakesThePlaceOfTheOneBefore) {
  MeshJob job;
  job.order(order(kLong, 0.002));
  ASSERT_TRUE(until([&] { return job.stage() != "script"; }));
  EXPECT_TRUE(job.working());
  EXPECT_NE(job.stage(), "");
  MeshOrder next{.file = write("next.lua", kBall), .request = {{.voxelSize = 0.3}, {}, false}};
  job.order(next);
  const auto made = wait(job);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ((*made)->own->parts.at(0).stats.voxelSize, 0.3);
}

TEST_F(MeshJobTest, IsCancelledAndDoesNotHoldUpWhoEndsIt) {
  const auto start = std::chrono::steady_clock::now();
  {
    MeshJob job;
    job.order(order(kLong, 0.002));
    ASSERT_TRUE(until([&] { return job.stage() != "script"; }));
    job.cancel();
    EXPECT_FALSE(job.working());
    EXPECT_EQ(job.stage(), "");
    EXPECT_FALSE(job.take());
    job.order(order(kLong, 0.002));
    EXPECT_FALSE(job.working()) << "what was cancelled begins with another order only";
    job.again();
    EXPECT_TRUE(job.working());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), kPatience / 2.0);
}

TEST_F(MeshJobTest, ManyOrdersInARowLeaveTheLast) {
  MeshJob job;
  for (int i = 0; i < 50; ++i) job.order(order(kBall, 0.1 + 0.01 * i));
  const auto made = wait(job);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ((*made)->own->parts.at(0).stats.voxelSize, 0.1 + 0.01 * 49);
}

TEST_F(MeshJobTest, ErrorsAreWords) {
  MeshJob job;
  int edition = 0;
  const auto refused = [&](MeshOrder wrong) {
    wrong.edition = ++edition;  // the file was written
    job.order(wrong);
    const auto made = wait(job);
    return made ? "" : made.error().message;
  };
  EXPECT_NE(refused(order("return plane()", 0.1)).find("unbounded"), std::string::npos);
  EXPECT_NE(refused(order("return sphere(", 0.1)).find("scene.lua:1:"), std::string::npos);
  EXPECT_NE(refused(order("return sphere(1) - sphere(2)", 0.1)).find("surface"), std::string::npos);
  MeshOrder none = order(kBall, 0.1);
  none.request.file = folder / "none.glb";
  EXPECT_NE(refused(none).find("none.glb"), std::string::npos);
  EXPECT_EQ(refused(order(kBall, 0.3)), "");
}

TEST_F(MeshJobTest, MeasuresAMeshThatIsThereWithoutMakingItAnew) {
  MeshJob job;
  MeshOrder ball = order(kBall, 0.2);
  job.order(ball);
  const auto plain = wait(job);
  ball.request.errors = true;
  job.order(ball);
  const auto measured = wait(job);
  ASSERT_TRUE(measured) << measured.error().message;
  EXPECT_EQ((*measured)->own, (*plain)->own);
  EXPECT_TRUE((*measured)->errors);
}

class MeshSessionTest : public MeshJobTest {
 protected:
  void SetUp() override {
    auto opened = Context::headless();
    ASSERT_TRUE(opened) << opened.error().message;
    context = std::move(*opened);
  }
  Session open(const std::string& text, View view) {
    Controls controls;
    controls.shader.view = view;
    controls.mesh.voxelSize = 0.2;
    auto session = Session::open(write("scene.lua", text), controls);
    if (!session) throw std::runtime_error(session.error().message);
    return std::move(*session);
  }
  /// Settles until the mesh that the controls ask for is shown, or there is a message.
  static void settle(Session& session) {
    session.settle();
    if (!until([&] {
          session.settle();
          return !session.meshing();
        }))
      throw std::runtime_error("the mesh was not made");
    session.settle();
  }
  static Picture picture(Session& session) {
    constexpr int kSize = 64;
    Canvas canvas;
    if (!canvas.update(session, kSize, kSize, 0.0)) throw std::runtime_error("cannot draw");
    auto drawn = canvas.picture(session);
    if (!drawn) throw std::runtime_error(drawn.error().message);
    return *drawn;
  }
  std::unique_ptr<Context> context;
};

TEST_F(MeshSessionTest, ShowsThePictureUntilThereIsAMesh) {
  Session session = open(kBall, View::Picture);
  settle(session);
  EXPECT_EQ(session.meshes(), 0) << "no view asks for one";
  const Picture marched = picture(session);
  session.controls.shader.view = View::Mesh;
  session.settle();
  EXPECT_TRUE(session.meshing() || session.mesh());
  settle(session);
  EXPECT_EQ(session.message(), "");
  ASSERT_TRUE(session.mesh());
  EXPECT_EQ(session.meshes(), 1);
  const Picture mesh = picture(session);
  EXPECT_NE(mesh.bytes, marched.bytes);
  for (const View view : {View::Wire, View::Split, View::Error}) {
    session.controls.shader.view = view;
    settle(session);
    EXPECT_EQ(session.message(), "");
    EXPECT_NE(picture(session).bytes, mesh.bytes) << static_cast<int>(view);
    EXPECT_EQ(session.errors() != nullptr, view == View::Error);
  }
}

// Both sides of a split view, where a value changes the slope, and then the code: more copies are near.
TEST_F(MeshSessionTest, ShowsTheMeshBesideSlopesThatFollowASlider) {
  const auto text = [](const char* cell, const char* rate) {
    return "camera{from = {1, 1, 5}, to = {0, 0, 0}}\nlocal cell, rate = param('cell', " + std::string(cell) +
           ", {min = 0.5, max = 1.7}), param('rate', " + rate +
           ", {min = 0, max = 30})\npart('row', box(0.4, 0.2, 0.2):bend(rate):repeat_grid({cell, 0, 0}, "
           "{5, 1, 1}))\n";
  };
  Session session = open(text("1.6", "10"), View::Split);
  settle(session);
  ASSERT_TRUE(session.mesh());
  for (const auto& [cell, rate] : {std::pair("1.6", "20"), std::pair("0.55", "20")}) {
    session.controls.parameters = {{"cell", std::stod(cell)}, {"rate", std::stod(rate)}};
    settle(session);
    EXPECT_EQ(session.message(), "");
    Session fresh = open(text(cell, rate), View::Split);
    settle(fresh);
    EXPECT_EQ(picture(session).bytes, picture(fresh).bytes) << cell;
    write("scene.lua", text("1.6", "10"));
  }
}

TEST_F(MeshSessionTest, FollowsTheControlsWithoutCompiling) {
  Session session = open(kBall, View::Mesh);
  settle(session);
  const std::size_t triangles = session.mesh()->shown.triangles.size();
  const Picture before = picture(session);
  const test::CompileCount count;
  session.controls.mesh.voxelSize = 0.4;
  settle(session);
  EXPECT_LT(session.mesh()->shown.triangles.size(), triangles);
  EXPECT_NE(picture(session).bytes, before.bytes);
  session.controls.mesh = {.tolerance = 0.01};
  settle(session);
  EXPECT_EQ(session.mesh()->own->tolerance, 0.01);
  session.controls.parameters["size"] = 0.5;
  settle(session);
  EXPECT_EQ(count.value(), 0);
  float farthest = 0.0f;
  for (const BufferVertex& v : session.mesh()->shown.vertices) farthest = std::max(farthest, v.position.x);
  EXPECT_NEAR(farthest, 0.5f, 0.02f);
  session.controls.split = 0.25;  // of no mesh
  session.settle();
  EXPECT_FALSE(session.meshing());
}

TEST_F(MeshSessionTest, FollowsTheFile) {
  Session session = open(kBall, View::Mesh);
  settle(session);
  write("scene.lua", "return box({3, 1, 1})");
  session.reload();
  settle(session);
  EXPECT_EQ(session.message(), "");
  float farthest = 0.0f;
  for (const BufferVertex& v : session.mesh()->shown.vertices) farthest = std::max(farthest, v.position.x);
  EXPECT_NEAR(farthest, 3.0f, 0.1f);
}

TEST_F(MeshSessionTest, SaysWhatCannotBeMeshedAndGoesOn) {
  Session session = open("return plane()", View::Picture);
  session.controls.shader.view = View::Mesh;
  settle(session);
  EXPECT_NE(session.message().find("unbounded"), std::string::npos) << session.message();
  EXPECT_FALSE(session.mesh());
  session.controls.shader.view = View::Picture;
  session.settle();
  EXPECT_EQ(session.message(), "");
  EXPECT_FALSE(session.exportMesh(folder / "a.glb").ok());
}

TEST_F(MeshSessionTest, IsCancelledAndBegunAgain) {
  Session session = open(kBall, View::Mesh);
  settle(session);
  session.controls.mesh.voxelSize = 0.003;
  session.settle();
  session.cancelMesh();
  session.settle();
  EXPECT_FALSE(session.meshing());
  EXPECT_EQ(session.mesh()->own->parts.at(0).stats.voxelSize, 0.2) << "what was shown stays";
  session.meshAgain();
  EXPECT_TRUE(session.meshing());
}

TEST_F(MeshSessionTest, ExportsWhatIsSeen) {
  Session session = open(kBall, View::Mesh);
  const auto refused = [&](const char* name) {
    const Status s = session.exportMesh(folder / name);
    return s ? "" : s.error().message;
  };
  EXPECT_EQ(refused("a.glb"), "there is no mesh yet to export; choose a view that shows one");
  settle(session);
  EXPECT_NE(refused("a.png").find("unknown extension"), std::string::npos);
  for (const char* name : {"a.glb", "a.stl"}) {
    ASSERT_EQ(refused(name), "");
    const auto read = readMesh(folder / name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->mesh.triangles.size(), session.mesh()->shown.triangles.size()) << name;
  }
  // And is held against the scene again.
  session.controls.mesh = {};
  session.controls.meshFile = folder / "a.glb";
  session.controls.shader.view = View::Error;
  settle(session);
  ASSERT_EQ(session.message(), "");
  ASSERT_TRUE(session.errors());
  EXPECT_LT(session.errors()->most, 0.05);
  EXPECT_EQ(refused("b.glb"), "what is shown is a file's mesh; show the scene's own to export it");
}

TEST_F(MeshSessionTest, LaysTheLegendOverPicturesThatAreSaved) {
  Session session = open(kBall, View::Error);
  settle(session);
  Canvas canvas;
  ASSERT_TRUE(canvas.update(session, 480, 360, 0.0));
  const auto saved = canvas.picture(session);
  ASSERT_TRUE(saved) << saved.error().message;
  int yellow = 0;
  for (std::size_t i = 0; i < saved->bytes.size(); i += 3)
    yellow += saved->bytes[i] == 255 && saved->bytes[i + 1] == 217 && saved->bytes[i + 2] == 0;
  EXPECT_GE(yellow, 20);
}

}  // namespace mesh_test
}  // namespace sdf::viewer
