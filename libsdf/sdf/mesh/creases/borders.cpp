#include "sdf/mesh/creases/borders.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <unordered_map>

#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/edit/divide.h"
#include "sdf/mesh/edit/short_edges.h"
#include "sdf/mesh/surface/surface_paint.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

constexpr std::uint32_t kNoCrossing = ~0u;

// How far inside its corners and sides a triangle looks for its paint, as a share of the way to the centroid.
constexpr float kInto = 0.025f;
constexpr int kBorderHalvings = 7;
// Rounds in which triangles that a border does not cross straight are divided, and how far beside a straight
// cut's middle they are looked at, as a share of the way to the triangle's corner.
constexpr int kRefinements = 4;
constexpr float kBeside = 0.15f;
// No piece of an edge is shorter than this share of it.
constexpr float kShortest = 1.0f / 64;

using Edge = std::array<std::uint32_t, 2>;

Edge edgeOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Some way between points that look different, and the part of it where that changes most.
struct Search {
  std::uint32_t where;  // a triangle or an edge
  int side;             // of the triangle
  glm::vec3 from, to;
  Paint atFirst, atLast;
  float first = 0.0f, last = 1.0f;

  float middle() const { return 0.5f * (first + last); }
  void halve(const Paint& atMiddle) {
    const bool near = atFirst.material != atLast.material
                          ? atMiddle.material == atFirst.material
                          : colorDifference(atFirst, atMiddle) <= colorDifference(atMiddle, atLast);
    (near ? first : last) = middle();
    (near ? atFirst : atLast) = atMiddle;
  }
};

class BorderCutter {
 public:
  BorderCutter(FeatureMesh& mesh, const LocalField& field, Progress& progress)
      : mesh_(mesh), field_(field), progress_(progress) {}

  std::vector<glm::vec3> run() {
    readCorners();
    halveDoubtful();
    cutSides_.assign(mesh_.triangles.size(), {});
    whole_ = static_cast<std::uint32_t>(mesh_.positions.size());
    findCrossings();
    if (progress_.stopped()) return {};
    const std::vector<glm::uvec3> triangles = mesh_.triangles;
    const std::vector<Edge> creases = mesh_.creases;
    const std::vector<glm::vec3> positions = mesh_.positions;
    for (bool whole = false;; whole = true) {
      splitCreases();
      mesh_.triangles.clear(), mesh_.materials.clear(), paint_.clear(), middles_.clear();
      for (std::size_t t = 0; t < triangles.size(); ++t) cut(t, triangles[t]);
      if (!leaveOutWhatCrosses()) {
        if (whole) dropUnused(mesh_);
        break;
      }
      mesh_.creases = creases, mesh_.positions = positions;
    }
    return addBorders();
  }

 private:
  const glm::vec3& position(std::size_t t, int k) const { return mesh_.positions[mesh_.triangles[t][k % 3]]; }
  // A point of a triangle, a little inside.
  glm::vec3 inside(std::size_t t, const glm::vec3& p) const {
    return glm::mix(p, (position(t, 0) + position(t, 1) + position(t, 2)) / 3.0f, kInto);
  }

  std::vector<std::uint32_t> allTriangles() const {
    std::vector<std::uint32_t> all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  // Reads the paint at the corners of the triangles that have none yet, which are the last ones.
  void readCorners() {
    std::vector<glm::vec3> points;
    for (std::size_t t = corners_.size() / 3; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) points.push_back(inside(t, position(t, k)));
    const std::vector<Paint> paint = readPaintBeside(points, field_, progress_);
    corners_.insert(corners_.end(), paint.begin(), paint.end());
  }

  void readEnds(std::vector<Search>& searches) const {
    std::vector<glm::vec3> points;
    for (const Search& s : searches) points.push_back(s.from), points.push_back(s.to);
    const std::vector<Paint> ends = readPaintBeside(points, field_, progress_);
    for (std::size_t s = 0; s < searches.size(); ++s)
      searches[s].atFirst = ends[2 * s], searches[s].atLast = ends[2 * s + 1];
  }

  // Leaves those that end at a border: what has become alike only changes fast.
  void halve(std::vector<Search>& searches) const {
    std::vector<glm::vec3> points(searches.size());
    for (int i = 0; i < kBorderHalvings; ++i) {
      std::ranges::transform(searches, points.begin(),
                             [](const Search& s) { return glm::mix(s.from, s.to, s.middle()); });
      const std::vector<Paint> paint = readPaintBeside(points, field_, progress_);
      for (std::size_t s = 0; s < searches.size(); ++s) searches[s].halve(paint[s]);
    }
    std::erase_if(searches, [](const Search& s) { return !differ(s.atFirst, s.atLast); });
  }

  // Where borders cross sides of these triangles, in their order; a border that ends in a triangle, and so
  // crosses one side, is left out.
  std::vector<Search> crossingsOf(const std::vector<std::uint32_t>& triangles) const {
    std::vector<Search> searches;
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) {
        const Paint &a = corners_[3 * t + k], &b = corners_[3 * t + (k + 1) % 3];
        if (differ(a, b))
          searches.push_back({t, k, inside(t, position(t, k)), inside(t, position(t, k + 1)), a, b});
      }
    halve(searches);
    const auto alone = [&](std::size_t s) {
      return (s == 0 || searches[s - 1].where != searches[s].where) &&
             (s + 1 == searches.size() || searches[s + 1].where != searches[s].where);
    };
    std::vector<Search> kept;
    for (std::size_t s = 0; s < searches.size(); ++s)
      if (!alone(s)) kept.push_back(searches[s]);
    return kept;
  }

