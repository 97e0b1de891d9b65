#include "sdf/mesh/refine/coarsen.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/refine/crowded.h"
#include "sdf/mesh/refine/sampled_mesh.h"
#include "sdf/mesh/refine/tints.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/mesh/surface/surface_paint.h"
#include "sdf/mesh/surface/surface_points.h"
#include "sdf/triangles/tree.h"

namespace sdf {
namespace {

using Index = HalfEdgeMesh::Index;

// An arc is as far from its chord as this share of the way from the one end to the tangent at the other.
constexpr float kArc = 0.25f;
// How far colours may come to be off: the rest is for what lies between vertices.
constexpr float kBlur = 0.75f * kColorTolerance;
// Twice a triangle's area over its longest side's square: none becomes slimmer.
constexpr float kSlimmest = 0.1f;
// Sheets that are nearer than so many times what they may come to be off, and an edge, are left as they are,
// with all their triangles: larger ones may reach into the other sheet.
constexpr float kApart = 4.0f;
// Rings of vertices around a tip that stay: however small they are normals turn as much along them.
constexpr int kTipRings = 3;
// Stars grow no larger: what follows looks at all of a star at once.
constexpr int kMostAround = 12;
// The edges that are collapsed first, times the mean; and how many times as long ones the next pass takes.
// Two passes that take out less than this share of the triangles are the last.
constexpr float kFirstEdges = 1.5f, kLonger = 1.4f;
constexpr std::size_t kFewGone = 30;

// What the surface is like at a triangle's corner, as seen from the triangle.
struct Corner {
  glm::vec3 normal;
  CornerColor color;
};

CornerColor mixed(const CornerColor& a, const CornerColor& b, const CornerColor& c,
                  const glm::vec3& weights) {
  return {weights.x * a.color + weights.y * b.color + weights.z * c.color,
          weights.x * a.ambient + weights.y * b.ambient + weights.z * c.ambient};
}

float difference(const CornerColor& a, const CornerColor& b) {
  return colorDifference({a.color, a.ambient}, {b.color, b.ambient});
}

// By half-edge, of its first vertex. At a crease either side has its own, which is read in the triangle.
std::vector<Corner> readCorners(const HalfEdgeMesh& mesh, const LocalField& field, bool painted,
                                const std::vector<glm::vec3>& normals, Progress& progress) {
  std::vector<glm::vec3> middles, sides;
  std::vector<Index> of;
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    if (mesh.creasesAt(mesh.from(h)) == 0) continue;
    const auto [a, b, c] = mesh.corners(h - h % 3);
    middles.push_back((a + b + c) / 3.0f), of.push_back(h);
  }
  gradientNormals(middles, field, progress, sides);
  std::vector<Paint> paint(normals.size()), paintBeside(of.size());
  if (painted) {
    paint = readPaintBeside(mesh.positions, field, progress);
    paintBeside = readPaintBeside(middles, field, progress);
  }
  std::vector<Corner> corners;
  corners.reserve(mesh.halfEdges());
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    const Index v = mesh.from(h);
    corners.push_back({normals[v], {paint[v].color, paint[v].ambient}});
  }
  for (std::size_t i = 0; i < of.size(); ++i)
    corners[of[i]] = {sides[i], {paintBeside[i].color, paintBeside[i].ambient}};
  return corners;
}

class Coarsener {
 public:
  Coarsener(const FeatureMesh& mesh, const LocalField& field, const CoarsenOptions& options,
            Progress& progress)
      : mesh_(mesh),
        limit_(static_cast<float>(options.off)),
        painted_(options.painted),
        progress_(progress),
        blurs_(mesh.triangles.size(), 0.0f),
        bends_(mesh_.halfEdges(), 0.0f) {
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
    std::vector<float> distances(mesh.positions.size());
    forEachGradient(mesh.positions, field, progress,
                    [&](std::size_t v, const RunGradients& g, std::size_t i) {
                      normals[v] = g.normal(i, normals[v]), distances[v] = g.distance(i);
                    });
    edge_ = meanEdge();
    stays_.assign(mesh_.vertices(), 0);
    const std::vector<char> crowded = crowdedVertices(mesh_, normals, edge_ + kApart * limit_);
    for (Index v = 0; v < mesh_.vertices(); ++v)
      if (crowded[v]) keepAround(v, 1);
    for (Index v = 0; v < mesh.tips.size(); ++v)
      if (mesh.tips[v]) keepAround(v, kTipRings);
    for (Index v = 0; v < mesh_.vertices(); ++v)
      if (std::abs(distances[v]) > limit_) keepAround(v, kTipRings);
    corners_ = readCorners(mesh_, field, painted_, normals, progress);
  }

