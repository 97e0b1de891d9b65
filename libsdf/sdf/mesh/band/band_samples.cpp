// What a band's samples say where they come close to zero: films to be dropped, and surface passed unseen.
#include <openvdb/tools/Dense.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sdf/mesh/band/band_grid-inl.h"

namespace sdf {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
using openvdb::Coord;

// Of a voxel's slope: what the distance rises by, at least, on both sides of a film; more than on a curved
// surface.
constexpr float kSteep = 0.3f;
// A sample in a voxel's cube is at most half its diagonal from any point in it.
constexpr float kHalfDiagonal = 0.8660254f;
// Of a voxel's slope: a distance that falls by less on the way to an edge runs along the surface, not into
// it.
constexpr float kFall = 0.1f;

constexpr int kSide = Leaf::DIM;
constexpr int kBefore = 1, kAfter = 2;  // samples around a leaf that are looked at
constexpr int kPadded = kBefore + kSide + kAfter;

/// A leaf's samples and those around it: [x][y][z] from -kBefore on.
class Samples {
 public:
  Samples(const Leaf& leaf, const openvdb::FloatTree& tree) : origin_(leaf.origin()) {
    openvdb::tools::Dense<float> cube({coord(-kBefore, -kBefore, -kBefore), coord(kLast, kLast, kLast)},
                                      &v_[0][0][0]);
    openvdb::tools::copyToDense(tree, cube, true);
  }

  Coord coord(int x, int y, int z) const { return origin_.offsetBy(x, y, z); }
  float at(int x, int y, int z) const { return v_[x + kBefore][y + kBefore][z + kBefore]; }
  float at(const Coord& c) const { return at(c.x(), c.y(), c.z()); }

 private:
  static constexpr int kLast = kSide + kAfter - 1;

  Coord origin_;
  float v_[kPadded][kPadded][kPadded];
};

/// Calls visit(x, y, z) for each sample of a leaf that passes a cheap test, which the compiler turns into
/// vector code.
template <class Test, class Visit>
void forEach(const Test& test, const Visit& visit) {
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y) {
      char passed[kSide];
      char any = 0;
      for (int z = 0; z < kSide; ++z) any |= passed[z] = test(x, y, z);
      if (!any) continue;
      for (int z = 0; z < kSide; ++z)
        if (passed[z]) visit(x, y, z);
    }
}

Coord unitStep(int axis) { return Coord(axis == 0, axis == 1, axis == 2); }

/// Runs work(leaf, results) over all leaves in parallel and joins the results in the leaves' order.
template <class Result, class Work>
std::vector<Result> overLeaves(const openvdb::FloatTree& tree, const Work& work) {
  std::vector<const Leaf*> leaves;
  tree.getNodes(leaves);
  std::vector<std::vector<Result>> found(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) { work(*leaves[i], found[i]); });
  std::vector<Result> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// 1 where no sample around c is inside, -1 where none is outside, else 0.
int signAround(const Samples& samples, const Coord& c, float film) {
  bool inside = false, outside = false;
  for (int i = 0; i < 27; ++i) {
    const float v = samples.at(c.offsetBy(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1));
    if (v < -film) inside = true;
    if (v > film) outside = true;
  }
  return inside == outside ? 0 : outside ? 1 : -1;
}

/// The sign that a sample of zero has to get: -1 between samples inside (a slit of no width), 1 between
/// samples outside (a film of no thickness) and where solids touch in a point or along a line, that of all
/// samples around it where films or slits cross, 0 where either will do.
int settledSign(const Samples& samples, const Coord& c, float film, float steep) {
  bool slit = false, sheet = false, open = false;
  for (int axis = 0; axis < 3; ++axis) {
    const float before = samples.at(c - unitStep(axis)), after = samples.at(c + unitStep(axis));
    slit |= before < -steep && after < -steep;
    sheet |= before > steep && after > steep;
    open |= before > film && after > film;
  }
  return sheet || (slit && open) ? 1 : slit ? -1 : signAround(samples, c, film);
}

/// The most that the distance changes by from a sample to both of its neighbours on a line.
float steepnessAround(const Samples& samples, const Coord& c) {
  const float value = samples.at(c);
  float most = 0.0f;
  for (int i = 14; i < 27; ++i) {
    const Coord way(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
    const float before = std::abs(samples.at(c - way) - value), after = std::abs(samples.at(c + way) - value);
    most = std::max(most, std::min(before, after));
  }
  return most;
}

/// Could the lattice edge from `value` to `next` cross the surface twice? The distance falls towards the edge
/// from both sides, and the two distances fit into it.
bool mayCrossTwice(float before, float value, float next, float after, float slope) {
  const float sign = value < 0.0f ? -1.0f : 1.0f, near = sign * value, far = sign * next;
  return (far >= 0.0f) & (near + far <= slope) & (sign * before > near + kFall * slope) &
         (sign * after > far + kFall * slope);
}

/// Is what the lattice edge from c along an axis crosses twice more than the tip of an edge that is seen
/// beside it? Of a sheet with a hole in it the surface is seen on opposite sides, of one that is passed
/// altogether nowhere.
bool isSheet(const Samples& samples, const Coord& c, int axis) {
  const bool sign = samples.at(c) < 0.0f;
  const auto seen = [&](int u, int v) {
    Coord beside = c;
    beside[(axis + 1) % 3] += u, beside[(axis + 2) % 3] += v;
    return (samples.at(beside) < 0.0f) != sign || (samples.at(beside + unitStep(axis)) < 0.0f) != sign;
  };
  int sides = 0, pairs = 0;
  for (const auto& [u, v] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, -1}}) {
    const bool one = seen(u, v), other = seen(-u, -v);
    sides += one + other, pairs += one && other;
  }
  return sides == 0 || pairs >= 2;  // along an edge that comes and goes one pair is seen
}

