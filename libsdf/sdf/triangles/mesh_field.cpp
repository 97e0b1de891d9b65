#include "sdf/triangles/mesh_field.h"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "sdf/triangles/brick_cache.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

bool isFinite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Each two triangles on an edge are looked at, and a sum over all of them tells sides there: twice this many
// take four times as long, 4,000 some 10 s.
constexpr std::uint32_t kMostOnEdge = 2000;

std::string crowdedEdge(const ClosedTriangles& all) {
  const MostOnEdge most = mostOnEdge(all.triangles);
  if (most.triangles <= kMostOnEdge) return {};
  const glm::vec3& p = all.points[most.vertex];
  std::ostringstream s;
  s << "an edge of this mesh, at (" << p.x << ", " << p.y << ", " << p.z << "), has " << most.triangles
    << " triangles, and at most " << kMostOnEdge << " are taken; move some of them away from it";
  return s.str();
}

double ulpUp(double v) { return std::nextafter(v, HUGE_VAL); }

}  // namespace

Status MeshField::checkVoxels(int voxels) {
  constexpr int kLeast = 16, kMost = 1024;
  if (voxels >= kLeast && voxels <= kMost) return okStatus();
  return Error{ErrorKind::Scene, "voxels must be from 16 to 1024, got " + std::to_string(voxels)};
}

Result<std::shared_ptr<const MeshField>> MeshField::make(TriangleMesh mesh, int voxels,
                                                         const std::filesystem::path& cache) {
  if (const Status s = checkVoxels(voxels); !s) return s.error();
  const auto start = std::chrono::steady_clock::now();
  const auto error = [](const std::string& what) { return Error{ErrorKind::Scene, what}; };
  ClosedTriangles triangles = closed(mesh);
  const Error hollow = error("the triangles of this mesh enclose nothing: it is no solid");
  if (triangles.triangles.empty())
    return triangles.films > 0 ? hollow : error("no triangle of this mesh has an area");
  if (const std::string crowd = crowdedEdge(triangles); !crowd.empty()) return error(crowd);
  std::shared_ptr<const MeshField> field(new MeshField(std::move(mesh), std::move(triangles), voxels, cache));
  if (!field->distance().hasInside()) return hollow;
  field->seconds_ = secondsSince(start);
  return field;
}

const Bricks& MeshField::bricks() const {
  std::call_once(sampled_, [&] {
    const auto start = std::chrono::steady_clock::now();
    bricks_ = cache_.empty() ? bricksOf(distance_, voxels_) : BrickCache(cache_).bricks(distance_, voxels_);
    seconds_ = seconds_ + secondsSince(start);
  });
  return *bricks_;
}

// Where p is not finite the distance is as far as that, or no number.
double MeshField::value(const glm::dvec3& p) const {
  if (!isFinite(p)) return glm::length(p);
  return distance_.read(p).distance;
}

ValueAndGradient MeshField::gradient(const glm::dvec3& p) const {
  if (!isFinite(p)) return {glm::length(p), glm::dvec3(NAN)};
  const TriangleDistance::Read read = distance_.read(p);
  return {read.distance, read.gradient};
}

Interval MeshField::range(const std::array<Interval, 3>& box) const {
  constexpr double kSlack = 1e-14;  // of the coordinates: what the value's rounding and the box's may be
  glm::dvec3 middle, half;
  bool nan = false;
  for (int k = 0; k < 3; ++k) {
    nan = nan || box[k].nan;
    middle[k] = 0.5 * box[k].lo + 0.5 * box[k].hi;
    half[k] = std::max(box[k].hi - middle[k], middle[k] - box[k].lo);
  }
  if (!isFinite(middle) || !isFinite(half)) return {-HUGE_VAL, HUGE_VAL, nan};
  const double f = distance_.read(middle).distance, size = glm::length(middle) + glm::length(half);
  const double reach = ulpUp(glm::length(half) * (1.0 + kSlack)) + kSlack * (size + std::abs(f));
  return {f - reach, f + reach, nan};
}

double MeshField::rounding(const glm::dvec3& p) const {
  return 0x1p-50 * (glm::length(p) + glm::length(distance_.min()) + glm::length(distance_.max()));
}

void MeshField::values(const PayloadRows& p, std::size_t count, float* out) const {
  DistanceAlong along(distance_);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 at(p[0][i], p[1][i], p[2][i]);
    out[i] = static_cast<float>(isFinite(at) ? along(at).distance : glm::length(at));
  }
}

void MeshField::gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const {
  DistanceAlong along(distance_);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 at(p[0][i], p[1][i], p[2][i]);
    TriangleDistance::Read read{glm::length(at), glm::dvec3(NAN), 0};
    if (isFinite(at)) read = along(at);
    out[0][i] = static_cast<float>(read.distance);
    for (int k = 0; k < 3; ++k) out[k + 1][i] = static_cast<float>(read.gradient[k]);
  }
}

}  // namespace sdf
