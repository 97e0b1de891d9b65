#include "sdf/triangles/closed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <unordered_map>

#include "sdf/base/flat_map.h"
#include "sdf/triangles/incidence.h"
#include "sdf/triangles/polygon.h"
#include "sdf/triangles/triangle_pairs.h"

namespace sdf {
namespace {

using Triangles = std::vector<glm::uvec3>;

constexpr float kJoin = 1e-5f;  // of the mesh's size: how far apart points of borders may be that are one

std::uint64_t directed(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

struct SamePlace {
  std::size_t operator()(const glm::vec3& p) const {
    std::uint32_t bits[3];
    std::memcpy(bits, &p, sizeof bits);
    std::uint64_t h = bits[0];
    for (const std::uint32_t more : {bits[1], bits[2]}) h = (h ^ more) * 0x9e3779b97f4a7c15ull;
    return h ^ h >> 29;
  }
};

/// Gives corners new numbers, and drops the triangles that lose a corner or have no area then.
void renumber(const std::vector<std::uint32_t>& becomes, ClosedTriangles& out) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    const glm::uvec3& old = out.triangles[i];
    const glm::uvec3 t(becomes[old.x], becomes[old.y], becomes[old.z]);
    if (t.x == t.y || t.y == t.z || t.z == t.x || hasNoArea(out.points, t)) continue;
    out.triangles[kept] = t;
    out.source[kept++] = out.source[i];
  }
  out.triangles.resize(kept);
  out.source.resize(kept);
}

void join(const TriangleMesh& mesh, ClosedTriangles& out) {
  std::unordered_map<glm::vec3, std::uint32_t, SamePlace> placeOf;
  placeOf.reserve(mesh.positions.size());
  std::vector<std::uint32_t> pointOf;
  pointOf.reserve(mesh.positions.size());
  for (const glm::vec3& at : mesh.positions) {
    const glm::vec3 p = at + 0.0f;  // -0 is 0
    const auto [place, fresh] = placeOf.try_emplace(p, static_cast<std::uint32_t>(out.points.size()));
    if (fresh) out.points.push_back(p);
    pointOf.push_back(place->second);
  }
  out.triangles = mesh.triangles;
  out.source.resize(mesh.triangles.size());
  std::iota(out.source.begin(), out.source.end(), 0u);
  renumber(pointOf, out);
}

enum class Left : char { Gone, Alone, Alike };

/// Of triangles with the same corners takes out as many that are turned one way as are turned the other way,
/// for nothing lies between them; and of the others it leaves so many at most. Returns which are left, alone
/// or with others alike.
std::vector<Left> mergeAlike(ClosedTriangles& out, std::size_t most) {
  struct Place {
    glm::uvec3 corners;  // the least first
    std::uint32_t triangle;
    int way;
  };
  std::vector<Place> places;
  places.reserve(out.triangles.size());
  for (std::uint32_t i = 0; i < out.triangles.size(); ++i) {
    glm::uvec3 t = out.triangles[i];
    while (t.x > t.y || t.x > t.z) t = {t.y, t.z, t.x};
    places.push_back({{t.x, std::min(t.y, t.z), std::max(t.y, t.z)}, i, t.y < t.z ? 1 : -1});
  }
  const auto key = [](const Place& p) {
    return std::array{p.corners.x, p.corners.y, p.corners.z, p.triangle};
  };
  std::ranges::sort(places, {}, key);
  std::vector<Left> left(out.triangles.size(), Left::Gone);
  for (auto first = places.begin(), end = first; first != places.end(); first = end) {
    int sum = 0;
    std::size_t fromMesh = 0;
    for (; end != places.end() && end->corners == first->corners; ++end) {
      sum += end->way;
      fromMesh += end->triangle < out.source.size();
    }
    const std::size_t count = std::min(static_cast<std::size_t>(std::abs(sum)), most);
    std::size_t some = 0;
    for (auto p = first; p != end && some < count; ++p) {
      if (p->way * sum < 0) continue;
      left[p->triangle] = count > 1 ? Left::Alike : Left::Alone;
      fromMesh -= p->triangle < out.source.size();
      ++some;
    }
    (count > 0 ? out.repeated : out.films) += fromMesh;
  }
  std::size_t kept = 0, keptOfMesh = 0;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    if (left[i] == Left::Gone) continue;
    out.triangles[kept++] = out.triangles[i];
    if (i < out.source.size()) out.source[keptOfMesh++] = out.source[i];
  }
  out.triangles.resize(kept);
  out.source.resize(keptOfMesh);
  return left;
}

