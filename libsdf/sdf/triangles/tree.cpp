#include "sdf/triangles/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <numeric>

#include "sdf/triangles/tree-inl.h"

namespace sdf {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles
constexpr int kBins = 16;
constexpr int kByCost = 64;  // levels; below them triangles are halved, so that none is deeper than kDeepest

double squaredTo(const glm::dvec3& p, const glm::vec3& min, const glm::vec3& max) {
  const glm::dvec3 gap = glm::max(glm::max(glm::dvec3(min) - p, p - glm::dvec3(max)), glm::dvec3(0.0));
  return glm::dot(gap, gap);
}

NearestPoint at(const glm::dvec3& p, const glm::dvec3& q, Feature feature) {
  return {0, feature, glm::dot(p - q, p - q)};
}

NearestPoint nearestOfEdge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, int k) {
  const glm::dvec3 edge = b - a;
  const double square = glm::dot(edge, edge), along = glm::dot(p - a, edge);
  if (!(along > 0.0)) return at(p, a, static_cast<Feature>(static_cast<int>(Feature::Corner0) + k));
  if (along >= square)
    return at(p, b, static_cast<Feature>(static_cast<int>(Feature::Corner0) + (k + 1) % 3));
  return at(p, a + along / square * edge, static_cast<Feature>(static_cast<int>(Feature::Edge0) + k));
}

}  // namespace

NearestPoint nearestOf(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const std::array<glm::dvec3, 3> corner{a, b, c};
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double square = glm::dot(n, n);
  bool inside = square > 0.0;
  for (int k = 0; inside && k < 3; ++k) {
    const glm::dvec3& from = corner[k];
    inside = glm::dot(glm::cross(corner[(k + 1) % 3] - from, p - from), n) > 0.0;
  }
  if (inside) {
    const double height = glm::dot(p - a, n);
    return {0, Feature::Face, height * height / square};
  }
  NearestPoint best;
  for (int k = 0; k < 3; ++k) {
    const NearestPoint edge = nearestOfEdge(p, corner[k], corner[(k + 1) % 3], k);
    if (edge.squared < best.squared) best = edge;
  }
  return best;
}

TriangleTree::TriangleTree(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(triangles.size());
  nodes_.emplace_back();
  slabs_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(order_.size()), 0);
  setDipoles();
  findLinks();
}

void TriangleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth) {
  struct Bin {
    Extent extent;
    std::uint32_t count = 0;
  };
  const auto middleOf = [&](std::uint32_t i) {
    const Extent e = extentOf(points_, triangles_[i]);
    return 0.5f * e.min + 0.5f * e.max;
  };
  Extent all, middles;
  for (std::uint32_t i = first; i < first + count; ++i) {
    all.add(extentOf(points_, triangles_[order_[i]]));
    middles.add(middleOf(order_[i]));
  }
  nodes_[node] = {all.min, all.max, first, count};
  slabs_[node] = slabOf(first, count);
  const glm::vec3 sides = middles.max - middles.min;
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  if (count <= kLeaf || !(sides[axis] > 0.0f)) return;
  const double perSide = kBins / static_cast<double>(sides[axis]);
  const auto binOf = [&](std::uint32_t i) {
    const double along = static_cast<double>(middleOf(i)[axis]) - static_cast<double>(middles.min[axis]);
    return std::min(static_cast<int>(along * perSide), kBins - 1);
  };
  std::array<Bin, kBins> bins;
  for (std::uint32_t i = first; i < first + count; ++i) {
    Bin& bin = bins[binOf(order_[i])];
    bin.extent.add(extentOf(points_, triangles_[order_[i]]));
    ++bin.count;
  }
  std::array<double, kBins> below{};  // the cost of what is in this bin and those before
  Bin sum;
  for (int i = 0; i < kBins; ++i) {
    sum.extent.add(bins[i].extent), sum.count += bins[i].count;
    below[i] = sum.extent.halfArea() * sum.count;
  }
  sum = {};
  int cut = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = kBins - 1; i > 0; --i) {
    sum.extent.add(bins[i].extent), sum.count += bins[i].count;
    const double cost = below[i - 1] + sum.extent.halfArea() * sum.count;
    if (sum.count > 0 && sum.count < count && cost < least) least = cost, cut = i;
  }
  const auto begin = order_.begin() + first;
  auto half = begin + count / 2;
  if (depth < kByCost)
    half = std::partition(begin, begin + count, [&](std::uint32_t i) { return binOf(i) < cut; });
  else
    std::nth_element(begin, half, begin + count,
                     [&](std::uint32_t i, std::uint32_t j) { return middleOf(i)[axis] < middleOf(j)[axis]; });
  const auto left = static_cast<std::uint32_t>(half - begin);
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  slabs_.resize(nodes_.size());
  nodes_[node].first = child, nodes_[node].count = 0;
  build(child, first, left, depth + 1);
  build(child + 1, first + left, count - left, depth + 1);
}

