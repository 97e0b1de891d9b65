#include <tbb/concurrent_set.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "sdf/mesh/band/band_grid-inl.h"
#include "sdf/mesh/extract/cell_patches.h"

namespace sdf {
namespace {

using openvdb::Coord;
using Leaf = openvdb::FloatTree::LeafNodeType;
using Accessor = openvdb::FloatGrid::ConstUnsafeAccessor;  // nothing is added to the tree while one lives

constexpr int kSide = Leaf::DIM;
constexpr int kVoxels = Leaf::SIZE;
constexpr std::size_t kBlocksATask = 32;
constexpr float kNotZero =
    std::numeric_limits<float>::min();  // leaves sums of samples that differ in sign alone

// Share of an edge that crossings keep away from its ends: where a sample is 0, the cells around it would
// have one and the same point, and triangles no area.
constexpr float kOffSample = 1.0f / 4096;

// The samples of a plane of constant x are the bits 8 y + z of a word.
using Plane = std::uint64_t;
constexpr Plane kFirstY = 0xffull, kFirstZ = 0x0101010101010101ull, kLastZ = kFirstZ << 7;

// What a cell leaves behind for its neighbours: its first point's number in the block, and two flags.
using Place = std::uint16_t;
constexpr Place kMany = 1;     // it has several points
constexpr Place kFlipped = 2;  // its patches are those of its signs' complement
constexpr int kPlaceShift = 2;

/// A leaf's cells: those whose lowest corner is a sample of it.
struct Block {
  Leaf* leaf = nullptr;
  const float* samples = nullptr;
  Place* places = nullptr;      // of its cells
  Plane inside[kSide] = {};     // which samples are negative
  std::uint32_t above[8] = {};  // the blocks at the offsets of a cell's corners; [0] is this one
  std::uint32_t points = 0;     // how many it has, then how many come before
  std::uint32_t quads = 0;
};

// Blocks that stand for all tiles outside and inside.
constexpr std::uint32_t kOutsideTile = 0, kInsideTile = 1, kTiles = 2;

// A crossed edge as a number: that of the lowest of the cells around it, the edge's axis, and whether its
// upper end is inside.
using Crossing = std::uint16_t;
constexpr int kAxisShift = 9, kUpperShift = 11;

/// What one task finds.
struct Piece {
  std::vector<glm::vec3> points;
  std::vector<Crossing> quads;
};

// Bits of four rows at once for each z, which the compiler turns into vector code.
Plane planeOf(const float* samples) {
  std::uint32_t rows[2][kSide] = {};
  for (int half = 0; half < 2; ++half)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < kSide; ++z)
        rows[half][z] |= samples[(half * 4 + y) * kSide + z] < 0.0f ? 1u << kSide * y : 0u;
  Plane bits = 0;
  for (int z = 0; z < kSide; ++z) bits |= (Plane{rows[1][z]} << 32 | rows[0][z]) << z;
  return bits;
}

/// Where the surface may be in a block: [x][2 y + z] are the signs of the samples at (x, . + y, . + z).
struct Signs {
  Plane at[kSide + 1][4];

  Signs(const std::vector<Block>& blocks, const Block& b) {
    for (int x = 0; x <= kSide; ++x) {
      const std::uint32_t* above = b.above + (x == kSide ? 4 : 0);
      Plane plane[4];
      for (int i = 0; i < 4; ++i) plane[i] = blocks[above[i]].inside[x % kSide];
      const auto alongZ = [](Plane p, Plane next) { return (p >> 1 & ~kLastZ) | (next << 7 & kLastZ); };
      at[x][0] = plane[0];
      at[x][1] = alongZ(plane[0], plane[1]);
      at[x][2] = plane[0] >> 8 | plane[2] << 56;
      at[x][3] = at[x][1] >> 8 | alongZ(plane[2], plane[3]) << 56;
    }
  }
  /// The cells of a plane whose corners differ.
  Plane mixed(int x) const {
    const Plane *a = at[x], *b = at[x + 1];
    const Plane any = a[0] | a[1] | a[2] | a[3] | b[0] | b[1] | b[2] | b[3];
    return any & ~(a[0] & a[1] & a[2] & a[3] & b[0] & b[1] & b[2] & b[3]);
  }
  /// The signs at a cell's corners.
  unsigned of(int x, int bit) const {
    unsigned inside = 0;
    for (int c = 0; c < 8; ++c) inside |= static_cast<unsigned>(at[x + (c >> 2)][c & 3] >> bit & 1) << c;
    return inside;
  }
  /// Calls visit(cell, its corners' signs) for each cell whose corners differ.
  template <class Visit>
  void forEachCell(const Visit& visit) const {
    for (int x = 0; x < kSide; ++x)
      for (Plane cells = mixed(x); cells != 0; cells &= cells - 1) {
        const int bit = std::countr_zero(cells);
        visit(x << 6 | bit, of(x, bit));
      }
  }
};

unsigned signsAt(const openvdb::FloatTree& tree, const Coord& cell) {
  unsigned inside = 0;
  for (int c = 0; c < 8; ++c)
    inside |= (tree.getValue(cell.offsetBy(c >> 2, c >> 1 & 1, c & 1)) < 0.0f ? 1u : 0u) << c;
  return inside;
}

/// Do both cells at the face that a cell's patch crosses twice have such a patch?
bool crossedTwiceFromBothSides(const openvdb::FloatTree& tree, Coord cell, unsigned inside) {
  const int face = kCellPatches[inside].twiceCrossed - 1;
  if (face < 0) return false;
  cell[face / 2] += face % 2 == 0 ? -1 : 1;
  return kCellPatches[signsAt(tree, cell)].twiceCrossed - 1 == (face ^ 1);
}

class Extraction {
 public:
  Extraction(openvdb::FloatTree& tree, double voxelSize) : tree_(tree), h_(voxelSize) {
    addTiles();
    std::vector<Leaf*> leaves;
    tree.getNodes(leaves);
    addBlocks(leaves);
    addBlocks(addMissingLeaves());  // which may be above those that there were
  }

