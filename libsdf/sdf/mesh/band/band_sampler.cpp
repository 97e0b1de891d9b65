// Samples a model into a band.
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "sdf/eval/batch.h"
#include "sdf/eval/promise.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/band/band_grid-inl.h"

namespace sdf {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr int kBranch = 4;  // a cell has kBranch³ children: one pass of the batch reading
constexpr int kChildren = kBranch * kBranch * kBranch;
constexpr int kLeafVoxels = kLeaf * kLeaf * kLeaf;
constexpr int kBlock = 4;  // voxels along an eighth of a leaf
constexpr int kBlockVoxels = kBlock * kBlock * kBlock;
constexpr int kBlocks = kLeafVoxels / kBlockVoxels;
constexpr double kExact = 2.0;  // within so many voxels' slope of zero samples are looked at for their values
constexpr int kMargin = 2;  // voxels around a cell over which its tape holds: a vertex may leave its leaf by
                            // one, and move by another as it is refined
constexpr double kSqrt3 = 1.7320508075688772;

// What a surface voxel costs in the end: its share of a leaf, extraction's buffers, vertices, triangles and
// measuring.
constexpr double kBytesPerSurfaceVoxel = 300.0;
constexpr double kBytesPerLeaf = 64.0 * kBytesPerSurfaceVoxel;

// Running so many instructions over a leaf takes no longer than making it a tape of its own.
constexpr std::size_t kShortTape = 64;

using Places = std::shared_ptr<const std::vector<std::uint32_t>>;

struct Cell {
  openvdb::Coord origin;
  TapePtr tape;
  Places operands;  // of a union, those that the tape is of
  double slope;     // bound of the distance's slope over the cell and its margin
};

struct BandLeaf {
  std::unique_ptr<Leaf> leaf;
  LocalTapes tapes;
};

struct LinkedTape {
  Places operands;
  TapePtr tape;
};

struct Workspace {
  BatchEvaluator batch;
  ScalarReading<Interval> intervals;
  std::vector<Decision> decisions;
  std::vector<Decision> decisionsOfOne;
  std::vector<LinkedTape> linked;  // of the present cell's children, which often share theirs
  std::vector<LocalTapes> local;
};

// Leaves far apart may have equal tapes: one of them stands for all, so that what reads points of many leaves
// reads them in few runs.
class DistinctTapes {
 public:
  LocalTapes of(const LocalTapes& tapes) {
    const std::uint64_t hash = tapes.surface->hash();
    const auto [first, last] = known_.equal_range(hash);
    for (auto it = first; it != last; ++it)
      if (*it->second.surface == *tapes.surface) return it->second;
    return known_.emplace(hash, tapes)->second;
  }

 private:
  std::unordered_multimap<std::uint64_t, LocalTapes> known_;
};

// Independent minima, which the compiler turns into vector code. A NaN is passed over. `count` is a multiple
// of 16.
float smallestMagnitude(const float* values, int count) {
  constexpr int kLanes = 16;
  float least[kLanes];
  std::fill_n(least, kLanes, std::numeric_limits<float>::infinity());
  for (int i = 0; i < count; i += kLanes)
    for (int k = 0; k < kLanes; ++k) {
      const float v = std::abs(values[i + k]);
      least[k] = v < least[k] ? v : least[k];
    }
  return *std::min_element(least, least + kLanes);
}

bool allFinite(const float* values, int count) {
  int infinite = 0;
  for (int i = 0; i < count; ++i) infinite += !(std::abs(values[i]) <= std::numeric_limits<float>::max());
  return infinite == 0;
}

std::string shown(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

std::string gigabytes(double bytes) { return shown(bytes / (1ull << 30)); }

}  // namespace

class BandSampler {
 public:
  BandSampler(const ModelTapes& model, const BandOptions& options, Progress& progress)
      : model_(model), options_(options), progress_(progress), h_(options.voxelSize) {}

  Result<NarrowBand> run() {
    if (auto s = descend(); !s) return s.error();
    return collect();
  }