// Triangles are taken with the sign by which they agree with the first that has an area.
TriangleTree::Slab TriangleTree::slabOf(std::uint32_t first, std::uint32_t count) const {
  glm::dvec3 sum(0.0);
  for (std::uint32_t i = first; i < first + count; ++i) {
    const glm::uvec3& t = triangles_[order_[i]];
    const glm::dvec3 a(points_[t.x]), b(points_[t.y]), c(points_[t.z]), area = glm::cross(b - a, c - a);
    sum += glm::dot(area, sum) < 0.0 ? -area : area;
  }
  const double length = glm::length(sum);
  if (!(length > 0.0)) return {};
  Slab slab{sum / length, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::uint32_t i = first; i < first + count; ++i)
    for (int k = 0; k < 3; ++k) {
      const double along = glm::dot(slab.normal, glm::dvec3(points_[triangles_[order_[i]][k]]));
      slab.low = std::min(slab.low, along);
      slab.high = std::max(slab.high, along);
    }
  return slab;
}

// The planes are asked where the box is nearer than `enough`.
double TriangleTree::leastSquaredTo(const glm::dvec3& p, std::uint32_t node, double enough) const {
  const double squared = squaredTo(p, nodes_[node].min, nodes_[node].max);
  if (!(squared < enough)) return squared;
  constexpr double kRounded = 1.0 - 1e-12;
  const Slab& slab = slabs_[node];
  const double along = glm::dot(slab.normal, p);
  const double gap = std::max({slab.low - along, along - slab.high, 0.0});
  const double rounding = 1e-15 * (std::abs(along) + std::abs(slab.low) + std::abs(slab.high));
  const double least = std::max(gap - rounding, 0.0);
  return std::max(squared, kRounded * least * least);
}

NearestPoint TriangleTree::nearest(const glm::dvec3& p, std::uint32_t hint, double enough) const {
  NearestPoint best;
  const auto look = [&](std::uint32_t i) {
    const glm::uvec3& t = triangles_[i];
    NearestPoint found =
        nearestOf(p, glm::dvec3(points_[t.x]), glm::dvec3(points_[t.y]), glm::dvec3(points_[t.z]));
    if (!(found.squared < best.squared)) return;
    found.triangle = i;
    best = found;
  };
  look(hint);
  struct Open {
    double squared;
    std::uint32_t node;
  };
  std::array<Open, kDeepest> open;
  std::size_t left = 0;
  open[left++] = {0.0, 0};
  while (left > 0 && best.squared > enough) {
    const auto [squared, number] = open[--left];
    if (!(squared < best.squared)) continue;
    const Node& node = nodes_[number];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) look(order_[i]);
      continue;
    }
    Open near{leastSquaredTo(p, node.first, best.squared), node.first};
    Open far{leastSquaredTo(p, node.first + 1, best.squared), node.first + 1};
    if (far.squared < near.squared) std::swap(near, far);
    if (far.squared < best.squared) open[left++] = far;
    if (near.squared < best.squared) open[left++] = near;
  }
  return best;
}

void TriangleTree::setDipoles() {
  dipoles_.resize(nodes_.size());
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    const Node& node = nodes_[n];
    Dipole& d = dipoles_[n];
    double weight = 0.0;
    const auto add = [&](const glm::dvec3& centre, const glm::dvec3& area, double share) {
      d.area += area;
      d.centre += share * centre;
      weight += share;
    };
    if (node.count == 0)
      for (std::uint32_t c = node.first; c < node.first + 2; ++c)
        add(dipoles_[c].centre, dipoles_[c].area, dipoles_[c].reach);
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const glm::uvec3& t = triangles_[order_[i]];
      const glm::dvec3 a(points_[t.x]), b(points_[t.y]), c(points_[t.z]);
      const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a);
      add((a + b + c) / 3.0, area, glm::length(area));
    }
    const glm::dvec3 low(node.min), high(node.max);
    d.centre = weight > 0.0 ? d.centre / weight : 0.5 * (low + high);
    d.reach = weight;  // the area, until all parents have read it
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const glm::dvec3 low(nodes_[n].min), high(nodes_[n].max);
    dipoles_[n].reach = glm::length(glm::max(dipoles_[n].centre - low, high - dipoles_[n].centre));
  }
}

double windingOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  const double rest = x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y;
  return std::atan2(volume, rest) / (2.0 * std::numbers::pi);
}

double TriangleTree::winding(const glm::dvec3& p) const {
  constexpr double kFar = 2.5;  // reaches
  double sum = 0.0;
  std::array<std::uint32_t, kDeepest> open;
  std::size_t left = 0;
  open[left++] = 0;
  while (left > 0) {
    const std::uint32_t number = open[--left];
    const Node& node = nodes_[number];
    const Dipole& d = dipoles_[number];
    const glm::dvec3 way = d.centre - p;
    const double square = glm::dot(way, way);
    if (square > kFar * kFar * d.reach * d.reach) {
      sum += glm::dot(d.area, way) / (4.0 * std::numbers::pi * square * std::sqrt(square));
    } else if (node.count == 0) {
      open[left++] = node.first, open[left++] = node.first + 1;
    } else {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const glm::uvec3& t = triangles_[order_[i]];
        sum += windingOf(glm::dvec3(points_[t.x]) - p, glm::dvec3(points_[t.y]) - p,
                         glm::dvec3(points_[t.z]) - p);
      }
    }
  }
  return sum;
}

}  // namespace sdf
