#include "sdf/mesh/mesher.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cstring>
#include <map>
#include <thread>

#include "mesh/scenes.h"
#include "sdf/eval/batch.h"
#include "sdf/mesh/surface/surface_paint.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/solids/flats.h"
#include "support/payloads.h"
#include "support/polygons.h"

namespace sdf::test {
namespace mesher_test {

const std::vector<std::string> kStages{"bounds",    "sampling", "extraction", "projection", "creases",
                                       "balancing", "borders",  "measuring",  "normals",    "colouring"};

Result<MeshedShape> tryMesh(const Shape& shape, const MeshOptions& options) {
  Progress progress;
  return meshShape(shape, "floor", options, progress);
}
MeshedShape meshed(const Shape& shape, const MeshOptions& options) { return tryMesh(shape, options).value(); }

Shape ground() { return plane({0.0, 1.0, 0.0}, 0.0); }

Shape paintedPair() {
  return translate(sphere(0.5), {-0.3, 0.0, 0.0}).paint({.color = {1.0, 0.0, 0.0}}) |
         translate(sphere(0.4), {0.3, 0.1, 0.0}).paint({.color = {0.0, 0.0, 1.0}});
}

TEST(FindBounds, KeepsWhatAShapeKnows) {
  const Box b = findBounds(translate(box({1.0, 2.0, 3.0}), {5.0, 0.0, 0.0}));
  EXPECT_EQ(b.min, glm::dvec3(4.0, -2.0, -3.0));
  EXPECT_EQ(b.max, glm::dvec3(6.0, 2.0, 3.0));
}

TEST(FindBounds, FindsAFieldsExtentByIntervals) {
  const Box b = findBounds(latticeBall());
  ASSERT_TRUE(b.finite());
  // The search ends at the power of two beyond, 2; then each side is bisected eight times over at most 4.
  const double step = 4.0 / 256;
  EXPECT_TRUE(region(1.5 + step).contains(b));
  // The lattice reaches the ball somewhere near each axis: samples of the solid must lie within.
  const Tape tape(latticeBall().distance);
  BatchEvaluator batch;
  Box seen;
  const int n = 100;
  std::vector<float> x(n), y(n), z(n), f(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      auto at = [](int k) { return static_cast<float>(-1.6 + 3.2 * (k + 0.5) / n); };
      for (int k = 0; k < n; ++k) x[k] = at(i), y[k] = at(j), z[k] = at(k);
      batch.evaluate(tape, {.x = x.data(), .y = y.data(), .z = z.data()}, n, f.data());
      for (int k = 0; k < n; ++k)
        if (f[k] < 0.0f) seen = unite(seen, {{x[k], y[k], z[k]}, {x[k], y[k], z[k]}});
    }
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(b.contains(seen));
}

TEST(FindBounds, FindsAFieldFarFromTheOrigin) {
  const Vec3E p = position() - Vec3E(300.0, -7.0, 0.0);
  const Box b = findBounds(field(dot(p, p) - 1.0));
  const Box truth{{299.0, -8.0, -1.0}, {301.0, -6.0, 1.0}};
  ASSERT_TRUE(b.finite());
  EXPECT_TRUE(b.contains(truth));
}

TEST(FindBounds, LeavesOpenSidesOpen) {
  const Box half = findBounds(ground());
  EXPECT_EQ(half.min, glm::dvec3(-kInfinity));
  EXPECT_EQ(half.max.x, kInfinity);
  EXPECT_EQ(half.max.z, kInfinity);
  EXPECT_FALSE(findBounds(gyroid(1.0, 0.1)).finite());
  const Vec3E p = position();
  const Box column = findBounds(field(length(p.x, p.z) - 1.0));
  EXPECT_TRUE(std::isinf(column.min.y) && std::isinf(column.max.y));
  EXPECT_TRUE(std::isfinite(column.min.x) && std::isfinite(column.max.z));
}

TEST(FindBounds, AnIntersectionIsAsSmallAsItsParts) {
  EXPECT_TRUE(region(1.0).contains(findBounds(gyroid(1.0, 0.1) & box(Vec3E(1.0)))));
  EXPECT_TRUE(region(1.0).contains(findBounds(ground() & sphere(1.0))));
}

TEST(MeshShape, MeasuresWhatItMade) {
  const double r = 1.0;
  const MeshedShape m = meshed(sphere(r), {});
  const MeshStats& s = m.stats;
  EXPECT_DOUBLE_EQ(s.voxelSize, 2.0 * r / 200.0) << "the longest side in 200 voxels";
  EXPECT_EQ(s.triangles, m.mesh.triangles.size());
  EXPECT_EQ(s.vertices, m.mesh.welded);
  EXPECT_EQ(m.mesh.triangleMaterial.size(), m.mesh.triangles.size());
  EXPECT_TRUE(s.watertight && s.manifold);
  EXPECT_EQ(s.components, 1);
  EXPECT_EQ(s.eulerCharacteristic, 2);
  EXPECT_GT(s.voxels, s.vertices);
  // Vertices lie on the sphere; triangles, with corners up to 3h apart, sag by no more than 3/2 h² / r.
  const double sag = 1.5 * s.voxelSize * s.voxelSize / r, rounding = 16.0 * kRoundoff;
  EXPECT_LE(s.maxDistance, sag + rounding);
  EXPECT_LE(s.rmsDistance, s.maxDistance);
  // A triangle of n on an area of 4 pi r² has its centroid below the sphere by about its area / (3 sqrt(3) r)
  // or more, which an equilateral one attains; half of it allows for the samples nearer to the corners.
  const double area = 4.0 * kPi * r * r / static_cast<double>(s.triangles);
  EXPECT_GE(s.maxDistance, 0.5 * area / (3.0 * std::sqrt(3.0) * r));
  EXPECT_NEAR(signedVolume(m.mesh.positions, m.mesh.triangles), 4.0 / 3.0 * kPi, 4.0 * kPi * sag);
}

// Each stage that reports is held up by a time of its own at its first report, which must show in its seconds
// and in no other's.
TEST(MeshShape, TellsItsStagesAndTheirTimes) {
  using Seconds = std::chrono::duration<double>;
  struct Recorder : Progress {
    std::vector<std::string> stages;
    std::map<std::string, Seconds> heldUp;
    std::atomic<bool> sound{true}, waits{false};
    void beginStage(std::string_view name) override {
      stages.emplace_back(name);
      waits = true;
    }
    void update(double f) override {
      if (!(f >= 0.0 && f <= 1.0)) sound = false;
      if (!waits.exchange(false)) return;
      const auto start = std::chrono::steady_clock::now();
      std::this_thread::sleep_for(std::chrono::milliseconds(20 * stages.size()));
      heldUp[stages.back()] = std::chrono::steady_clock::now() - start;
    }
  } progress;
  const auto start = std::chrono::steady_clock::now();
  const auto m = meshShape(paintedPair(), "part", {.voxelSize = 1.0 / 32}, progress);
  const Seconds wall = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(m.ok());
  EXPECT_EQ(progress.stages, kStages);
  EXPECT_TRUE(progress.sound);
  EXPECT_GE(progress.heldUp.size(), 3u) << "stages that report";
  double sum = 0.0;
  std::vector<std::string> names;
  for (const auto& [name, seconds] : m->stageSeconds) {
    names.push_back(name);
    EXPECT_GE(seconds, progress.heldUp[name].count()) << name;
    sum += seconds;
  }
  EXPECT_EQ(names, kStages);
  EXPECT_LE(sum, wall.count()) << "a stage's time was counted twice";
}

TEST(MeshShape, RefusesAnUnboundedShapeAndNamesItsAxes) {
  struct Case {
    Shape shape;
    const char* axes;
  };
  for (const Case& c :
       {Case{ground(), "unbounded in x, y and z"}, Case{infiniteCylinder(1.0), "unbounded in y;"},
        Case{repeatGrid(sphere(0.3), {1.0, 0.0, 1.0}), "unbounded in x and z;"}}) {
    const auto m = tryMesh(c.shape, {});
    ASSERT_FALSE(m.ok());
    EXPECT_EQ(m.error().kind, ErrorKind::Scene);
    EXPECT_NE(m.error().message.find("part 'floor'"), std::string::npos) << m.error().message;
    EXPECT_NE(m.error().message.find(c.axes), std::string::npos) << m.error().message;
  }
}

TEST(MeshShape, ClipsToTheBoundsClosedAndWatertight) {
  const Box clip{{-1.03, -0.71, -0.9}, {0.97, 0.8, 1.0}};
  const glm::dvec3 size = clip.size();
  const double h = 1.0 / 32, whole = size.x * size.y * size.z;
  const double balls = 4.0 / 3.0 * kPi * 0.2 * 0.2 * 0.2;
  struct Case {
    const char* name;
    Shape shape;
    double volume;
    int components;
  };
  // Lattice of balls: those at x, z in {-0.5, 0, 0.5}, y in {-0.5, 0, 0.5}, and at x = -1, z = 1 in part.
  for (const Case& c : {Case{"plane", ground(), size.x * 0.71 * size.z, 1},
                        Case{"sphere around it all", sphere(9.0), whole, 1},
                        Case{"endless lattice", repeatGrid(sphere(0.2), Vec3E(0.5)), 0.0, 0}}) {
    SCOPED_TRACE(c.name);
    const MeshedShape m = meshed(c.shape, {.voxelSize = h, .bounds = clip});
    EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
    if (c.components > 0) {
      EXPECT_EQ(m.stats.components, c.components);
      EXPECT_EQ(m.stats.eulerCharacteristic, 2);
      // Only what lies within two voxels of an edge may be missing.
      const double edges = 4.0 * (size.x + size.y + size.z) * 4.0 * h * h;
      EXPECT_NEAR(signedVolume(m.mesh.positions, m.mesh.triangles), c.volume, edges);
    } else {
      EXPECT_GE(m.stats.components, 27);
      EXPECT_GT(signedVolume(m.mesh.positions, m.mesh.triangles), 27 * balls * 0.9);
    }
    const double rounding = 16.0 * kRoundoff;
    for (const glm::vec3& p : m.mesh.positions) ASSERT_TRUE(clip.grown(rounding).contains({p, p}));
  }
}

TEST(MeshShape, BoundsThatHoldTheShapeLeaveItAlone) {
  const MeshOptions free{.voxelSize = 1.0 / 16};
  MeshOptions held = free;
  held.bounds = region(3.0);
  const Mesh a = meshed(sphere(1.0), free).mesh, b = meshed(sphere(1.0), held).mesh;
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(MeshShape, MeshesSamplesOnAGrid) {
  constexpr double kRadius = 0.7;
  const auto grid = std::make_shared<const Grid>(17, 1.0, [](auto p) { return glm::length(p) - kRadius; });
  // The second derivatives of the distance add up to 2 / r; linear interpolation is off by h²/8 of that.
  const double h = 2.0 * grid->halfCell(), nearest = kRadius - std::sqrt(3.0) * h;
  const double off = h * h / 8.0 * 2.0 / nearest;
  const Shape ball = field(payloadHere(grid), region(1.0), grid->lipschitz());
  const MeshedShape m = meshed(ball, {.voxelSize = 1.0 / 40});
  EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
  EXPECT_EQ(m.stats.components, 1);
  EXPECT_EQ(m.stats.eulerCharacteristic, 2);
  ASSERT_GT(m.mesh.positions.size(), 1000u);
  // A vertex leaves the surface by 3 / 20 of the most that the gradient turns by along an edge of its
  // triangles, times that edge's length: the gradients of two cells, along a cell's diagonal of the mesher's.
  const double moved = 0.15 * (h / nearest) * std::sqrt(3.0) / 40.0;
  for (std::size_t i = 0; i < m.mesh.positions.size(); ++i) {
    const glm::dvec3 p(m.mesh.positions[i]);
    ASSERT_NEAR(grid->value(p), 0.0, moved);
    ASSERT_NEAR(glm::length(p), kRadius, off + moved);
    // At a face between cells the gradients differ by as much as cells are wide, seen from the middle.
    ASSERT_GE(glm::dot(glm::dvec3(m.mesh.normals[i]), p / glm::length(p)), std::cos(h / nearest));
  }
}

// A union of payloads and balls, turned and moved, has the mesh of the balls that they are.
TEST(MeshShape, MeshesPayloadsInAUnion) {
  const auto four = fourPoints();
  const Shape data = field(payloadHere(four), region(1.25), 1.0);
  std::vector<Shape> balls;
  for (const glm::dvec3& c : four->points()) balls.push_back(translate(sphere(four->radius()), Vec3E(c)));
  const auto placed = [](const Shape& s) {
    return unite(
        {rotate(s, {0.3, 0.5, 0.0}), translate(s, {2.4, 0.0, 0.1}), translate(sphere(0.3), Vec3E(-1.0))});
  };
  const MeshedShape got = meshed(placed(data), {.voxelSize = 1.0 / 32});
  const MeshedShape expected = meshed(placed(unite(balls)), {.voxelSize = 1.0 / 32});
  EXPECT_TRUE(got.stats.watertight);
  EXPECT_EQ(got.stats.components, expected.stats.components);
  EXPECT_EQ(got.stats.eulerCharacteristic, expected.stats.eulerCharacteristic);
  EXPECT_NEAR(signedVolume(got.mesh.positions, got.mesh.triangles),
              signedVolume(expected.mesh.positions, expected.mesh.triangles), 1e-3);
}

// The edges of a polygon whose distance is data are as sharp as those of a formula: each corner of its upper
// rim is met by a vertex, within a seventh of a voxel.
TEST(MeshShape, KeepsTheEdgesOfAPolygonOfManySides) {
  const auto corners = starCorners(40, 0.9);
  const Shape cut = subtract({extrude(polygon(corners), 0.3), sphere(0.5)});
  const MeshedShape m = meshed(cut, {.voxelSize = 1.0 / 50});
  EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
  EXPECT_EQ(m.stats.eulerCharacteristic, 0);
  for (const glm::dvec2& corner : corners) {
    double nearest = 1.0;
    for (const glm::vec3& p : m.mesh.positions)
      nearest = std::min(nearest, glm::distance(glm::dvec3(p), glm::dvec3(corner, 0.3)));
    EXPECT_LE(nearest, 0.15 / 50);
  }
}

class SamplingCounter : public Progress {
 public:
  void beginStage(std::string_view name) override { count += name == "sampling"; }
  int count = 0;
};

TEST(MeshShape, StartsFromTheLargestVoxelsThatKeepTheTolerance) {
  for (const Shape& shape :
       {sphere(1.0), rotateAbout(box({1.0, 0.7, 0.4}), {0.6, 0.8, 0.0}, 0.5), boredBox()}) {
    SamplingCounter samplings;
    const MeshStats stats =
        meshShape(shape, "part", {.voxelSize = 0.02, .tolerance = 4e-3}, samplings).value().stats;
    EXPECT_LE(samplings.count, 4);  // of the smallest, and of 16, 8 and 4 times as large ones
    EXPECT_EQ(stats.voxelSize, 0.02);
    EXPECT_LE(stats.maxDistance, 4e-3);
    // Those that the smallest voxels gave are among the points that were looked at.
    EXPECT_GE(stats.surfacePoints, 15000u);
    EXPECT_TRUE(stats.watertight && stats.manifold);
    EXPECT_EQ(stats.crossings, 0u);
  }
}

// Edges that are rounded about as sharply as the tolerance leave slim triangles with few samples. Of many
// tolerances one in twenty needs voxels of half the size, another one with each instruction set's roundings.
TEST(MeshShape, NeedsNoFinerVoxelsForRoundedEdges) {
  const Shape body = round(box({1.0, 0.5, 1.0}), 0.1), dome = translate(sphere(0.7), {0.0, 0.6, 0.0});
  const Shape shape = unite(body, dome, {Blend::Kind::Quadratic, 0.2});
  int missed = 0;
  for (double tolerance = 2.51e-3; tolerance < 3.2e-3; tolerance *= 1.0215) {
    SamplingCounter samplings;
    const MeshStats stats =
        meshShape(shape, "part", {.voxelSize = 0.0115, .tolerance = tolerance}, samplings).value().stats;
    EXPECT_LE(stats.maxDistance, tolerance);
    EXPECT_LE(samplings.count, 5) << tolerance;
    missed += samplings.count > 4;
  }
  EXPECT_LE(missed, 1);
}

// Each is three voxels wide.
TEST(MeshShape, KeepsWhatOnlyTheSmallestVoxelsSee) {
  const Shape bores = infiniteCylinder(0.03);
  const Shape bored = subtract(box(Vec3E(1.0)), translate(bores, {0.313, 0.0, 0.217}));
  EXPECT_EQ(meshed(bored, {.voxelSize = 0.02, .tolerance = 4e-3}).stats.eulerCharacteristic, 0);
  const Shape warted = sphere(1.0) | translate(sphere(0.03), {0.6, 0.8, 0.0});
  const MeshedShape mesh = meshed(warted, {.voxelSize = 0.02, .tolerance = 4e-3});
  EXPECT_LE(mesh.stats.maxDistance, 4e-3);
  double top = 0.0;
  for (const glm::vec3& p : mesh.mesh.positions) top = std::max<double>(top, glm::length(p));
  EXPECT_GE(top, 1.026);
}

// Squares 25 voxels wide, and a spot of six, which is as round as the tolerance asks: a polygon in it has so
// much less of its area.
TEST(MeshShape, KeepsThePaintThatOnlyTheSmallestVoxelsSee) {
  constexpr double kRadius = 0.06, kTolerance = 1e-3;
  const Vec3E p = position();
  const Expr squares = select(less(0.0, sin(kPi * 4.0 * p.x) * sin(kPi * 4.0 * p.z)), 1.0, 0.0),
             spot = select(less(length(p - Vec3E(0.537, 0.1, 0.313)), kRadius), 1.0, 0.0);
  const Shape board = box({1.0, 0.1, 1.0});
  const auto redOf = [](const MeshedShape& m) {
    double red = 0.0;  // area times colour, seen from above
    for (const glm::uvec3& t : m.mesh.triangles) {
      const glm::vec3 &a = m.mesh.positions[t.x], &b = m.mesh.positions[t.y], &c = m.mesh.positions[t.z];
      const double area = 0.5 * glm::cross(b - a, c - a).y;
      if (area > 0.0)
        red += area * (m.mesh.colors[t.x].x + m.mesh.colors[t.y].x + m.mesh.colors[t.z].x) / 3.0;
    }
    return red;
  };
  const MeshedShape squared = meshed(board.paint({.color = {squares, 0.5, 0.5}}), {.tolerance = kTolerance});
  // Borders, 28 long, are found to a 128th of an edge of the lattice: 0.003 in all.
  EXPECT_NEAR(redOf(squared), 2.0, 0.01);
  EXPECT_LE(squared.stats.triangles, 500u);
  const MeshedShape spotted =
      meshed(board.paint({.color = {spot, 0.5, 0.5}}), {.voxelSize = 0.02, .tolerance = kTolerance});
  EXPECT_NEAR(redOf(spotted), kPi * kRadius * kRadius, 2.0 * kTolerance * 2.0 * kPi * kRadius);
}

TEST(MeshShape, SaysWhenThereIsNothingToMesh) {
  const Vec3E p = position();
  struct Case {
    Shape shape;
    std::optional<Box> bounds;
    const char* says;
  };
  for (const Case& c :
       {Case{field(dot(p, p) + 1.0), {}, "no surface"},
        Case{field(dot(p, p) + 1.0), region(1.0), "no surface inside the bounds at a voxel size of 0.1"},
        Case{translate(sphere(1.0), {9.0, 0.0, 0.0}), region(1.0), "nothing inside the bounds"},
        Case{sphere(-1.0), {}, "radius must be positive"}}) {
    const auto m = tryMesh(c.shape, {.voxelSize = 0.1, .bounds = c.bounds});
    ASSERT_FALSE(m.ok());
    EXPECT_EQ(m.error().kind, ErrorKind::Scene);
    EXPECT_NE(m.error().message.find(c.says), std::string::npos) << m.error().message;
    EXPECT_NE(m.error().message.find("part 'floor'"), std::string::npos) << m.error().message;
    EXPECT_EQ(m.error().message.find('\n'), std::string::npos);
  }
}

TEST(MeshShape, NamesAVoxelSizeThatSeesWhatIsTooThin) {
  const Shape sheet = translate(box({1.0, 0.01, 1.0}), {0.0, 0.05, 0.0});
  const auto refused = tryMesh(sheet, {.voxelSize = 0.1});
  ASSERT_FALSE(refused.ok());
  const std::string &message = refused.error().message, says = "at a voxel size of 0.1; take one of ";
  const std::size_t at = message.find(says);
  ASSERT_NE(at, std::string::npos) << message;
  EXPECT_TRUE(tryMesh(sheet, {.voxelSize = std::stod(message.substr(at + says.size()))}).ok()) << message;
}

// No voxels in reach would see it.
TEST(MeshShape, HasWhatIsFarTooThinMadeThicker) {
  const auto refused = tryMesh(translate(box({1.0, 1e-5, 1.0}), {0.0, 0.05, 0.0}), {.voxelSize = 0.1});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("at a voxel size of 0.1; make it thicker than 0.1"),
            std::string::npos)
      << refused.error().message;
}

// A maximum takes the box alone where the dome is no number: there it reaches beyond the dome's bounds.
TEST(MeshShape, BlamesWhatIsNoNumberForWhatLeavesTheBounds) {
  const Vec3E p = position();
  const Box bounds{{-1.5, -0.5, -1.5}, {1.5, 1.5, 1.5}};
  const Shape dome = field(p.y - sqrt(1.0 - p.x * p.x - p.z * p.z), bounds);
  const Shape block = translate(box({2.0, 1.2, 2.0}), {0.0, 1.2, 0.0});
  const auto refused = tryMesh(intersect(dome, block), {.voxelSize = 0.05});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message.find("part 'floor': the distance is no number at ("), 0u)
      << refused.error().message;
}

// The unit ball by a formula that is steep near one point of its surface only: up to 21 there.
Expr steepSomewhere() {
  const Vec3E p = position(), q = p - Vec3E(0.6, 0.6, 0.53);
  return (length(p) - 1.0) * (20.0 * exp(-200.0 * dot(q, q)) + 1.0);
}

TEST(MeshShape, RefusesWhatContradictsTheBoundsAndSlopeStatedForIt) {
  const Expr ball = length(position()) - 1.0;
  struct Case {
    const char* says;
    Expr formula;
    Box bounds;
    double slope;
    Box trueBounds;
    double trueSlope;
  };
  for (const Case& c : {
           // Closed, but beyond its bounds; cut open by them; without the pieces where the slope is false:
           // with
           // its sides open, and as a dent with walls.
           Case{"the surface leaves the bounds (-1, -1, -1) to (1, 1, 0.95)",
                ball,
                {glm::dvec3(-1.0), {1.0, 1.0, 0.95}},
                1.0,
                region(1.0),
                1.0},
           Case{"the surface leaves the bounds (-0.5, -1, -1) to (1, 1, 1)",
                ball,
                {{-0.5, -1.0, -1.0}, glm::dvec3(1.0)},
                1.0,
                region(1.0),
                1.0},
           Case{"the mesh is torn open at (", ball * 2.0, region(1.1), 1.0, region(1.1), 2.0},
           Case{"the mesh is off by about 0.074", steepSomewhere(), region(1.2), 1.0, region(1.2), kInfinity},
       }) {
    SCOPED_TRACE(c.says);
    const auto refused = tryMesh(field(c.formula, c.bounds, c.slope), {.voxelSize = 0.02});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::Scene);
    EXPECT_EQ(refused.error().message.find("part 'floor': " + std::string(c.says)), 0u)
        << refused.error().message;
    const bool blamesBounds = std::string(c.says).starts_with("the surface leaves");
    EXPECT_NE(refused.error().message.find(blamesBounds ? "enlarge the bounds of its field"
                                                        : "allows 1. Enlarge the lipschitz"),
              std::string::npos)
        << refused.error().message;
    EXPECT_TRUE(tryMesh(field(c.formula, c.trueBounds, c.trueSlope), {.voxelSize = 0.02}).ok());
  }
}

