#include "sdf/mesh/refine/remesh_measure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <span>

#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// Points evaluated at a time, to bound the memory.
constexpr std::size_t kMeasuredPoints = std::size_t{1} << 20;

// Steps along each side at least. What lies between two of them is at most 1 / (4 * 81) of a quadratic
// error's span larger.
constexpr int kLeast = 9;

// Adds the triangle's corners, and the nodes of a grid no coarser than `cell`: rows along the longest side.
void addPoints(const std::array<glm::vec3, 3>& corners, float cell, std::vector<glm::vec3>& points) {
  points.insert(points.end(), corners.begin(), corners.end());
  std::size_t k = 0;
  float longest = 0.0f;
  for (std::size_t i = 0; i < 3; ++i)
    if (const float l = glm::distance(corners[i], corners[(i + 1) % 3]); l > longest) longest = l, k = i;
  const glm::vec3 &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
  const float height = glm::length(glm::cross(b - a, c - a)) / longest;
  const int rows = std::max(kLeast, static_cast<int>(std::ceil(height / cell)));
  for (int j = 0; j < rows; ++j) {
    const float t = static_cast<float>(j) / static_cast<float>(rows);
    const int columns = std::max(kLeast - j, static_cast<int>(std::ceil(longest * (1.0f - t) / cell)));
    for (int i = 0; i <= columns; ++i) {
      const float s = static_cast<float>(i) / static_cast<float>(std::max(columns, 1));
      points.push_back(t * c + (1.0f - t) * (a + s * (b - a)));
    }
  }
}

// What these distances, the corners' first, say of a triangle.
TriangleDistances judged(const std::array<glm::vec3, 3>& corners, std::span<const float> distances) {
  TriangleDistances t{corners, {distances[0], distances[1], distances[2]}, 0.0f, true};
  for (const float d : distances) t.largest = d <= t.largest ? t.largest : d;
  return t;
}

bool counts(const HalfEdgeMesh& mesh, std::uint32_t h) { return mesh.alive(h) && !mesh.isExemptTriangle(h); }

// Reads those of the triangles, by their first half-edges, that are not known.
class Reader {
 public:
  Reader(const HalfEdgeMesh& mesh, const LocalField& field, std::vector<TriangleDistances>& known,
         Progress& progress)
      : mesh_(mesh), field_(field), finder_(field.finder()), known_(known), progress_(progress) {}

  void add(std::uint32_t h) {
    const std::array<glm::vec3, 3> corners = mesh_.corners(h);
    const double voxel = finder_->at((corners[0] + corners[1] + corners[2]) / 3.0f).voxel;
    addPoints(corners, static_cast<float>(voxel) / 3.0f, points_);
    triangles_.push_back(h), ends_.push_back(points_.size());
    if (points_.size() >= kMeasuredPoints) flush();
  }

  void flush() {
    const std::vector<float> distances = distancesAt(points_, field_, progress_);
    if (!progress_.stopped())
      for (std::size_t i = 0, begin = 0; i < triangles_.size(); begin = ends_[i++])
        known_[triangles_[i] / 3] =
            judged(mesh_.corners(triangles_[i]), std::span(distances).subspan(begin, ends_[i] - begin));
    points_.clear(), triangles_.clear(), ends_.clear();
  }

 private:
  const HalfEdgeMesh& mesh_;
  const LocalField& field_;
  std::unique_ptr<LocalField::Finder> finder_;
  std::vector<TriangleDistances>& known_;
  Progress& progress_;
  std::vector<glm::vec3> points_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::size_t> ends_;  // of each triangle's points
};

}  // namespace

std::vector<float> distancesAt(const std::vector<glm::vec3>& points, const LocalField& field,
                               Progress& progress) {
  std::vector<float> all(points.size());
  forEachGradient(points, field, progress, [&](std::size_t i, const RunGradients& g, std::size_t k) {
    all[i] = std::abs(g.distance(k));
  });
  return all;
}

DenseDistances measureDensely(const HalfEdgeMesh& mesh, const LocalField& field, double tolerance,
                              std::vector<TriangleDistances>& known, Progress& progress) {
  known.resize(mesh.halfEdges() / 3);
  Reader reader(mesh, field, known, progress);
  for (std::uint32_t h = 0; h < mesh.halfEdges() && !progress.stopped(); h += 3)
    if (counts(mesh, h) && !(known[h / 3].known && known[h / 3].corners == mesh.corners(h))) reader.add(h);
  reader.flush();
  DenseDistances result;
  if (progress.stopped()) return result;
  for (std::uint32_t h = 0; h < mesh.halfEdges(); h += 3) {
    if (!counts(mesh, h)) continue;
    const TriangleDistances& t = known[h / 3];
    for (std::uint32_t i = 0; i < 3; ++i)
      if (!(t.atCorners[i] <= tolerance)) result.vertices.push_back(mesh.from(h + i));
    const double largest = t.largest;
    result.largest = largest <= result.largest ? result.largest : largest;
    if (!(largest <= tolerance)) result.exceeding.push_back(h);
  }
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  return result;
}

}  // namespace sdf
