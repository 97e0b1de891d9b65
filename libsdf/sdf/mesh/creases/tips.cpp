#include "sdf/mesh/creases/tips.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/edit/islands.h"
#include "sdf/mesh/edit/short_edges.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// Cosine of what normals turn by along an edge near a tip: 25 degrees.
constexpr float kTurned = 0.9f;
// Voxels that a vertex may be moved by; of a slim cone as many as it goes on for where it is two voxels wide.
constexpr double kTipReach = 4.0;
// Of that: what triangles around a tip are exchanged within.
constexpr double kWidest = 2.0;
// Planes whose normals' least mean square along a direction is below this have no point in common for sure.
constexpr double kFlatTip = 1e-3;
// Voxels from the tip at which the surface is looked at, one reading after the other, in so many directions.
constexpr double kTipProbes[] = {0.4, 0.1, 0.02};
constexpr int kAround = 8;
// Of the probes' distance: how far their planes may pass the tip.
constexpr double kMissed = 0.05;
// Of the mean: how little normals may turn from one probe to the next. They do not on a pyramid's face.
constexpr double kEven = 0.2;

// Planes n . x = d.
struct Planes {
  glm::dmat3 squares{0.0};  // sum of n n^T
  glm::dvec3 sum{0.0}, toPoint{0.0};
  int count = 0;

  void add(const glm::dvec3& n, double d) {
    squares += glm::outerProduct(n, n);
    sum += n;
    toPoint += d * n;
    ++count;
  }
  bool meet() const {
    // The least eigenvalue is the determinant by the product of the others, which are at most `count`
    // together.
    return glm::determinant(squares) > kFlatTip * 0.25 * count * count * count;
  }
};

struct Tip {
  std::uint32_t vertex;
  glm::dvec3 at, axis;  // n . axis is the same for all planes around
  double far;           // from the vertex
  bool found = false;
};

// The mesh's vertices that are no crease's, and what turns around them.
class Finder {
  using Pair = std::array<std::uint32_t, 2>;  // a vertex and a neighbour

  std::span<const Pair> neighbours(std::uint32_t v) const {
    return {std::lower_bound(around_.begin(), around_.end(), Pair{v, 0}),
            std::lower_bound(around_.begin(), around_.end(), Pair{v + 1, 0})};
  }

 public:
  Finder(const FeatureMesh& mesh, const std::vector<glm::vec3>& normals, const LocalField& field)
      : mesh_(mesh), normals_(normals), locals_(field.finder()) {}

  // Those that something turns around.
  std::vector<std::uint32_t> vertices() const {
    std::vector<std::uint32_t> all;
    for (const Pair& p : around_)
      if (all.empty() || all.back() != p[0]) all.push_back(p[0]);
    return all;
  }

  // Common points of the planes around vertices, each with the vertex that is nearest to it.
  std::vector<Tip> run() {
    gather();
    std::vector<Tip> tips;
    for (std::size_t i = 0; i < around_.size(); i += neighbours(around_[i][0]).size())
      if (auto tip = tipOf(neighbours(around_[i][0]))) {
        walkTo(*tip);
        tips.push_back(*tip);
      }
    std::ranges::stable_sort(tips, {}, &Tip::vertex);
    const auto same = [](const Tip& a, const Tip& b) { return a.vertex == b.vertex; };
    tips.erase(std::unique(tips.begin(), tips.end(), same), tips.end());
    return tips;
  }

 private:
  void gather() {
    std::vector<char> creased(mesh_.positions.size(), 0);
    for (const auto& [a, b] : mesh_.creases) creased[a] = creased[b] = 1;
    around_ = collected<Pair>(mesh_.triangles.size(), [&](std::uint32_t t, std::vector<Pair>& out) {
      const glm::uvec3& c = mesh_.triangles[t];
      const auto turns = [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(normals_[a], normals_[b]) < kTurned;
      };
      if (!turns(c.x, c.y) && !turns(c.y, c.z) && !turns(c.z, c.x)) return;
      if (creased[c.x] || creased[c.y] || creased[c.z]) return;
      for (int k = 0; k < 3; ++k) {
        out.push_back({c[k], c[(k + 1) % 3]});
        out.push_back({c[k], c[(k + 2) % 3]});
      }
    });
    tbb::parallel_sort(around_);
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
  }

