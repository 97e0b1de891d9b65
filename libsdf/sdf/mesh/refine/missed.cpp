#include "sdf/mesh/refine/missed.h"

#include <glm/geometric.hpp>
#include <utility>

#include "sdf/mesh/creases/crease.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/surface/project.h"

namespace sdf {
namespace {

// Steps of the grids that triangles are looked at in, the finer one where more than this share of the
// tolerance was seen in the coarser one: a parabola's largest value is a ninth more than between three steps.
constexpr int kCoarseSteps = 3, kFineSteps = 7;
constexpr float kClose = 0.75f;
// Points of the surface whose squared distance is less than this share of the tolerance's are not looked at
// again.
constexpr double kWatched = 0.64;
// Few, as they set out again from what the last ones found.
constexpr std::size_t kClimbers = 64;

}  // namespace

std::vector<SampledMesh::Index> MissedSamples::add() {
  added_.clear();
  const std::vector<Index> all = alive();
  std::vector<Index> close;
  addAt(changed(all), kCoarseSteps, &close);
  addAt(close, kFineSteps, nullptr);
  addOfSurface(all);
  addOfCreases();
  if (added_.empty()) addClimbed(all);  // which takes the longest
  return std::exchange(added_, {});
}

std::vector<SampledMesh::Index> MissedSamples::addNextTo(const std::vector<glm::vec3>& places) {
  const std::vector<Index> triangles = alive();
  const std::vector<NearestPoint> nearest =
      nearestTriangles(places, sampled_.mesh.positions, cornersOf(triangles), progress_);
  std::vector<glm::vec3> feet = places, normals;
  refineVertices(feet, normals, field_, progress_);
  if (progress_.stopped()) return {};
  for (std::size_t i = 0; i < places.size(); ++i)
    take(triangles[nearest[i].triangle], places[i], {feet[i], normals[i]});
  surface_.insert(surface_.end(), feet.begin(), feet.end());
  return std::exchange(added_, {});
}

std::vector<SampledMesh::Index> MissedSamples::alive() const {
  std::vector<Index> all;
  for (Index h = 0; h < sampled_.mesh.halfEdges(); h += 3)
    if (sampled_.mesh.alive(h)) all.push_back(h);
  return all;
}

// Those of the triangles in which nothing has been looked for as they are, or something was found.
std::vector<SampledMesh::Index> MissedSamples::changed(const std::vector<Index>& triangles) {
  looked_.resize(sampled_.mesh.halfEdges() / 3);
  std::vector<Index> changed;
  for (const Index h : triangles) {
    const Corners corners = sampled_.mesh.corners(h);
    if (std::exchange(looked_[h / 3], corners) != corners) changed.push_back(h);
  }
  return changed;
}

// A sample, which was found from a place on or near a triangle.
void MissedSamples::take(Index triangle, const glm::vec3& place, const SurfaceSample& sample) {
  sampled_.add(triangle / 3, sample);
  added_.push_back(triangle);
  const OffSurface off{triangle, sampled_.mesh.corners(triangle), place, sample.at};
  if (off_.empty() || off_.back().triangle != triangle)
    off_.push_back(off);
  else if (off.distance() > off_.back().distance())
    off_.back() = off;
}

// At a grid over some triangles; `close` receives those that are nearly too far.
void MissedSamples::addAt(const std::vector<Index>& triangles, int steps, std::vector<Index>* close) {
  std::vector<glm::vec3> places, normals;
  for (const Index h : triangles) {
    const auto [a, b, c] = sampled_.mesh.corners(h);
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; k <= steps - i; ++k) {
        const float u = static_cast<float>(i) / static_cast<float>(steps),
                    v = static_cast<float>(k) / static_cast<float>(steps);
        places.push_back((1.0f - u - v) * a + u * b + v * c);
      }
  }
  std::vector<glm::vec3> feet = places;
  refineVertices(feet, normals, field_, progress_);
  if (progress_.stopped()) return;
  const std::size_t each = triangles.empty() ? 1 : places.size() / triangles.size();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    float most = 0.0f;
    const bool hasNone = sampled_.onTriangle.first(triangles[t] / 3) == Lists::kNone;
    for (std::size_t i = t * each; i < (t + 1) * each; ++i) {
      const float off = glm::distance(feet[i], places[i]);
      most = std::max(most, off);
      if (off > tolerance_) {
        take(triangles[t], places[i], {feet[i], normals[i]});
        looked_[triangles[t] / 3] = {};
      } else if (hasNone) {
        sampled_.add(triangles[t] / 3, {feet[i], normals[i]});
      }
    }
    if (close && most > kClose * tolerance_) close->push_back(triangles[t]);
  }
}

