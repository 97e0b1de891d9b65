#include "sdf/mesh/creases/sharpen.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "sdf/mesh/edit/divide.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/edit/islands.h"
#include "sdf/mesh/edit/short_edges.h"
#include "sdf/mesh/edit/uncross.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

constexpr std::uint32_t kNone = ~0u;

// Rounds in which edges that one crossing does not explain are halved.
constexpr int kSharpenHalvings = 3;
// The side of a crossing is the piece of its edge's end if their normals are no more than 25 degrees apart.
constexpr float kSamePiece = 0.9f;

class Sharpener {
 public:
  Sharpener(std::vector<glm::vec3> positions, std::vector<glm::vec3>& normals,
            std::vector<glm::uvec3> triangles, const std::vector<glm::vec3>& extracted,
            const LocalField& field, Progress& progress)
      : normals_(normals),
        triangles_(std::move(triangles)),
        cuts_(extracted),
        field_(field),
        progress_(progress) {
    mesh_.positions = std::move(positions);
    cuts_.first = cuts_.firstOfCreases = static_cast<std::uint32_t>(mesh_.positions.size());
  }

  Sharpened run() {
    std::vector<Island> islands;
    if (hasSharpEdges(normals_, triangles_)) islands = findIslands(cuts_.extracted, triangles_);
    crossings_ = findCrossings(mesh_.positions, normals_, triangles_, field_, progress_);
    nameCrossings();
    for (int round = 0; round < kSharpenHalvings; ++round)
      if (!halveDoubtful()) break;
    std::erase_if(crossings_, [](const Crossing& c) { return !c.point.placed; });
    if (crossings_.empty()) {
      mesh_.triangles = std::move(triangles_);
      std::vector<std::uint32_t> doubtful = uncross(mesh_, normals_, cuts_, {});
      return {std::move(mesh_), std::move(doubtful)};
    }
    nameCrossings();
    vertexOf_.assign(crossings_.size(), kNone);
    const std::vector<Crossed> crossed = crossedTriangles();
    findCorners(crossed);
    cutTriangles(crossed);
    if (!islands.empty()) addCuts(islands);
    dropSwallowed(mesh_, islands);
    normals_.resize(mesh_.positions.size(), glm::vec3(0.0f));
    const double shortest = kShort * field_.finder()->at(mesh_.positions[0]).voxel;
    const Collapses collapses = collapseShortEdges(mesh_, normals_, anchors_, shortest);
    std::vector<std::uint32_t> doubtful = uncross(mesh_, normals_, cuts_, collapses);
    const std::vector<std::uint32_t> place = dropUnused(mesh_, &normals_);
    for (std::uint32_t& v : doubtful) v = place[v];
    std::erase(doubtful, Collapses::kNone);
    return {std::move(mesh_), std::move(doubtful)};
  }

 private:
  void nameCrossings() {
    crossingOf_.clear();
    touched_.assign(mesh_.positions.size(), 0);
    for (std::uint32_t i = 0; i < crossings_.size(); ++i) {
      const auto [a, b] = crossings_[i].edge;
      crossingOf_.emplace(edgeKey(a, b), i);
      touched_[a] = touched_[b] = 1;
    }
  }

  // Is the crossing the only one of its edge?
  bool isSure(const Crossing& c) const {
    return c.point.placed && glm::dot(c.point.normal[0], normals_[c.edge[0]]) > kSamePiece &&
           glm::dot(c.point.normal[1], normals_[c.edge[1]]) > kSamePiece;
  }