  // From vertex to vertex, as long as one is nearer to the tip.
  void walkTo(Tip& tip) const {
    for (auto from = static_cast<std::uint32_t>(mesh_.positions.size()); from != tip.vertex;) {
      from = tip.vertex;
      for (const Pair& p : neighbours(from))
        if (const double far = glm::distance(tip.at, glm::dvec3(mesh_.positions[p[1]])); far < tip.far)
          tip.far = far, tip.vertex = p[1];
    }
  }

  std::optional<Tip> tipOf(std::span<const Pair> around) {
    const std::uint32_t v = around.front()[0];
    const glm::dvec3 origin(mesh_.positions[v]);
    Planes planes;
    const auto add = [&](std::uint32_t u) {
      const glm::dvec3 n(normals_[u]);
      planes.add(n, glm::dot(n, glm::dvec3(mesh_.positions[u]) - origin));
    };
    add(v);
    for (const Pair& p : around) add(p[1]);
    if (!planes.meet()) return std::nullopt;
    const glm::dmat3 inverse = glm::inverse(planes.squares);
    const glm::dvec3 way = inverse * planes.toPoint;
    const double far = glm::length(way);
    const glm::dvec3 axis = inverse * planes.sum;
    // Of a normal along the axis: the sine of the cone's half angle.
    const double rise = std::min(1.0, 1.0 / glm::length(axis)), goesOn = std::sqrt(1.0 - rise * rise) / rise;
    if (!(far <= std::max(kTipReach, goesOn) * locals_->at(mesh_.positions[v]).voxel)) return std::nullopt;
    return Tip{v, origin + way, axis, far};
  }

  const FeatureMesh& mesh_;
  const std::vector<glm::vec3>& normals_;
  const std::unique_ptr<LocalField::Finder> locals_;
  std::vector<Pair> around_;
};

// Looks around a tip, from ever closer; where planes do not meet in it it is none.
class Approach {
 public:
  Approach(const PointRun& run, Tip& tip) : run_(run), tip_(tip) {}

  bool run() {
    for (const double reach : kTipProbes)
      if (!step(reach * run_.voxel)) return false;
    return turnsEvenly() && glm::distance(tip_.at, start_) < kTipReach * run_.voxel;
  }

 private:
  bool step(double reach) {
    const double size = glm::length(tip_.axis), rise = 1.0 / size;  // n . axis / |axis|
    if (!(rise > 0.01 && rise < 0.999)) return false;
    const glm::dvec3 axis = tip_.axis / size;
    const glm::dvec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 other = glm::cross(axis, side);
    // Down the cone whose normals rise like that.
    const double down = std::sqrt(1.0 - rise * rise);
    PointRows points;
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      const glm::dvec3 out = std::cos(angle) * side + std::sin(angle) * other;
      points.set(k, glm::vec3(tip_.at + reach * (rise * out - down * axis)));
    }
    float value[kAround];
    PointRows g;
    run_.batch.evaluateGradient(*run_.tapes.distance, points.rows(), kAround, value, g.x, g.y, g.z);
    Planes planes;
    double d[kAround];
    for (int k = 0; k < kAround; ++k) {
      const glm::dvec3 gradient(g.at(k));
      const double length = glm::length(gradient);
      normal_[k] = gradient / length;
      d[k] = glm::dot(normal_[k], glm::dvec3(points.at(k)) - tip_.at) - value[k] / length;
      planes.add(normal_[k], d[k]);
    }
    if (!planes.meet()) return false;
    const glm::dmat3 inverse = glm::inverse(planes.squares);
    const glm::dvec3 move = inverse * planes.toPoint;
    tip_.at += move;
    tip_.axis = inverse * planes.sum;
    double missed = 0.0;
    for (int k = 0; k < kAround; ++k) missed = std::max(missed, std::abs(glm::dot(normal_[k], move) - d[k]));
    return missed <= kMissed * reach;
  }

  bool turnsEvenly() const {
    double least = HUGE_VAL, all = 0.0;
    for (int k = 0; k < kAround; ++k) {
      const double turn = glm::distance(normal_[k], normal_[(k + 1) % kAround]);
      least = std::min(least, turn);
      all += turn;
    }
    return least > kEven * all / kAround;
  }

  const PointRun& run_;
  Tip& tip_;
  const glm::dvec3 start_ = tip_.at;
  glm::dvec3 normal_[kAround];
};

