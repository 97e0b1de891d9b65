#include "sdf/mesh/refine/crowded.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "sdf/base/fnv.h"
#include "sdf/triangles/triangle_pairs.h"

namespace sdf {
namespace {

using Index = SampledMesh::Index;
using BoxPoint = boost::geometry::model::point<float, 3, boost::geometry::cs::cartesian>;
using BoxOf = boost::geometry::model::box<BoxPoint>;

// Cosine: normals that are farther apart are opposite; those of both sides of an ordinary edge are not.
constexpr float kOpposite = -0.5f;

// Grown to all sides.
BoxOf boxOf(const Corners& t, float grown = 0.0f) {
  const glm::vec3 low = glm::min(glm::min(t[0], t[1]), t[2]) - grown,
                  high = glm::max(glm::max(t[0], t[1]), t[2]) + grown;
  return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

// Directions by the side of a cube that they leave it through, and the ninth of that side.
class Directions {
 public:
  static constexpr int kCount = 54;

  Directions() {
    for (int a = 0; a < kCount; ++a)
      for (int b = 0; b < kCount; ++b)
        if (glm::dot(middle(a), middle(b)) < 0.0f) opposite_[a] |= std::uint64_t{1} << b;
  }
  static int of(const glm::vec3& n) {
    const glm::vec3 size = glm::abs(n);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto third = [&](float x) {
      return std::clamp(static_cast<int>((x / size[axis] + 1.0f) * 1.5f), 0, 2);
    };
    return ((axis * 2 + (n[axis] < 0.0f)) * 3 + third(n[(axis + 1) % 3])) * 3 + third(n[(axis + 2) % 3]);
  }
  /// The directions that are at more than a right angle to this one, a bit each.
  std::uint64_t oppositeOf(int direction) const { return opposite_[direction]; }

 private:
  static glm::vec3 middle(int direction) {
    const int axis = direction / 18;
    glm::vec3 n;
    n[axis] = direction / 9 % 2 ? -1.0f : 1.0f;
    n[(axis + 1) % 3] = static_cast<float>(direction / 3 % 3 - 1) * 2.0f / 3.0f;
    n[(axis + 2) % 3] = static_cast<float>(direction % 3 - 1) * 2.0f / 3.0f;
    return glm::normalize(n);
  }
  std::uint64_t opposite_[kCount] = {};
};

struct CellHash {
  std::size_t operator()(const glm::ivec3& c) const {
    std::size_t hash = kFnvBegin<std::size_t>;
    for (int k = 0; k < 3; ++k) hash = fnv(hash, static_cast<std::size_t>(c[k]));
    return hash;
  }
};

// A vertex seen from one side of the surface.
struct Facing {
  Index vertex;
  glm::vec3 at, normal;
};

// Along the normal of the triangle that has h, twice its area.
glm::vec3 areaOf(const HalfEdgeMesh& mesh, Index h) {
  const Corners t = mesh.corners(h - h % 3);
  return glm::cross(t[1] - t[0], t[2] - t[0]);
}

// Do the triangles of some crease at the vertex face one another?
bool isInCrevice(const HalfEdgeMesh& mesh, Index v) {
  if (mesh.creasesAt(v) == 0) return false;
  Index e = mesh.outgoing(v);
  do {
    const glm::vec3 beyond = mesh.positions[mesh.apex(mesh.twin(e))] - mesh.positions[v];
    if (mesh.isCrease(e) && glm::dot(areaOf(mesh, e), beyond) > 0.0f) return true;
    e = mesh.turned(e);
  } while (e != mesh.outgoing(v));
  return false;
}

// One for each vertex, in crevices one for each triangle.
std::vector<Facing> facings(const HalfEdgeMesh& mesh, const std::vector<glm::vec3>& normals) {
  std::vector<Facing> all;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.vertexAlive(v)) continue;
    const auto add = [&](const glm::vec3& normal) { all.push_back({v, mesh.positions[v], normal}); };
    if (!isInCrevice(mesh, v)) {
      add(normals[v]);
      continue;
    }
    Index e = mesh.outgoing(v);
    do {
      if (const glm::vec3 area = areaOf(mesh, e); area != glm::vec3(0.0f)) add(glm::normalize(area));
      e = mesh.turned(e);
    } while (e != mesh.outgoing(v));
  }
  return all;
}

// The facings of each cell of a grid, and where their normals go.
class CellFacings {
 public:
  CellFacings(const HalfEdgeMesh& mesh, const std::vector<Facing>& all, float size)
      : mesh_(mesh), all_(all), size_(size), next_(all.size()) {
    for (Index i = 0; i < all.size(); ++i) {
      Cell& cell = cells_[cellOf(all[i])];
      next_[i] = std::exchange(cell.first, i);
      cell.directions |= std::uint64_t{1} << Directions::of(all[i].normal);
    }
  }

