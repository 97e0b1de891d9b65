#include "sdf/mesh/narrow_band.h"

#include <cmath>

#include "sdf/mesh/band_grid-inl.h"

namespace sdf {

NarrowBand::NarrowBand() : grid_(std::make_unique<Grid>()) {
  openvdb::initialize();
  grid_->grid = openvdb::FloatGrid::create();
}
NarrowBand::~NarrowBand() = default;
NarrowBand::NarrowBand(NarrowBand&&) noexcept = default;
NarrowBand& NarrowBand::operator=(NarrowBand&&) noexcept = default;

double NarrowBand::voxelSize() const { return grid_->voxelSize; }
std::uint64_t NarrowBand::sampleCount() const { return grid_->samples; }
const NarrowBand::NotNumbers& NarrowBand::notNumbers() const { return grid_->notNumbers; }

namespace {

constexpr int kLeaf = openvdb::FloatTree::LeafNodeType::DIM;  // voxels along a leaf
using TapesOfLeaves = std::unordered_map<openvdb::Coord, LocalTapes, CoordHash>;

// Remembers the last leaf, so that neighbours are found at once.
class LeafFinder : public LocalField::Finder {
 public:
  LeafFinder(const TapesOfLeaves& tapes, const LocalTapes& whole, double voxel)
      : tapes_(tapes), whole_(whole), h_(voxel) {}
  LocalField::Local at(const glm::vec3& p) override {
    const LocalTapes* tapes = inLeaf(glm::dvec3(p) / h_);
    return {tapes ? *tapes : whole_, h_};
  }

 private:
  const LocalTapes* inLeaf(const glm::dvec3& q) {
    constexpr double kLast =
        1 << 30;  // lattice coordinates beyond, and those that are no numbers, fit no int
    if (!(std::abs(q.x) < kLast && std::abs(q.y) < kLast && std::abs(q.z) < kLast)) return nullptr;
    // Rounds down by truncating: a call of floor() would take longer than all the rest.
    const glm::ivec3 toZero(q);
    const glm::ivec3 voxel(toZero.x - (q.x < toZero.x), toZero.y - (q.y < toZero.y),
                           toZero.z - (q.z < toZero.z));
    const glm::ivec3 leaf = voxel & ~(kLeaf - 1);
    if (last_ && leaf == lastLeaf_) return last_;
    // A cell on a leaf's far side belongs to the next leaf, which may not be there; any leaf within a voxel
    // will do.
    for (int i = 0; i < 27; ++i) {
      constexpr int kOffset[3] = {0, 1, -1};
      const glm::ivec3 offset(kOffset[i / 9], kOffset[i / 3 % 3], kOffset[i % 3]);
      const glm::ivec3 near = (voxel + offset) & ~(kLeaf - 1);
      const auto it = tapes_.find(openvdb::Coord(near.x, near.y, near.z));
      if (it == tapes_.end()) continue;
      last_ = i == 0 ? &it->second : nullptr;
      lastLeaf_ = leaf;
      return &it->second;
    }
    return nullptr;
  }

  const TapesOfLeaves& tapes_;
  const LocalTapes& whole_;
  double h_;
  const LocalTapes* last_ = nullptr;
  glm::ivec3 lastLeaf_{};
};

}  // namespace

std::unique_ptr<LocalField::Finder> BandField::finder() const {
  return std::make_unique<LeafFinder>(band_.grid_->tapes, whole_, band_.voxelSize());
}

RawSurface NarrowBand::extract() {
  RawSurface surface = extractSurface(grid_->grid->tree(), grid_->voxelSize);
  grid_->grid.reset();
  return surface;
}

}  // namespace sdf