 private:
  // Finds the leaves that the surface may meet, and samples them.
  Status descend() {
    if (auto s = placeRoot(); !s) return s;
    for (level_ = 0; level_ < levels_; ++level_) {
      if (size_ > kLeaf * kBranch)
        cells_ = overChildren<Cell>(
            [](Cell child, Workspace&, auto& found) { found.push_back(std::move(child)); });
      else
        leaves_ = overChildren<BandLeaf>([&](const Cell& cell, Workspace& w, auto& found) {
          BandLeaf leaf = sampleLeaf(cell, w);
          if (leaf.leaf) found.push_back(std::move(leaf));
        });
      if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
      if (auto s = checkMemory(); !s) return s;
    }
    return okStatus();
  }

  // The smallest cell of kLeaf * kBranch^n voxels that covers the bounds and a voxel around them.
  Status placeRoot() {
    const Box& b = options_.bounds;
    const double voxels = b.longestSide() / h_;
    if (!(voxels < 1e8)) return tooLarge(kBytesPerSurfaceVoxel * voxels * voxels);
    for (int axis = 0; axis < 3; ++axis) {
      voxels_.min()[axis] = static_cast<int>(std::floor(b.min[axis] / h_)) - 1;
      voxels_.max()[axis] = static_cast<int>(std::ceil(b.max[axis] / h_)) + 1;
    }
    const openvdb::Coord first = voxels_.min() & ~(kLeaf - 1), span = voxels_.max() - first;
    size_ = kLeaf * kBranch;
    for (levels_ = 1; size_ <= std::max({span.x(), span.y(), span.z()}); ++levels_) size_ *= kBranch;
    cells_ = {{first, model_.whole(), std::make_shared<const std::vector<std::uint32_t>>(model_.all()),
               model_.slope()}};
    return okStatus();
  }

  Status tooLarge(double bytes) const {
    return Error{ErrorKind::Limits, "a voxel size of " + shown(h_) + " needs about " + gigabytes(bytes) +
                                        " GiB, more than the limit of " + gigabytes(options_.maxMemory) +
                                        " GiB; take a voxel size of " + shown(fittingVoxel(bytes)) +
                                        ", smaller bounds or a higher limit"};
  }

  // A voxel size that fits the limit: by the bytes estimated for this one, and by those that a coarse band
  // takes. A surface takes them by the square of its voxels' number. Two digits, upwards.
  double fittingVoxel(double bytes) const {
    constexpr double kCoarse = 1.0 / 100, kMargin = 1.2;  // cells may lie otherwise
    const double coarse = kCoarse * options_.bounds.longestSide();
    const BandOptions all{coarse, options_.bounds, std::numeric_limits<double>::infinity()};
    BandSampler sampler(model_, all, progress_);
    if (!sampler.descend()) return h_;  // interrupted
    const double takes = static_cast<double>(sampler.leaves_.size()) * kBytesPerLeaf;
    const double fits = kMargin * std::max(h_ * std::sqrt(bytes / options_.maxMemory),
                                           coarse * std::sqrt(takes / options_.maxMemory));
    const double digit = std::pow(10.0, std::floor(std::log10(fits)) - 1.0);
    return std::ceil(fits / digit) * digit;
  }

  // From the cells that survived so far: each meets the surface in about the area of its side.
  Status checkMemory() const {
    const double leavesAcross = static_cast<double>(size_) / kLeaf;
    const double leaves = size_ > kLeaf ? cells_.size() * leavesAcross * leavesAcross * 0.5 : leaves_.size();
    const double bytes = leaves * kBytesPerLeaf;
    return bytes > options_.maxMemory ? tooLarge(bytes) : okStatus();
  }

  // Half the side of the box that a cell's voxels and `margin` voxels around them span.
  double reach(int size, int margin) const { return ((size - 1) / 2.0 + margin) * h_; }

  glm::dvec3 centre(const openvdb::Coord& origin, int size) const {
    const double half = (size - 1) / 2.0;
    return {(origin.x() + half) * h_, (origin.y() + half) * h_, (origin.z() + half) * h_};
  }

  // The places where a cell's tape holds.
  Box reached(const openvdb::Coord& origin, int size) const {
    const glm::dvec3 c = centre(origin, size), half(reach(size, kMargin));
    return {c - half, c + half};
  }

  double slack(const glm::dvec3& c) const { return distanceRounding(c, options_.bounds.longestSide()); }

