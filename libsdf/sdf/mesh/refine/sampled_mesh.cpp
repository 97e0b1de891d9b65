#include "sdf/mesh/refine/sampled_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/mesh/surface/project.h"

namespace sdf {

namespace {

// The centroid, or the inner nodes of a grid that is no coarser than the spacing.
void addInside(const Corners& t, float spacing, std::vector<glm::vec3>& points) {
  const float longest =
      std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
  const int steps = std::max(3, static_cast<int>(std::ceil(longest / spacing)));
  for (int i = 1; i < steps; ++i)
    for (int k = 1; i + k < steps; ++k) {
      const float u = static_cast<float>(i) / static_cast<float>(steps),
                  v = static_cast<float>(k) / static_cast<float>(steps);
      points.push_back((1.0f - u - v) * t[0] + u * t[1] + v * t[2]);
    }
}

}  // namespace

// Those of a point of the triangle.
glm::vec3 clampedWeights(const glm::vec3& weights) {
  const glm::vec3 positive = glm::max(weights, 0.0f);
  return positive / (positive.x + positive.y + positive.z);
}

namespace {

float distanceToSides(const glm::vec3& p, const Corners& t) {
  float least = HUGE_VALF;
  for (int k = 0; k < 3; ++k) {
    const glm::vec3 side = t[k == 2 ? 0 : k + 1] - t[k], d = p - t[k];
    const float square = glm::dot(side, side),
                along = square > 0.0f ? std::clamp(glm::dot(d, side) / square, 0.0f, 1.0f) : 0.0f;
    const glm::vec3 off = d - along * side;
    least = std::min(least, glm::dot(off, off));
  }
  return std::sqrt(least);
}

}  // namespace

OverTriangle over(const glm::vec3& p, const Corners& t) {
  const glm::vec3 u = t[1] - t[0], v = t[2] - t[0], n = glm::cross(u, v), d = p - t[0];
  const float square = glm::dot(n, n), beta = glm::dot(glm::cross(d, v), n) / square,
              gamma = glm::dot(glm::cross(u, d), n) / square,
              inside = std::min({1.0f - beta - gamma, beta, gamma});
  const glm::vec3 weights(1.0f - beta - gamma, beta, gamma);
  if (inside >= 0.0f) return {inside, std::abs(glm::dot(d, n)) / std::sqrt(square), weights};
  return {inside, distanceToSides(p, t), weights};
}

SampledMesh::SampledMesh(const FeatureMesh& given, const LocalField& field, float spacing, Progress& progress)
    : mesh(given), creaseOf(mesh.halfEdges(), kNone) {
  std::vector<char> onCreases(given.positions.size(), 0);
  for (const auto& [a, b] : given.creases) onCreases[a] = onCreases[b] = 1;
  std::vector<glm::vec3> points = given.positions, unit;
  std::vector<Index> triangleOf(points.size(), kNone);
  for (Index v = 0; v < mesh.vertices(); ++v)
    if (!onCreases[v] && mesh.vertexAlive(v)) triangleOf[v] = mesh.outgoing(v) / 3;
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    if (h % 3 == 0) {
      addInside(mesh.corners(h), spacing, points);
      triangleOf.resize(points.size(), h / 3);
    }
    if (h > mesh.twin(h) || mesh.isCrease(h)) continue;
    points.push_back(0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]));
    triangleOf.push_back(h / 3);
  }
  refineVertices(points, unit, field, progress);
  for (std::size_t i = 0; i < points.size(); ++i)
    samples.push_back({i < given.positions.size() ? given.positions[i] : points[i], unit[i]});
  normals.assign(unit.begin(), unit.begin() + static_cast<std::ptrdiff_t>(given.positions.size()));
  onTriangle.grow(given.triangles.size(), samples.size());
  for (Index i = 0; i < samples.size(); ++i)
    if (triangleOf[i] != kNone) put(triangleOf[i], i);
  addCreases(given);
}

void SampledMesh::addCreases(const FeatureMesh& given) {
  Index count = 0;
  for (Index h = 0; h < mesh.halfEdges(); ++h)
    if (mesh.isCrease(h) && creaseOf[h] == kNone) creaseOf[h] = creaseOf[mesh.twin(h)] = count++;
  onCrease.grow(count, samples.size());
  std::vector<char> taken(given.positions.size(), 0);
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    const Index v = mesh.from(h);
    if (creaseOf[h] == kNone || taken[v]) continue;
    taken[v] = 1;
    onCrease.add(creaseOf[h], v);
  }
}

