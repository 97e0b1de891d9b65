#include "piecewise_solid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace sdf::accuracy {
namespace {

// A foot's distance to the zero sets on which it is to lie.
constexpr double kOnSurface = 1e-9;

// Pieces that a foot is to lie on, one to three.
struct Joint {
  std::array<int, 3> piece;
  int count;
};

// The nearest point to p where all pieces of the joint are 0: Newton's method, each step to the point nearest
// to p of the planes that the pieces look like where the last one ended. Nothing where the planes are
// parallel or the steps lead nowhere.
std::optional<glm::dvec3> footOn(const PiecewiseSolid& solid, const Joint& joint, const glm::dvec3& p) {
  constexpr int kSteps = 50;
  constexpr double kParallel = 1e-4, kStill = 1e-11, kFarther = 50.0;
  glm::dvec3 at = p;
  for (int step = 0; step < kSteps; ++step) {
    glm::dvec3 next = p;
    std::array<glm::dvec3, 3> across;
    for (int i = 0; i < joint.count; ++i) {
      const PiecewiseSolid::Piece& piece = solid.pieces[joint.piece[i]];
      const glm::dvec3 g = gradient(piece, at);
      // Along what is left of the gradient the planes before this one are not left.
      glm::dvec3 free = g;
      for (int j = 0; j < i; ++j) free -= glm::dot(free, across[j]) * across[j];
      if (!(glm::length(free) > kParallel * glm::length(g))) return {};
      across[i] = glm::normalize(free);
      next -= across[i] * (piece(at) + glm::dot(g, next - at)) / glm::dot(g, across[i]);
    }
    // Farther away, the rounding of the gradients moves the foot more.
    if (glm::distance(next, at) < kStill * (1.0 + kFarther * glm::distance(next, p))) return next;
    at = next;
  }
  return {};
}

// The distance from p to the surface among feet on pieces whose values at p are at most slope * reach: all
// that can be within `reach`. Infinite where there is none.
double distanceWithin(const PiecewiseSolid& solid, const glm::dvec3& p, double reach) {
  struct Near {
    int piece;
    double distance;
  };
  double best = kInfinity;
  const auto tryJoint = [&](const Joint& joint) {
    const std::optional<glm::dvec3> foot = footOn(solid, joint, p);
    const double d = foot ? glm::distance(*foot, p) : kInfinity;
    if (d < best && std::abs(solid.value(*foot)) <= solid.slope * kOnSurface) best = d;
    return d;
  };
  std::vector<Near> near;
  for (int i = 0; i < static_cast<int>(solid.pieces.size()); ++i)
    if (std::abs(solid.pieces[i](p)) <= solid.slope * reach) near.push_back({i, tryJoint({{i}, 1})});
  // What lies on several pieces is no nearer than any of them.
  std::erase_if(near, [&](const Near& n) { return n.distance >= best; });
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      tryJoint({{near[i].piece, near[j].piece}, 2});
      for (std::size_t k = 0; k < j; ++k) tryJoint({{near[i].piece, near[j].piece, near[k].piece}, 3});
    }
  return best;
}

}  // namespace

double PiecewiseSolid::value(const glm::dvec3& p) const {
  double v = pieces[0](p);
  for (std::size_t i = 1; i < pieces.size(); ++i)
    v = united ? std::min(v, pieces[i](p)) : std::max(v, pieces[i](p));
  return v;
}

double PiecewiseSolid::distance(const glm::dvec3& p) const {
  for (double reach = 2.0 * std::abs(value(p)) / slope + kOnSurface; reach < 4.0 * radius; reach *= 2.0)
    if (const double d = distanceWithin(*this, p, reach); d <= reach) return d;
  return kInfinity;
}

// Where one line passes the surface.
void PiecewiseSolid::addLine(PointMaker::Random& random, std::vector<glm::dvec3>& points) const {
  constexpr double kShortest = 1e-3;
  constexpr int kHalvings = 40;
  const glm::dvec3 along = randomDirection(random);
  const glm::dvec3 u = glm::normalize(glm::cross(along, randomDirection(random))), w = glm::cross(along, u);
  // A point of the disc across it, by rejection.
  double a, b;
  do a = uniform(random, -1.0, 1.0), b = uniform(random, -1.0, 1.0);
  while (a * a + b * b > 1.0);
  const glm::dvec3 from = radius * (a * u + b * w - along);
  double t = 0.0, v = value(from);
  while (t < 2.0 * radius) {
    const double next = t + std::max(std::abs(v) / slope, kShortest), there = value(from + next * along);
    if ((v < 0.0) != (there < 0.0)) {
      double low = t, high = next;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        ((value(from + middle * along) < 0.0) == (v < 0.0) ? low : high) = middle;
      }
      points.push_back(from + high * along);
    }
    t = next, v = there;
  }
}

std::vector<glm::dvec3> PiecewiseSolid::surfacePoints(std::size_t count, unsigned seed) const {
  constexpr std::size_t kLines = 1024, kChunk = 32;
  std::vector<glm::dvec3> points;
  for (std::uint64_t first = 0; points.size() < count; first += kLines) {
    std::array<std::vector<glm::dvec3>, kLines / kChunk> found;
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
      PointMaker::Random random((std::uint64_t{seed} << 40) + first + chunk);
      for (std::size_t i = 0; i < kChunk; ++i) addLine(random, found[chunk]);
    });
    for (const auto& some : found) points.insert(points.end(), some.begin(), some.end());
  }
  points.resize(count);
  return points;
}

}  // namespace sdf::accuracy
