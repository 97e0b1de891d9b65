#include "sdf/mesh/measure/topology.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <numeric>
#include <span>

#include "sdf/base/disjoint_sets.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

struct Summary {
  std::ptrdiff_t vertices = 0;  // used by a triangle
  std::ptrdiff_t edges = 0;
  bool balanced = true;  // every edge has as many triangles one way as the other
  bool manifold = true;  // one each way, and around every vertex a single fan

  Summary operator+(const Summary& o) const {
    return {vertices + o.vertices, edges + o.edges, balanced && o.balanced, manifold && o.manifold};
  }
};

// A neighbour of a vertex, with the triangles on the edge to it.
struct Spoke {
  std::uint32_t neighbour;
  int outgoing = 0, incoming = 0;
};

// Examines one vertex at a time: its edges to larger vertices, and whether its triangles form one fan, that
// is whether its neighbours, joined by the triangles, are connected.
class VertexExaminer {
 public:
  VertexExaminer(const std::vector<glm::uvec3>& triangles, const Incidence& incidence)
      : triangles_(triangles), incidence_(incidence) {}

  void examine(std::uint32_t v, Summary& s) {
    const std::span<const std::uint32_t> around = incidence_.of(v);
    if (around.empty()) return;
    ++s.vertices;
    spokes_.clear(), fans_.clear();
    std::size_t joins = 0;
    for (const std::uint32_t t : around) {
      const glm::uvec3& c = triangles_[t];
      const int k = c.x == v ? 0 : c.y == v ? 1 : 2;
      const std::uint32_t next = spoke(c[(k + 1) % 3]), previous = spoke(c[(k + 2) % 3]);
      ++spokes_[next].outgoing;
      ++spokes_[previous].incoming;
      joins += fans_.join(next, previous);
    }
    for (const Spoke& e : spokes_) {
      if (e.neighbour < v) continue;
      ++s.edges;
      s.balanced = s.balanced && e.outgoing == e.incoming;
      s.manifold = s.manifold && e.outgoing == 1 && e.incoming == 1;
    }
    s.manifold = s.manifold && spokes_.size() == joins + 1;
  }

 private:
  std::uint32_t spoke(std::uint32_t neighbour) {
    for (std::uint32_t i = 0; i < spokes_.size(); ++i)
      if (spokes_[i].neighbour == neighbour) return i;
    spokes_.push_back({neighbour}), fans_.add();
    return static_cast<std::uint32_t>(spokes_.size() - 1);
  }

  const std::vector<glm::uvec3>& triangles_;
  const Incidence& incidence_;
  std::vector<Spoke> spokes_;
  DisjointSets fans_;  // of spokes
};

}  // namespace

void measureTopology(const std::vector<glm::uvec3>& triangles, std::size_t vertices, MeshStats& stats) {
  const Incidence incidence(triangles, vertices);
  const Summary s = tbb::parallel_reduce(
      tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(vertices)), Summary{},
      [&](const tbb::blocked_range<std::uint32_t>& range, Summary sum) {
        VertexExaminer examiner(triangles, incidence);
        for (std::uint32_t v = range.begin(); v != range.end(); ++v) examiner.examine(v, sum);
        return sum;
      },
      std::plus<>());
  stats.triangles = triangles.size();
  stats.vertices = static_cast<std::uint64_t>(s.vertices);
  stats.watertight = s.balanced && !triangles.empty();
  stats.manifold = s.manifold && !triangles.empty();
  // A vertex that no triangle has is a piece of its own.
  const std::vector<std::uint32_t> pieces = piecesOf(triangles, vertices);
  std::ptrdiff_t components = s.vertices - static_cast<std::ptrdiff_t>(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) components += pieces[v] == v;
  stats.components = static_cast<int>(components);
  stats.eulerCharacteristic =
      static_cast<int>(s.vertices - s.edges + static_cast<std::ptrdiff_t>(triangles.size()));
}

void measureCrossings(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                      MeshStats& stats) {
  const TrianglePairs pairs = crossingTriangles(positions, triangles);
  stats.crossings = pairs.size();
  if (pairs.empty()) return;
  const glm::uvec3& first = triangles[pairs[0][0]];
  stats.firstCrossing = (positions[first.x] + positions[first.y] + positions[first.z]) / 3.0f;
}

}  // namespace sdf
