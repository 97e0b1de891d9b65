#include "sdf/mesh/edit/uncross.h"

#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/edit/neighbourhood.h"

namespace sdf {
namespace {

// Rounds until a mesh is given up as it is: some ten are the most that any has taken.
constexpr int kRounds = 60;

TrianglePairs crossingsOf(const std::vector<std::uint32_t>& triangles, const FeatureMesh& mesh,
                          const Neighbourhood& near) {
  std::vector<char> asked(mesh.triangles.size(), 0);
  for (const std::uint32_t t : triangles) asked[t] = 1;
  return crossingTriangles(mesh.positions, mesh.triangles, near.triangles(), asked);
}

/// Does a triangle agree with the normals at its corners, of which it has one at least?
bool agrees(const FeatureMesh& mesh, const std::vector<glm::vec3>& normals, const glm::uvec3& t) {
  const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
  const glm::vec3 area = glm::cross(b - a, c - a);
  bool any = false;
  for (int k = 0; k < 3; ++k) {
    const bool faces = isFacing(area, normals[t[k]]);
    if (!faces && !isNone(normals[t[k]])) return false;
    any = any || faces;
  }
  return any;
}

/// Has a crease moved a corner of a triangle by more than a share of the edge that was cut there?
bool wasMovedFar(const FeatureMesh& mesh, const Cuts& cuts, const glm::uvec3& t) {
  constexpr float kFar = 0.45f;
  for (int k = 0; k < 3; ++k) {
    if (t[k] < cuts.firstOfCreases) continue;
    const auto& [of, weight] = cuts.added[t[k] - cuts.first];
    const glm::vec3 &a = mesh.positions[of.x], &b = mesh.positions[of.y], &c = mesh.positions[of.z];
    const glm::vec3 way = mesh.positions[t[k]] - (a * weight.x + b * weight.y + c * weight.z), edge = b - a;
    if (glm::dot(way, way) > kFar * kFar * glm::dot(edge, edge)) return true;
  }
  return false;
}

/// Where triangles may cross.
struct Suspects {
  std::vector<std::uint32_t> triangles;
  std::vector<char> vertices;  ///< around those that do not agree with the normals; empty if there are none
};

Suspects suspectsOf(const FeatureMesh& mesh, const std::vector<glm::vec3>& normals, const Cuts& cuts) {
  constexpr int kRings = 2;
  Suspects s;
  s.triangles = indicesThat(mesh.triangles.size(), [&](std::uint32_t i) {
    const glm::uvec3& t = mesh.triangles[i];
    return !isGone(t) && (!agrees(mesh, normals, t) || wasMovedFar(mesh, cuts, t));
  });
  std::vector<std::uint32_t> around;
  for (const std::uint32_t t : s.triangles)
    if (!agrees(mesh, normals, mesh.triangles[t])) around.push_back(t);
  if (around.empty()) return s;
  s.vertices.assign(mesh.positions.size(), 0);
  markCorners(s.vertices, mesh, around);
  for (int ring = 0; ring < kRings; ++ring) {
    around = trianglesWith(s.vertices, mesh);
    markCorners(s.vertices, mesh, around);
  }
  s.triangles.insert(s.triangles.end(), around.begin(), around.end());
  return s;
}

std::vector<std::uint32_t> trianglesOf(const TrianglePairs& pairs) {
  std::vector<std::uint32_t> all;
  for (const auto& [a, b] : pairs) all.push_back(a), all.push_back(b);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Undoes collapses, with all later ones that were made of what they had left.
class Undoing {
 public:
  Undoing(const Collapses& collapses, FeatureMesh& mesh)
      : collapses_(collapses),
        mesh_(mesh),
        undone_(collapses.steps.size(), 0),
        took_(mesh.positions.size(), kNone),
        last_(mesh.triangles.size(), kNone),
        stepOf_(collapses.changes.size()),
        before_(collapses.changes.size()) {
    for (std::uint32_t step = 0; step < collapses.steps.size(); ++step) {
      if (const std::uint32_t v = collapses.steps[step].gone; v != kNone) took_[v] = step;
      for (std::size_t i = collapses.steps[step].first; i < collapses.end(step); ++i) {
        stepOf_[i] = step;
        before_[i] = std::exchange(last_[collapses.changes[i].triangle], static_cast<std::uint32_t>(i));
      }
    }
  }

  /// All that changed one of the triangles. Returns the triangles that were changed back.
  std::vector<std::uint32_t> undo(const std::vector<std::uint32_t>& triangles) {
    steps_.clear();
    for (const std::uint32_t t : triangles) addAllOf(t, 0);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const std::uint32_t step = steps_[i];
      for (std::size_t k = collapses_.steps[step].first; k < collapses_.end(step); ++k) {
        const auto& [triangle, before] = collapses_.changes[k];
        addAllOf(triangle, step);
        for (int corner = 0; corner < 3; ++corner)
          if (const std::uint32_t by = took_[before[corner]]; by != kNone && by >= step) add(by);
      }
    }
    std::ranges::sort(steps_, std::greater<>());
    std::vector<std::uint32_t> restored;
    for (const std::uint32_t step : steps_)
      for (std::size_t k = collapses_.steps[step].first; k < collapses_.end(step); ++k) {
        const auto& [triangle, before] = collapses_.changes[k];
        mesh_.triangles[triangle] = before;
        restored.push_back(triangle);
      }
    return restored;
  }

 private:
  static constexpr std::uint32_t kNone = Collapses::kNone;

  void add(std::uint32_t step) {
    if (!undone_[step]) undone_[step] = 1, steps_.push_back(step);
  }
  // The steps from one on that changed a triangle.
  void addAllOf(std::uint32_t triangle, std::uint32_t from) {
    for (std::uint32_t i = last_[triangle]; i != kNone && stepOf_[i] >= from; i = before_[i]) add(stepOf_[i]);
  }

  const Collapses& collapses_;
  FeatureMesh& mesh_;
  std::vector<char> undone_;
  std::vector<std::uint32_t> took_;    // by vertex, the step in which it went
  std::vector<std::uint32_t> last_;    // by triangle, its last change
  std::vector<std::uint32_t> stepOf_;  // by change
  std::vector<std::uint32_t> before_;  // by change, the one before of its triangle
  std::vector<std::uint32_t> steps_;   // to undo now
};

class Uncrosser {
 public:
  Uncrosser(FeatureMesh& mesh, std::vector<glm::vec3>& normals, const Tiles& tiles, const Cuts& cuts,
            const Collapses& collapses)
      : mesh_(mesh),
        normals_(normals),
        cuts_(cuts),
        undoing_(collapses, mesh),
        stage_(mesh.positions.size(), kPlaced),
        changed_(stage_.size(), 0),
        tiles_(tiles) {
    findPlaces();
  }