  /// Is there one within a cell's length whose normal is opposite, of another vertex than those around?
  bool hasOpposite(const Facing& one) const {
    const glm::ivec3 at = cellOf(one);
    const std::uint64_t opposite = directions_.oppositeOf(Directions::of(one.normal));
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(at + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
      if (found == cells_.end() || (found->second.directions & opposite) == 0) continue;
      for (Index k = found->second.first; k != SampledMesh::kNone; k = next_[k])
        if (isOpposite(one, all_[k]) && one.vertex != all_[k].vertex &&
            !mesh_.adjacent(one.vertex, all_[k].vertex))
          return true;
    }
    return false;
  }

 private:
  struct Cell {
    Index first = SampledMesh::kNone;
    std::uint64_t directions = 0;
  };
  glm::ivec3 cellOf(const Facing& one) const { return glm::ivec3(glm::floor(one.at / size_)); }
  bool isOpposite(const Facing& a, const Facing& b) const {
    const glm::vec3 between = a.at - b.at;
    return glm::dot(between, between) <= size_ * size_ && glm::dot(a.normal, b.normal) < kOpposite;
  }

  const HalfEdgeMesh& mesh_;
  const std::vector<Facing>& all_;
  float size_;
  Directions directions_;
  std::unordered_map<glm::ivec3, Cell, CellHash> cells_;
  std::vector<Index> next_;  // of the same cell
};

}  // namespace

std::vector<char> crowdedVertices(const HalfEdgeMesh& mesh, const std::vector<glm::vec3>& normals,
                                  float reach) {
  const std::vector<Facing> all = facings(mesh, normals);
  const CellFacings cells(mesh, all, reach);
  std::vector<char> crowded(mesh.vertices(), 0);
  for (const Facing& one : all) crowded[one.vertex] |= cells.hasOpposite(one) ? 1 : 0;
  return crowded;
}

struct CrowdedTriangles::Trees {
  using Entry = std::pair<BoxOf, Index>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;
  std::vector<Tree> byBlock;
  std::vector<BoxOf> boxes;         // by triangle, of those in a tree
  std::vector<std::uint8_t> block;  // by triangle, the same
};

CrowdedTriangles::CrowdedTriangles(const SampledMesh& sampled, const MeshBlocks& blocks, float reach)
    : mesh_(sampled.mesh),
      blocks_(blocks),
      crowded_(mesh_.halfEdges() / 3, 0),
      trees_(std::make_unique<Trees>()) {
  findCrowded(reach);
  std::vector<std::vector<Trees::Entry>> entries(blocks.count() + 1);
  trees_->boxes.resize(crowded_.size()), trees_->block.resize(crowded_.size());
  for (Index t = 0; t < crowded_.size(); ++t) {
    if (!crowded_[t]) continue;
    any_ = true;
    trees_->boxes[t] = boxOf(mesh_.corners(3 * t));
    trees_->block[t] = blockOf(t);
    entries[trees_->block[t]].emplace_back(trees_->boxes[t], t);
  }
  for (const auto& own : entries) trees_->byBlock.emplace_back(own);
}

CrowdedTriangles::~CrowdedTriangles() = default;

void CrowdedTriangles::findCrowded(float reach) {
  namespace index = boost::geometry::index;
  std::vector<Trees::Entry> entries;
  std::vector<glm::vec3> areas(crowded_.size(), glm::vec3(0.0f));
  for (Index t = 0; t < crowded_.size(); ++t) {
    if (!mesh_.alive(3 * t)) continue;
    areas[t] = areaOf(mesh_, 3 * t);
    entries.emplace_back(boxOf(mesh_.corners(3 * t)), t);
  }
  const Trees::Tree tree(entries);
  tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t i) {
    const Index t = entries[i].second;
    const auto isOpposite = [&](const Trees::Entry& other) {
      return glm::dot(areas[t], areas[other.second]) < 0.0f;
    };
    const auto near = index::intersects(boxOf(mesh_.corners(3 * t), reach)) && index::satisfies(isOpposite);
    crowded_[t] = tree.qbegin(near) != tree.qend();
  });
}