TEST(MeshShape, RefusesWhatWouldNotFit) {
  const auto m = tryMesh(sphere(1.0), {.voxelSize = 1e-4, .maxMemory = double(1 << 28)});
  ASSERT_FALSE(m.ok());
  EXPECT_EQ(m.error().kind, ErrorKind::Limits);
  EXPECT_NE(m.error().message.find("voxel size of 0.0001 "), std::string::npos) << m.error().message;
}

TEST(MeshShape, StopsInEveryStage) {
  struct Stopper : Progress {
    std::string at;
    void beginStage(std::string_view name) override {
      if (name == at) stop();
    }
  };
  for (const std::string& stage : kStages) {
    SCOPED_TRACE(stage);
    Stopper progress;
    progress.at = stage;
    const auto m = meshShape(paintedPair(), "part", {.voxelSize = 1.0 / 32}, progress);
    ASSERT_FALSE(m.ok());
    EXPECT_EQ(m.error().kind, ErrorKind::Interrupted);
  }
}

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(MeshShape, MakesTheSameBytesForAnyNumberOfThreads) {
  const Shape shapes[] = {strewn(100, 0.2, true), melt(), paintedPair()};
  for (const Shape& shape : shapes) {
    auto run = [&](int threads) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      return meshed(shape, {.voxelSize = 1.0 / 16});
    };
    const MeshedShape one = run(1);
    for (const int threads : {2, 5}) {
      const MeshedShape other = run(threads);
      EXPECT_TRUE(sameBytes(one.mesh.positions, other.mesh.positions));
      EXPECT_TRUE(sameBytes(one.mesh.normals, other.mesh.normals));
      EXPECT_TRUE(sameBytes(one.mesh.colors, other.mesh.colors));
      EXPECT_TRUE(sameBytes(one.mesh.triangles, other.mesh.triangles));
      EXPECT_TRUE(sameBytes(one.mesh.triangleMaterial, other.mesh.triangleMaterial));
      EXPECT_TRUE(sameBytes(one.mesh.copyOf, other.mesh.copyOf));
      EXPECT_EQ(one.stats.rmsDistance, other.stats.rmsDistance);
      EXPECT_EQ(one.stats.maxDistance, other.stats.maxDistance);
      EXPECT_EQ(one.stats.voxels, other.stats.voxels);
    }
  }
}