  // Calls visit(child) for each child of the cell that the surface may meet.
  template <class Visit>
  void forSurvivingChildren(const Cell& cell, Workspace& w, const Visit& visit) const {
    const int size = size_ / kBranch;
    openvdb::Coord origin[kChildren];
    PointRows centres;
    float value[kChildren];
    int count = 0;
    for (int i = 0; i < kChildren; ++i) {
      const openvdb::Coord o = cell.origin.offsetBy(i / (kBranch * kBranch) * size,
                                                    i / kBranch % kBranch * size, i % kBranch * size);
      if (!voxels_.hasOverlap(openvdb::CoordBBox::createCube(o, size))) continue;
      origin[count] = o;
      centres.set(count++, glm::vec3(centre(o, size)));
    }
    if (count == 0) return;
    const Tape& tape = *cell.tape;
    const double margin = slack(centre(cell.origin, size_));
    w.linked.clear();
    w.local.clear();
    w.batch.evaluateBalls(tape, centres.rows(), count, static_cast<float>(kSqrt3 * reach(size, kMargin)),
                          static_cast<float>(margin), value, w.decisions);
    for (int k = 0; k < count; ++k) {
      double slope = std::min<double>(tape.lipschitz(), cell.slope);
      if (!mayMeet(tape, origin[k], size, value[k], margin, slope, w)) continue;
      if (size == kLeaf && tape.instructions().size() <= kShortTape) {
        visit(Cell{origin[k], cell.tape, cell.operands, slope});
        continue;
      }
      const Places near = operandsNear(cell, origin[k], size);
      if (near->empty()) continue;
      if (near->size() < cell.operands->size()) {
        const TapePtr linked = linkedTape(near, w);
        // A leaf's tape is not looked at again: one that is long is better specialised.
        if (size > kLeaf || linked->instructions().size() <= kShortTape) {
          visit(Cell{origin[k], linked, near, slope});
          continue;
        }
      }
      const Decision* decisions = w.decisions.empty() ? nullptr : &w.decisions[k];
      std::size_t stride = count;
      if (!tape.hasSlopes()) decisions = refineDecisions(tape, origin[k], size, decisions, stride, w);
      const TapePtr special = tape.specialised(decisions, stride);
      visit(Cell{origin[k], special ? special : cell.tape, cell.operands, slope});
    }
  }

  // Those of the cell's operands that can matter in a child where samples are looked at.
  Places operandsNear(const Cell& cell, const openvdb::Coord& origin, int size) const {
    if (cell.operands->size() == 1 || model_.slope() == kInfinity) return cell.operands;
    const double most = kExact * h_ * model_.slope() + slack(centre(origin, size));
    std::vector<std::uint32_t> near = model_.relevantOperands(reached(origin, size), most, *cell.operands);
    if (near.size() == cell.operands->size()) return cell.operands;
    return std::make_shared<const std::vector<std::uint32_t>>(std::move(near));
  }

  const TapePtr& linkedTape(const Places& operands, Workspace& w) const {
    for (const LinkedTape& l : w.linked)
      if (*l.operands == *operands) return l.tape;
    return w.linked.emplace_back(LinkedTape{operands, model_.link(*operands)}).tape;
  }

  static const LocalTapes& localTapes(const TapePtr& tape, Workspace& w) {
    for (const LocalTapes& l : w.local)
      if (l.surface == tape) return l;
    const auto isConstant = [](Operand o) { return o.isConstant(); };
    TapePtr distance = tape;
    if (!std::all_of(tape->outputs().begin() + 1, tape->outputs().end(), isConstant)) {
      distance = tape->firstOutputOnly();
      if (distance->instructions().size() == tape->instructions().size())
        distance = tape;  // no need to keep both
    }
    return w.local.emplace_back(LocalTapes{tape, std::move(distance)});
  }

  // Can the zero set meet the cell (and a voxel around it)? First by the slope bound; then, where that is
  // loose, by interval values and by interval derivatives, which sharpen the bound for all that lies in the
  // cell.
  bool mayMeet(const Tape& tape, const openvdb::Coord& origin, int size, double value, double margin,
               double& slope, Workspace& w) const {
    const double radius = kSqrt3 * reach(size, 1);
    if (std::abs(value) > slope * radius + margin) return false;
    if (slope <= 1.0 || !std::isfinite(value)) return true;
    const Box box = reached(origin, size);
    const Interval range = evaluate(tape, box, w.intervals);
    if (!range.nan && (range.lo > margin || range.hi < -margin)) return false;
    // Sampling a leaf costs less than the interval derivatives that might spare it.
    if (size == kLeaf && std::isfinite(slope)) return true;
    slope = std::min(slope, lipschitzOver(tape, box));
    return std::abs(value) <= slope * radius + margin;
  }