  // Two crossings of a triangle tell where the border goes on to its sides.
  void findCrossings() {
    const std::vector<Search> crossings = crossingsOf(allTriangles());
    for (std::size_t s = 0, end = 0; s < crossings.size(); s = end) {
      while (end < crossings.size() && crossings[end].where == crossings[s].where) ++end;
      const bool two = end == s + 2;
      for (std::size_t i = s; i < end; ++i)
        addCrossing(crossings[i],
                    two ? shareOnSide(crossings[i], crossings[2 * s + 1 - i]) : crossings[i].middle());
    }
  }

  // Searches look a little inside. Where the line through two crossings meets the side of the first one, as a
  // share of that side.
  static float shareOnSide(const Search& a, const Search& b) {
    // Shares are those of the triangle's corners; what is inside has a third of kInto of each at least.
    constexpr float kLeast = kInto / 3.0f, kAlong = 1.0f - kInto;
    const auto weights = [&](const Search& s) {
      glm::vec3 w(kLeast);
      w[s.side] += kAlong * (1.0f - s.middle());
      w[(s.side + 1) % 3] += kAlong * s.middle();
      return w;
    };
    const int opposite = (a.side + 2) % 3;
    const glm::vec3 first = weights(a), second = weights(b), way = first - second;
    if (way[opposite] == 0.0f) return a.middle();
    return (first - way * (first[opposite] / way[opposite]))[(a.side + 1) % 3];
  }

  // Triangles that a border does not cross straight: it has a corner in them, or others meet it there.
  std::vector<std::uint32_t> doubtfulOf(const std::vector<std::uint32_t>& triangles) const {
    const std::vector<Search> crossings = crossingsOf(triangles);
    struct Chord {
      std::uint32_t triangle;
      Paint sides[2];  // expected
    };
    std::vector<std::uint32_t> doubtful;
    std::vector<Chord> chords;
    std::vector<glm::vec3> points;
    for (std::size_t s = 0; s + 1 < crossings.size();) {
      const Search &a = crossings[s], &b = crossings[s + 1];
      if (s + 2 < crossings.size() && crossings[s + 2].where == a.where) {
        doubtful.push_back(a.where);  // three paints meet
        s += 3;
        continue;
      }
      // The corner that both sides share, and the middle of the side across.
      const int corner = b.side == a.side + 1 ? b.side : a.side;
      const glm::vec3 middle =
          0.5f * (glm::mix(a.from, a.to, a.middle()) + glm::mix(b.from, b.to, b.middle()));
      points.push_back(glm::mix(middle, position(a.where, corner), kBeside));
      points.push_back(
          glm::mix(middle, 0.5f * (position(a.where, corner + 1) + position(a.where, corner + 2)), kBeside));
      chords.push_back({a.where, {corners_[3 * a.where + corner], corners_[3 * a.where + (corner + 1) % 3]}});
      s += 2;
    }
    const std::vector<Paint> paint = readPaintBeside(points, field_, progress_);
    for (std::size_t i = 0; i < chords.size(); ++i)
      if (differ(paint[2 * i], chords[i].sides[0]) || differ(paint[2 * i + 1], chords[i].sides[1]))
        doubtful.push_back(chords[i].triangle);
    return doubtful;
  }

