#include "mesh_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "accuracy/take.h"
#include "reference/triangle_soup.h"
#include "sdf/mesh/mesher.h"

namespace sdf::chart {
namespace {

using accuracy::TriangleMesh;
using accuracy::TriangleSoup;

constexpr unsigned kSeed = 1;

class SolidTruth : public MeshTruth {
 public:
  SolidTruth(std::shared_ptr<const accuracy::PiecewiseSolid> solid, std::size_t points)
      : solid_(std::move(solid)), points_(solid_->surfacePoints(points, kSeed)) {}
  double distance(const glm::dvec3& p) const override { return solid_->distance(p); }
  glm::dvec3 normal(const glm::dvec3& p) const override {
    return glm::normalize(accuracy::gradient([this](const glm::dvec3& q) { return solid_->value(q); }, p));
  }
  const std::vector<glm::dvec3>& points() const override { return points_; }
  double error() const override { return 1e-9; }

 private:
  std::shared_ptr<const accuracy::PiecewiseSolid> solid_;
  std::vector<glm::dvec3> points_;
};

glm::dvec3 facetNormal(const TriangleMesh& mesh, std::size_t i) {
  const glm::ivec3& t = mesh.triangles[i];
  const glm::dvec3 n = glm::cross(mesh.points[t.y] - mesh.points[t.x], mesh.points[t.z] - mesh.points[t.x]);
  const double length = glm::length(n);
  return length > 0.0 ? n / length : glm::dvec3(0.0);
}

class FineMeshTruth : public MeshTruth {
 public:
  FineMeshTruth(TriangleMesh mesh, double error, std::size_t points)
      : mesh_(std::move(mesh)),
        soup_(mesh_),
        points_(accuracy::pointsOn(mesh_, points, kSeed)),
        error_(error) {}
  double distance(const glm::dvec3& p) const override { return soup_.distance(p); }
  glm::dvec3 normal(const glm::dvec3& p) const override {
    return facetNormal(mesh_, soup_.nearest(p).triangle);
  }
  const std::vector<glm::dvec3>& points() const override { return points_; }
  double error() const override { return error_; }

 private:
  TriangleMesh mesh_;
  TriangleSoup soup_;
  std::vector<glm::dvec3> points_;
  double error_;
};

// The normal that the mesh is shaded with at a point of its i-th triangle.
glm::dvec3 shadingNormal(const JudgedMesh& judged, std::size_t i, const glm::dvec3& p) {
  if (judged.normals.empty()) return facetNormal(judged.mesh, i);
  const glm::ivec3& t = judged.mesh.triangles[i];
  const glm::dvec3 &a = judged.mesh.points[t.x], &b = judged.mesh.points[t.y], &c = judged.mesh.points[t.z];
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double square = glm::dot(n, n);
  if (square == 0.0) return judged.normals[i][0];
  const double u = glm::dot(glm::cross(c - b, p - b), n) / square;
  const double v = glm::dot(glm::cross(a - c, p - c), n) / square;
  return glm::normalize(u * judged.normals[i][0] + v * judged.normals[i][1] +
                        (1.0 - u - v) * judged.normals[i][2]);
}

// The least angle between n and the normals of the surface within `near` of p, radians.
double normalError(const MeshTruth& truth, const glm::dvec3& p, const glm::dvec3& n, double near) {
  double closest = glm::dot(n, truth.normal(p));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-near, near}) {
      glm::dvec3 q = p;
      q[axis] += side;
      closest = std::max(closest, glm::dot(n, truth.normal(q)));
    }
  return std::acos(std::clamp(closest, -1.0, 1.0));
}

// The vertices, or so many of them.
std::vector<glm::dvec3> someVertices(const TriangleMesh& mesh, std::size_t most) {
  std::vector<glm::dvec3> some;
  const std::size_t stride = mesh.points.size() / most + 1;
  for (std::size_t i = 0; i < mesh.points.size(); i += stride) some.push_back(mesh.points[i]);
  return some;
}

}  // namespace

std::unique_ptr<MeshTruth> truthOf(const Subject& subject, std::size_t points) {
  if (subject.solid) return std::make_unique<SolidTruth>(subject.solid, points);
  constexpr double kFine = 400.0;
  Progress progress;
  const MeshOptions options{.voxelSize = subject.bounds.longestSide() / kFine};
  const MeshedShape fine = take(meshShape(subject.shape, subject.name, options, progress));
  return std::make_unique<FineMeshTruth>(accuracy::weldedMesh(fine.mesh), fine.stats.maxDistance, points);
}

void judgeMesh(const JudgedMesh& judged, const MeshTruth& truth, std::size_t points, Row& row) {
  if (judged.mesh.triangles.empty()) throw std::runtime_error("no triangles");
  const auto fromTruth = [&](const glm::dvec3& p) { return truth.distance(p); };
  const TriangleSoup soup(judged.mesh);
  const std::vector<glm::dvec3> on = accuracy::pointsOn(judged.mesh, points, kSeed);
  const accuracy::Spread to = accuracy::spreadOver(on, fromTruth);
  const accuracy::Spread corners = accuracy::spreadOver(someVertices(judged.mesh, 2 * points), fromTruth);
  const accuracy::Spread back =
      accuracy::spreadOver(truth.points(), [&](const glm::dvec3& p) { return soup.distance(p); });
  row.rms = std::max(to.rms, back.rms);
  row.max = std::max({to.max, corners.max, back.max});
  row.truth = truth.error();
  row.triangles = static_cast<double>(judged.mesh.triangles.size());
  const double near = 2.0 * row.max;
  row.normal =
      glm::degrees(accuracy::spreadOver(on, [&](const glm::dvec3& p) {
                     return normalError(truth, p, shadingNormal(judged, soup.nearest(p).triangle, p), near);
                   }).rms);
}

}  // namespace sdf::chart