  // Adds to what the slopes decided what intervals decide.
  const Decision* refineDecisions(const Tape& tape, const openvdb::Coord& origin, int size,
                                  const Decision* known, std::size_t& stride, Workspace& w) const {
    evaluate(tape, reached(origin, size), w.intervals, w.decisionsOfOne);
    for (std::size_t i = 0; i < w.decisionsOfOne.size(); ++i)
      if (w.decisionsOfOne[i] == Decision::Open) w.decisionsOfOne[i] = known[i * stride];
    stride = 1;
    return w.decisionsOfOne.data();
  }

  // Replaces the cells by what take(child, workspace, found) makes of their children that the surface may
  // meet; in parallel, with progress, until stopped.
  template <class Item, class Take>
  std::vector<Item> overChildren(const Take& take) {
    std::vector<std::vector<Item>> found(cells_.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t i) {
      if (progress_.stopped()) return;
      Workspace& w = workspaces_.local();
      forSurvivingChildren(cells_[i], w, [&](Cell child) { take(std::move(child), w, found[i]); });
      cells_[i].tape.reset();
      samples_ += kChildren;
      progress_.update((level_ + static_cast<double>(++done) / cells_.size()) / levels_);
    });
    cells_.clear();
    size_ /= kBranch;
    std::vector<Item> all;
    for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(all));
    return all;
  }

  // The samples of a leaf; empty where no edge of the lattice that starts or ends in it can cross the
  // surface.
  BandLeaf sampleLeaf(const Cell& cell, Workspace& w) {
    const LocalTapes& tapes = localTapes(cell.tape, w);
    const double slope = std::min<double>(tapes.distance->lipschitz(), cell.slope);
    Blocks blocks;
    float sampled[kLeafVoxels];
    const int count = sampleBlocks(cell.origin, *tapes.distance, slope, blocks, sampled, w.batch);
    // An edge of the lattice that crosses the surface has both ends within a voxel's slope of zero.
    const double near = slope * h_ + slack(centre(cell.origin, kLeaf));
    const bool finite = allFinite(sampled, count);
    const float smallest = smallestMagnitude(sampled, count);
    if (finite && smallest > near) return {};
    auto leaf = std::make_unique<Leaf>(cell.origin, 0.0f, true);
    float* values = leaf->buffer().data();
    fill(blocks, sampled, values);
    if (!finite) {
      makeFinite(cell.origin, values);
      if (smallestMagnitude(values, kLeafVoxels) > near) return {};
    }
    const auto steepest = NarrowBand::Grid::slopeOf(*tapes.distance, model_.slope());
    leaf->setTransientData(smallest <= kFilm * static_cast<float>(steepest * h_));
    return {std::move(leaf), tapes};
  }

  // The eighths of a leaf.
  struct Blocks {
    float middle[kBlocks];  // the value at their centres
    bool far[kBlocks];      // no value in it is looked at for more than its sign
  };

  static openvdb::Coord blockStart(int block) {
    return {(block >> 2) * kBlock, (block >> 1 & 1) * kBlock, (block & 1) * kBlock};
  }

  // Samples those blocks of a leaf that are not far, one after the other; the number of samples.
  int sampleBlocks(const openvdb::Coord& origin, const Tape& distance, double slope, Blocks& blocks,
                   float* sampled, BatchEvaluator& batch) {
    static_assert(kLeafVoxels <= kBatchPoints);
    PointRows places;
    for (int b = 0; b < kBlocks; ++b) places.set(b, glm::vec3(centre(origin + blockStart(b), kBlock)));
    batch.evaluate(distance, places.rows(), kBlocks, blocks.middle);
    const double far = slope * (kSqrt3 * reach(kBlock, 0) + kExact * h_) + slack(centre(origin, kLeaf));
    int count = 0;
    for (int b = 0; b < kBlocks; ++b) {
      blocks.far[b] = std::abs(blocks.middle[b]) > far && std::isfinite(blocks.middle[b]);
      if (blocks.far[b]) continue;
      placeBlock(origin + blockStart(b), places.x + count, places.y + count, places.z + count);
      count += kBlockVoxels;
    }
    samples_ += static_cast<std::uint64_t>(kBlocks + count);
    if (count > 0) batch.evaluate(distance, places.rows(), count, sampled);
    return count;
  }

  // Spreads a leaf's samples, and over far blocks their centre's value, which has their sign.
  static void fill(const Blocks& blocks, const float* sampled, float* values) {
    for (int b = 0; b < kBlocks; ++b) {
      float* to = values + Leaf::coordToOffset(blockStart(b));
      for (int row = 0; row < kBlock * kBlock; ++row) {
        float* out = to + row / kBlock * kLeaf * kLeaf + row % kBlock * kLeaf;
        if (blocks.far[b])
          std::fill_n(out, kBlock, blocks.middle[b]);
        else
          std::copy_n(std::exchange(sampled, sampled + kBlock), kBlock, out);
      }
    }
  }

  // The places of a block's voxels, z running fastest.
  void placeBlock(const openvdb::Coord& start, float* x, float* y, float* z) const {
    constexpr int kPlane = kBlock * kBlock;
    for (int i = 0; i < kBlock; ++i) {
      std::fill_n(x + i * kPlane, kPlane, static_cast<float>((start.x() + i) * h_));
      std::fill_n(y + i * kBlock, kBlock, static_cast<float>((start.y() + i) * h_));
      z[i] = static_cast<float>((start.z() + i) * h_);
    }
    for (int i = kBlock; i < kPlane; i += kBlock) std::copy_n(z, kBlock, z + i);
    for (int i = kPlane; i < kBlockVoxels; i += kPlane)
      std::copy_n(y, kPlane, y + i), std::copy_n(z, kPlane, z + i);
  }

  // The extraction takes no others. What is not a number counts as outside; the first one is the least in
  // space, whichever thread comes first.
  void makeFinite(const openvdb::Coord& origin, float* values) {
    const float far = static_cast<float>(3 * h_);
    const std::lock_guard lock(notNumbersMutex_);
    for (int i = 0; i < kLeafVoxels; ++i) {
      float& v = values[i];
      if (std::isinf(v)) v = std::copysign(far, v);
      if (!std::isnan(v)) continue;
      v = far;
      const openvdb::Coord at = origin + Leaf::offsetToLocalCoord(i);
      if (notNumbers_++ == 0 || at < firstNotNumber_) firstNotNumber_ = at;
    }
  }

  // Hands the leaves to a grid and spreads the sign to the tiles between them.
  NarrowBand collect() {
    NarrowBand band;
    band.grid_->voxelSize = h_;
    band.grid_->samples = samples_;
    band.grid_->lipschitz = model_.slope();
    band.grid_->notNumbers = {
        notNumbers_,
        glm::vec3(firstNotNumber_.x(), firstNotNumber_.y(), firstNotNumber_.z()) * static_cast<float>(h_)};
    auto& tree = band.grid_->grid->tree();
    band.grid_->tapes.reserve(leaves_.size());
    DistinctTapes distinct;
    for (BandLeaf& l : leaves_) {
      band.grid_->tapes.emplace(l.leaf->origin(), distinct.of(l.tapes));
      tree.addLeaf(l.leaf.release());
    }
    band.settleZeros();  // tiles take their sign from the samples at leaves' corners, and are neutral yet
    constexpr openvdb::Index kAboveLeaves = 1;  // these have no values to be filled
    openvdb::tools::signedFloodFillWithValues(tree, static_cast<float>(3 * h_), static_cast<float>(-3 * h_),
                                              true, 1, kAboveLeaves);
    band.settleZeros();
    return band;
  }

  const ModelTapes& model_;
  const BandOptions& options_;
  Progress& progress_;
  double h_;
  openvdb::CoordBBox voxels_;  // that matter
  int levels_ = 0, level_ = 0;
  int size_ = 0;  // of the present cells, in voxels
  std::vector<Cell> cells_;
  std::vector<BandLeaf> leaves_;
  std::atomic<std::uint64_t> samples_{0};
  std::mutex notNumbersMutex_;
  std::uint64_t notNumbers_ = 0;
  openvdb::Coord firstNotNumber_;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
};

Result<NarrowBand> sampleNarrowBand(const ModelTapes& model, const BandOptions& options, Progress& progress) {
  return BandSampler(model, options, progress).run();
}

}  // namespace sdf