  // Halves the sides of such triangles, so that what a straight cut gets wrong becomes small.
  void halveDoubtful() {
    std::vector<std::uint32_t> fresh = allTriangles();
    for (int round = 0; round < kRefinements && !progress_.stopped(); ++round) {
      const std::vector<std::uint32_t> doubtful = doubtfulOf(fresh);
      if (doubtful.empty()) return;
      for (const std::uint32_t t : doubtful)
        for (int k = 0; k < 3; ++k) halveEdge(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
      splitCreases();
      std::ranges::sort(mesh_.creases);
      const std::size_t kept = divideHalved();
      readCorners();
      fresh.clear();
      for (std::size_t t = kept; t < mesh_.triangles.size(); ++t)
        fresh.push_back(static_cast<std::uint32_t>(t));
      crossings_.clear();
    }
  }

  void halveEdge(std::uint32_t a, std::uint32_t b) {
    const auto middle = static_cast<std::uint32_t>(mesh_.positions.size());
    if (crossings_.try_emplace(edgeKey(a, b), middle).second)
      mesh_.positions.push_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
  }

  // Puts the pieces of the triangles with halved sides behind the others, and returns how many these are.
  std::size_t divideHalved() {
    std::vector<glm::uvec3> pieces;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const glm::uvec3 t = mesh_.triangles[i];
      const std::array<std::uint32_t, 3> x{crossingAt(t.x, t.y), crossingAt(t.y, t.z), crossingAt(t.z, t.x)};
      if (x[0] != kNoCrossing || x[1] != kNoCrossing || x[2] != kNoCrossing) {
        divide(t, x, pieces);
        continue;
      }
      mesh_.triangles[kept] = t;
      std::copy_n(&corners_[3 * i], 3, &corners_[3 * kept]);
      ++kept;
    }
    mesh_.triangles.resize(kept);
    corners_.resize(3 * kept);
    mesh_.triangles.insert(mesh_.triangles.end(), pieces.begin(), pieces.end());
    return kept;
  }

  // The first of an edge's two triangles decides where.
  void addCrossing(const Search& s, float share) {
    cutSides_[s.where][s.side] = true;
    const glm::uvec3& t = mesh_.triangles[s.where];
    const std::uint32_t a = t[s.side], b = t[(s.side + 1) % 3];
    const auto [it, fresh] =
        crossings_.try_emplace(edgeKey(a, b), static_cast<std::uint32_t>(mesh_.positions.size()));
    if (fresh)
      mesh_.positions.push_back(
          glm::mix(mesh_.positions[a], mesh_.positions[b], std::clamp(share, kShortest, 1.0f - kShortest)));
  }

  // Pieces that are too thin for floats may cross: then the edges that end in one stay whole. Returns whether
  // there are any that were cut.
  bool leaveOutWhatCrosses() {
    const auto all = allTriangles();
    std::vector<char> asked(all.size(), 0);
    for (std::size_t t = 0; t < asked.size(); ++t) {
      const glm::uvec3& v = mesh_.triangles[t];
      asked[t] = std::max({v.x, v.y, v.z}) >= whole_;
    }
    std::vector<char> leave(mesh_.positions.size(), 0);
    for (const auto& pair : crossingTriangles(mesh_.positions, mesh_.triangles, all, asked))
      for (const std::uint32_t t : pair)
        for (int k = 0; k < 3; ++k) leaveOut(mesh_.triangles[t][k], leave);
    return std::erase_if(crossings_, [&](const auto& entry) { return leave[entry.second] != 0; }) > 0;
  }
  // The middle of three crossings stands for them.
  void leaveOut(std::uint32_t v, std::vector<char>& leave) const {
    leave[v] = 1;
    if (const auto it = middles_.find(v); it != middles_.end())
      for (const std::uint32_t x : it->second) leave[x] = 1;
  }

  std::uint32_t crossingAt(std::uint32_t a, std::uint32_t b) const {
    const auto it = crossings_.find(edgeKey(a, b));
    return it == crossings_.end() ? kNoCrossing : it->second;
  }

  void splitCreases() {
    std::vector<Edge> pieces;
    for (const auto& [a, b] : mesh_.creases)
      if (const std::uint32_t m = crossingAt(a, b); m != kNoCrossing)
        pieces.push_back({a, m}), pieces.push_back({b, m});
      else
        pieces.push_back({a, b});
    mesh_.creases = std::move(pieces);
  }

  void add(const glm::uvec3& triangle, const Paint& paint) {
    mesh_.triangles.push_back(triangle);
    mesh_.materials.push_back(paint.material);
    paint_.push_back(paint);
  }

  // A polygon as a fan of triangles around its last vertex at an odd place: these lie in sides of a triangle,
  // the others may lie beside them in the same side.
  void addPolygon(const std::array<std::uint32_t, 6>& around, const Paint& paint) {
    std::uint32_t corners[6];
    std::size_t n = 0, apex = 0;
    for (int i = 0; i < 6; ++i) {
      if (around[i] == kNoCrossing) continue;
      if (i % 2 == 1) apex = n;
      corners[n++] = around[i];
    }
    for (std::size_t i = 1; i + 1 < n; ++i)
      add({corners[apex], corners[(apex + i) % n], corners[(apex + i + 1) % n]}, paint);
  }