  FeatureMesh run() {
    float longest = kFirstEdges * edge_;
    for (int last = 0; last < 2 && !progress_.stopped(); longest *= kLonger) {
      const std::size_t before = mesh_.liveTriangles();
      for (Index h = 0; h < mesh_.halfEdges(); ++h)
        if (mesh_.alive(h)) tryCollapse(h, longest * longest);
      last = (before - mesh_.liveTriangles()) * kFewGone < before ? last + 1 : 0;
    }
    return mesh_.compacted();
  }

 private:
  // What a vertex that goes is next to then.
  struct Left {
    float distance = HUGE_VALF;
    CornerColor color{};
  };

  void keepAround(Index v, int rings) {
    stays_[v] = 1;
    Index e = mesh_.outgoing(v);
    do {
      if (rings > 1) keepAround(mesh_.to(e), rings - 1);
      stays_[mesh_.to(e)] = 1;
      e = mesh_.turned(e);
    } while (e != mesh_.outgoing(v));
  }

  float meanEdge() const {
    double sum = 0.0;
    for (Index h = 0; h < mesh_.halfEdges(); ++h) sum += glm::length(along(h));
    return static_cast<float>(sum / mesh_.halfEdges());
  }
  glm::vec3 along(Index h) const { return mesh_.positions[mesh_.to(h)] - mesh_.positions[mesh_.from(h)]; }

  // Merges from(h) into to(h), if that is allowed.
  void tryCollapse(Index h, float longestSquare) {
    const Index u = mesh_.from(h), v = mesh_.to(h);
    if (stays_[u]) return;
    const int creases = mesh_.creasesAt(u);
    if (creases != 0 && (creases != 2 || !mesh_.isCrease(h))) return;
    const glm::vec3 way = along(h);
    if (glm::dot(way, way) > longestSquare || !isFlat(way, corners_[h], merged(h))) return;
    const float bend = creases == 2 ? bendWithout(h) : 0.0f;
    if (bend > limit_ || spokesAt(u) + spokesAt(v) - 4 > kMostAround) return;
    Left left;
    const bool sound = everyCorner(h, [&](Index e, const Corner& corner) {
      return e == h || mesh_.apex(e) == v || isSound(e, v, corner, left);
    });
    if (!sound || left.distance > limit_ || !mesh_.canCollapse(h)) return;
    if (painted_ && !addBlur(h, creases == 0 ? difference(corners_[h].color, left.color) : creaseColors(h)))
      return;
    everyCorner(h, [&](Index e, Corner corner) { return corners_[e] = corner, true; });
    merge(h, bend);
  }

  // How far colours that go are from what is left there adds up. Returns whether that is little.
  bool addBlur(Index h, float own) {
    float blur = 0.0f;
    everyCorner(h, [&](Index e, const Corner&) { return blur = std::max(blur, blurs_[e / 3]), true; });
    blur += own;
    if (blur > kBlur) return false;
    everyCorner(h, [&](Index e, const Corner&) { return blurs_[e / 3] = blur, true; });
    return true;
  }

  // What the corners at from(h) become once it is merged into to(h), of what is left of h.
  const Corner& merged(Index h) const { return corners_[HalfEdgeMesh::next(h)]; }

  // Calls of(e, corner) for the half-edges out of from(h), with what their corners become, until it returns
  // false. Did it never?
  template <class Of>
  bool everyCorner(Index h, const Of& of) const {
    Corner corner = merged(h);
    Index e = h;
    do {
      if (!of(e, corner)) return false;
      e = mesh_.turned(e);
      if (mesh_.isCrease(e)) corner = corners_[mesh_.twin(h)];
    } while (e != h);
    return true;
  }

  // By what there is at its ends: is the surface near an edge?
  bool isFlat(const glm::vec3& way, const Corner& a, const Corner& b) const {
    return kArc * std::max(std::abs(glm::dot(a.normal, way)), std::abs(glm::dot(b.normal, way))) <= limit_;
  }