void MissedSamples::addOfCreases() {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  const auto normal = [&](Index h) {
    const auto [a, b, c] = mesh.corners(h - h % 3);
    return glm::normalize(glm::cross(b - a, c - a));
  };
  std::vector<CreasePoint> points;
  std::vector<Index> edges;
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    if (!mesh.alive(h) || !mesh.isCrease(h) || h > mesh.twin(h)) continue;
    const glm::vec3 middle = 0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]);
    points.push_back(
        {middle, {normal(h), normal(mesh.twin(h))}, glm::normalize(mesh.positions[mesh.apex(h)] - middle)});
    edges.push_back(h);
  }
  std::vector<CreasePoint> placed = points;
  placeOnCreases(placed, field_, progress_);
  if (progress_.stopped()) return;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].placed || !(glm::distance(placed[i].at, points[i].at) > tolerance_)) continue;
    sampled_.addToCrease(sampled_.creaseOf[edges[i]], {placed[i].at, placed[i].normal[0]});
    added_.push_back(edges[i] - edges[i] % 3);
  }
}

std::vector<glm::uvec3> MissedSamples::cornersOf(const std::vector<Index>& triangles) const {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  std::vector<glm::uvec3> corners;
  for (const Index h : triangles) corners.emplace_back(mesh.from(h), mesh.from(h + 1), mesh.from(h + 2));
  return corners;
}

// What lies between the surface's points and is farther than they are.
void MissedSamples::addClimbed(const std::vector<Index>& triangles) {
  const std::vector<glm::uvec3> corners = cornersOf(triangles);
  Box bounds;
  for (const glm::uvec3& t : corners) {
    const glm::dvec3 at(sampled_.mesh.positions[t.x]);
    bounds = unite(bounds, {at, at});
  }
  const std::vector<FarPoint> far = farthestOfSurface(surface_, field_, bounds.longestSide(),
                                                      sampled_.mesh.positions, corners, progress_, kClimbers);
  const std::size_t known = surface_.size();
  for (std::size_t i = known; i < far.size(); ++i)
    if (far[i].distance > tolerance_) surface_.push_back(far[i].at);
  if (surface_.size() > known) addOfSurface(triangles);
}

void MissedSamples::addOfSurface(const std::vector<Index>& triangles) {
  const HalfEdgeMesh& mesh = sampled_.mesh;
  const std::vector<glm::uvec3> corners = cornersOf(triangles);
  const std::vector<NearestPoint> nearest =
      nearestTriangles(surface_, mesh.positions, corners, progress_, std::sqrt(kWatched) * tolerance_);
  if (progress_.stopped()) return;
  const double limit = static_cast<double>(tolerance_) * tolerance_;
  std::vector<glm::vec3> missed, normals, near;
  std::vector<Index> of;
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    if (nearest[i].squared > limit)
      missed.push_back(surface_[i]), of.push_back(triangles[nearest[i].triangle]);
    if (nearest[i].squared > kWatched * limit) near.push_back(surface_[i]);
  }
  surface_ = std::move(near);
  gradientNormals(missed, field_, progress_, normals);
  for (std::size_t i = 0; i < missed.size(); ++i) sampled_.add(of[i] / 3, {missed[i], normals[i]});
  added_.insert(added_.end(), of.begin(), of.end());
}

}  // namespace sdf
