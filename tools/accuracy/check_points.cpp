#include "check_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sdf::accuracy {
namespace {

using Random = PointMaker::Random;

std::size_t below(Random& random, std::size_t count) { return random() % count; }

glm::dvec3 asFloats(const glm::dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

}  // namespace

Box boxOf(const TriangleMesh& mesh) {
  Box box;
  for (const glm::dvec3& p : mesh.points) box = unite(box, {p, p});
  return box;
}

ByArea::ByArea(const std::vector<glm::dvec3>& points, const std::vector<glm::ivec3>& triangles) {
  double sum = 0.0;
  for (const glm::ivec3& t : triangles)
    sums_.push_back(sum += glm::length(glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x])));
}

std::size_t ByArea::at(double share) const {
  return std::upper_bound(sums_.begin(), sums_.end() - 1, share * sums_.back()) - sums_.begin();
}

double largest(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double uniform(Random& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

glm::dvec3 randomDirection(Random& random) {
  while (true) {
    const glm::dvec3 v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const double length = glm::length(v);
    if (length > 0.01 && length <= 1.0) return v / length;
  }
}

Turning::Turning(const std::optional<Axis>& axis) : axis_(axis) {
  if (!axis) return;
  const glm::dvec3 y = axis->direction;
  u_ = std::abs(y.x) < 0.5 ? glm::normalize(glm::dvec3(1, 0, 0) - y.x * y)
                           : glm::normalize(glm::dvec3(0, 0, 1) - y.z * y);
  w_ = glm::cross(u_, y);
}

glm::dvec3 Turning::toMesh(const glm::dvec3& p) const {
  if (!axis_) return p;
  const glm::dvec3 q = p - axis_->origin;
  return {std::hypot(glm::dot(q, u_), glm::dot(q, w_)), glm::dot(q, axis_->direction), 0.0};
}

glm::dvec3 Turning::fromMesh(const glm::dvec3& q, std::mt19937_64& random) const {
  if (!axis_) return q;
  constexpr double kCosines[] = {1.0, 0.0, -1.0, 0.0};
  const double angle = uniform(random, -kPi, std::numbers::pi);
  const std::size_t quarter = below(random, 8);
  const double cosine = quarter < 4 ? kCosines[quarter] : std::cos(angle);
  const double sine = quarter < 4 ? kCosines[(quarter + 3) % 4] : std::sin(angle);
  return axis_->origin + q.y * axis_->direction + q.x * (cosine * u_ + sine * w_);
}

PointMaker::PointMaker(const ReferenceCase& c)
    : case_(c),
      turning_(c.axis),
      byArea_(c.mesh.points, c.mesh.triangles),
      box_(intersect(boxOf(c.mesh), c.region)) {
  size_ = box_.longestSide();
  reach_ = std::max(largest(box_.min), largest(box_.max));
  if (c.axis) reach_ += glm::length(c.axis->origin);
}

glm::dvec3 PointMaker::operator()(std::uint64_t k, Random& random,
                                  const std::function<double(const glm::dvec3&)>& value) const {
  // Points near centres and the medial axis are the dearest: all of a mesh can be equally near.
  constexpr int kKinds = 64;
  const int kind = static_cast<int>(k % kKinds);
  if (kind == 0) return asFloats(onMedialAxis(random, value));
  const glm::dvec3 p = kind < 32   ? nearSurface(random)
                       : kind < 36 ? nearSpecial(random)
                       : kind < 50 ? around(random)
                       : kind < 58 ? onSymmetry(random)
                                   : far(random);
  return asFloats(turning_.fromMesh(glm::clamp(p, case_.region.min, case_.region.max), random));
}

// Half of them by area; half by triangle, since small triangles stand where the surface bends. Some on
// vertices and edges.
PointMaker::OnSurface PointMaker::onSurface(Random& random) const {
  std::size_t i = below(random, byArea_.size());
  if (below(random, 2)) i = byArea_.at(uniform(random, 0.0, 1.0));
  const glm::ivec3& t = case_.mesh.triangles[i];
  const glm::dvec3 a = case_.mesh.points[t.x], b = case_.mesh.points[t.y], c = case_.mesh.points[t.z];
  double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0);
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  const std::size_t place = below(random, 8);
  if (place == 0) u = v = 0.0;
  if (place == 1) v = 0.0;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  return {a + u * (b - a) + v * (c - a), length > 0.0 ? normal / length : glm::dvec3(0, 1, 0)};
}

double PointMaker::offset(Random& random) const { return size_ * std::pow(10.0, uniform(random, -6.0, 0.0)); }

glm::dvec3 PointMaker::nearSurface(Random& random) const {
  const glm::dvec3 at = onSurface(random).at;
  return at + offset(random) * randomDirection(random);
}

glm::dvec3 PointMaker::nearSpecial(Random& random) const {
  if (case_.special.empty()) return onSymmetry(random);
  const glm::dvec3 at = case_.special[below(random, case_.special.size())];
  return below(random, 8) ? at + offset(random) * randomDirection(random) : at;
}

glm::dvec3 PointMaker::around(Random& random) const {
  const Box box = below(random, 2) ? box_ : box_.grown(0.5 * size_);
  glm::dvec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(random, box.min[i], box.max[i]);
  return p;
}

// Onto the coordinate planes and axes, the planes through the middle of the solid, and the diagonals.
glm::dvec3 PointMaker::onSymmetry(Random& random) const {
  glm::dvec3 p = around(random);
  const int i = static_cast<int>(below(random, 3)), j = (i + 1 + static_cast<int>(below(random, 2))) % 3;
  const std::size_t kind = below(random, 6);
  if (kind >= 4) {
    p[i] = kind == 4 ? p[j] : -p[j];
  } else {
    const glm::dvec3 onto = kind % 2 ? box_.centre() : glm::dvec3(0.0);
    p[i] = onto[i];
    if (kind >= 2) p[j] = onto[j];
  }
  return p;
}

glm::dvec3 PointMaker::far(Random& random) const {
  return box_.centre() + size_ * std::pow(10.0, uniform(random, 0.0, 2.0)) * randomDirection(random);
}

// From a point of the surface inward or outward, as far as the distance grows by as much.
glm::dvec3 PointMaker::onMedialAxis(Random& random,
                                    const std::function<double(const glm::dvec3&)>& value) const {
  const OnSurface s = onSurface(random);
  const glm::dvec3 from = glm::clamp(s.at, case_.region.min, case_.region.max);
  const glm::dvec3 way = below(random, 4) ? -s.normal : s.normal;
  const double tolerance = case_.chord + 1e-6 * size_;
  const Random turn = random;  // the same turn for all of the line
  double stays = 0.0, leaves = size_;
  glm::dvec3 p;
  for (int step = 0; step < 20; ++step) {
    const double t = 0.5 * (stays + leaves);
    Random again = turn;
    p = turning_.fromMesh(glm::clamp(from + t * way, case_.region.min, case_.region.max), again);
    (std::abs(value(p)) > t - tolerance ? stays : leaves) = t;
  }
  return p;
}

glm::dvec3 gradient(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& p) {
  const auto [x, y, z] = derivatives(f, p, 1e-6);
  return {x, y, z};
}

}  // namespace sdf::accuracy
