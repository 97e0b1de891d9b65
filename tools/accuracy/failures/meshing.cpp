// Failures of meshing: what samples on a lattice make of a surface.
#include <cmath>
#include <map>
#include <optional>

#include "accuracy/operators/operator_meshes.h"
#include "probe.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

constexpr double kVoxel = 1.0 / 16;
constexpr int kShifts = 8;

template <class Visit>
void forEachCell(int n, const Visit& visit) {
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) visit(glm::ivec3(x, y, z));
}

/// Samples at the multiples of h up to `reach` from the origin.
class Lattice {
 public:
  Lattice(const Distance& f, double reach, double h)
      : h_(h), half_(static_cast<int>(std::floor(reach / h + 1e-9))) {
    forEachCell(cells() + 1, [&](const glm::ivec3& c) { values_.push_back(f(point(c))); });
  }
  int cells() const { return 2 * half_; }
  glm::dvec3 point(const glm::ivec3& c) const { return glm::dvec3(c - half_) * h_; }
  int index(const glm::ivec3& c) const { return (c.x * (cells() + 1) + c.y) * (cells() + 1) + c.z; }
  double at(const glm::ivec3& c) const { return values_[index(c)]; }
  bool inside(const glm::ivec3& c) const { return at(c) < 0.0; }

 private:
  double h_;
  int half_;
  std::vector<double> values_;
};

glm::ivec3 unit(int axis) { return {axis == 0, axis == 1, axis == 2}; }

/// Mean of the crossings on a cell's twelve edges, if there are any.
std::optional<glm::dvec3> meanCrossing(const Lattice& lattice, const glm::ivec3& cell) {
  int crossings = 0;
  glm::dvec3 sum(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      const glm::ivec3 a = cell + (k & 1) * unit((axis + 1) % 3) + (k >> 1) * unit((axis + 2) % 3),
                       b = a + unit(axis);
      if (lattice.inside(a) == lattice.inside(b)) continue;
      const double t = lattice.at(a) / (lattice.at(a) - lattice.at(b));
      sum += lattice.point(a) + t * (lattice.point(b) - lattice.point(a));
      ++crossings;
    }
  return crossings > 0 ? std::optional(sum / static_cast<double>(crossings)) : std::nullopt;
}

struct NaiveMesh {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// What a plain mesher does, surface nets (Gibson 1998), over the lattice of multiples of h up to `reach`
/// from the origin, inside being f < 0: one vertex a cell, at the mean of the cell's linear crossings, and a
/// quad for each lattice edge that changes sign. Nothing is closed at the lattice's sides.
NaiveMesh naiveMesh(const Shape& shape, double reach, double h = kVoxel) {
  const Lattice lattice(Distance(shape), reach, h);
  NaiveMesh mesh;
  std::map<int, std::uint32_t> vertexOf;
  forEachCell(lattice.cells(), [&](const glm::ivec3& c) {
    const std::optional<glm::dvec3> at = meanCrossing(lattice, c);
    if (!at) return;
    vertexOf[lattice.index(c)] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(*at);
  });
  forEachCell(lattice.cells(), [&](const glm::ivec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (c[u] == 0 || c[v] == 0 || lattice.inside(c) == lattice.inside(c + unit(axis))) continue;
      std::uint32_t q[4];
      const glm::ivec3 around[4] = {c, c - unit(u), c - unit(u) - unit(v), c - unit(v)};
      for (int k = 0; k < 4; ++k) q[k] = vertexOf.at(lattice.index(around[k]));
      if (!lattice.inside(c)) std::swap(q[1], q[3]);
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    }
  });
  return mesh;
}

MeshStats topologyOf(const NaiveMesh& mesh) {
  MeshStats stats;
  measureTopology(mesh.triangles, mesh.points.size(), stats);
  return stats;
}

/// How many edges have one triangle, and how many more than two.
struct BadEdges {
  explicit BadEdges(const std::vector<glm::uvec3>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, count] : edges) boundary += count == 1, crowded += count > 2;
  }
  double boundary = 0, crowded = 0;
};

/// Nothing where the mesher refuses.
std::optional<MeshedShape> ourMesh(const Shape& s, std::optional<Box> bounds = {}, double voxel = kVoxel) {
  Progress progress;
  auto result = meshShape(s, "case", {.voxelSize = voxel, .bounds = bounds}, progress);
  if (!result) return std::nullopt;
  return std::move(*result);
}

double boundaryEdges(const Mesh& mesh) {
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (glm::uvec3& t : triangles) t = {mesh.pointOf(t.x), mesh.pointOf(t.y), mesh.pointOf(t.z)};
  return BadEdges(triangles).boundary;
}

/// Counts the shifts along x at which each method goes wrong and does not say so.
template <class Naive, class Ours>
Figures overShifts(const Naive& naive, const Ours& ours) {
  Figures wrong;
  for (int i = 0; i < kShifts; ++i) {
    wrong.naive += naive(i * kVoxel / kShifts);
    wrong.ours += ours(i * kVoxel / kShifts);
  }
  return wrong;
}