TEST(MeshShape, HasNormalsWhereADistanceIsARoot) {
  // A trapezoid's is the root of a square, whose slope is 0 on the surface itself. A normal is rounded some
  // times.
  const Mesh mesh = meshed(revolve(trapezoid(0.6, 0.2, 0.5)), {.voxelSize = 1.0 / 24}).mesh;
  std::size_t onSide = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 p(mesh.positions[i]);
    if (std::abs(p.y) > 0.4) continue;
    ++onSide;
    const double radius = std::hypot(p.x, p.z);
    const glm::dvec3 exact = glm::normalize(glm::dvec3(p.x / radius, 0.4, p.z / radius));
    EXPECT_LT(glm::distance(glm::dvec3(mesh.normals[i]), exact), 16 * 0x1p-24) << "vertex " << i;
  }
  EXPECT_GT(onSide, 500u);
}

TEST(MeshShape, HasUnitNormalsHoweverSlightOrSteepTheFieldIs) {
  const Vec3E p = position();
  for (const double scale : {1e-30, 1e-22, 1e-19, 1.0, 1e19, 1e25}) {
    const Mesh mesh =
        meshed(field((dot(p, p) - 1.0) * scale), {.voxelSize = 0.25, .bounds = region(1.5)}).mesh;
    ASSERT_FALSE(mesh.positions.empty()) << scale;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      EXPECT_NEAR(glm::distance(mesh.normals[i], glm::normalize(mesh.positions[i])), 0.0f, 1e-5f) << scale;
  }
}