SampledMesh::Farthest SampledMesh::farthestOf(Index triangle) const {
  const Corners corners = mesh.corners(3 * triangle);
  const Tint* tint = tints.any() ? &tints.corners[3 * triangle] : nullptr;
  Farthest farthest;
  for (Index w = onTriangle.first(triangle); w != Lists::kNone; w = onTriangle.after(w)) {
    const OverTriangle o = over(samples[w].at, corners);
    const float d =
        tint ? std::max(o.distance,
                        tints.distance(w, mixed(tint[0], tint[1], tint[2], clampedWeights(o.weights))))
             : o.distance;
    if (farthest.sample == kNone || d > farthest.distance) farthest = {w, d};
  }
  return farthest;
}

glm::vec3 SampledMesh::meanNormal(std::initializer_list<Index> vertices) const {
  glm::vec3 sum(0.0f);
  for (const Index v : vertices)
    if (isSmooth(v)) sum += normals[v];
  return isNone(sum) ? sum : glm::normalize(sum);
}

bool SampledMesh::isTip(Index v) const {
  if (mesh.creasesAt(v) < 3) return false;
  const Index first = mesh.outgoing(v);
  Index e = first;
  do {
    if (mesh.isCrease(e)) return false;
    e = mesh.turned(e);
  } while (e != first);
  return true;
}

SampledMesh::Index SampledMesh::newSample(const SurfaceSample& sample, const Paint* paint) {
  samples.push_back(sample);
  if (tints.any()) tints.addSample(paint);
  onTriangle.grow(onTriangle.count(), samples.size());
  onCrease.grow(onCrease.count(), samples.size());
  return static_cast<Index>(samples.size() - 1);
}

void SampledMesh::put(Index triangle, Index sample) {
  const auto [a, b, c] = mesh.corners(3 * triangle);
  if (!isFacing(glm::cross(b - a, c - a), samples[sample].normal)) samples[sample].normal = glm::vec3(0.0f);
  onTriangle.add(triangle, sample);
}

void SampledMesh::add(Index triangle, const SurfaceSample& sample, const Paint* paint) {
  put(triangle, newSample(sample, paint));
}

void SampledMesh::addToCrease(Index edge, const SurfaceSample& sample) {
  onCrease.add(edge, newSample(sample, nullptr));
}

SampledMesh::Index SampledMesh::split(Index h, const glm::vec3& p) {
  const Index first = mesh.halfEdges(), a = mesh.from(h), b = mesh.to(h);
  const Index edge = creaseOf[h], bc = mesh.twin(mesh.next(h)), db = mesh.twin(mesh.previous(mesh.twin(h)));
  const glm::vec3 sum = normals[a] + normals[b];
  normals.push_back(glm::length(sum) > 0.0f ? glm::normalize(sum) : normals[a]);
  const Index v = mesh.split(h, p);
  creaseOf.resize(mesh.halfEdges(), kNone);
  if (tints.any()) tints.corners.resize(mesh.halfEdges());
  onTriangle.grow(mesh.halfEdges() / 3, samples.size());
  // The two new triangles are v b c and b v d (HalfEdgeMesh::split).
  creaseOf[mesh.twin(bc)] = creaseOf[bc], creaseOf[mesh.twin(db)] = creaseOf[db];
  creaseOf[mesh.next(h)] = creaseOf[mesh.previous(mesh.twin(h))] = kNone;
  if (edge == kNone) return v;
  const auto half = static_cast<Index>(onCrease.count());
  onCrease.grow(half + 1, samples.size());
  creaseOf[first] = creaseOf[mesh.twin(first)] = half;
  return v;
}

void SampledMesh::flip(Index h) {
  const Index g = mesh.twin(h);
  if (tints.any()) {
    std::vector<Tint>& at = tints.corners;
    const Tint a = at[h], b = at[mesh.next(h)], c = at[mesh.previous(h)], d = at[mesh.previous(g)];
    // The triangles d c a and c d b (HalfEdgeMesh::flip).
    at[h] = at[mesh.next(g)] = d, at[g] = at[mesh.next(h)] = c;
    at[mesh.previous(h)] = a, at[mesh.previous(g)] = b;
  }
  mesh.flip(h);
  for (const Index e : {mesh.next(h), mesh.previous(h), mesh.next(g), mesh.previous(g)})
    creaseOf[e] = creaseOf[mesh.twin(e)];
  creaseOf[h] = creaseOf[g] = kNone;
}

void SampledMesh::collapse(Index h, const glm::vec3& p) {
  const Index u = mesh.from(h), v = mesh.to(h);
  for (const Index side : {h, mesh.twin(h)}) {
    const Index n = mesh.twin(mesh.next(side)), o = mesh.twin(mesh.previous(side));
    creaseOf[n] = creaseOf[o] = creaseOf[n] != kNone ? creaseOf[n] : creaseOf[o];
  }
  const glm::vec3 sum = normals[u] + normals[v];
  if (isSmooth(u) && isSmooth(v) && glm::length(sum) > 0.0f) normals[v] = glm::normalize(sum);
  mesh.collapse(h);
  mesh.positions[v] = p;
}

}  // namespace sdf