  // Where from(h) is between its two neighbours on its crease, as a share of the way to to(h); and how far
  // beside.
  std::pair<float, float> placeOnCrease(Index h) const {
    const glm::vec3 d = -along(mesh_.otherOnCrease(h)), way = d + along(h);
    const float t = glm::dot(d, way) / glm::dot(way, way);
    return {t, glm::distance(d, t * way)};
  }
  // How far the crease's vertices are from the edge that merging from(h) into to(h) leaves: no normals tell
  // of it.
  float bendWithout(Index h) const {
    const auto [t, off] = placeOnCrease(h);
    return t > 0.0f && t < 1.0f ? std::max(bends_[h], bends_[mesh_.otherOnCrease(h)]) + off : HUGE_VALF;
  }
  void merge(Index h, float bend) {
    for (const Index side : {h, mesh_.twin(h)}) {  // what comes to lie on each other
      const Index n = mesh_.twin(HalfEdgeMesh::next(side)), p = mesh_.twin(HalfEdgeMesh::previous(side));
      bends_[n] = bends_[p] = std::max(bends_[n], bends_[p]);
    }
    const Index rest = mesh_.isCrease(h) ? mesh_.otherOnCrease(h) : h, back = mesh_.twin(rest);
    mesh_.collapse(h);
    for (const Index side : {rest, back})
      if (mesh_.alive(side)) bends_[side] = bends_[mesh_.twin(side)] = bend;
  }
  // How far the colours of a vertex on a crease, on either side, are from those that its neighbours make.
  float creaseColors(Index h) const {
    const Index e = mesh_.otherOnCrease(h), g = mesh_.twin(h);
    const float t = placeOnCrease(h).first;
    const auto off = [&](Index own, Index other, Index to) {
      return difference(corners_[own].color,
                        mixed(corners_[other].color, corners_[to].color, {}, {1.0f - t, t, 0.0f}));
    };
    return std::max(off(h, mesh_.twin(e), HalfEdgeMesh::next(h)),
                    off(HalfEdgeMesh::next(g), HalfEdgeMesh::next(e), g));
  }

  int spokesAt(Index v) const {
    int count = 0;
    Index e = mesh_.outgoing(v);
    do ++count, e = mesh_.turned(e);
    while (e != mesh_.outgoing(v));
    return count;
  }

  // Is e's triangle still one of the surface once from(e) is merged into v? Sees how near it is.
  bool isSound(Index e, Index v, const Corner& corner, Left& left) const {
    const glm::vec3 &was = mesh_.positions[mesh_.from(e)], &is = mesh_.positions[v],
                    &p = mesh_.positions[mesh_.to(e)], &q = mesh_.positions[mesh_.apex(e)];
    const glm::vec3 area = glm::cross(p - is, q - is), before = glm::cross(p - was, q - was);
    if (!isFacing(area, before / glm::length(before))) return false;
    const auto slimness = [&](const glm::vec3& n, const glm::vec3& tip) {
      return glm::length(n) /
             std::max({glm::dot(p - tip, p - tip), glm::dot(q - tip, q - tip), glm::dot(p - q, p - q)});
    };
    const float slim = slimness(area, is);
    if (slim < kSlimmest && slim < slimness(before, was)) return false;
    const Corner &atP = corners_[HalfEdgeMesh::next(e)], &atQ = corners_[HalfEdgeMesh::previous(e)];
    for (const Corner* c : {&corner, &atP, &atQ})
      if (!isFacing(area, c->normal)) return false;
    if (!isFlat(p - is, corner, atP) || !isFlat(q - is, corner, atQ)) return false;
    const auto distance = static_cast<float>(std::sqrt(nearestOf(was, is, p, q).squared));
    if (distance >= left.distance) return true;
    left.distance = distance;
    if (painted_)
      left.color = mixed(corner.color, atP.color, atQ.color, clampedWeights(over(was, {is, p, q}).weights));
    return true;
  }

  HalfEdgeMesh mesh_;
  float limit_, edge_ = 0.0f;  // what it may be off, and the mean of the edges at first
  bool painted_;
  Progress& progress_;
  std::vector<char> stays_;      // by vertex
  std::vector<Corner> corners_;  // by half-edge, of its first vertex
  std::vector<float> blurs_;     // by triangle: how far the colours that it stands for are from its own
  std::vector<float> bends_;     // by half-edge of a crease: how far what it stands for is from it
};

}  // namespace

void coarsen(FeatureMesh& mesh, const LocalField& field, const CoarsenOptions& options, Progress& progress) {
  mesh = Coarsener(mesh, field, options, progress).run();
}

}  // namespace sdf
