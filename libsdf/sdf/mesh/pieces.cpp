#include "sdf/mesh/pieces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "sdf/base/disjoint_sets.h"
#include "sdf/mesh/dress/color.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/surface/surface_points.h"
#include "sdf/shape/operators/booleans.h"

namespace sdf {
namespace {

// A piece is compared with so many kinds of its structure at most: copies that a scene makes come in few.
constexpr std::size_t kMostKinds = 16;
// Of a coordinate: what rounding to floats moves it by at most.
constexpr double kRounding = 0x1p-24;

bool meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k)
    if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) return false;
  return true;
}

// The boxes that hang together, by number: a sweep along the longest side of them all.
DisjointSets joinedWhereMeeting(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& b : boxes) all = unite(all, b);
  const glm::dvec3 size = all.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(boxes[i].min[axis], i); });
  DisjointSets sets(boxes.size());
  std::vector<std::uint32_t> open;  // those that the sweep has not left yet
  for (const std::uint32_t i : order) {
    std::erase_if(open, [&](std::uint32_t k) { return boxes[k].max[axis] < boxes[i].min[axis]; });
    for (const std::uint32_t k : open)
      if (meet(boxes[k], boxes[i])) sets.join(k, i);
    open.push_back(i);
  }
  return sets;
}

std::vector<Expr> graphsOf(const Shape& shape) {
  std::vector<Expr> graphs{shape.distance};
  graphs.insert(graphs.end(), shape.surface.begin(), shape.surface.end());
  return graphs;
}

// Finds for each piece the first one that it is a copy of.
class Kinds {
 public:
  void name(std::vector<Piece>& pieces, std::size_t i) {
    std::vector<Expr> graphs = graphsOf(pieces[i].shape);
    std::vector<Kind>& kinds = byHash_[hashWithoutMotion(graphs)];
    for (const Kind& kind : kinds)
      if (const auto motion = motionBetween(kind.graphs, graphs)) {
        pieces[i].like = kind.first, pieces[i].motion = *motion;
        return;
      }
    if (kinds.size() < kMostKinds) kinds.push_back({i, std::move(graphs)});
  }

 private:
  struct Kind {
    std::size_t first;
    std::vector<Expr> graphs;
  };
  std::map<std::size_t, std::vector<Kind>> byHash_;
};

double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x];
    area += 0.5 *
            glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
  }
  return area;
}

// Joins pieces' meshes, and what is known of them.
class Joiner {
 public:
  /// `points` is the number of all pieces' distinct ones.
  Joiner(const Shape& shape, std::size_t points) : shape_(shape) {
    Mesh& mesh = all_.mesh;
    mesh.welded = static_cast<std::uint32_t>(points);
    for (auto* each : {&mesh.positions, &mesh.normals, &mesh.colors, &mesh.ambient}) each->resize(points);
  }