  // Halves the edges that a third piece seems to cross. Returns whether there were any.
  bool halveDoubtful() {
    std::vector<Crossing> sure;
    std::ranges::copy_if(crossings_, std::back_inserter(sure), [&](const Crossing& c) { return isSure(c); });
    if (sure.size() == crossings_.size()) return false;
    std::erase_if(crossings_, [&](const Crossing& c) { return isSure(c); });
    nameCrossings();
    std::vector<glm::vec3> middles, normals;
    for (const Crossing& c : crossings_) {
      middles.push_back(0.5f * (mesh_.positions[c.edge[0]] + mesh_.positions[c.edge[1]]));
      cuts_.addOnEdge(c.edge, 0.5f);
    }
    refineVertices(middles, normals, field_, progress_);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    cuts_.firstOfCreases = first + static_cast<std::uint32_t>(middles.size());
    mesh_.positions.insert(mesh_.positions.end(), middles.begin(), middles.end());
    normals_.insert(normals_.end(), normals.begin(), normals.end());
    std::vector<glm::uvec3> divided;
    std::erase_if(triangles_, [&](const glm::uvec3& t) {
      auto x = crossingsOf(t);
      if (x[0] == kNone && x[1] == kNone && x[2] == kNone) return false;
      for (std::uint32_t& middle : x)
        if (middle != kNone) middle += first;
      divide(t, x, divided);
      return true;
    });
    // Edges that were there before have been looked at.
    crossings_ = findCrossings(mesh_.positions, normals_, divided, field_, progress_);
    std::erase_if(crossings_, [&](const Crossing& c) { return c.edge[1] < first; });
    crossings_.insert(crossings_.begin(), sure.begin(), sure.end());
    nameCrossings();
    triangles_.insert(triangles_.end(), divided.begin(), divided.end());
    return true;
  }

  std::uint32_t crossingAt(std::uint32_t a, std::uint32_t b) const {
    if (!touched_[a] || !touched_[b]) return kNone;
    const auto it = crossingOf_.find(edgeKey(a, b));
    return it == crossingOf_.end() ? kNone : it->second;
  }

  std::array<std::uint32_t, 3> crossingsOf(const glm::uvec3& t) const {
    return {crossingAt(t.x, t.y), crossingAt(t.y, t.z), crossingAt(t.z, t.x)};
  }

  struct Crossed {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> crossings;  // of its edges
  };

  // Those that any crossing lies on, in their order.
  std::vector<Crossed> crossedTriangles() const {
    return collected<Crossed>(triangles_.size(), [&](std::uint32_t i, std::vector<Crossed>& out) {
      const glm::uvec3& t = triangles_[i];
      if (touched_[t.x] + touched_[t.y] + touched_[t.z] < 2) return;
      const auto x = crossingsOf(t);
      if (x[0] != kNone || x[1] != kNone || x[2] != kNone) out.push_back({i, x});
    });
  }

  static bool isThreefold(const std::array<std::uint32_t, 3>& x) {
    return x[0] != kNone && x[1] != kNone && x[2] != kNone;
  }