/// Least and greatest of each sample's neighbourhood of 3^3, gathered axis by axis.
struct Neighbourhoods {
  float least[kSide][kSide][kSide], most[kSide][kSide][kSide];

  explicit Neighbourhoods(const Samples& s) {
    constexpr int kWide = kSide + 2;
    float low[kWide][kWide][kSide], high[kWide][kWide][kSide];
    for (int x = 0; x < kWide; ++x)
      for (int y = 0; y < kWide; ++y)
        for (int z = 0; z < kSide; ++z) {
          const float a = s.at(x - 1, y - 1, z - 1), b = s.at(x - 1, y - 1, z), c = s.at(x - 1, y - 1, z + 1);
          low[x][y][z] = std::min(a, std::min(b, c)), high[x][y][z] = std::max(a, std::max(b, c));
        }
    for (int x = 0; x < kWide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          low[x][y][z] = std::min(low[x][y][z], std::min(low[x][y + 1][z], low[x][y + 2][z]));
          high[x][y][z] = std::max(high[x][y][z], std::max(high[x][y + 1][z], high[x][y + 2][z]));
        }
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          least[x][y][z] = std::min(low[x][y][z], std::min(low[x + 1][y][z], low[x + 2][y][z]));
          most[x][y][z] = std::max(high[x][y][z], std::max(high[x + 1][y][z], high[x + 2][y][z]));
        }
  }
};

/// First-order distance from a sample, by the steepest differences to its neighbours. It does not exceed that
/// of the true gradient by more than rounding where the field is smooth.
float nearness(const Samples& samples, const Coord& c, float voxel) {
  const float value = samples.at(c);
  float squared = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float before = value - samples.at(c - unitStep(axis)),
                after = value - samples.at(c + unitStep(axis));
    squared += std::max(before * before, after * after);
  }
  return std::abs(value) / std::sqrt(squared) * voxel;
}

}  // namespace

// Where two solids touch in a face, or a cut ends in one, the distance is zero up to rounding on a film that
// is no part of the surface. Which sign its samples have would be chance; both neighbours along an axis tell.
// What is near to zero goes by how steep the distance is around it: of a formula the bound may be that of a
// place far away, thousands of times more.
void NarrowBand::settleZeros() {
  struct Change {
    Coord at;
    float value;
  };
  auto& tree = grid_->grid->tree();
  const auto changes = overLeaves<Change>(tree, [&](const Leaf& leaf, auto& found) {
    if (!leaf.transientData()) return;
    const float slope = static_cast<float>(grid_->slopeAt(leaf.origin()) * grid_->voxelSize);
    const Samples samples(leaf, tree);
    const auto near = [&](int x, int y, int z) { return std::abs(samples.at(x, y, z)) <= kFilm * slope; };
    forEach(near, [&](int x, int y, int z) {
      const Coord c(x, y, z);
      const float steep = std::min(slope, steepnessAround(samples, c)), film = kFilm * steep;
      if (std::abs(samples.at(c)) > film) return;
      const int sign = settledSign(samples, c, film, kSteep * steep);
      if (sign != 0) found.push_back({samples.coord(x, y, z), static_cast<float>(sign) * film});
    });
  });
  openvdb::FloatGrid::Accessor accessor(tree);
  for (const Change& c : changes) accessor.setValueOnly(c.at, c.value);
}

std::vector<NarrowBand::Suspect> NarrowBand::suspects() const {
  const float h = static_cast<float>(grid_->voxelSize);
  const auto& tree = grid_->grid->tree();
  return overLeaves<Suspect>(tree, [&](const Leaf& leaf, auto& found) {
    const float slope = static_cast<float>(grid_->slopeAt(leaf.origin())) * h;
    const Samples samples(leaf, tree);
    const auto suspect = [&](const Coord& c, const glm::vec3& along, float share) {
      const Coord at = samples.coord(c.x(), c.y(), c.z());
      found.push_back({glm::vec3(at.x(), at.y(), at.z()) * h, along, share, samples.at(c)});
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Coord s = unitStep(axis);
      const auto crossing = [&](int x, int y, int z) {
        return mayCrossTwice(samples.at(x - s.x(), y - s.y(), z - s.z()), samples.at(x, y, z),
                             samples.at(x + s.x(), y + s.y(), z + s.z()),
                             samples.at(x + 2 * s.x(), y + 2 * s.y(), z + 2 * s.z()), slope);
      };
      forEach(crossing, [&](int x, int y, int z) {
        const Coord c(x, y, z);
        if (!isSheet(samples, c, axis)) return;
        const float value = std::abs(samples.at(c)), both = value + std::abs(samples.at(c + s));
        glm::vec3 along(0.0f);
        along[axis] = h;
        suspect(c, along, both > 0.0f ? value / both : 0.5f);
      });
    }
    const Neighbourhoods around(samples);
    const auto alone = [&](int x, int y, int z) {
      return (std::abs(samples.at(x, y, z)) <= kHalfDiagonal * slope) &
             ((around.least[x][y][z] >= 0.0f) | (around.most[x][y][z] < 0.0f));
    };
    forEach(alone, [&](int x, int y, int z) {
      const Coord c(x, y, z);
      if (nearness(samples, c, h) <= kHalfDiagonal * h) suspect(c, glm::vec3(0.0f), 0.0f);
    });
  });
}

}  // namespace sdf
