#include "sdf/mesh/edit/short_edges.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "sdf/mesh/edit/indices-inl.h"

namespace sdf {
namespace {

// Corners that are this share of the shortest edge apart are one.
constexpr double kSamePoint = 0.01;
// Cosine of what a triangle may turn away from its piece: 75 degrees, or what it was turned by before.
constexpr double kUpright = 0.25;
// Of its longest side, the height of a triangle that points anywhere.
constexpr double kNeedle = 1e-3;
constexpr int kPasses = 4;

class Collapser {
 public:
  Collapser(FeatureMesh& mesh, const std::vector<glm::vec3>& normals,
            const std::vector<std::uint32_t>& anchors, double shortest)
      : mesh_(mesh), normals_(normals), shortest_(shortest), fanOf_(mesh.positions.size(), 0) {
    list();
    for (const std::uint32_t v : anchors) fan(v).anchored = true;
    for (const auto& [a, b] : mesh_.creases) fan(a).creases.push_back(b), fan(b).creases.push_back(a);
  }

  Collapses run() {
    std::vector<Edge> edges;
    for (int pass = 0; pass < kPasses; ++pass) {
      edges = shortEdges();
      collapseAll(edges, false);
      edges = edgesAtTurned();
      if (edges.empty()) break;
      collapseAll(edges, true);
      for (const Edge& e : edges) tryFlip(e.gone, e.kept);
    }
    // What the last changes have made, or made room for.
    edges = shortEdges();
    collapseAll(edges, false);
    putBack();
    return std::move(done_);
  }

 private:
  template <int n>
  using Few = boost::container::small_vector<std::uint32_t, n>;

  struct Fan {
    std::uint32_t vertex = ~0u;
    Few<10> triangles{};
    Few<3> creases{};  // neighbours
    bool anchored = false;
    bool whole = false;  // all its triangles are listed
  };

  struct Edge {
    double length;
    std::uint32_t gone, kept;
    bool operator<(const Edge& o) const {
      return std::tie(length, gone, kept) < std::tie(o.length, o.gone, o.kept);
    }
  };

  // A triangle near a crease.
  struct Local {
    glm::uvec3 corners;
    glm::vec3 normal;     // of its piece
    std::uint32_t place;  // in the mesh
  };

  // The numbers of the triangles that hold a condition, in their order.
  template <class Condition>
  std::vector<std::uint32_t> trianglesThat(const Condition& holds) const {
    return indicesThat(mesh_.triangles.size(), [&](std::uint32_t t) { return holds(mesh_.triangles[t]); });
  }

  // Lists the triangles at creases, those that are turned, and those that touch them.
  void list() {
    enum : char { kFar, kNear, kMiddle };
    std::vector<char> marks(mesh_.positions.size(), kFar);
    const auto touches = [&](const glm::uvec3& t, char mark) {
      return marks[t.x] >= mark || marks[t.y] >= mark || marks[t.z] >= mark;
    };
    const auto mark = [&](std::uint32_t v, char mark) { marks[v] = std::max(marks[v], mark); };
    // That of a vertex that has one: it is on the triangle's piece.
    const auto pieceNormal = [&](const glm::uvec3& t) { return normals_[std::min({t.x, t.y, t.z})]; };
    for (const auto& [a, b] : mesh_.creases) mark(a, kMiddle), mark(b, kMiddle);
    for (const std::uint32_t t :
         trianglesThat([&](const glm::uvec3& c) { return isTurned(c, pieceNormal(c)); }))
      for (int k = 0; k < 3; ++k) mark(mesh_.triangles[t][k], kMiddle);
    for (const std::uint32_t t : trianglesThat([&](const glm::uvec3& c) { return touches(c, kMiddle); }))
      for (int k = 0; k < 3; ++k) mark(mesh_.triangles[t][k], kNear);
    fans_.resize(1);  // of all that is far
    for (const std::uint32_t t : trianglesThat([&](const glm::uvec3& c) { return touches(c, kNear); })) {
      const glm::uvec3& corners = mesh_.triangles[t];
      const auto local = static_cast<std::uint32_t>(triangles_.size());
      triangles_.push_back({corners, pieceNormal(corners), t});
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = corners[k];
        if (fanOf_[v] == 0) {
          fanOf_[v] = static_cast<std::uint32_t>(fans_.size());
          fans_.push_back({.vertex = v, .whole = marks[v] >= kNear});
        }
        fan(v).triangles.push_back(local);
      }
    }
  }

  Fan& fan(std::uint32_t v) { return fans_[fanOf_[v]]; }
  const Fan& fan(std::uint32_t v) const { return fans_[fanOf_[v]]; }