// Roundings of a few tolerances, on a lattice of so many triangles that blocks of them are changed at once.
TEST(MeshShape, KeepsAToleranceAtSmallRoundings) {
  const Shape frame = round(subtract(box({1.96, 0.16, 1.96}), box({1.5, 1.0, 1.5})), 0.04);
  const MeshedShape m = meshed(frame, {.voxelSize = 0.022, .tolerance = 3.4e-3});
  EXPECT_LE(m.stats.maxDistance, 3.4e-3);
  EXPECT_LT(m.mesh.triangles.size(), 450u);
}

TEST(MeshShape, KeepsAToleranceWithFewTriangles) {
  const Shape turned = rotate(box({1.0, 0.6, 0.8}), {0.3, 0.5, 0.2});
  const MeshedShape cuboid = meshed(turned, {.voxelSize = 0.05, .tolerance = 1e-3});
  EXPECT_EQ(cuboid.mesh.triangles.size(), 12u);
  EXPECT_EQ(cuboid.mesh.welded, 8u);
  EXPECT_EQ(cuboid.stats.tolerance, 1e-3);
  const MeshedShape ball = meshed(sphere(1.0), {.voxelSize = 0.04, .tolerance = 1e-3});
  EXPECT_LE(ball.stats.maxDistance, 1e-3);
  EXPECT_LE(ball.mesh.triangles.size(), 3200u);  // 1.32 times the fewest, 0.1925 * 4 pi / 1e-3
  EXPECT_TRUE(ball.stats.watertight && ball.stats.manifold);
  EXPECT_EQ(meshed(sphere(1.0), {.voxelSize = 0.04}).stats.tolerance, 0.0);
}