/// Calls f(a, b) for each edge of each triangle, the way that it runs.
template <class F>
void forEdges(const Triangles& triangles, F f) {
  for (const glm::uvec3& t : triangles)
    for (int k = 0; k < 3; ++k) f(t[k], t[(k + 1) % 3]);
}

/// By how many more triangles go along an edge one way than the other: from the lower point to the higher
/// one.
FlatMap<int> balances(const Triangles& triangles) {
  FlatMap<int> balance;
  forEdges(triangles, [&](std::uint32_t a, std::uint32_t b) {
    balance.insert(edgeKey(a, b), 0).first += a < b ? 1 : -1;
  });
  return balance;
}

/// The edges that would close the triangles, each as often as it is needed.
std::vector<std::array<std::uint32_t, 2>> missingEdges(const Triangles& triangles) {
  FlatMap<int> balance = balances(triangles);
  std::vector<std::array<std::uint32_t, 2>> missing;
  forEdges(triangles, [&](std::uint32_t a, std::uint32_t b) {
    int& more = balance.insert(edgeKey(a, b), 0).first;
    const int way = a < b ? 1 : -1;
    for (; more * way > 0; more -= way) missing.push_back({b, a});
  });
  return missing;
}

/// Moves points of borders that are near one another to one place, in the order of their numbers.
void joinBorders(ClosedTriangles& out) {
  const auto missing = missingEdges(out.triangles);
  if (missing.empty()) return;
  glm::vec3 least(out.points[0]), most = least;
  for (const glm::vec3& p : out.points) least = glm::min(least, p), most = glm::max(most, p);
  const float reach = kJoin * glm::length(most - least);
  std::vector<std::uint32_t> border;
  for (const auto& edge : missing) border.push_back(edge[0]);
  std::ranges::sort(border);
  border.erase(std::unique(border.begin(), border.end()), border.end());
  const auto cellOf = [&](const glm::vec3& p, const glm::ivec3& beside) {
    const glm::vec3 cell = glm::floor((p - least) / (2.0f * reach)) + glm::vec3(beside);
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key = key * 0x100003u + static_cast<std::uint64_t>(cell[k] + 2.0f);
    return key;
  };
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  std::vector<std::uint32_t> becomes(out.points.size());
  std::iota(becomes.begin(), becomes.end(), 0u);
  const auto joined = [&](std::uint32_t i) {
    for (int side = 0; side < 27; ++side) {
      const auto near = cells.find(cellOf(out.points[i], {side % 3 - 1, side / 3 % 3 - 1, side / 9 - 1}));
      if (near == cells.end()) continue;
      for (const std::uint32_t other : near->second)
        if (glm::distance(out.points[i], out.points[other]) <= reach) return becomes[i] = other, true;
    }
    return false;
  };
  for (const std::uint32_t i : border)
    if (!joined(i)) cells[cellOf(out.points[i], glm::ivec3(0))].push_back(i);
  renumber(becomes, out);
}

/// Turns triangles over until neighbours across edges of two run the same way around; of each patch as few
/// as can be.
void orient(ClosedTriangles& out) {
  struct Pair {
    std::uint32_t first = 0, second = 0;
    int count = 0;
  };
  Triangles& triangles = out.triangles;
  FlatMap<Pair> pairs;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      Pair& pair = pairs.insert(edgeKey(triangles[i][k], triangles[i][(k + 1) % 3]), Pair()).first;
      (pair.count == 0 ? pair.first : pair.second) = i;
      ++pair.count;
    }
  const auto runs = [&](std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    for (int k = 0; k < 3; ++k)
      if (triangles[i][k] == a && triangles[i][(k + 1) % 3] == b) return true;
    return false;
  };
  constexpr char kUnseen = 2;
  std::vector<char> over(triangles.size(), kUnseen);
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (over[seed] != kUnseen) continue;
    std::vector<std::uint32_t> patch{seed};
    over[seed] = 0;
    std::size_t turned = 0;
    for (std::size_t next = 0; next < patch.size(); ++next)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t i = patch[next], a = triangles[i][k], b = triangles[i][(k + 1) % 3];
        const Pair& pair = pairs.insert(edgeKey(a, b), Pair()).first;
        if (pair.count != 2) continue;
        const std::uint32_t other = pair.first == i ? pair.second : pair.first;
        if (over[other] != kUnseen) continue;
        over[other] = runs(other, a, b) ? 1 - over[i] : over[i];
        turned += over[other];
        patch.push_back(other);
      }
    const char most = 2 * turned > patch.size() ? 1 : 0;
    for (const std::uint32_t i : patch) {
      if (over[i] == most) continue;
      std::swap(triangles[i].y, triangles[i].z);
      ++out.turned;
    }
  }
}

