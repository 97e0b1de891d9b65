// Triangles of a tree that cross.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/triangles/tree-inl.h"
#include "sdf/triangles/tree.h"
#include "sdf/triangles/triangle_pairs.h"

namespace sdf {
namespace {

bool hasCorner(const glm::uvec3& t, std::uint32_t corner) {
  return t.x == corner || t.y == corner || t.z == corner;
}

// The directions along which a triangle is narrow: across its plane, and in that across its edges. What lies
// beyond it along one of them does not meet it, however large the triangle's own box is.
class Narrows {
 public:
  Narrows(const std::vector<glm::vec3>& points, const glm::uvec3& t) : origin_(points[t.x]) {
    const glm::dvec3 u = glm::dvec3(points[t.y]) - origin_, v = glm::dvec3(points[t.z]) - origin_;
    const glm::dvec3 across = glm::cross(u, v);
    const std::array<glm::dvec3, kWays> ways{across, glm::cross(across, u), glm::cross(across, v - u),
                                             glm::cross(v, across)};
    size_ = sizeOf(glm::abs(u)) + sizeOf(glm::abs(v));
    for (std::size_t i = 0; i < kWays; ++i) {
      const double first = glm::dot(u, ways[i]), second = glm::dot(v, ways[i]);
      slabs_[i] = {ways[i], std::min({0.0, first, second}), std::max({0.0, first, second})};
    }
  }

  /// Is the box certainly beside the triangle?
  bool miss(const glm::vec3& min, const glm::vec3& max) const {
    const glm::dvec3 low = glm::dvec3(min) - origin_, high = glm::dvec3(max) - origin_;
    const glm::dvec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const double size = size_ + sizeOf(glm::max(glm::abs(low), glm::abs(high)));
    for (const Slab& slab : slabs_) {
      const glm::dvec3 along = glm::abs(slab.way);
      const double at = glm::dot(middle, slab.way), reach = glm::dot(half, along);
      const double sure = kSure * size * sizeOf(along);
      if (at - reach - slab.high > sure || slab.low - at - reach > sure) return true;
    }
    return false;
  }

 private:
  static constexpr double kSure = 1e-13;  // certainly more than what rounds the products
  static constexpr std::size_t kWays = 4;
  struct Slab {
    glm::dvec3 way;
    double low, high;  // of the triangle, along the way
  };
  static double sizeOf(const glm::dvec3& p) { return p.x + p.y + p.z; }

  glm::dvec3 origin_;
  double size_;  // of the triangle
  std::array<Slab, kWays> slabs_;
};

// Triangles around a corner, for which looking at each two costs as much as a table of them.
constexpr std::uint32_t kManyAround = 64;
constexpr std::uint32_t kNoHub = std::numeric_limits<std::uint32_t>::max();

}  // namespace

// The triangles around a corner, seen from there: arcs on a sphere, of which two meet if and only if the
// triangles meet beyond the corner. The tree's triangles are boxes around the arcs.
struct TriangleTree::Link {
  std::vector<std::uint32_t> triangles;
  std::vector<glm::vec3> ends;      // of the boxes
  std::vector<glm::uvec3> corners;  // of the boxes, among the ends
  std::unique_ptr<TriangleTree> tree;

  void add(std::uint32_t triangle, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 u = glm::normalize(a), v = glm::normalize(b);
    // The arc is as far from its chord as half the chord at most, and 1 - cos of half the angle.
    constexpr double kRounding = 1e-6;
    const double half = 0.5 * glm::length(u - v);
    const double margin = 1.0 - std::sqrt(std::max(0.0, 1.0 - half * half)) + kRounding;
    const auto first = static_cast<std::uint32_t>(ends.size());
    ends.emplace_back(glm::min(u, v) - margin);
    ends.emplace_back(glm::max(u, v) + margin);
    corners.emplace_back(first, first + 1, first + 1);
    triangles.push_back(triangle);
  }
};

void TriangleTree::findLinks() {
  std::vector<std::uint32_t> around(points_.size());
  for (const glm::uvec3& t : triangles_)
    for (int k = 0; k < 3; ++k) ++around[t[k]];
  std::unordered_map<std::uint32_t, std::shared_ptr<Link>> links;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t corner = triangles_[i][k];
      if (around[corner] <= kManyAround || hasNoArea(points_, triangles_[i])) continue;
      std::shared_ptr<Link>& link = links[corner];
      if (!link) link = std::make_shared<Link>();
      const glm::dvec3 at(points_[corner]);
      link->add(i, glm::dvec3(points_[triangles_[i][(k + 1) % 3]]) - at,
                glm::dvec3(points_[triangles_[i][(k + 2) % 3]]) - at);
    }
  for (auto& [corner, link] : links) {
    link->tree = std::make_unique<TriangleTree>(link->ends, link->corners);
    links_.emplace(corner, std::move(link));
  }
  if (!links_.empty()) findHubs();
}

// Of a leaf the first that will do, above it the one that both nodes have.
void TriangleTree::findHubs() {
  hubs_.assign(nodes_.size(), kNoHub);
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    const Node& node = nodes_[n];
    if (node.count == 0) {
      if (hubs_[node.first] == hubs_[node.first + 1]) hubs_[n] = hubs_[node.first];
      continue;
    }
    for (int k = 0; k < 3 && hubs_[n] == kNoHub; ++k) {
      const std::uint32_t corner = triangles_[order_[node.first]][k];
      const auto hasIt = [&](std::uint32_t i) { return hasCorner(triangles_[i], corner); };
      const auto begin = order_.begin() + node.first;
      if (links_.contains(corner) && std::all_of(begin, begin + node.count, hasIt)) hubs_[n] = corner;
    }
  }
}

