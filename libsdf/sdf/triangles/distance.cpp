#include "sdf/triangles/distance.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/base/disjoint_sets.h"
#include "sdf/base/flat_map.h"
#include "sdf/triangles/incidence.h"
#include "sdf/triangles/twofold.h"

namespace sdf {
namespace {

int cornerOf(Feature feature) { return (static_cast<int>(feature) - 1) % 3; }

std::pair<glm::dvec3, glm::dvec3> boxOf(const ClosedTriangles& all) {
  glm::dvec3 min(HUGE_VAL), max(-HUGE_VAL);
  for (const glm::uvec3& t : all.triangles)
    for (int k = 0; k < 3; ++k) {
      min = glm::min(min, glm::dvec3(all.points[t[k]]));
      max = glm::max(max, glm::dvec3(all.points[t[k]]));
    }
  return {min, max};
}

glm::dvec3 areaOf(const std::array<glm::dvec3, 3>& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); }

/// The distance, and the way to the point from the feature, of length 1; 0 where the point is on it.
std::pair<double, glm::dvec3> precise(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t,
                                      Feature feature) {
  if (feature == Feature::Face) {
    const TwofoldVec n = cross(twofoldDifference(t[1], t[0]), twofoldDifference(t[2], t[0]));
    const glm::dvec3 along = rounded(n);
    const double steep = glm::length(along), height = dot(n, twofoldDifference(p, t[0])).high / steep;
    return {std::abs(height), std::copysign(1.0, height) / steep * along};
  }
  const int k = cornerOf(feature);
  const TwofoldVec from = twofoldDifference(p, t[k]);
  glm::dvec3 way = rounded(from);
  double distance = glm::length(way);
  if (feature < Feature::Corner0) {
    const TwofoldVec edge = twofoldDifference(t[(k + 1) % 3], t[k]), across = cross(from, edge);
    const glm::dvec3 e = rounded(edge);
    distance = glm::length(rounded(across)) / glm::length(e);
    way = rounded(cross(edge, across));  // |e|^2 times the part of `from` that is across the edge
  }
  const double length = glm::length(way);
  return {distance, length > 0.0 ? way / length : glm::dvec3(0.0)};
}

}  // namespace

TriangleDistance::TriangleDistance(ClosedTriangles triangles)
    : triangles_(std::move(triangles)),
      min_(boxOf(triangles_).first),
      max_(boxOf(triangles_).second),
      tree_(triangles_.points, triangles_.triangles) {
  setNormals();
  const bool isSurface = triangles_.manifold && !tree_.crosses();
  if (isSurface && normalsTellSides()) signBy_ = SignBy::Normals;
  if (signBy_ == SignBy::Winding)
    setPatches(isSurface ? std::vector<char>(triangles_.triangles.size(), 0) : tree_.crossing());
}

std::array<glm::dvec3, 3> TriangleDistance::corners(std::uint32_t triangle) const {
  const glm::uvec3& t = triangles_.triangles[triangle];
  return {glm::dvec3(triangles_.points[t.x]), glm::dvec3(triangles_.points[t.y]),
          glm::dvec3(triangles_.points[t.z])};
}

void TriangleDistance::setNormals() {
  const std::vector<glm::uvec3>& all = triangles_.triangles;
  std::vector<glm::dvec3> atPoint(triangles_.points.size(), glm::dvec3(0.0));
  FlatMap<glm::dvec3> atEdge;
  const auto key = [&](std::uint32_t i, int k) { return edgeKey(all[i][k], all[i][(k + 1) % 3]); };
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const std::array<glm::dvec3, 3> t = corners(i);
    const glm::dvec3 area = areaOf(t);
    const double size = glm::length(area);
    if (!(size > 0.0)) continue;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 u = t[(k + 1) % 3] - t[k], v = t[(k + 2) % 3] - t[k];
      atPoint[all[i][k]] += std::atan2(size, glm::dot(u, v)) / size * area;
      atEdge.insert(key(i, k), glm::dvec3(0.0)).first += area / size;
    }
  }
  for (const glm::dvec3& n : atPoint) pointNormals_.emplace_back(n);
  for (std::uint32_t i = 0; i < all.size(); ++i)
    for (int k = 0; k < 3; ++k) edgeNormals_.emplace_back(atEdge.insert(key(i, k), glm::dvec3(0.0)).first);
}

std::vector<std::uint32_t> TriangleDistance::largestOfEach(
    std::size_t sets, const std::function<std::uint32_t(std::uint32_t)>& setOf) const {
  const auto count = static_cast<std::uint32_t>(triangles_.triangles.size());
  const auto sizeOf = [&](std::uint32_t i) { return glm::length(areaOf(corners(i))); };
  std::vector<std::uint32_t> largest(sets, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t& best = largest[setOf(i)];
    if (best == count || sizeOf(i) > sizeOf(best)) best = i;
  }
  return largest;
}

/// Is it outside of the solid on that side of each piece of the surface that its normals point to? So it is
/// not where a shell within a shell is turned the wrong way. Asked is beside one triangle of each piece.
bool TriangleDistance::normalsTellSides() const {
  const std::vector<glm::uvec3>& all = triangles_.triangles;
  const std::vector<std::uint32_t> pieces = piecesOf(all, triangles_.points.size());
  for (const std::uint32_t i :
       largestOfEach(pieces.size(), [&](std::uint32_t triangle) { return pieces[all[triangle].x]; }))
    if (i < all.size() && sidesOf(i) != std::array{false, true}) return false;
  return true;
}