TEST(MeshShape, HalvesVoxelsForAToleranceUntilThinPartsAreSeen) {
  // A fifth of a voxel thick, and between the samples.
  const Shape plate = translate(box({1.5, 1.5, 0.01}), {0.0137, 0.0213, 0.0311});
  const MeshedShape m = meshed(plate, {.voxelSize = 4.0 / 64, .tolerance = 1e-3});
  EXPECT_EQ(m.mesh.triangles.size(), 12u);
  EXPECT_EQ(m.stats.unresolved, 0u);
  EXPECT_LT(m.stats.voxelSize, 0.02);
}

// The area of a mesh's triangles whose corners all have this colour, but for what colours are held to.
double areaOf(const Mesh& mesh, const glm::vec3& color) {
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto isOff = [&](std::uint32_t v) {
      return colorDifference({color, {}}, {mesh.colors[v], {}}) > kColorTolerance;
    };
    if (isOff(t.x) || isOff(t.y) || isOff(t.z)) continue;
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

// Squares of two colours whose sides are askew to the lattice and end nowhere near its samples.
TEST(MeshShape, KeepsPatternsWithFewTriangles) {
  const Vec3E p = position();
  const Expr stripe = select(less(0.0, sin(3.0 * p.x + 0.4) * sin(3.0 * p.y)), 1.0, 0.25);
  const Shape board =
      rotate(box({2.0, 2.0, 0.1}).paint({.color = Vec3E(stripe, 0.25, 0.25)}), {0.2, 0.1, 0.3});
  for (const double tolerance : {0.0, 2e-3}) {
    const MeshedShape m = meshed(board, {.voxelSize = 0.05, .tolerance = tolerance});
    EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
    const double one = areaOf(m.mesh, {1.0f, 0.25f, 0.25f}), other = areaOf(m.mesh, {0.25f, 0.25f, 0.25f});
    const double whole = 2.0 * 16.0 + 4.0 * 4.0 * 0.2;
    EXPECT_NEAR(one + other, whole, 1e-3 * whole) << "no triangle is of two colours";
    EXPECT_GT(std::min(one, other), 0.3 * whole);
    if (tolerance > 0.0) {
      EXPECT_LT(m.mesh.triangles.size(), 600u);
    }
  }
}

TEST(MeshShape, KeepsBordersOfMaterialsWithinATolerance) {
  const double tolerance = 1e-3;
  const MeshedShape m = meshed(paintedPair(), {.voxelSize = 0.02, .tolerance = tolerance});
  EXPECT_EQ(m.stats.tolerance, tolerance);
  EXPECT_LE(m.stats.maxDistance, tolerance);
  EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
  EXPECT_EQ(m.stats.components, 1u);
  EXPECT_LT(m.mesh.triangles.size(), meshed(paintedPair(), {.voxelSize = 0.02}).mesh.triangles.size() / 10);
  ASSERT_EQ(m.mesh.materials.size(), 2u);
  for (std::size_t t = 0; t < m.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const glm::uvec3& corners = m.mesh.triangles[t];
      ASSERT_EQ(m.mesh.colors[corners[k]], m.mesh.materials[m.mesh.triangleMaterial[t]].color);
      // On the ball of its colour: the red one's centre is at -0.3.
      const bool red = m.mesh.colors[corners[k]].x > 0.5f;
      const glm::dvec3 centre = red ? glm::dvec3(-0.3, 0.0, 0.0) : glm::dvec3(0.3, 0.1, 0.0);
      ASSERT_NEAR(glm::distance(glm::dvec3(m.mesh.positions[corners[k]]), centre), red ? 0.5 : 0.4,
                  2.0 * tolerance);
    }
}

TEST(MeshShape, KeepsColoursThatChangeSlowly) {
  const Vec3E p = position();
  const Shape ball = sphere(1.0).paint({.color = Vec3E(0.5 + 0.4 * sin(4.0 * p.x), 0.3, 0.2)});
  const MeshedShape m = meshed(ball, {.voxelSize = 0.04, .tolerance = 5e-3});
  EXPECT_LE(m.stats.maxDistance, 5e-3);
  const MeshedShape plain = meshed(sphere(1.0), {.voxelSize = 0.04, .tolerance = 5e-3});
  EXPECT_GT(m.mesh.triangles.size(), plain.mesh.triangles.size()) << "colours ask for more";
  // In between, as a screen shows it: what the tolerance of colours is, and a half for what is off the
  // surface.
  for (const glm::uvec3& t : m.mesh.triangles) {
    const glm::vec3 middle = (m.mesh.positions[t.x] + m.mesh.positions[t.y] + m.mesh.positions[t.z]) / 3.0f;
    const float red = (m.mesh.colors[t.x].x + m.mesh.colors[t.y].x + m.mesh.colors[t.z].x) / 3.0f,
                exact = 0.5f + 0.4f * std::sin(4.0f * middle.x);
    ASSERT_NEAR(std::sqrt(red), std::sqrt(exact), 1.0 / 64 + 0.04);
  }
}

TEST(MeshShape, SaysWhichToleranceCannotBeKept) {
  const auto tiny = tryMesh(sphere(1.0), {.voxelSize = 0.04, .tolerance = 1e-7});
  ASSERT_FALSE(tiny.ok());
  EXPECT_EQ(tiny.error().kind, ErrorKind::Limits);
  EXPECT_EQ(
      tiny.error().message,
      "part 'floor': a tolerance of 1e-07 is below the rounding of coordinates at this size; take at least "
      "1.90735e-06");
  // Walls between two bores that run out to nothing.
  const Shape knives = subtract({box(Vec3E(1.0)), translate(infiniteCylinder(0.5), {0.501, 0.0, 0.0}),
                                 translate(infiniteCylinder(0.5), {-0.501, 0.0, 0.0})});
  const auto refused = tryMesh(knives, {.voxelSize = 0.2, .tolerance = 1e-5});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::Limits);
  EXPECT_NE(refused.error().message.find("could not be kept; the best that was reached is "),
            std::string::npos)
      << refused.error().message;
}

}  // namespace mesher_test
}  // namespace sdf::test