  void add(const MeshedShape& piece, const RigidMotion* moved) {
    const Mesh& mesh = piece.mesh;
    std::vector<std::uint32_t> numbers;
    float reach = 0.0f;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      numbers.push_back(addVertex(v < mesh.welded));
      const std::uint32_t to = numbers.back();
      all_.mesh.positions[to] = placed(mesh.positions[v], moved);
      all_.mesh.normals[to] =
          moved ? glm::vec3(moved->rotation * glm::dvec3(mesh.normals[v])) : mesh.normals[v];
      all_.mesh.colors[to] = mesh.colors[v], all_.mesh.ambient[to] = mesh.ambient[v];
      if (v >= mesh.welded) all_.mesh.copyOf.push_back(numbers[mesh.pointOf(v)]);
      reach = std::max(reach, largestCoordinate(all_.mesh.positions[to]));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& v = mesh.triangles[t];
      all_.mesh.triangles.emplace_back(numbers[v.x], numbers[v.y], numbers[v.z]);
      materials_.push_back(mesh.materials[mesh.triangleMaterial[t]].number);
    }
    addStats(piece, moved, moved ? std::sqrt(3.0) * kRounding * reach : 0.0);
  }

  MeshedShape join(const Values& values) {
    Mesh& mesh = all_.mesh;
    takeMaterials(shape_, materials_, values, mesh);
    MeshStats& stats = all_.stats;
    stats.rmsDistance = area_ > 0.0 ? std::sqrt(squares_ / area_) : 0.0;
    std::vector<glm::uvec3> triangles = mesh.triangles;
    for (glm::uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) t[k] = mesh.pointOf(t[k]);
    const std::vector<glm::vec3> points(mesh.positions.begin(), mesh.positions.begin() + mesh.welded);
    measureTopology(triangles, points.size(), stats);
    measureCrossings(points, triangles, stats);
    return std::move(all_);
  }

 private:
  static glm::vec3 placed(const glm::vec3& p, const RigidMotion* moved) {
    return moved ? glm::vec3((*moved)(p)) : p;
  }

  // The next of the distinct points, or of those that repeat one.
  std::uint32_t addVertex(bool isPoint) {
    if (isPoint) return next_++;
    Mesh& mesh = all_.mesh;
    for (auto* each : {&mesh.positions, &mesh.normals, &mesh.colors, &mesh.ambient}) each->emplace_back();
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }

  void addStats(const MeshedShape& piece, const RigidMotion* moved, double rounding) {
    const MeshStats& own = piece.stats;
    MeshStats& all = all_.stats;
    if (!moved) {
      all.voxels += own.voxels;
      for (const auto& [name, seconds] : piece.stageSeconds) addSeconds(name, seconds);
    }
    all.tolerance = own.tolerance;
    if (own.voxelSize > 0.0)
      all.voxelSize = all.voxelSize > 0.0 ? std::min(all.voxelSize, own.voxelSize) : own.voxelSize;
    if (!piece.mesh.triangles.empty()) {
      const double area = areaOf(piece.mesh);
      area_ += area, squares_ += area * own.rmsDistance * own.rmsDistance;
      if (const double distance = own.maxDistance + rounding; distance > all.maxDistance)
        all.maxDistance = distance, all.farthest = placed(own.farthest, moved);
      if (own.provenDistance > 0.0)
        all.provenDistance = std::max(all.provenDistance, own.provenDistance + rounding);
    }
    all.surfacePoints += own.surfacePoints;
    if (own.unresolved > 0) {
      const bool known = own.resolvingVoxel > 0.0 && (all.unresolved == 0 || all.resolvingVoxel > 0.0);
      all.resolvingVoxel = !known                ? 0.0
                           : all.unresolved == 0 ? own.resolvingVoxel
                                                 : std::min(all.resolvingVoxel, own.resolvingVoxel);
      if (all.unresolved == 0) all.firstUnresolved = placed(own.firstUnresolved, moved);
      all.unresolved += own.unresolved;
    }
    if (own.notNumbers > 0 && all.notNumbers == 0) all.firstNotNumber = placed(own.firstNotNumber, moved);
    all.notNumbers += own.notNumbers;
  }

  void addSeconds(const std::string& name, double seconds) {
    auto& stages = all_.stageSeconds;
    const auto known = std::ranges::find(stages, name, [](const auto& s) { return s.first; });
    if (known == stages.end())
      stages.emplace_back(name, seconds);
    else
      known->second += seconds;
  }

  const Shape& shape_;
  MeshedShape all_;
  std::uint32_t next_ = 0;      // of the distinct points
  std::vector<int> materials_;  // by triangle
  double area_ = 0.0, squares_ = 0.0;
};

}  // namespace

std::vector<Piece> isolatedPieces(const Shape& shape, double apart) {
  const std::vector<Piece> whole{{shape, 0}};
  if (!shape.ok() || !shape.outer || shape.outer->blend.kind != Blend::Kind::Hard) return whole;
  std::vector<const Shape*> operands;
  std::vector<Box> boxes;
  for (const Shape& operand : shape.outer->operands) {
    if (operand.bounds.empty()) continue;
    if (!operand.bounds.finite()) return whole;
    operands.push_back(&operand), boxes.push_back(operand.bounds.grown(0.5 * apart));
  }
  DisjointSets sets = joinedWhereMeeting(boxes);
  std::map<std::uint32_t, std::vector<Shape>> groups;
  for (std::uint32_t i = 0; i < operands.size(); ++i) {
    std::vector<Shape>& group = groups[sets.of(i)];
    group.push_back(*operands[i]);
    group.back().materials = shape.materials;  // as its numbers are
  }
  if (groups.size() < 2) return whole;
  std::vector<Piece> pieces;
  Kinds kinds;
  for (const auto& [first, group] : groups) {
    pieces.push_back({unite(group), pieces.size()});
    kinds.name(pieces, pieces.size() - 1);
  }
  return pieces;
}

Result<MeshedShape> meshPieces(const Shape& shape, const std::vector<Piece>& pieces, const Values& values,
                               const MeshPiece& mesh, Progress& progress) {
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].like == i) firsts.push_back(i);
  progress.beginStage("pieces that lie apart");
  std::vector<std::optional<Result<MeshedShape>>> meshed(pieces.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, firsts.size(), [&](std::size_t k) {
    Progress own(&progress);
    meshed[firsts[k]] = mesh(pieces[firsts[k]].shape, own);
    progress.update(static_cast<double>(++done) / static_cast<double>(firsts.size()));
  });
  std::size_t points = 0;
  for (const Piece& piece : pieces) {
    const Result<MeshedShape>& model = *meshed[piece.like];
    if (!model) return model.error();
    points += model->mesh.welded;
  }
  if (points == 0) return MeshedShape();
  Joiner joiner(shape, points);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    joiner.add(**meshed[pieces[i].like], pieces[i].like == i ? nullptr : &pieces[i].motion);
  return joiner.join(values);
}

}  // namespace sdf