// That of all of its vertices, if they have one.
std::uint8_t CrowdedTriangles::blockOf(Index triangle) const {
  const Index h = 3 * triangle;
  const std::uint8_t block = blocks_.of(mesh_.from(h));
  return blocks_.of(mesh_.from(h + 1)) == block && blocks_.of(mesh_.from(h + 2)) == block ? block
                                                                                          : MeshBlocks::kNone;
}

// `own` are the triangle's vertices, of which the first may be at another place than the mesh has it.
bool CrowdedTriangles::crosses(const glm::uvec3& own, const Corners& at, std::span<const Index> but,
                               std::uint8_t block) const {
  namespace index = boost::geometry::index;
  std::vector<glm::vec3> positions(6);
  std::ranges::copy(at, positions.begin());
  const auto crosses = [&](const Trees::Entry& entry) {
    if (std::ranges::find(but, entry.second) != but.end()) return false;
    glm::uvec3 other;
    for (int k = 0; k < 3; ++k) {
      const Index v = mesh_.from(3 * entry.second + static_cast<Index>(k));
      other[k] = v == own[0] ? 0 : v == own[1] ? 1 : v == own[2] ? 2 : 3 + static_cast<Index>(k);
      if (other[k] >= 3) positions[other[k]] = mesh_.positions[v];
    }
    return cross(positions, {0, 1, 2}, other);
  };
  const auto near = index::intersects(boxOf(at)) && index::satisfies(crosses);
  const auto isIn = [&](const Trees::Tree& tree) { return tree.qbegin(near) != tree.qend(); };
  if (block == MeshBlocks::kNone) return std::ranges::any_of(trees_->byBlock, isIn);
  return isIn(trees_->byBlock[block]) || isIn(trees_->byBlock[MeshBlocks::kNone]);
}

bool CrowdedTriangles::areCrowded(std::span<const Index> triangles) const {
  return std::ranges::any_of(triangles, [&](Index t) { return t < crowded_.size() && crowded_[t]; });
}

bool CrowdedTriangles::wouldCross(const Ring& ring, const glm::vec3& centre, std::uint8_t block) const {
  if (!any_) return false;
  const std::vector<Index> replaced = ring.triangles();
  if (!areCrowded(replaced)) return false;
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    if (crosses({ring.centre(), ring.vertex(i), ring.vertex(k)}, {centre, ring.position(i), ring.position(k)},
                replaced, block))
      return true;
  }
  return false;
}

bool CrowdedTriangles::wouldCross(Index h, std::uint8_t block) const {
  const Index g = mesh_.twin(h), both[2] = {h / 3, g / 3};
  if (!areCrowded(both)) return false;
  const Index a = mesh_.from(h), b = mesh_.to(h), c = mesh_.apex(h), d = mesh_.apex(g);
  const auto crossesAs = [&](const glm::uvec3& t) {
    return crosses(t, {mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]}, both, block);
  };
  return crossesAs({d, c, a}) || crossesAs({c, d, b});
}

void CrowdedTriangles::replaced(const Ring& ring) {
  if (any_) put(ring.triangles());
}

void CrowdedTriangles::flipped(Index h) {
  const Index both[2] = {h / 3, mesh_.twin(h) / 3};
  put(both);
}

// What is made of crowded triangles is crowded.
void CrowdedTriangles::put(std::span<const Index> triangles) {
  if (areCrowded(triangles))
    for (const Index t : triangles) put(t);
}

// As it is now, or not at all where it is gone.
void CrowdedTriangles::put(Index triangle) {
  Trees& trees = *trees_;
  if (triangle >= crowded_.size())
    crowded_.resize(triangle + 1, 0), trees.boxes.resize(triangle + 1), trees.block.resize(triangle + 1);
  BoxOf& box = trees.boxes[triangle];
  std::uint8_t& block = trees.block[triangle];
  if (crowded_[triangle]) trees.byBlock[block].remove({box, triangle});
  crowded_[triangle] = mesh_.alive(3 * triangle);
  if (!crowded_[triangle]) return;
  box = boxOf(mesh_.corners(3 * triangle)), block = blockOf(triangle);
  trees.byBlock[block].insert({box, triangle});
}

}  // namespace sdf