// Puts a fan around a tip in the place of the triangles that are nearest to it.
class Crowner {
 public:
  Crowner(FeatureMesh& mesh, std::vector<glm::vec3>& normals, const std::vector<std::uint32_t>& near)
      : mesh_(mesh), normals_(normals), fixed_(mesh.positions.size(), 0) {
    std::vector<char> isNear(mesh.positions.size(), 0);
    for (const std::uint32_t v : near) isNear[v] = 1;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const std::uint32_t v = mesh.triangles[t][k]; isNear[v]) fans_[v].push_back(t);
  }

  // Takes ever more triangles until they leave a hole that a fan closes, a round one if it need not reach far
  // for that.
  void crown(const Tip& tip, double voxel) {
    const double least = std::max(1.01 * tip.far, kNarrowest * voxel);
    for (double reach = least; reach <= kFarForRound * voxel; reach *= kWider)
      if (find(tip, reach) && widest_ < kRound && !crosses(tip)) return close(tip);
    const double most = kWidest * std::max(kTipReach * voxel, tip.far);
    for (double reach = least; reach <= most; reach *= kWider)
      if (find(tip, reach) && !crosses(tip)) return close(tip);
  }

 private:
  static constexpr double kWider = 1.3;
  static constexpr double kNarrowest = 0.1, kFarForRound = 3.0;  // voxels
  // Of triangles around a fan, which it may cross.
  static constexpr int kRings = 3;
  // What a fan's triangle may turn around the axis: 100 degrees.
  static constexpr double kRound = 1.745;

  // The triangles around the vertices within reach, and the sides of the hole that they leave.
  bool find(const Tip& tip, double reach) {
    std::vector<std::uint32_t> inside{tip.vertex};
    gone_.clear(), next_.clear();
    std::set<std::uint32_t> seen{tip.vertex}, gone;
    for (std::size_t i = 0; i < inside.size(); ++i)
      for (const std::uint32_t t : fans_.at(inside[i])) {
        gone.insert(t);
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t v = mesh_.triangles[t][k];
          if (fixed_[v]) return false;
          if (fans_.contains(v) && glm::distance(glm::dvec3(mesh_.positions[v]), tip.at) <= reach &&
              seen.insert(v).second)
            inside.push_back(v);
        }
      }
    gone_.assign(gone.begin(), gone.end());
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (const std::uint32_t t : gone_)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        if (sides.erase({b, a}) == 0) sides.insert({a, b});
      }
    for (const auto& [a, b] : sides)
      if (!next_.emplace(a, b).second) return false;
    within_.clear();
    for (const std::uint32_t t : gone_)
      for (int k = 0; k < 3; ++k)
        if (const std::uint32_t v = mesh_.triangles[t][k]; !next_.contains(v)) within_.insert(v);
    // Vertices, edges and triangles of a disc, which no crease leaves.
    const std::size_t count = next_.size(), edges = (3 * gone_.size() + count) / 2;
    return count >= 3 && within_.size() + count + gone_.size() == edges + 1 && isFan(tip) &&
           std::ranges::none_of(mesh_.creases, [&](const auto& c) {
             return within_.contains(c[0]) != within_.contains(c[1]);
           });
  }

  // Does a fan from the tip to the hole's sides go round once, and lie as the surface does?
  bool isFan(const Tip& tip) {
    std::size_t steps = 0;
    widest_ = 0.0;
    double turned = 0.0;
    std::uint32_t a = next_.begin()->first;
    do {
      const auto side = next_.find(a);
      if (side == next_.end() || ++steps > next_.size()) return false;
      const std::uint32_t b = side->second;
      const glm::dvec3 u = glm::dvec3(mesh_.positions[a]) - tip.at,
                       v = glm::dvec3(mesh_.positions[b]) - tip.at;
      const glm::dvec3 area = glm::cross(u, v);
      for (const std::uint32_t c : {a, b})
        if (!isNone(normals_[c]) && !isFacing(area, glm::dvec3(normals_[c]))) return false;
      const glm::dvec3 axis = glm::normalize(tip.axis);
      const auto flat = [&](const glm::dvec3& p) { return p - glm::dot(p, axis) * axis; };
      const double turn = std::atan2(glm::dot(area, axis), glm::dot(flat(u), flat(v)));
      if (!(turn > 0.0)) return false;
      turned += turn;
      widest_ = std::max(widest_, turn);
      a = b;
    } while (a != next_.begin()->first);
    return steps == next_.size() && std::abs(turned - 2.0 * std::numbers::pi) < 0.1;
  }

  // Would the fan cross what is around it?
  bool crosses(const Tip& tip) const {
    std::set<std::uint32_t> around, vertices;
    for (const auto& [a, b] : next_) vertices.insert(a);
    for (int ring = 0; ring < kRings; ++ring) {
      for (const std::uint32_t v : vertices)
        if (const auto fan = fans_.find(v); fan != fans_.end())
          std::ranges::copy_if(fan->second, std::inserter(around, around.end()),
                               [&](std::uint32_t t) { return !isGone(mesh_.triangles[t]); });
      for (const std::uint32_t t : around)
        for (int k = 0; k < 3; ++k) vertices.insert(mesh_.triangles[t][k]);
    }
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::map<std::uint32_t, std::uint32_t> number;
    const auto add = [&](const glm::uvec3& t) {
      glm::uvec3& copy = triangles.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const auto [at, fresh] = number.try_emplace(t[k], static_cast<std::uint32_t>(positions.size()));
        if (fresh) positions.push_back(t[k] == tip.vertex ? glm::vec3(tip.at) : mesh_.positions[t[k]]);
        copy[k] = at->second;
      }
    };
    for (const auto& [a, b] : next_) add({a, b, tip.vertex});
    const auto fan = static_cast<std::uint32_t>(triangles.size());
    for (const std::uint32_t t : around)
      if (!std::ranges::binary_search(gone_, t)) add(mesh_.triangles[t]);
    return std::ranges::any_of(crossingTriangles(positions, triangles),
                               [&](const auto& pair) { return std::min(pair[0], pair[1]) < fan; });
  }

  void close(const Tip& tip) {
    mesh_.positions[tip.vertex] = glm::vec3(tip.at);
    normals_[tip.vertex] = glm::vec3(0.0f);
    mesh_.tips.resize(mesh_.positions.size(), 0);
    mesh_.tips[tip.vertex] = 1;
    for (const std::uint32_t t : gone_) mesh_.triangles[t] = glm::uvec3(0);
    for (const auto& [a, b] : next_) {
      mesh_.triangles.push_back({a, b, tip.vertex});
      fixed_[a] = 1;
    }
    for (const std::uint32_t v : within_) fixed_[v] = 1;
    std::erase_if(mesh_.creases, [&](const auto& c) { return within_.contains(c[0]); });
  }

  FeatureMesh& mesh_;
  std::vector<glm::vec3>& normals_;
  std::vector<char> fixed_;  // vertices that fans have been put around
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> fans_;
  // What is looked at:
  std::vector<std::uint32_t> gone_;
  std::map<std::uint32_t, std::uint32_t> next_;  // along the hole's sides
  std::set<std::uint32_t> within_;               // vertices that are not on these
  double widest_ = 0.0;                          // turn of a triangle of the fan
};

}  // namespace