  void cut(std::size_t number, const glm::uvec3& t) {
    const Paint* paint = &corners_[3 * number];
    const std::array<std::uint32_t, 3> x{crossingAt(t.x, t.y), crossingAt(t.y, t.z), crossingAt(t.z, t.x)};
    std::array<bool, 3> sides = cutSides_[number];
    for (int k = 0; k < 3; ++k) sides[k] = sides[k] && x[k] != kNoCrossing;
    const int cuts = sides[0] + sides[1] + sides[2];
    if (cuts < 2) return addPolygon({t.x, x[0], t.y, x[1], t.z, x[2]}, paint[0]);
    if (cuts == 3) {
      const auto middle = static_cast<std::uint32_t>(mesh_.positions.size());
      middles_[middle] = x;
      mesh_.positions.push_back((mesh_.positions[x[0]] + mesh_.positions[x[1]] + mesh_.positions[x[2]]) /
                                3.0f);
      for (int k = 0; k < 3; ++k) {
        add({t[k], x[k], middle}, paint[k]);
        add({x[k], t[(k + 1) % 3], middle}, paint[(k + 1) % 3]);
        mesh_.creases.push_back({x[k], middle});
      }
      return;
    }
    int k = 0;  // the corner whose sides are cut
    while (!sides[k] || !sides[(k + 2) % 3]) ++k;
    const std::uint32_t after = x[k], across = x[(k + 1) % 3], before = x[(k + 2) % 3];
    add({t[k], after, before}, paint[k]);
    addPolygon({before, after, t[(k + 1) % 3], across, t[(k + 2) % 3], kNoCrossing}, paint[(k + 1) % 3]);
    mesh_.creases.push_back({after, before});
  }

  // What differs on both sides of an edge. Returns the vertices of such edges.
  std::vector<glm::vec3> addBorders() {
    struct Side {
      Edge edge;
      std::uint32_t triangle;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        sides.push_back({edgeOf(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]), t});
    std::ranges::sort(sides);
    std::vector<Search> searches;
    std::vector<Edge> edges, borders;
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
      const auto& [edge, s] = sides[i];
      const std::uint32_t t = sides[i + 1].triangle;
      if (!differ(paint_[s], paint_[t])) continue;
      // At a crossing a border is certain; elsewhere a colour may only change fast.
      if (paint_[s].material != paint_[t].material || edge[1] >= whole_) {
        borders.push_back(edge);
      } else {
        const glm::vec3 middle = 0.5f * (mesh_.positions[edge[0]] + mesh_.positions[edge[1]]);
        searches.push_back(
            {static_cast<std::uint32_t>(edges.size()), 0, inside(s, middle), inside(t, middle), {}, {}});
        edges.push_back(edge);
      }
    }
    readEnds(searches);
    halve(searches);
    for (const Search& s : searches) borders.push_back(edges[s.where]);
    mesh_.creases.insert(mesh_.creases.end(), borders.begin(), borders.end());
    for (Edge& c : mesh_.creases) c = edgeOf(c[0], c[1]);
    std::ranges::sort(mesh_.creases);
    mesh_.creases.erase(std::unique(mesh_.creases.begin(), mesh_.creases.end()), mesh_.creases.end());
    return endsOf(borders);
  }

  std::vector<glm::vec3> endsOf(const std::vector<Edge>& edges) const {
    std::vector<char> isEnd(mesh_.positions.size(), 0);
    for (const auto& [a, b] : edges) isEnd[a] = isEnd[b] = 1;
    std::vector<glm::vec3> ends;
    for (std::size_t v = 0; v < isEnd.size(); ++v)
      if (isEnd[v]) ends.push_back(mesh_.positions[v]);
    return ends;
  }

  FeatureMesh& mesh_;
  const LocalField& field_;
  Progress& progress_;
  std::uint32_t whole_ = 0;     // vertices that were there
  std::vector<Paint> corners_;  // of each triangle's three, inside
  std::vector<std::array<bool, 3>> cutSides_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;               // by edge: the vertex in it
  std::unordered_map<std::uint32_t, std::array<std::uint32_t, 3>> middles_;  // of three crossings
  std::vector<Paint> paint_;  // of each triangle of the new mesh
};

}  // namespace

std::vector<glm::vec3> cutAtBorders(FeatureMesh& mesh, const LocalField& field, Progress& progress) {
  return BorderCutter(mesh, field, progress).run();
}

}  // namespace sdf