void TriangleDistance::setPatches(const std::vector<char>& crossing) {
  const std::vector<glm::uvec3>& all = triangles_.triangles;
  const auto count = static_cast<std::uint32_t>(all.size());
  patches_.resize(count);
  DisjointSets sets(count);
  struct Edge {
    int triangles = 0;
    std::uint32_t first = 0, place = 0;  // of those that cross nothing; and which of its edges it is
  };
  FlatMap<Edge> edges;
  const auto edgeAt = [&](std::uint32_t i, int k) -> Edge& {
    return edges.insert(edgeKey(all[i][k], all[i][(k + 1) % 3]), Edge{0, count, 0}).first;
  };
  for (std::uint32_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) ++edgeAt(i, k).triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    patches_[i].known = crossing[i] == 0;
    for (int k = 0; patches_[i].known && k < 3; ++k) {
      Edge& edge = edgeAt(i, k);
      if (edge.triangles != 2) continue;
      if (edge.first == count) {
        edge.first = i, edge.place = static_cast<std::uint32_t>(k);
        continue;
      }
      sets.join(i, edge.first);
      patches_[i].joined |= 1u << k, patches_[edge.first].joined |= 1u << edge.place;
    }
  }
  for (const std::uint32_t i :
       largestOfEach(count, [&](std::uint32_t triangle) { return sets.of(triangle); }))
    if (i < count && patches_[i].known) patches_[sets.of(i)].inside = sidesOf(i);
  for (std::uint32_t i = 0; i < count; ++i) patches_[i].inside = patches_[sets.of(i)].inside;
}

std::optional<std::vector<glm::uvec3>> TriangleDistance::surface() const {
  if (signBy_ == SignBy::Normals) return triangles_.triangles;
  if (!std::ranges::all_of(patches_, &Patch::known)) return {};
  std::vector<glm::uvec3> all;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const auto [before, behind] = patches_[i].inside;
    const glm::uvec3& t = triangles_.triangles[i];
    if (before != behind) all.push_back(behind ? t : glm::uvec3(t.x, t.z, t.y));
  }
  return all;
}

std::array<bool, 2> TriangleDistance::sidesOf(std::uint32_t triangle) const {
  const std::array<glm::dvec3, 3> t = corners(triangle);
  const glm::dvec3 area = areaOf(t), middle = (t[0] + t[1] + t[2]) / 3.0;
  const glm::dvec3 off = 1e-6 * area / std::sqrt(glm::length(area));
  return {isWoundAround(middle + off), isWoundAround(middle - off)};
}

bool TriangleDistance::hasInside() const {
  if (signBy_ == SignBy::Normals) return true;
  constexpr std::size_t kMost = 20000;
  const std::size_t count = triangles_.triangles.size(), step = count / kMost + 1;
  for (std::size_t i = 0; i < count; i += step) {
    const auto [before, behind] = sidesOf(static_cast<std::uint32_t>(i));
    if (before || behind) return true;
  }
  return false;
}

bool TriangleDistance::isWoundAround(const glm::dvec3& p) const { return std::abs(tree_.winding(p)) > 0.5; }

glm::dvec3 TriangleDistance::pseudonormal(const NearestPoint& nearest) const {
  const std::uint32_t i = nearest.triangle;
  if (nearest.feature == Feature::Face) return areaOf(corners(i));
  const int k = cornerOf(nearest.feature);
  return glm::dvec3(nearest.feature < Feature::Corner0 ? edgeNormals_[3 * i + k]
                                                       : pointNormals_[triangles_.triangles[i][k]]);
}

bool TriangleDistance::isInside(const glm::dvec3& p, const NearestPoint& nearest,
                                const glm::dvec3& way) const {
  const auto isBehind = [&] { return glm::dot(pseudonormal(nearest), way) < 0.0; };
  if (signBy_ == SignBy::Normals) return isBehind();
  const Patch& patch = patches_[nearest.triangle];
  const bool isFace = nearest.feature == Feature::Face,
             isEdge = !isFace && nearest.feature < Feature::Corner0;
  const bool told =
      patch.known && (isFace || (isEdge && (patch.joined >> cornerOf(nearest.feature) & 1) != 0));
  return told ? patch.inside[isBehind() ? 1 : 0] : isWoundAround(p);
}

TriangleDistance::Read TriangleDistance::read(const glm::dvec3& p, std::uint32_t hint,
                                              std::optional<bool> known) const {
  const NearestPoint nearest = tree_.nearest(p, hint);
  auto [distance, way] = precise(p, corners(nearest.triangle), nearest.feature);
  const bool inside = distance > 0.0 && (known ? *known : isInside(p, nearest, way));
  if (way == glm::dvec3(0.0)) {  // on an edge or a corner
    const glm::dvec3 normal = pseudonormal(nearest);
    const double length = glm::length(normal);
    way = length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0);
    return {distance, way, nearest.triangle};
  }
  return {inside ? -distance : distance, inside ? -way : way, nearest.triangle};
}

TriangleDistance::Read DistanceAlong::operator()(const glm::dvec3& p) {
  constexpr double kSurely = 0.999;  // of the ball, for rounding
  std::optional<bool> inside;
  if (glm::distance(p, last_) < kSurely * std::abs(read_.distance)) inside = read_.distance < 0.0;
  read_ = distance_.read(p, read_.triangle, inside);
  last_ = p;
  return read_;
}

}  // namespace sdf