  std::vector<Edge> shortEdges() const {
    std::vector<Edge> edges;
    for (const Fan& fan : fans_) {
      if (fan.creases.empty()) continue;
      const std::uint32_t v = fan.vertex;
      for (const std::uint32_t t : fan.triangles)
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t w = triangles_[t].corners[k];
          if (w == v) continue;
          if (const double d = length(v, w); d < shortest_) edges.push_back({d, w, v});
        }
    }
    return edges;
  }

  // Those of the triangles around the corners of such as are turned.
  std::vector<Edge> edgesAtTurned() const {
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const glm::uvec3& c = triangles_[t].corners;
      if (isGone(c) || !isTurned(c, triangles_[t].normal)) continue;
      for (int k = 0; k < 3; ++k)
        for (const std::uint32_t other : neighbours(c[k])) {
          edges.push_back({length(c[k], other), c[k], other});
          edges.push_back({length(c[k], other), other, c[k]});
        }
    }
    return edges;
  }

  void collapseAll(std::vector<Edge>& edges, bool turned) {
    std::sort(edges.begin(), edges.end());
    const auto same = [](const Edge& a, const Edge& b) { return a.gone == b.gone && a.kept == b.kept; };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    for (const auto& [length, gone, kept] : edges)
      if (!fan(gone).triangles.empty() && !fan(kept).triangles.empty() && mayGo(gone, kept) &&
          (turned ? turnsBack(gone, kept) : staysUpright(gone, kept)) && linked(gone, kept))
        collapse(gone, kept);
  }

  // Are fewer triangles turned afterwards?
  bool turnsBack(std::uint32_t gone, std::uint32_t kept) const {
    int before = 0, after = 0;
    for (const std::uint32_t t : fan(gone).triangles) {
      const glm::vec3& normal = triangles_[t].normal;
      const bool was = isTurned(triangles_[t].corners, normal);
      const bool is = !contains(t, kept) && isTurned(moved(t, gone, kept), normal);
      before += was, after += is;
    }
    return after < before;
  }

  // Turns the edge between two triangles, one of which is turned over, if then neither is.
  void tryFlip(std::uint32_t a, std::uint32_t b) {
    if (!fan(a).whole || !fan(b).whole || has(fan(a).creases, b)) return;
    std::uint32_t sides[2];
    int count = 0;
    for (const std::uint32_t t : fan(a).triangles)
      if (contains(t, b)) {
        if (count == 2) return;
        sides[count++] = t;
      }
    if (count != 2 || std::min(upright(sides[0]), upright(sides[1])) >= kUpright) return;
    const std::uint32_t c = third(sides[0], a, b), d = third(sides[1], a, b);
    if (c == d || !fan(c).whole || !fan(d).whole || has(neighbours(c), d)) return;
    const glm::uvec3 old[2] = {triangles_[sides[0]].corners, triangles_[sides[1]].corners};
    // Each loses one end of the edge for the other's third vertex.
    replace(sides[0], b, d), replace(sides[1], a, c);
    if (std::min(upright(sides[0]), upright(sides[1])) >= kUpright) {
      done_.begin(Collapses::kNone);
      for (int k = 0; k < 2; ++k) done_.add(triangles_[sides[k]].place, old[k]);
      drop(fan(b).triangles, sides[0]), drop(fan(a).triangles, sides[1]);
      fan(d).triangles.push_back(sides[0]), fan(c).triangles.push_back(sides[1]);
      return;
    }
    triangles_[sides[0]].corners = old[0], triangles_[sides[1]].corners = old[1];
  }

  std::uint32_t third(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    const glm::uvec3& c = triangles_[t].corners;
    return c.x != a && c.x != b ? c.x : c.y != a && c.y != b ? c.y : c.z;
  }
  void replace(std::uint32_t t, std::uint32_t vertex, std::uint32_t by) {
    for (int k = 0; k < 3; ++k)
      if (triangles_[t].corners[k] == vertex) triangles_[t].corners[k] = by;
  }

  double length(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(mesh_.positions[a], mesh_.positions[b]);
  }
  static bool has(const auto& list, std::uint32_t v) {
    return std::find(list.begin(), list.end(), v) != list.end();
  }
  static void drop(auto& list, std::uint32_t v) {
    list.erase(std::remove(list.begin(), list.end(), v), list.end());
  }
  bool contains(std::uint32_t t, std::uint32_t v) const {
    const glm::uvec3& c = triangles_[t].corners;
    return c.x == v || c.y == v || c.z == v;
  }

  bool mayGo(std::uint32_t gone, std::uint32_t kept) const {
    const Fan& own = fan(gone);
    if (!own.whole || !fan(kept).whole) return false;
    if (own.creases.empty()) return true;
    if (length(gone, kept) < kSamePoint * shortest_) return !fan(kept).creases.empty();
    return has(own.creases, kept) && !own.anchored;
  }

  Few<24> neighbours(std::uint32_t v) const {
    Few<24> around;
    for (const std::uint32_t t : fan(v).triangles)
      for (int k = 0; k < 3; ++k)
        if (triangles_[t].corners[k] != v) around.push_back(triangles_[t].corners[k]);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
  }

  bool linked(std::uint32_t gone, std::uint32_t kept) const {
    const auto a = neighbours(gone), b = neighbours(kept);
    Few<24> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    return common.size() == 2 && std::binary_search(a.begin(), a.end(), kept);
  }

  // The cosine between a triangle and its piece, with one of its vertices elsewhere; -1 of a needle, and 1 of
  // one that will go with an edge of no length.
  double upright(const glm::uvec3& corners, const glm::vec3& normal) const {
    const glm::dvec3 p(mesh_.positions[corners.x]);
    const glm::dvec3 u = glm::dvec3(mesh_.positions[corners.y]) - p,
                     v = glm::dvec3(mesh_.positions[corners.z]) - p, w = v - u, area = glm::cross(u, v);
    const double size = glm::length(area),
                 longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
    const double least = kSamePoint * shortest_;
    if (std::min({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)}) < least * least) return 1.0;
    return size > kNeedle * longest ? glm::dot(area, glm::dvec3(normal)) / size : -1.0;
  }
  // Is a triangle far from turned, whatever floats round?
  bool clearlyUpright(const glm::uvec3& corners, const glm::vec3& normal) const {
    const glm::vec3 &a = mesh_.positions[corners.x], &b = mesh_.positions[corners.y],
                    &c = mesh_.positions[corners.z];
    const glm::vec3 u = b - a, v = c - a, w = c - b, area = glm::cross(u, v);
    const float size = glm::dot(area, area), turn = glm::dot(area, normal),
                longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
    constexpr float kClear = 0.5f, kFat = 0.01f;
    return turn > 0.0f && turn * turn > kClear * kClear * size && size > kFat * kFat * longest * longest;
  }
  bool isTurned(const glm::uvec3& corners, const glm::vec3& normal) const {
    return !clearlyUpright(corners, normal) && upright(corners, normal) < kUpright;
  }
  double upright(std::uint32_t t) const { return upright(triangles_[t].corners, triangles_[t].normal); }
  // The corners of a triangle with one of them elsewhere.
  glm::uvec3 moved(std::uint32_t t, std::uint32_t vertex, std::uint32_t elsewhere) const {
    glm::uvec3 corners = triangles_[t].corners;
    for (int k = 0; k < 3; ++k)
      if (corners[k] == vertex) corners[k] = elsewhere;
    return corners;
  }

  bool staysUpright(std::uint32_t gone, std::uint32_t kept) const {
    for (const std::uint32_t t : fan(gone).triangles) {
      if (contains(t, kept)) continue;
      const glm::uvec3 after = moved(t, gone, kept);
      const glm::vec3& normal = triangles_[t].normal;
      if (isTurned(after, normal) && upright(after, normal) < upright(t)) return false;
    }
    return true;
  }

  void collapse(std::uint32_t gone, std::uint32_t kept) {
    done_.begin(gone);
    for (const std::uint32_t t : fan(gone).triangles) {
      done_.add(triangles_[t].place, triangles_[t].corners);
      if (contains(t, kept)) {
        for (int k = 0; k < 3; ++k)
          if (triangles_[t].corners[k] != gone) drop(fan(triangles_[t].corners[k]).triangles, t);
        triangles_[t].corners = glm::uvec3(0u);
        continue;
      }
      replace(t, gone, kept);
      fan(kept).triangles.push_back(t);
    }
    for (const std::uint32_t other : fan(gone).creases) {
      auto& theirs = fan(other).creases;
      drop(theirs, gone);
      if (other == kept || has(theirs, kept)) continue;
      theirs.push_back(kept);
      fan(kept).creases.push_back(other);
    }
    fan(kept).anchored |= fan(gone).anchored;
    fan(gone) = {.vertex = gone, .whole = true};
  }

  void putBack() {
    for (const Local& t : triangles_) mesh_.triangles[t.place] = t.corners;
    mesh_.creases.clear();
    for (const Fan& fan : fans_)
      for (const std::uint32_t w : fan.creases)
        if (const std::uint32_t v = fan.vertex; v < w) mesh_.creases.push_back({v, w});
    std::ranges::sort(mesh_.creases);
  }

  FeatureMesh& mesh_;
  const std::vector<glm::vec3>& normals_;
  double shortest_;
  std::vector<Local> triangles_;
  std::vector<std::uint32_t> fanOf_;  // by vertex, its place in fans_
  std::vector<Fan> fans_;
  Collapses done_;
};

}  // namespace

Collapses collapseShortEdges(FeatureMesh& mesh, const std::vector<glm::vec3>& normals,
                             const std::vector<std::uint32_t>& anchors, double shortest) {
  return Collapser(mesh, normals, anchors, shortest).run();
}

}  // namespace sdf