void placeTips(FeatureMesh& mesh, std::vector<glm::vec3>& normals, std::vector<std::uint32_t>& doubtful,
               const LocalField& field, Progress& progress) {
  Finder finder(mesh, normals, field);
  std::vector<Tip> tips = finder.run();
  forEachRun(
      tips.size(), [&](std::size_t i) { return glm::vec3(tips[i].at); }, field, progress,
      [&](const PointRun& run) {
        for (std::size_t i = 0; i < run.count; ++i) {
          Tip& tip = tips[run.first + i];
          tip.found = Approach(run, tip).run();
        }
      });
  std::erase_if(tips, [](const Tip& t) { return !t.found; });
  if (tips.empty()) return;
  std::ranges::sort(tips, {}, &Tip::far);
  Crowner crowner(mesh, normals, finder.vertices());
  const auto locals = field.finder();
  for (const Tip& tip : tips) crowner.crown(tip, locals->at(glm::vec3(tip.at)).voxel);
  std::erase_if(mesh.triangles, isGone);
  dropSwallowed(mesh, findIslands(mesh.positions, mesh.triangles));
  const std::vector<std::uint32_t> place = dropUnused(mesh, &normals);
  for (std::uint32_t& v : doubtful) v = place[v];
  std::erase(doubtful, Collapses::kNone);
}

}  // namespace sdf