  RawSurface run() {
    const std::size_t own = blocks_.size() - kTiles;
    places_ = std::make_unique_for_overwrite<Place[]>(own * kVoxels);
    for (std::size_t i = 0; i < own; ++i) blocks_[kTiles + i].places = places_.get() + i * kVoxels;
    pieces_.resize((own + kBlocksATask - 1) / kBlocksATask);
    forEachPiece([&](Piece& piece, std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) mesh(blocks_[i], piece);
    });
    std::uint32_t points = 0, quads = 0;
    for (Block& b : blocks_) {
      points += std::exchange(b.points, points);
      quads += std::exchange(b.quads, quads);
    }
    surface_.points.resize(points);
    surface_.triangles.resize(2 * static_cast<std::size_t>(quads));
    forEachPiece([&](Piece& piece, std::size_t first, std::size_t) {
      std::copy(piece.points.begin(), piece.points.end(), surface_.points.begin() + blocks_[first].points);
      std::vector<glm::vec3>().swap(piece.points);
    });
    forEachPiece([&](Piece& piece, std::size_t first, std::size_t end) { placeQuads(piece, first, end); });
    return std::move(surface_);
  }

 private:
  // Runs work(piece, its first block, the one after its last) over all pieces in parallel.
  template <class Work>
  void forEachPiece(const Work& work) {
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) {
      const std::size_t first = kTiles + i * kBlocksATask;
      work(pieces_[i], first, std::min(first + kBlocksATask, blocks_.size()));
    });
  }

  template <class Work>
  void forEachBlock(const Work& work) {
    tbb::parallel_for(std::size_t{kTiles}, blocks_.size(), [&](std::size_t i) { work(blocks_[i]); });
  }

  void addTiles() {
    const float far = std::abs(tree_.background());
    for (const float value : {far, -far}) {
      std::vector<float>& samples = tiles_.emplace_back(kVoxels, value);
      Block& tile = blocks_.emplace_back();
      tile.samples = samples.data();
      std::fill_n(tile.inside, kSide, value < 0.0f ? ~Plane{0} : Plane{0});
    }
  }

  void addBlocks(const std::vector<Leaf*>& leaves) {
    for (Leaf* leaf : leaves) {
      leaf->setTransientData(static_cast<openvdb::Index32>(blocks_.size()));
      blocks_.emplace_back().leaf = leaf;
    }
    forEachBlock([&](Block& b) {
      if (b.samples) return;
      b.samples = b.leaf->buffer().data();
      for (int x = 0; x < kSide; ++x) b.inside[x] = planeOf(b.samples + x * kSide * kSide);
    });
    forEachBlock([&](Block& b) {
      Accessor accessor(tree_);
      for (int i = 0; i < 8; ++i)
        if (b.above[i] < kTiles) b.above[i] = blockAt(accessor, offset(b, i, kSide));
    });
  }

  // The block of a leaf's origin moved as a cell's corner is.
  static Coord offset(const Block& b, int corner, int by) {
    return b.leaf->origin().offsetBy((corner >> 2) * by, (corner >> 1 & 1) * by, (corner & 1) * by);
  }

  static std::uint32_t blockAt(const Accessor& accessor, const Coord& origin) {
    if (const Leaf* leaf = accessor.probeConstLeaf(origin)) return leaf->transientData();
    return accessor.getValue(origin) < 0.0f ? kInsideTile : kOutsideTile;
  }

  // The cells around an edge that a sample of a leaf belongs to may have their lowest corner in no leaf: such
  // leaves are added, with the tile's value.
  std::vector<Leaf*> addMissingLeaves() {
    tbb::concurrent_set<Coord> missing;
    forEachBlock([&](Block& b) {
      const unsigned below = neededBelow(b);
      Accessor accessor(tree_);
      for (int i = 1; i < 8; ++i) {
        const Coord origin = offset(b, i, -kSide);
        if ((below >> i & 1u) && !accessor.probeConstLeaf(origin)) missing.insert(origin);
      }
    });
    std::vector<Leaf*> added;
    for (const Coord& origin : missing) {
      added.push_back(new Leaf(origin, tree_.getValue(origin), true));
      tree_.addLeaf(added.back());
    }
    return added;
  }

  // Bits of the offsets below a block at which there are cells around its crossed edges.
  unsigned neededBelow(const Block& b) const {
    constexpr int kX = 4, kY = 2, kZ = 1;
    const Signs s(blocks_, b);
    Accessor accessor(tree_);
    unsigned need = 0;
    const auto ask = [&](Plane crossed, int below) { need |= (crossed != 0 ? 1u : 0u) << below; };
    for (int x = 0; x < kSide; ++x) {
      const Plane first = x == 0 ? ~Plane{0} : 0;
      const Plane alongX = s.at[x][0] ^ s.at[x + 1][0], alongY = s.at[x][0] ^ s.at[x][2],
                  alongZ = s.at[x][0] ^ s.at[x][1];
      ask((alongX | alongZ) & kFirstY, kY), ask((alongX | alongY) & kFirstZ, kZ);
      ask((alongY | alongZ) & first, kX), ask(alongX & kFirstY & kFirstZ, kY | kZ);
      ask(alongY & first & kFirstZ, kX | kZ), ask(alongZ & first & kFirstY, kX | kY);
    }
    // Where the sign changes towards a tile below, there may be any.
    for (const int below : {kX, kY, kZ}) {
      const std::uint32_t block = blockAt(accessor, offset(b, below, -kSide));
      if (block >= kTiles) continue;
      for (int x = 0; x < (below == kX ? 1 : kSide); ++x) {
        const Plane face = below == kX ? ~Plane{0} : below == kY ? kFirstY : kFirstZ;
        if ((b.inside[x] ^ blocks_[block].inside[x]) & face) return 0xff;
      }
    }
    return need;
  }

  void mesh(Block& b, Piece& piece) {
    glm::vec3 points[kMostPatches * kVoxels];
    Crossing quads[3 * kVoxels];
    Signs(blocks_, b).forEachCell([&](int cell, unsigned inside) {
      const Coord at = b.leaf->origin() + Leaf::offsetToLocalCoord(cell);
      addQuads(b, cell, inside, quads);
      const bool flip = crossedTwiceFromBothSides(tree_, at, inside);
      if (flip) inside ^= 0xffu;
      const unsigned count = kCellPatches[inside].count;
      b.places[cell] = static_cast<Place>(b.points << kPlaceShift | (flip ? kFlipped : 0) | (count > 1));
      placePoints(b, cell, at, kPatchMeans[inside].data(), count, points + b.points);
      b.points += count;
    });
    piece.points.insert(piece.points.end(), points, points + b.points);
    piece.quads.insert(piece.quads.end(), quads, quads + b.quads);
  }

  // Adds the crossed edges that end in a cell's highest corner: the cell is the lowest of the four around
  // them. The others may be missing only where two tiles differ.
  void addQuads(Block& b, int cell, unsigned inside, Crossing* quads) const {
    const unsigned upper = inside >> 7 & 1u, leaves = leaving(cell);
    for (int axis = 0; axis < 3; ++axis) {
      if (upper == (inside >> (7u ^ cornerBit(axis)) & 1u)) continue;
      const unsigned u = leaves & cornerBit(axis + 1), v = leaves & cornerBit(axis + 2);
      if (b.above[u] >= kTiles && b.above[v] >= kTiles && b.above[u | v] >= kTiles)
        quads[b.quads++] = static_cast<Crossing>(cell | axis << kAxisShift | upper << kUpperShift);
    }
  }

  void placePoints(const Block& b, int cell, const Coord& at, const PatchMean* means, unsigned count,
                   glm::vec3* points) const {
    float corner[8], crossing[kCellEdges];
    if (leaving(cell) == 0) {
      for (unsigned c = 0; c < 8; ++c) corner[c] = std::abs(b.samples[cell + step(c)]);
    } else {
      for (unsigned c = 0; c < 8; ++c) {
        const auto [block, place] = moved(b, cell, c);
        corner[c] = std::abs(block.samples[place]);
      }
    }
    for (int e = 0; e < kCellEdges; ++e) {
      const float from = corner[lowerCorner(e)], to = corner[lowerCorner(e) | cornerBit(e / 4)];
      crossing[e] = std::clamp(from / (from + to + kNotZero), kOffSample, 1.0f - kOffSample);
    }
    for (unsigned patch = 0; patch < count; ++patch)
      for (int axis = 0; axis < 3; ++axis) {
        float sum = means[patch].base[axis];
        for (int e = 4 * axis; e < 4 * axis + 4; ++e) sum += means[patch].weight[e] * crossing[e];
        points[patch][axis] = static_cast<float>((at[axis] + static_cast<double>(sum)) * h_);
      }
  }

  // The block and the number of the cell (or sample) that is moved as a corner is from a cell of b.
  std::pair<const Block&, int> moved(const Block& b, int cell, unsigned corner) const {
    const unsigned leaves = leaving(cell) & corner;
    if (leaves == 0) return {b, cell + step(corner)};
    return {blocks_[b.above[leaves]], cell + step(corner) - kSide * step(leaves)};
  }
  static int step(unsigned corner) { return (corner >> 2) << 6 | (corner >> 1 & 1) << 3 | (corner & 1); }
  // The axes along which the next cell is in another block.
  static unsigned leaving(int cell) {
    return (cell >> 6 == 7 ? 4u : 0u) | ((cell >> 3 & 7) == 7 ? 2u : 0u) | ((cell & 7) == 7 ? 1u : 0u);
  }

  // Where an edge lies in the four cells around it, in that order: cellEdge's u and v.
  static constexpr int kEdgeOf[4] = {0, 2, 3, 1};

  void placeQuads(const Piece& piece, std::size_t first, std::size_t end) {
    glm::uvec3* triangles = surface_.triangles.data() + 2 * static_cast<std::size_t>(blocks_[first].quads);
    std::size_t block = first, before = blocks_[first].quads;
    for (std::size_t i = 0; i < piece.quads.size(); ++i) {
      while (block + 1 < end && blocks_[block + 1].quads <= before + i) ++block;
      const Block& b = blocks_[block];
      const int cell = piece.quads[i] & (kVoxels - 1), axis = piece.quads[i] >> kAxisShift & 3;
      const unsigned u = cornerBit(axis + 1), v = cornerBit(axis + 2);
      // Counter-clockwise, seen against the axis.
      const unsigned corner[4] = {u | v, v, 0, u};
      std::uint32_t quad[4];
      Place flags = 0;
      if ((leaving(cell) & (u | v)) == 0)
        for (int k = 0; k < 4; ++k) {
          const Place place = b.places[cell + step(corner[k])];
          flags |= place;
          quad[k] = b.points + (place >> kPlaceShift);
        }
      else
        flags = kMany;
      if (flags & kMany)
        for (int k = 0; k < 4; ++k) quad[k] = pointOf(b, cell, corner[k], 4 * axis + kEdgeOf[k]);
      if (piece.quads[i] >> kUpperShift) std::swap(quad[1], quad[3]);
      cut(quad, triangles + 2 * i);
    }
  }

  // The point of the patch that crosses an edge of the cell that is moved as a corner is from a cell of b.
  std::uint32_t pointOf(const Block& b, int cell, unsigned corner, int edge) const {
    const auto [block, at] = moved(b, cell, corner);
    const Place place = block.places[at];
    std::uint32_t point = block.points + (place >> kPlaceShift);
    if (place & kMany) {
      const unsigned inside = Signs(blocks_, block).of(at >> 6, at & 63);
      point += kCellPatches[place & kFlipped ? inside ^ 0xffu : inside].of[edge];
    }
    return point;
  }

  // A quad as two triangles, cut along its shorter diagonal.
  void cut(const std::uint32_t* q, glm::uvec3* triangles) const {
    const auto squared = [&](int i, int k) {
      const glm::vec3 d = surface_.points[q[i]] - surface_.points[q[k]];
      return glm::dot(d, d);
    };
    const int first = squared(0, 2) <= squared(1, 3) ? 0 : 1;
    triangles[0] = {q[first], q[first + 1], q[first + 2]};
    triangles[1] = {q[first], q[first + 2], q[(first + 3) % 4]};
  }

  openvdb::FloatTree& tree_;
  double h_;
  std::vector<std::vector<float>> tiles_;
  std::vector<Block> blocks_;
  std::vector<Piece> pieces_;
  std::unique_ptr<Place[]> places_;
  RawSurface surface_;
};

}  // namespace

RawSurface extractSurface(openvdb::FloatTree& tree, double voxelSize) {
  return Extraction(tree, voxelSize).run();
}

}  // namespace sdf