  std::uint32_t addVertex(const glm::vec3& p) {
    mesh_.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  // The first piece of a triangle takes its place.
  void add(const glm::uvec3& triangle) {
    if (std::exchange(first_, false))
      mesh_.triangles[place_] = triangle;
    else
      mesh_.triangles.push_back(triangle);
  }

  void addCrease(std::uint32_t a, std::uint32_t b) {
    mesh_.creases.push_back({std::min(a, b), std::max(a, b)});
  }

  std::uint32_t vertexAt(std::uint32_t crossing) {
    if (crossing == kNone) return kNone;
    if (vertexOf_[crossing] == kNone) {
      const auto& [edge, p] = crossings_[crossing];
      const glm::vec3 &a = mesh_.positions[edge[0]], way = mesh_.positions[edge[1]] - a;
      cuts_.addOnEdge(edge, glm::dot(p.at - a, way) / glm::dot(way, way));
      vertexOf_[crossing] = addVertex(p.at);
      if (p.corner) anchors_.push_back(vertexOf_[crossing]);
    }
    return vertexOf_[crossing];
  }

  // Corners of the triangles with three pieces, in their order.
  void findCorners(const std::vector<Crossed>& crossed) {
    std::vector<CornerPoint> corners;
    for (const auto& [triangle, x] : crossed) {
      if (!isThreefold(x)) continue;
      const glm::uvec3& t = triangles_[triangle];
      CornerPoint corner{};
      for (int k = 0; k < 3; ++k) {
        corner.normal[k] = normals_[t[k]];
        corner.on[k] = mesh_.positions[t[k]];
        corner.at += crossings_[x[k]].point.at / 3.0f;
      }
      corners.push_back(corner);
    }
    placeCorners(corners, field_, progress_);
    corners_ = std::move(corners);
  }

  void cutTriangles(const std::vector<Crossed>& crossed) {
    mesh_.triangles = std::move(triangles_);
    for (const auto& [triangle, x] : crossed) {
      place_ = triangle;
      first_ = true;
      cut(glm::uvec3(mesh_.triangles[triangle]), x);
    }
    std::ranges::sort(mesh_.creases);
  }

  void cut(const glm::uvec3& t, const std::array<std::uint32_t, 3>& x) {
    if (isThreefold(x)) return cutAroundCorner(t, x);
    const int count = (x[0] != kNone) + (x[1] != kNone) + (x[2] != kNone);
    // Turned so that the first edge is cut, and of two the last, too.
    int first = 0;
    while (x[first] == kNone || (count == 2 && x[(first + 2) % 3] == kNone)) ++first;
    const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3], ab = vertexAt(x[first]);
    if (count == 1) {
      add({a, ab, c});
      add({ab, b, c});
      return;
    }
    const std::uint32_t ca = vertexAt(x[(first + 2) % 3]);
    add({a, ab, ca});
    addCrease(ab, ca);
    const auto length = [&](std::uint32_t p, std::uint32_t q) {
      return glm::distance(mesh_.positions[p], mesh_.positions[q]);
    };
    if (length(ab, c) <= length(b, ca)) {
      add({ab, b, c});
      add({ab, c, ca});
    } else {
      add({ab, b, ca});
      add({b, c, ca});
    }
  }

  void cutAroundCorner(const glm::uvec3& t, const std::array<std::uint32_t, 3>& x) {
    const CornerPoint& found = corners_[nextCorner_++];
    cuts_.addInside(t);
    const std::uint32_t corner = addVertex(found.at);
    if (found.placed) anchors_.push_back(corner);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t on = vertexAt(x[k]);
      add({t[k], on, corner});
      add({on, t[(k + 1) % 3], corner});
      addCrease(on, corner);
    }
  }

  // The vertices that were added since.
  void addCuts(std::vector<Island>& islands) const {
    std::vector<std::uint32_t> of(mesh_.positions.size(), kNone);
    for (std::uint32_t i = 0; i < islands.size(); ++i)
      for (const std::uint32_t v : islands[i].vertices) of[v] = i;
    for (std::uint32_t v = cuts_.first; v < of.size(); ++v) {
      of[v] = of[cuts_.added[v - cuts_.first].of.x];
      if (of[v] != kNone) islands[of[v]].vertices.push_back(v);
    }
  }

  static constexpr double kShort = 0.2;  // voxels

  std::vector<glm::vec3>& normals_;
  std::vector<glm::uvec3> triangles_;
  Cuts cuts_;
  const LocalField& field_;
  Progress& progress_;
  FeatureMesh mesh_;
  std::size_t place_ = 0;  // of the triangle that is cut
  bool first_ = false;     // none of its pieces has been added
  std::vector<Crossing> crossings_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossingOf_;
  std::vector<char> touched_;
  std::vector<std::uint32_t> vertexOf_;
  std::vector<CornerPoint> corners_;
  std::vector<std::uint32_t> anchors_;  // vertices at corners that were placed
  std::size_t nextCorner_ = 0;
};

}  // namespace

Sharpened sharpen(std::vector<glm::vec3> positions, std::vector<glm::vec3>& normals,
                  std::vector<glm::uvec3> triangles, const std::vector<glm::vec3>& extracted,
                  const LocalField& field, Progress& progress) {
  return Sharpener(std::move(positions), normals, std::move(triangles), extracted, field, progress).run();
}

}  // namespace sdf
