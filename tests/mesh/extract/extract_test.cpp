#include <gtest/gtest.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <glm/vector_relational.hpp>
#include <random>

#include "mesh/scenes.h"
#include "sdf/eval/batch.h"
#include "sdf/mesh/band/band_grid-inl.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/extract/cell_patches.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"

namespace sdf::test {
namespace extract_test {

using openvdb::Coord;
using Quad = std::array<std::uint32_t, 4>;
constexpr float kBackground = 3.0f;

openvdb::FloatGrid::Ptr makeGrid(double h) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(kBackground);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(h));
  return grid;
}

// The number of the first point among `points` at p, but for rounding: points share a place where the surface
// passes through a sample.
class PointNumbers {
 public:
  explicit PointNumbers(const std::vector<openvdb::Vec3s>& points, float tolerance) : tolerance_(tolerance) {
    for (std::uint32_t i = 0; i < points.size(); ++i)
      sorted_.push_back({{points[i].x(), points[i].y(), points[i].z()}, i});
    std::sort(sorted_.begin(), sorted_.end(), [](const Entry& a, const Entry& b) { return a.at.x < b.at.x; });
  }
  /// -1: there is none.
  std::int64_t at(const glm::vec3& p) const {
    auto it = std::lower_bound(sorted_.begin(), sorted_.end(), p.x - tolerance_,
                               [](const Entry& e, float x) { return e.at.x < x; });
    for (; it != sorted_.end() && it->at.x <= p.x + tolerance_; ++it)
      if (glm::all(glm::lessThanEqual(glm::abs(it->at - p), glm::vec3(tolerance_)))) return it->number;
    return -1;
  }

 private:
  struct Entry {
    glm::vec3 at;
    std::uint32_t number;
  };
  std::vector<Entry> sorted_;
  float tolerance_;
};

template <class T>
std::vector<T> sorted(std::vector<T> all) {
  std::sort(all.begin(), all.end());
  return all;
}

// Each quad from that corner on from which it reads least, in order.
std::vector<Quad> canonical(std::vector<Quad> quads) {
  for (Quad& q : quads) {
    Quad turned = q;
    for (int i = 0; i < 3; ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      q = std::min(q, turned);
    }
  }
  return sorted(std::move(quads));
}

// Voxels that our points keep off samples, along each axis: OpenVDB's may lie on them, several in one place.
constexpr double kOffSamples = 1.0 / 4096;

// Holds the extraction of a grid to OpenVDB's: the same points but for rounding and for what keeps them off
// samples, and the same quads.
void expectOpenVdbsSurface(openvdb::FloatGrid& grid, std::size_t atLeast = 1) {
  const double h = grid.voxelSize().x();
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, triangles, quads, 0.0, 0.0);
  ASSERT_TRUE(triangles.empty());
  ASSERT_GE(quads.size(), atLeast);
  const RawSurface surface = extractSurface(grid.tree(), h);
  ASSERT_EQ(surface.points.size(), points.size());
  ASSERT_EQ(surface.triangles.size(), 2 * quads.size());

  // Sums and products of numbers of the points' size, in float there and here.
  float size = static_cast<float>(h);
  for (const glm::vec3& p : surface.points) size = std::max(size, glm::length(p));
  const PointNumbers numbers(points,
                             static_cast<float>(8 * kRoundoff) * size + static_cast<float>(kOffSamples * h));
  std::vector<std::uint32_t> number, numberThere;
  for (const glm::vec3& p : surface.points) {
    const std::int64_t n = numbers.at(p);
    ASSERT_GE(n, 0) << p.x << ' ' << p.y << ' ' << p.z;
    number.push_back(static_cast<std::uint32_t>(n));
  }
  for (const auto& p : points)
    numberThere.push_back(static_cast<std::uint32_t>(numbers.at({p.x(), p.y(), p.z()})));
  ASSERT_EQ(sorted(number), sorted(numberThere));

  std::vector<Quad> ours, theirs;
  for (std::size_t i = 0; i < surface.triangles.size(); i += 2) {
    const glm::uvec3 a = surface.triangles[i], b = surface.triangles[i + 1];
    ASSERT_TRUE(b.x == a.x && b.y == a.z) << "not cut from one quad";
    ours.push_back({number[a.x], number[a.y], number[a.z], number[b.z]});
    const auto& p = surface.points;
    ASSERT_LE(glm::distance(p[a.x], p[a.z]), glm::distance(p[a.y], p[b.z]) + 8 * kRoundoff * size);
  }
  for (const auto& q : quads)
    theirs.push_back({numberThere[q[0]], numberThere[q[1]], numberThere[q[2]], numberThere[q[3]]});
  ASSERT_EQ(canonical(ours), canonical(theirs));
}

// Samples of random size; `inside(c)` says their sign.
class Samples {
 public:
  float operator()(bool inside) { return inside ? -size_(random_) : size_(random_); }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<float> size_{0.1f, 1.0f};
};

