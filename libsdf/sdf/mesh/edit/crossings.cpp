#include "sdf/mesh/edit/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <limits>
#include <memory>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/indices-inl.h"
#include "sdf/mesh/edit/tiles.h"
#include "sdf/triangles/triangle_pairs.h"

namespace sdf {
namespace {

// Fewer triangles than these are compared each with each.
constexpr std::size_t kFew = 24;
// Halves that together hold more than this share of the whole make it no easier.
constexpr double kNoGain = 1.6;
constexpr std::size_t kChunk = 8192;

/// A triangle's box.
struct Item {
  glm::vec3 low, high;
  std::uint32_t triangle;
};

/// What a search has found and works with.
struct Scratch {
  std::vector<Item> items;                // of a tile
  std::vector<std::vector<Item>> levels;  // a list for each depth
  TrianglePairs found;
};

class Search {
 public:
  Search(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
         const std::vector<std::uint32_t>& among, const std::vector<char>* asked)
      : positions_(positions), triangles_(triangles), among_(among), asked_(asked) {}

  TrianglePairs run() {
    sortIntoTiles();
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, first_.size() - 1, [&](std::size_t tile) {
      if (first_[tile + 1] > first_[tile]) searchTile(static_cast<std::uint32_t>(tile), scratches.local());
    });
    TrianglePairs all;
    for (const Scratch& s : scratches) all.insert(all.end(), s.found.begin(), s.found.end());
    std::ranges::sort(all);
    return all;
  }

 private:
  Item itemOf(std::uint32_t t) const {
    const glm::uvec3& v = triangles_[t];
    const glm::vec3 &a = positions_[v.x], &b = positions_[v.y], &c = positions_[v.z];
    return {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), t};
  }