/// Two solids, given for each shift along x, of which a method may see another number without a word.
FailureCase twoSolidsCase(const std::string& name, const std::string& figure, double naiveAtLeast,
                          const std::string& ours, const std::string& reason,
                          const std::function<Shape(double)>& solids) {
  return {name, figure, {"surface nets", naiveAtLeast}, {ours, 0.0}, reason, [solids] {
            return overShifts(
                [&](double s) { return topologyOf(naiveMesh(solids(s), 1.25)).components != 2; },
                [&](double s) {
                  const MeshStats stats = ourMesh(solids(s))->stats;
                  return stats.components != 2 && stats.unresolved == 0;
                });
          }};
}

/// A ball, and beside it something thin.
FailureCase missedCase(const std::string& name, const Shape& thin, double naiveAtLeast,
                       const std::string& reason) {
  return twoSolidsCase(name, "shifts of the lattice, of 8, at which it is missed without a word",
                       naiveAtLeast, "surface that no sample sees is looked for and reported", reason,
                       [thin](double shift) {
                         return sphere(0.25) | translate(thin, {0.75 + shift, 0.01, 0.01});
                       });
}

Shape at(double x, const Shape& s) { return translate(s, {x, 0, 0}); }

}  // namespace

std::vector<FailureCase> meshingFailures() {
  return {
      {"two boxes share a face",
       "solids too many",
       {"inside is f < 0, surface nets", 1.0},
       {"samples of zero between two samples inside are inside", 0.0},
       "f = 0 on the shared face, a plane of the lattice: two solids where there is one",
       [] {
         const Shape both = at(-0.5, box(Vec3E(0.5))) | at(0.5, box(Vec3E(0.5)));
         return Figures{topologyOf(naiveMesh(both, 1.25)).components - 1.0,
                        std::abs(ourMesh(both)->stats.components - 1.0)};
       }},
      {"a cut that ends 1e-6 under a face",
       "Euler characteristic, of a hole through a block",
       {"inside is f < 0, surface nets", 2.0},
       {"samples on a film of no thickness are outside", 0.0},
       "the film over the mouth closes the hole: a pit has 2, a hole through has 0",
       [] {
         constexpr double kFilm = 1e-6;
         // The block's upper face is half a film above a plane of the lattice, the cut's end half below.
         const Shape block = translate(box(Vec3E(0.5)), {0, kFilm / 2, 0});
         const Shape cut = translate(box({0.25, 1.0, 0.25}), {0, 0.5 - 1.0 - kFilm / 2, 0});
         return Figures{std::abs(double(topologyOf(naiveMesh(block - cut, 1.0)).eulerCharacteristic)),
                        std::abs(double(ourMesh(block - cut)->stats.eulerCharacteristic))};
       }},
      twoSolidsCase(
          "union of two spheres that touch", "shifts of the lattice, of 8, with a neck that is not reported",
          1.0, "passages thinner than a voxel are found and reported",
          "they touch in a point, so any neck is the lattice's making; whether there is one depends on the "
          "shift",
          [](double shift) { return at(shift - 0.5, sphere(0.5)) | at(shift + 0.5, sphere(0.5)); }),
      {"intersection of two spheres that touch",
       "shifts of the lattice, of 8, with an empty mesh or a speck and no word",
       {"surface nets", 8.0},
       {"refused: no surface inside the bounds", 0.0},
       "a point has no inside",
       [] {
         const auto point = [](double shift) {
           return at(shift - 0.5, sphere(0.5)) & at(shift + 0.5, sphere(0.5));
         };
         return overShifts([&](double s) { return naiveMesh(point(s), 1.25).triangles.size() < 100; },
                           [&](double s) { return ourMesh(point(s)).has_value(); });
       }},
      missedCase("plate half a voxel thick", box({0.25 * kVoxel, 0.3, 0.3}), 4.0,
                 "no plane of the lattice lies in it at half of the shifts"),
      missedCase("rod of 0.4 voxels", capsule({0, -0.3, 0}, {0, 0.3, 0}, 0.2 * kVoxel), 4.0,
                 "its section is met by a line of the lattice at an eighth of the offsets"),
      missedCase("speck of 0.8 voxels", sphere(0.4 * kVoxel), 2.0,
                 "0.16 voxels off two planes of the lattice, it holds a sample over 0.66 voxels along x"),
      twoSolidsCase("gap of 0.4 voxels", "shifts of the lattice, of 8, at which it is closed without a word",
                    3.0, "surface that no sample sees is looked for and reported",
                    "no plane of the lattice lies in it at six tenths of the shifts",
                    [](double shift) {
                      const double offset = 0.5 + 0.2 * kVoxel;
                      return at(shift - offset, box(Vec3E(0.5))) | at(shift + offset, box(Vec3E(0.5)));
                    }),
      {"turned sheet of 0.8 voxels",
       "handles or pieces too many, not reported",
       {"surface nets", 1.0},
       {"holes that the samples make are found and reported", 0.0},
       "where the sheet passes between two planes of samples it has holes; as a solid it has Euler "
       "characteristic 2",
       [] {
         const Shape sheet = rotate(box({0.4 * kVoxel, 1.0, 1.0}), {0.0, 0.03, 0.05});
         const MeshStats stats = ourMesh(sheet)->stats;
         const double silent = stats.unresolved > 0 ? 0.0 : std::abs(stats.eulerCharacteristic - 2.0);
         return Figures{std::abs(topologyOf(naiveMesh(sheet, 1.25)).eulerCharacteristic - 2.0), silent};
       }},
      {"endless plane",
       "edges with one triangle",
       {"surface nets over the bounds", 1.0},
       {"clipped by the bounds and closed; refused without bounds", 0.0},
       "the surface leaves the lattice on four sides",
       [] {
         const Shape ground = plane({0, 1, 0}, 0.03);
         const double ours = boundaryEdges(ourMesh(ground, Box::centred(glm::dvec3(1.0)))->mesh);
         return Figures{BadEdges(naiveMesh(ground, 1.0).triangles).boundary, ourMesh(ground) ? 1.0 : ours};
       }},
      {"sphere of 1.1 in bounds of 1",
       "edges with one triangle",
       {"surface nets over the bounds", 1.0},
       {"clipped by the bounds and closed", 0.0},
       "six caps of the sphere lie outside the lattice",
       [] {
         return Figures{BadEdges(naiveMesh(sphere(1.1), 1.0).triangles).boundary,
                        boundaryEdges(ourMesh(sphere(1.1), Box::centred(glm::dvec3(1.0)))->mesh)};
       }},
      {"saddle x y = 0.001",
       "edges with more than two triangles, or pinched vertices",
       {"surface nets, one vertex a cell", 1.0},
       {"a vertex for each sheet that passes through a cell (OpenVDB's dual extraction)", 0.0},
       "two sheets share the cells along z",
       [] {
         constexpr double kCoarse = 1.0 / 8,
                          kHalf = kCoarse / 2;  // the crossing runs through the middle of cells
         const Vec3E p = position();
         const Shape saddle = field((p.x - kHalf) * (p.y - kHalf) - 0.001, Box::centred(glm::dvec3(1.0)));
         const Shape block = saddle & box(Vec3E(0.9));
         return Figures{BadEdges(naiveMesh(block, 1.0, kCoarse).triangles).crowded,
                        ourMesh(block, {}, kCoarse)->stats.manifold ? 0.0 : 1.0};
       }},
      {"sign of a mesh with a hole",
       "share of signs that are wrong",
       {"parity of crossings along x", 0.01},
       {"a mesh that is not closed is refused", 0.0},
       "rays that leave by the hole count one crossing less; two of twelve triangles are gone",
       [] {
         TriangleMesh open = boxMesh(glm::dvec3(1.0));
         open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // the face x = 1
         int wrong = 0, all = 0;
         worst(1.5, 16, [&](const glm::dvec3& p) {
           const bool within = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
           const bool through = std::abs(p.y) < 1.0 && std::abs(p.z) < 1.0;
           const int crossings = through && p.x < -1.0 ? 1 : 0;  // of the face x = -1; that of x = 1 is open
           wrong += (crossings % 2 == 1) != within, ++all;
           return 0.0;
         });
         double ours = 1.0;
         try {
           Reference{open};
         } catch (const std::invalid_argument&) {
           ours = 0.0;
         }
         return Figures{double(wrong) / all, ours};
       }},
      {"edges of a turned cube at 64 voxels",
       "error in voxels that the report does not own up to",
       {"surface nets; nothing is measured", 0.5},
       {"distance of the mesh to the surface measured and reported with every mesh", 0.05},
       "dual vertices cannot lie on edges: more than half a voxel is lost; the report samples each triangle "
       "at four points, CGAL measures ours at a hundred, which may find a little more",
       [] {
         const Shape cube = rotateAbout(box(Vec3E(1.0)), {1, 2, 3}, 0.7);
         const double voxel = 3.5 / 64;
         const Reference exact(turned(boxMesh(glm::dvec3(1.0)), turn({1, 2, 3}, 0.7)));
         double naive = 0.0, ours = 0.0;
         const NaiveMesh plain = naiveMesh(cube, 1.75, voxel);
         for (const glm::uvec3& t : plain.triangles) {
           const glm::dvec3 a = plain.points[t.x], b = plain.points[t.y], c = plain.points[t.z];
           naive = std::max(naive, exact.distance((a + b + c) / 3.0));
         }
         const auto meshed = ourMesh(cube, {}, voxel);
         const Mesh& m = meshed->mesh;
         constexpr int kSteps = 13;  // 105 points
         for (const glm::uvec3& t : m.triangles)
           for (int i = 0; i <= kSteps; ++i)
             for (int j = 0; i + j <= kSteps; ++j) {
               const double u = double(i) / kSteps, v = double(j) / kSteps;
               ours = std::max(
                   ours, exact.distance((1 - u - v) * glm::dvec3(m.positions[t.x]) +
                                        u * glm::dvec3(m.positions[t.y]) + v * glm::dvec3(m.positions[t.z])));
             }
         return Figures{naive / voxel, std::max(0.0, ours - meshed->stats.maxDistance) / voxel};
       }}};
}

}  // namespace sdf::accuracy