/// Takes the loops apart that the edges form: each point of a loop once.
std::vector<std::vector<std::uint32_t>> loopsOf(std::vector<std::array<std::uint32_t, 2>> edges) {
  std::ranges::sort(edges);
  const auto firstOf = [&](std::uint32_t point) {
    return static_cast<std::size_t>(std::ranges::lower_bound(edges, std::array<std::uint32_t, 2>{point, 0}) -
                                    edges.begin());
  };
  std::vector<std::size_t> next(edges.size());  // by a point's first edge: the one to be taken next
  std::iota(next.begin(), next.end(), std::size_t{0});
  std::vector<std::vector<std::uint32_t>> loops;
  std::unordered_map<std::uint32_t, std::size_t> placeOf;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    const std::uint32_t from = edges[start][0];
    const auto open = [&](std::uint32_t point) {
      const std::size_t edge = next[firstOf(point)];
      return edge < edges.size() && edges[edge][0] == point;
    };
    std::vector<std::uint32_t> path{from};
    placeOf.emplace(from, 0);
    while (open(path.back())) {
      const std::uint32_t to = edges[next[firstOf(path.back())]++][1];
      const auto [place, fresh] = placeOf.try_emplace(to, path.size());
      if (fresh) {
        path.push_back(to);
        continue;
      }
      const auto begin = path.begin() + static_cast<std::ptrdiff_t>(place->second);
      loops.emplace_back(begin, path.end());
      for (auto point = begin + 1; point != path.end(); ++point) placeOf.erase(*point);
      path.erase(begin + 1, path.end());
    }
    for (const std::uint32_t point : path) placeOf.erase(point);
  }
  return loops;
}

/// Closes the loops that the borders form. One that is closed by what was left out before is no hole, and
/// what only closes a triangle from behind is a film.
void closeLoops(ClosedTriangles& out) {
  const auto loops = loopsOf(missingEdges(out.triangles));
  if (loops.empty()) return;
  std::vector<std::size_t> begins{out.triangles.size()};
  for (const auto& loop : loops) {
    cutPolygon(out.points, loop, out.triangles);
    begins.push_back(out.triangles.size());
  }
  const std::vector<Left> left = mergeAlike(out, out.triangles.size());
  for (std::size_t i = 0; i < loops.size(); ++i)
    out.holes += std::any_of(left.begin() + static_cast<std::ptrdiff_t>(begins[i]),
                             left.begin() + static_cast<std::ptrdiff_t>(begins[i + 1]),
                             [](Left one) { return one == Left::Alone; });
  out.repeated -= static_cast<std::size_t>(
      std::count(left.begin() + static_cast<std::ptrdiff_t>(begins.front()), left.end(), Left::Alike));
}

/// Has every edge two triangles, one each way, and every point one fan?
bool isManifold(const ClosedTriangles& all) {
  FlatMap<std::uint32_t> third;  // by a directed edge: the point across, plus 1
  for (const glm::uvec3& t : all.triangles)
    for (int k = 0; k < 3; ++k)
      if (!third.insert(directed(t[k], t[(k + 1) % 3]), t[(k + 2) % 3] + 1).second) return false;
  std::vector<std::uint32_t> corners(all.points.size(), 0);
  for (const glm::uvec3& t : all.triangles)
    for (int k = 0; k < 3; ++k) ++corners[t[k]];
  std::vector<char> seen(all.points.size(), 0);
  for (const glm::uvec3& t : all.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t hub = t[k];
      if (seen[hub]) continue;
      seen[hub] = 1;
      std::uint32_t fan = 0;
      for (std::uint32_t rim = t[(k + 1) % 3], first = rim; fan == 0 || rim != first; ++fan) {
        const std::uint32_t across = third.insert(directed(hub, rim), 0).first;
        if (across == 0 || fan > corners[hub]) return false;
        rim = across - 1;
      }
      if (fan != corners[hub]) return false;
    }
  return true;
}

}  // namespace

ClosedTriangles closed(const TriangleMesh& mesh) {
  ClosedTriangles out;
  join(mesh, out);
  mergeAlike(out, 1);
  if (out.triangles.empty()) return out;
  joinBorders(out);
  orient(out);
  closeLoops(out);
  out.manifold = isManifold(out);
  return out;
}

}  // namespace sdf