// Nodes to be looked at, the last one first.
struct TriangleTree::Nodes {
  std::array<std::uint32_t, kDeepest> numbers;
  std::size_t count = 0;

  explicit Nodes(std::uint32_t root) { push(root); }
  void push(std::uint32_t number) { numbers[count++] = number; }
  std::uint32_t pop() { return numbers[--count]; }
};

// A triangle that others are looked for which cross it.
struct TriangleTree::Asked {
  std::uint32_t triangle;
  Extent box;
  Narrows narrows;
  bool done = false;
};

TriangleTree::Asked TriangleTree::asked(std::uint32_t triangle) const {
  const glm::uvec3& t = triangles_[triangle];
  return {triangle, extentOf(points_, t), Narrows(points_, t)};
}

bool TriangleTree::isToSkip(const Asked& asked, std::uint32_t number) const {
  const Node& node = nodes_[number];
  return asked.done || apart(asked.box, {node.min, node.max}) ||
         (!hubs_.empty() && hasCorner(triangles_[asked.triangle], hubs_[number])) ||
         asked.narrows.miss(node.min, node.max);
}

bool TriangleTree::crosses(const Asked& asked, std::uint32_t other) const {
  if (other == asked.triangle || asked.done) return false;
  const glm::uvec3 &s = triangles_[asked.triangle], &t = triangles_[other];
  // The last is seldom asked.
  return !apart(asked.box, extentOf(points_, t)) && cross(points_, s, t) && !hasNoArea(points_, t);
}

// Calls found(asked, other) for those below some nodes that cross one, but for pairs around a corner of many,
// until a call returns true. Triangles near one another share the way through the tree.
template <class Found>
bool TriangleTree::anyBelow(Nodes open, std::vector<Asked>& all, const Found& found) const {
  Extent box;
  for (const Asked& asked : all) box.add(asked.box);
  while (open.count > 0) {
    const std::uint32_t number = open.pop();
    const Node& node = nodes_[number];
    const auto skips = [&](const Asked& asked) { return isToSkip(asked, number); };
    if (apart({node.min, node.max}, box) || std::ranges::all_of(all, skips)) continue;
    if (node.count == 0) {
      open.push(node.first + 1), open.push(node.first);
      continue;
    }
    for (Asked& asked : all) {
      if (skips(asked)) continue;
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (crosses(asked, order_[i]) && found(asked, order_[i])) return true;
    }
  }
  return false;
}

// The same of pairs around a corner of many.
template <class Found>
bool TriangleTree::anyAround(std::uint32_t corner, Asked& asked, const Found& found) const {
  const Link& link = *links_.at(corner);
  const auto place = std::ranges::lower_bound(link.triangles, asked.triangle) - link.triangles.begin();
  const glm::uvec3& ends = link.corners[static_cast<std::size_t>(place)];
  const Extent own{link.ends[ends.x], link.ends[ends.y]};
  for (Nodes open(0); open.count > 0 && !asked.done;) {
    const Node& node = link.tree->nodes_[open.pop()];
    if (apart({node.min, node.max}, own)) continue;
    if (node.count == 0) open.push(node.first), open.push(node.first + 1);
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t other = link.triangles[link.tree->order_[i]];
      if (crosses(asked, other) && found(asked, other)) return true;
    }
  }
  return false;
}

template <class Found>
bool TriangleTree::anyOf(Nodes below, std::vector<Asked>& all, const Found& found) const {
  for (Asked& asked : all) {
    if (hasNoArea(points_, triangles_[asked.triangle]) && found(asked, asked.triangle)) return true;
    for (int k = 0; k < 3 && !links_.empty() && !asked.done; ++k) {
      const std::uint32_t corner = triangles_[asked.triangle][k];
      if (links_.contains(corner) && anyAround(corner, asked, found)) return true;
    }
  }
  return anyBelow(below, all, found);
}

// Calls visit(leaf, later) for each leaf, `later` being nodes with all leaves that come after it, until a
// call returns true.
template <class Visit>
bool TriangleTree::anyLeaf(const Visit& visit) const {
  for (Nodes later(0); later.count > 0;) {
    const std::uint32_t number = later.pop();
    const Node& node = nodes_[number];
    if (node.count == 0)
      later.push(node.first + 1), later.push(node.first);
    else if (visit(number, later))
      return true;
  }
  return false;
}

bool TriangleTree::crosses(std::uint32_t triangle) const {
  std::vector<Asked> all{asked(triangle)};
  return anyOf(Nodes(0), all, [](const Asked&, std::uint32_t) { return true; });
}

bool TriangleTree::crosses() const {
  std::vector<Asked> all;
  return anyLeaf([&](std::uint32_t leaf, Nodes later) {
    const Node& node = nodes_[leaf];
    all.clear();
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) all.push_back(asked(order_[i]));
    later.push(leaf);
    return anyOf(later, all, [](const Asked&, std::uint32_t) { return true; });
  });
}

std::vector<char> TriangleTree::crossing() const {
  std::vector<char> crossing(triangles_.size(), 0);
  std::vector<Asked> all;
  anyLeaf([&](std::uint32_t leaf, const Nodes&) {
    const Node& node = nodes_[leaf];
    all.clear();
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (crossing[order_[i]] == 0) all.push_back(asked(order_[i]));
    anyOf(Nodes(0), all, [&](Asked& asked, std::uint32_t other) {
      asked.done = true;
      crossing[asked.triangle] = crossing[other] = 1;
      return false;
    });
    return false;
  });
  return crossing;
}

}  // namespace sdf