  void layTiles() {
    using Range = tbb::blocked_range<std::size_t>;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const Item all = tbb::parallel_reduce(
        Range(0, among_.size(), kChunk), Item{glm::vec3(kFar), glm::vec3(-kFar), 0},
        [&](const Range& range, Item sum) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const Item one = itemOf(among_[i]);
            sum.low = glm::min(sum.low, one.low), sum.high = glm::max(sum.high, one.high);
          }
          return sum;
        },
        [](const Item& a, const Item& b) {
          return Item{glm::min(a.low, b.low), glm::max(a.high, b.high), 0};
        });
    tiles_ = Tiles::ofTriangles(all.low, all.high, among_.size());
  }

  template <class Work>
  void forEachItem(const Work& work) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, among_.size(), kChunk), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) work(itemOf(among_[i]));
    });
  }

  // The order in a tile may differ from run to run; what is found in it does not.
  void sortIntoTiles() {
    layTiles();
    const auto places = std::make_unique<std::atomic<std::uint32_t>[]>(tiles_.count());
    forEachItem([&](const Item& i) {
      tiles_.forEach(i.low, i.high,
                     [&](std::uint32_t tile) { places[tile].fetch_add(1, std::memory_order_relaxed); });
    });
    first_.assign(tiles_.count() + 1, 0);
    for (std::size_t i = 0; i < tiles_.count(); ++i) {
      first_[i + 1] = first_[i] + places[i];
      places[i] = first_[i];
    }
    sorted_.resize(first_.back());
    forEachItem([&](const Item& i) {
      tiles_.forEach(i.low, i.high, [&](std::uint32_t tile) {
        sorted_[places[tile].fetch_add(1, std::memory_order_relaxed)] = i.triangle;
      });
    });
  }

  /// Where the part of a tile is that is looked through: [low, high).
  struct Region {
    std::uint32_t tile;
    glm::vec3 low, high;
  };

  void searchTile(std::uint32_t tile, Scratch& s) const {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    s.items.clear();
    for (std::size_t i = first_[tile]; i < first_[tile + 1]; ++i) s.items.push_back(itemOf(sorted_[i]));
    search(s.items.data(), s.items.size(), {tile, glm::vec3(-kFar), glm::vec3(kFar)}, 0, s);
  }

  // Halves the triangles by their boxes' middles, those in between being in both halves, until few are left.
  void search(const Item* items, std::size_t count, const Region& region, std::size_t depth,
              Scratch& s) const {
    if (asked_ && std::none_of(items, items + count, [&](const Item& i) { return isAsked(i); })) return;
    if (count <= kFew) return compareAll(items, count, region, s);
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low), sum(0.0f);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 middle = 0.5f * (items[i].low + items[i].high);
      low = glm::min(low, middle), high = glm::max(high, middle), sum += middle;
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float at = sum[axis] / static_cast<float>(count);
    std::size_t below = 0, above = 0;
    for (std::size_t i = 0; i < count; ++i)
      below += items[i].low[axis] < at, above += items[i].high[axis] >= at;
    if (static_cast<double>(below + above) > kNoGain * static_cast<double>(count) ||
        std::max(below, above) == count)
      return compareAll(items, count, region, s);
    if (s.levels.size() <= depth) s.levels.resize(depth + 1);
    for (const bool upper : {false, true}) {
      std::vector<Item> half = std::move(s.levels[depth]);
      half.clear();
      for (std::size_t i = 0; i < count; ++i)
        if (upper ? items[i].high[axis] >= at : items[i].low[axis] < at) half.push_back(items[i]);
      Region part = region;
      (upper ? part.low : part.high)[axis] = at;
      search(half.data(), half.size(), part, depth + 1, s);
      s.levels[depth] = std::move(half);
    }
  }

  bool isAsked(const Item& item) const { return !asked_ || (*asked_)[item.triangle]; }

  void compareAll(const Item* items, std::size_t count, const Region& region, Scratch& s) const {
    for (std::size_t i = 0; i < count; ++i) {
      const Item& a = items[i];
      if (!isAsked(a)) continue;
      for (std::size_t k = asked_ ? 0 : i + 1; k < count; ++k) {
        const Item& b = items[k];
        const bool apart = (a.low.x > b.high.x) | (b.low.x > a.high.x) | (a.low.y > b.high.y) |
                           (b.low.y > a.high.y) | (a.low.z > b.high.z) | (b.low.z > a.high.z);
        // Of two that are asked for the first takes the pair.
        if (!apart && k != i && (k > i || !isAsked(b)) && isHere(glm::max(a.low, b.low), region))
          compare(a.triangle, b.triangle, s);
      }
      if (isHere(a.low, region) && hasNoArea(positions_, triangles_[a.triangle]))
        s.found.push_back({a.triangle, a.triangle});
    }
  }

  // Of all parts that two boxes share, one takes their pair: that with the lowest corner of what they share.
  bool isHere(const glm::vec3& p, const Region& r) const {
    return p.x >= r.low.x && p.x < r.high.x && p.y >= r.low.y && p.y < r.high.y && p.z >= r.low.z &&
           p.z < r.high.z && tiles_.at(p) == r.tile;
  }

  void compare(std::uint32_t a, std::uint32_t b, Scratch& s) const {
    if (cross(positions_, triangles_[a], triangles_[b]) && !hasNoArea(positions_, triangles_[a]) &&
        !hasNoArea(positions_, triangles_[b]))
      s.found.push_back({std::min(a, b), std::max(a, b)});
  }

  const std::vector<glm::vec3>& positions_;
  const std::vector<glm::uvec3>& triangles_;
  const std::vector<std::uint32_t>& among_;
  const std::vector<char>* asked_;
  Tiles tiles_;
  std::vector<std::uint32_t> first_;  // of each tile, in sorted_
  std::vector<std::uint32_t> sorted_;
};

}  // namespace

TrianglePairs crossingTriangles(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles) {
  const auto all =
      indicesThat(triangles.size(), [&](std::uint32_t triangle) { return !isGone(triangles[triangle]); });
  return Search(positions, triangles, all, nullptr).run();
}

TrianglePairs crossingTriangles(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles,
                                const std::vector<std::uint32_t>& among, const std::vector<char>& asked) {
  return Search(positions, triangles, among, &asked).run();
}

}  // namespace sdf
