#include "sdf/mesh/edit/half_edges.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cassert>

namespace sdf {
namespace {

struct Side {
  std::uint32_t low, high, half;
  auto operator<=>(const Side&) const = default;
};

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(const FeatureMesh& mesh)
    : positions(mesh.positions),
      twin_(3 * mesh.triangles.size()),
      out_(mesh.positions.size(), kNone),
      materials_(mesh.materials),
      crease_(3 * mesh.triangles.size(), 0),
      creases_(mesh.positions.size(), 0),
      tips_(mesh.tips),
      live_(mesh.triangles.size()) {
  from_.reserve(twin_.size());
  std::vector<Side> sides;
  sides.reserve(twin_.size());
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto h = static_cast<Index>(from_.size());
      from_.push_back(t[k]);
      out_[t[k]] = h;
      sides.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]), h});
    }
  tbb::parallel_sort(sides);
  std::size_t crease = 0;
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Side &a = sides[i], &b = sides[i + 1];
    assert(a.low == b.low && a.high == b.high);
    pair(a.half, b.half);
    const std::array<Index, 2> edge{a.low, a.high};
    while (crease < mesh.creases.size() && mesh.creases[crease] < edge) ++crease;
    if (crease == mesh.creases.size() || mesh.creases[crease] != edge) continue;
    crease_[a.half] = crease_[b.half] = 1;
    for (const Index v : edge) creases_[v] = static_cast<std::uint8_t>(std::min(creases_[v] + 1, 3));
  }
  for (Index v = 0; v < tips_.size(); ++v)
    if (tips_[v]) creases_[v] = 3;
}

FeatureMesh HalfEdgeMesh::compacted() const {
  FeatureMesh mesh;
  mesh.positions = positions, mesh.tips = tips_;
  for (Index h = 0; h < from_.size(); h += 3) {
    if (!alive(h)) continue;
    mesh.triangles.emplace_back(from_[h], from_[h + 1], from_[h + 2]);
    if (hasMaterials()) mesh.materials.push_back(material(h));
  }
  for (Index h = 0; h < from_.size(); ++h)
    if (alive(h) && isCrease(h) && from(h) < to(h)) mesh.creases.push_back({from(h), to(h)});
  std::ranges::sort(mesh.creases);
  dropUnused(mesh);
  return mesh;
}

bool HalfEdgeMesh::adjacent(Index u, Index v) const {
  Index h = out_[u];
  do {
    if (to(h) == v) return true;
    h = turned(h);
  } while (h != out_[u]);
  return false;
}

bool HalfEdgeMesh::canCollapse(Index h) const {
  const Index u = from(h), v = to(h), g = twin(h);
  if (creases_[u] == 2 ? !isCrease(h) : creases_[u] != 0) return false;
  // The sides that come to lie on each other: from u, and from v, to the corner across.
  if (isCrease(previous(h)) && isCrease(next(h))) return false;
  if (isCrease(previous(g)) && isCrease(next(g))) return false;
  // A vertex across with three neighbours would keep two.
  for (const Index e : {previous(h), previous(g)})
    if (turned(turned(turned(e))) == e) return false;
  // Common neighbours: the two vertices across, and no other.
  const Index first = turned(h);  // u to apex(h)
  for (Index e = turned(first); to(e) != apex(g); e = turned(e))
    if (adjacent(to(e), v)) return false;
  return apex(h) != apex(g);
}

void HalfEdgeMesh::collapse(Index h) {
  const Index u = from(h), v = to(h), g = twin(h);
  Index e = h;
  do {
    from_[e] = v;
    e = turned(e);
  } while (e != h);
  for (const Index side : {h, g}) {
    const Index n = twin(next(side)), p = twin(previous(side));
    pair(n, p);
    crease_[n] = crease_[p] = crease_[n] | crease_[p];
    out_[from_[n]] = n;
    out_[from_[p]] = p;
    const Index t = side - side % 3;
    from_[t] = from_[t + 1] = from_[t + 2] = kNone;
  }
  out_[u] = kNone;
  std::atomic_ref(live_).fetch_sub(2, std::memory_order_relaxed);
}

bool HalfEdgeMesh::canFlip(Index h) const {
  return !isCrease(h) && apex(h) != apex(twin(h)) && !adjacent(apex(h), apex(twin(h)));
}

// Names a triangle's corners; its first side is h.
void HalfEdgeMesh::set(Index h, Index a, Index b, Index c) {
  from_[h] = a, from_[next(h)] = b, from_[previous(h)] = c;
  out_[a] = h, out_[b] = next(h), out_[c] = previous(h);
}

void HalfEdgeMesh::flip(Index h) {
  const Index g = twin(h), a = from(h), b = to(h), c = apex(h), d = apex(g);
  const Index bc = twin(next(h)), ca = twin(previous(h)), ad = twin(next(g)), db = twin(previous(g));
  const std::uint8_t sides[4] = {crease_[bc], crease_[ca], crease_[ad], crease_[db]};
  set(h, d, c, a);  // d c, c a, a d
  set(g, c, d, b);  // c d, d b, b c
  pair(h, g);
  pair(next(h), ca), pair(previous(h), ad), pair(next(g), db), pair(previous(g), bc);
  crease_[h] = crease_[g] = 0;
  crease_[previous(g)] = sides[0], crease_[next(h)] = sides[1], crease_[previous(h)] = sides[2],
  crease_[next(g)] = sides[3];
}

HalfEdgeMesh::Index HalfEdgeMesh::split(Index h, const glm::vec3& p) {
  const auto m = static_cast<Index>(out_.size());
  const Index g = twin(h), b = to(h), c = apex(h), d = apex(g);
  const Index bc = twin(next(h)), db = twin(previous(g));
  const auto x = static_cast<Index>(from_.size()), y = x + 3;  // triangles m b c and b m d
  const std::uint8_t crease = crease_[h], atC = crease_[bc], atD = crease_[db];
  positions.push_back(p);
  out_.push_back(h);
  creases_.push_back(crease ? 2 : 0);
  if (hasMaterials()) {
    const int first = material(h), second = material(g);
    materials_.push_back(first), materials_.push_back(second);
  }
  from_.resize(x + 6), twin_.resize(x + 6), crease_.resize(x + 6, 0);
  set(x, m, b, c), set(y, b, m, d);
  from_[next(h)] = m, from_[g] = m;
  out_[from_[h]] = h, out_[b] = y, out_[m] = x;
  pair(x, y), pair(x + 1, bc), pair(x + 2, next(h)), pair(y + 1, previous(g)), pair(y + 2, db);
  crease_[x] = crease_[y] = crease;
  crease_[x + 1] = atC, crease_[y + 2] = atD;
  crease_[next(h)] = crease_[previous(g)] = 0;
  live_ += 2;
  return m;
}

}  // namespace sdf