TEST(Extract, EverySignOfACellAndOfTwoNeighboursIsMeshedAsByOpenVdb) {
  // Boxes of 2 x 2 x 3 samples of all signs, along each axis, each in a cube of 5^3 of one sign: some cross
  // the borders of leaves.
  constexpr int kCube = 5, kAlong = 16, kSigns = 1 << 12;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool around : {false, true}) {
      SCOPED_TRACE(::testing::Message() << "axis " << axis << ", in the " << (around ? "solid" : "open"));
      const auto grid = makeGrid(1.0);
      auto accessor = grid->getAccessor();
      Samples sample;
      const int side = kCube * kAlong;
      for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
          for (int z = 0; z < side; ++z) accessor.setValue({x, y, z}, sample(around));
      for (int signs = 0; signs < kSigns; ++signs)
        for (int i = 0; i < 12; ++i) {
          Coord c(signs % kAlong * kCube + 1, signs / kAlong % kAlong * kCube + 1,
                  signs / kAlong / kAlong * kCube + 1);
          c[axis] += i / 4, c[(axis + 1) % 3] += i / 2 % 2, c[(axis + 2) % 3] += i % 2;
          accessor.setValue(c, sample((signs >> i & 1) != 0));
        }
      expectOpenVdbsSurface(*grid, kSigns);
    }
}

TEST(Extract, AmbiguousFacesDoNotSpoilTheManifold) {
  // Noise of one octave: many ambiguous cells, and neighbours of every kind.
  const auto grid = makeGrid(0.25);
  auto accessor = grid->getAccessor();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  constexpr int kSide = 40;
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y)
      for (int z = 0; z < kSide; ++z) {
        const bool rim = std::min({x, y, z}) == 0 || std::max({x, y, z}) == kSide - 1;
        accessor.setValue({x - 13, y - 13, z - 13}, rim ? 1.0f : value(random));
      }
  expectOpenVdbsSurface(*grid, 3 * kSide * kSide * kSide / 4);
  const RawSurface surface = extractSurface(grid->tree(), 0.25);
  MeshStats stats;
  measureTopology(surface.triangles, surface.points.size(), stats);
  EXPECT_TRUE(stats.watertight);
  EXPECT_TRUE(stats.manifold);
}

TEST(Extract, TheSurfaceMayLeaveTheLeaves) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const auto grid = makeGrid(0.1);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    for (int i = 0; i < 64; ++i) {
      if (random() % 3 != 0) continue;
      const Coord origin(i / 16 * 8 - 16, i / 4 % 4 * 8 - 16, i % 4 * 8 - 16);
      auto leaf = std::make_unique<openvdb::FloatTree::LeafNodeType>(origin, 0.0f, true);
      for (int k = 0; k < 512; ++k) leaf->buffer().data()[k] = random() % 4 ? 1.0f : value(random);
      grid->tree().addLeaf(leaf.release());
    }
    expectOpenVdbsSurface(*grid);
  }
}

// The leaves in which a scene's surface can be seen, and tiles of the right sign between them.
openvdb::FloatGrid::Ptr gridOf(const Shape& shape, const Box& bounds, double h) {
  const auto grid = makeGrid(h);
  const TapePtr tape = tapeOf(shape)->firstOutputOnly();
  BatchEvaluator batch;
  const auto lowest = [&](double v) { return static_cast<int>(std::floor(v / h / 8.0)) * 8 - 8; };
  for (int i = lowest(bounds.min.x); i * h <= bounds.max.x + h; i += 8)
    for (int j = lowest(bounds.min.y); j * h <= bounds.max.y + h; j += 8)
      for (int k = lowest(bounds.min.z); k * h <= bounds.max.z + h; k += 8) {
        float x[512], y[512], z[512], f[512];
        for (int n = 0; n < 512; ++n)
          x[n] = static_cast<float>((i + n / 64) * h), y[n] = static_cast<float>((j + n / 8 % 8) * h),
          z[n] = static_cast<float>((k + n % 8) * h);
        batch.evaluate(*tape, {.x = x, .y = y, .z = z}, 512, f);
        if (std::none_of(f, f + 512, [&](float v) { return std::abs(v) <= 2.0 * h; })) continue;
        auto leaf = std::make_unique<openvdb::FloatTree::LeafNodeType>(Coord(i, j, k), 0.0f, true);
        std::copy_n(f, 512, leaf->buffer().data());
        grid->tree().addLeaf(leaf.release());
      }
  openvdb::tools::signedFloodFillWithValues(grid->tree(), kBackground, -kBackground);
  return grid;
}

TEST(Extract, ScenesAreMeshedAsByOpenVdb) {
  const struct {
    const char* name;
    Shape shape;
    double h;
  } scenes[] = {
      {"bored box", boredBox(), 1.0 / 24},
      {"smooth union", melt(), 1.0 / 24},
      {"hundreds of balls", strewn(400, 0.09), 1.0 / 20},
      {"sheet that falls between the samples in part",
       translate(rotate(ringAndSheet(), {0.01, 0.013, 0.0}), {.0137, .0213, .0311}), 1.0 / 32},
      {"faces on the lattice", box({0.5, 0.75, 0.25}) | translate(box({0.25, 0.25, 0.25}), {0.75, 0.0, 0.0}),
       1.0 / 16},
      {"far from the origin", translate(torus(0.8, 0.3), {0.3, 0.2, -0.4}), 1.0 / 40},
  };
  for (const auto& s : scenes) {
    SCOPED_TRACE(s.name);
    expectOpenVdbsSurface(*gridOf(s.shape, region(2.0), s.h), 1000);
  }
}

TEST(Extract, TheNumberOfThreadsChangesNothing) {
  const auto surfaceBy = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return extractSurface(gridOf(strewn(100, 0.2), region(2.0), 1.0 / 20)->tree(), 1.0 / 20);
  };
  const RawSurface one = surfaceBy(1), many = surfaceBy(8);
  ASSERT_FALSE(one.points.empty());
  EXPECT_EQ(one.points, many.points);
  EXPECT_EQ(one.triangles, many.triangles);
}

}  // namespace extract_test
}  // namespace sdf::test