  void run(TrianglePairs pairs) {
    for (int round = 0; round < kRounds && !pairs.empty(); ++round) {
      if (!near_) near_.emplace(mesh_, tiles_, trianglesOf(pairs));
      std::ranges::fill(changed_, char{0});
      left_ = false;
      std::erase_if(pairs, [&](const auto& pair) { return takeBack(pair); });
      if (!pairs.empty()) grow(trianglesOf(pairs));
      if (left_) near_.emplace(mesh_, tiles_, trianglesWith(changed_, mesh_));
      pairs = crossingsOf(near_->trianglesAt(changed_), mesh_, *near_);
    }
    std::erase_if(mesh_.creases, [&](const auto& crease) {
      return stage_[crease[0]] != kPlaced || stage_[crease[1]] != kPlaced;
    });
  }

 private:
  // How far a vertex was taken back: in quarters to where the mesh was uncut, then in halves to where it was
  // extracted.
  enum Stage : char { kPlaced, kUncut = 4, kHalfway, kExtracted };

  // Where the vertices were before creases were cut, and where they were extracted.
  void findPlaces() {
    placed_ = uncut_ = mesh_.positions;
    const bool known = !cuts_.extracted.empty();
    extracted_ = known ? cuts_.extracted : mesh_.positions;
    extracted_.resize(uncut_.size());
    for (std::size_t v = cuts_.first; v < uncut_.size(); ++v) {
      const auto& [of, weight] = cuts_.added[v - cuts_.first];
      const auto mean = [&, &of = of, &weight = weight](const std::vector<glm::vec3>& p) {
        return p[of.x] * weight.x + p[of.y] * weight.y + p[of.z] * weight.z;
      };
      if (v >= cuts_.firstOfCreases) uncut_[v] = mean(uncut_);
      extracted_[v] = known ? mean(extracted_) : uncut_[v];
    }
  }

  glm::vec3 placeOf(std::uint32_t v, Stage stage) const {
    if (stage < kUncut)
      return glm::mix(placed_[v], uncut_[v], static_cast<float>(stage) / static_cast<float>(kUncut));
    if (stage == kHalfway) return 0.5f * (uncut_[v] + extracted_[v]);
    return stage == kUncut ? uncut_[v] : extracted_[v];
  }

