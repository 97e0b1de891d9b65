#include "sdf/mesh/band/narrow_band.h"

#include <cmath>

#include "sdf/mesh/band/band_grid-inl.h"

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

using TapesOfLeaves = std::unordered_map<openvdb::Coord, LocalTapes, CoordHash>;

// Remembers the last leaf, so that neighbours are found at once.
class LeafFinder : public LocalField::Finder {
 public:
  LeafFinder(const TapesOfLeaves& tapes, const LocalTapes& whole, double voxel)
      : tapes_(tapes), whole_(whole), h_(voxel) {}
  LocalField::Local at(const glm::vec3& p) override {
    if (inside_[0].x <= p.x && p.x <= inside_[1].x && inside_[0].y <= p.y && p.y <= inside_[1].y &&
        inside_[0].z <= p.z && p.z <= inside_[1].z)
      return {*last_, h_};
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
    // A cell on a leaf's far side belongs to the next leaf, which may not be there; any leaf within a voxel
    // will do.
    for (int i = 0; i < 27; ++i) {
      constexpr int kOffset[3] = {0, 1, -1};
      const glm::ivec3 offset(kOffset[i / 9], kOffset[i / 3 % 3], kOffset[i % 3]);
      const glm::ivec3 near = (voxel + offset) & ~(kLeaf - 1);
      const auto it = tapes_.find(openvdb::Coord(near.x, near.y, near.z));
      if (it == tapes_.end()) continue;
      if (i == 0) remember(leaf, it->second);
      return &it->second;
    }
    return nullptr;
  }

  void remember(const glm::ivec3& leaf, const LocalTapes& tapes) {
    last_ = &tapes;
    for (int i = 0; i < 3; ++i) {
      inside_[0][i] = std::nextafter(static_cast<float>(leaf[i] * h_), HUGE_VALF);
      inside_[1][i] = std::nextafter(static_cast<float>((leaf[i] + kLeaf) * h_), -HUGE_VALF);
    }
  }

  const TapesOfLeaves& tapes_;
  const LocalTapes& whole_;
  double h_;
  const LocalTapes* last_ = nullptr;
  glm::vec3 inside_[2]{glm::vec3(HUGE_VALF),
                       glm::vec3(-HUGE_VALF)};  // the least and the most in the last leaf
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