  bool raise(std::uint32_t v, Stage stage) {
    if (stage_[v] >= stage) return false;
    stage_[v] = stage;
    const glm::vec3 to = placeOf(v, stage);
    left_ = left_ || !near_->contains(mesh_.positions[v]) || !near_->contains(to);
    mesh_.positions[v] = to;
    if (stage > kUncut) normals_[v] = glm::vec3(0.0f);
    changed_[v] = 1;
    return true;
  }

  bool raiseCorners(const std::vector<std::uint32_t>& triangles, Stage stage) {
    bool any = false;
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) any |= raise(mesh_.triangles[t][k], stage);
    return any;
  }

  // Takes the corner that creases have moved farthest back by a stage, or if there is none all corners, if
  // any of them can go and none has gone before.
  bool takeBack(const std::array<std::uint32_t, 2>& pair) {
    Stage least = kExtracted;
    float farthest = 0.0f;
    std::uint32_t moved = 0;
    for (const std::uint32_t t : pair)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[t][k];
        if (changed_[v]) return true;
        least = std::min(least, stage_[v]);
        const float way = stage_[v] < kUncut ? glm::distance(mesh_.positions[v], uncut_[v]) : 0.0f;
        if (way > farthest) farthest = way, moved = v;
      }
    if (farthest > 0.0f) return raise(moved, static_cast<Stage>(stage_[moved] + 1));
    if (least == kExtracted) return false;
    return raiseCorners({pair[0], pair[1]}, std::max(kHalfway, static_cast<Stage>(least + 1)));
  }

  void undo(const std::vector<std::uint32_t>& triangles) {
    const std::vector<std::uint32_t> restored = undoing_.undo(triangles);
    near_->add(restored);
    raiseCorners(restored, kExtracted);
    markCorners(changed_, mesh_, restored);
  }

  void grow(const std::vector<std::uint32_t>& stuck) {
    std::vector<char> marked(stage_.size(), 0);
    markCorners(marked, mesh_, stuck);
    const std::vector<std::uint32_t> around = near_->trianglesAt(marked);
    undo(around);
    raiseCorners(around, kExtracted);
  }

  FeatureMesh& mesh_;
  std::vector<glm::vec3>& normals_;
  const Cuts& cuts_;
  Undoing undoing_;
  std::vector<Stage> stage_;
  std::vector<char> changed_;
  const Tiles& tiles_;
  std::optional<Neighbourhood> near_;  // of what crosses
  bool left_ = false;                  // it does not hold all that has changed
  std::vector<glm::vec3> placed_, uncut_, extracted_;
};

}  // namespace

std::vector<std::uint32_t> uncross(FeatureMesh& mesh, std::vector<glm::vec3>& normals, const Cuts& cuts,
                                   const Collapses& collapses) {
  const Suspects suspects = suspectsOf(mesh, normals, cuts);
  if (suspects.triangles.empty()) return {};
  const Tiles tiles = tilesOf(mesh);
  TrianglePairs pairs = crossingsOf(suspects.triangles, mesh, Neighbourhood(mesh, tiles, suspects.triangles));
  if (!pairs.empty()) Uncrosser(mesh, normals, tiles, cuts, collapses).run(std::move(pairs));
  return indicesThat(suspects.vertices.size(), [&](std::uint32_t v) { return suspects.vertices[v] != 0; });
}

void uncrossMoved(FeatureMesh& mesh, const std::vector<std::uint32_t>& doubtful,
                  const std::vector<glm::vec3>& before) {
  if (doubtful.empty()) return;
  const Tiles tiles = tilesOf(mesh);
  std::vector<char> changed(mesh.positions.size(), 0), back(changed);
  for (const std::uint32_t v : doubtful) changed[v] = 1;
  Neighbourhood near(mesh, tiles, trianglesWith(changed, mesh));
  for (int round = 0; round < kRounds; ++round) {
    const TrianglePairs pairs = crossingsOf(near.trianglesAt(changed), mesh, near);
    if (pairs.empty()) return;
    // What is back and still crosses takes what is around it along.
    if (round > 0) markCorners(back, mesh, near.trianglesAt(back));
    markCorners(back, mesh, trianglesOf(pairs));
    for (std::size_t v = 0; v < back.size(); ++v) {
      changed[v] = back[v] && mesh.positions[v] != before[v];
      if (changed[v]) mesh.positions[v] = before[v];
    }
  }
}

}  // namespace sdf
