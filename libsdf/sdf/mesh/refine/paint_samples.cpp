#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {
namespace {

using Index = SampledMesh::Index;

// The triangles around a vertex between two creases.
struct Sector {
  std::vector<Index> corners;  // half-edges out of the vertex
  Index largest;               // of the largest triangle
};

std::vector<Sector> sectorsAround(const HalfEdgeMesh& mesh, Index v) {
  Index first = mesh.outgoing(v);
  for (Index e = first;;) {
    if (mesh.isCrease(e)) first = e;
    e = mesh.turned(e);
    if (e == mesh.outgoing(v) || mesh.isCrease(first)) break;
  }
  std::vector<Sector> sectors;
  float largest = 0.0f;
  Index e = first;
  do {
    if (sectors.empty() || mesh.isCrease(e)) sectors.push_back({{}, e}), largest = 0.0f;
    sectors.back().corners.push_back(e);
    const auto [a, b, c] = mesh.corners(e - e % 3);
    if (const float area = glm::length(glm::cross(b - a, c - a)); area > largest)
      largest = area, sectors.back().largest = e;
    e = mesh.turned(e);
  } while (e != first);
  return sectors;
}

}  // namespace

// Samples that are as near to a border as this, which might be on its other side.
std::vector<char> SampledMesh::besideBorders(float away) const {
  std::vector<char> beside(samples.size(), 0);
  const auto mark = [&](Index crease, Index triangle) {
    const glm::vec3 from = mesh.positions[mesh.from(crease)], way = mesh.positions[mesh.to(crease)] - from;
    for (Index w = onTriangle.first(triangle); w != Lists::kNone; w = onTriangle.after(w)) {
      const glm::vec3 d = samples[w].at - from;
      const float t = glm::clamp(glm::dot(d, way) / glm::dot(way, way), 0.0f, 1.0f);
      if (glm::distance(d, t * way) < away) beside[w] = 1;
    }
  };
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    if (!mesh.isCrease(h)) continue;
    Index e = h;
    do {  // from either end, as its twin is a crease, too
      mark(h, e / 3);
      e = mesh.turned(e);
    } while (e != h);
  }
  return beside;
}

// Of each triangle a known sample, of those that lie in it or else in the next triangles that no crease parts
// from it. kNone: there is none up to the creases.
std::vector<Index> SampledMesh::knownNextTo(const std::vector<char>& isKnown) const {
  std::vector<Index> known(mesh.halfEdges() / 3, kNone), next;
  for (Index t = 0; t < known.size(); ++t)
    for (Index w = onTriangle.first(t); w != Lists::kNone && known[t] == kNone; w = onTriangle.after(w))
      if (isKnown[w]) known[t] = w, next.push_back(t);
  for (std::size_t i = 0; i < next.size(); ++i)
    for (Index h = 3 * next[i]; h < 3 * next[i] + 3; ++h)
      if (const Index t = mesh.twin(h) / 3; !mesh.isCrease(h) && known[t] == kNone)
        known[t] = known[next[i]], next.push_back(t);
  return known;
}

// Where a vertex's own colour is not known, and might be of the other side of a border, that of the next
// known sample between two creases, else what is seen in the largest triangle there.
void SampledMesh::paintSectors(const LocalField& field, Progress& progress, const std::vector<Paint>& paint,
                               const std::vector<Index>& known, Tints& own) const {
  std::vector<Sector> unseen;
  std::vector<glm::vec3> points;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.vertexAlive(v) || (isSmooth(v) && own.isKnown(v))) continue;
    for (Sector& s : sectorsAround(mesh, v)) {
      Index nearest = Lists::kNone;
      float least = HUGE_VALF;
      const auto look = [&](Index w) {
        const float d = glm::distance(samples[w].at, mesh.positions[v]);
        if (d < least) least = d, nearest = w;
      };
      for (const Index h : s.corners) {
        if (known[h / 3] != kNone) look(known[h / 3]);
        for (Index w = onTriangle.first(h / 3); w != Lists::kNone; w = onTriangle.after(w))
          if (own.isKnown(w)) look(w);
      }
      if (nearest != Lists::kNone) {
        if (isSmooth(v) && !differ(paint[v], paint[nearest])) continue;
        for (const Index h : s.corners) own.corners[h] = own.of(paint[nearest]);
        continue;
      }
      const auto [a, b, c] = mesh.corners(s.largest - s.largest % 3);
      points.push_back((a + b + c) / 3.0f);
      unseen.push_back(std::move(s));
    }
  }
  const std::vector<Paint> looked = readPaintBeside(points, field, progress);
  for (std::size_t i = 0; i < unseen.size(); ++i)
    for (const Index h : unseen[i].corners) own.corners[h] = own.of(looked[i]);
}

void SampledMesh::paint(const LocalField& field, float tolerance, Progress& progress) {
  std::vector<glm::vec3> points;
  for (const SurfaceSample& s : samples) points.push_back(s.at);
  const std::vector<Paint> paint = readPaintBeside(points, field, progress);
  Tints own(paint, tolerance);
  if (!own.any()) return;
  std::vector<Index> triangleOf(samples.size(), kNone);
  for (Index t = 0; t < mesh.halfEdges() / 3; ++t)
    for (Index w = onTriangle.first(t); w != Lists::kNone; w = onTriangle.after(w)) triangleOf[w] = t;
  const std::vector<char> beside = besideBorders(kBorderTolerances * tolerance);
  std::vector<char> isKnown(samples.size(), 0);
  const auto find = [&](const auto& isSure) {
    for (Index i = 0; i < samples.size(); ++i) {
      const Index t = triangleOf[i];
      isKnown[i] = t != kNone && (isKnown[i] || isSure(i, t)) &&
                   (!mesh.hasMaterials() || paint[i].material == mesh.material(3 * t));
    }
  };
  find([&](Index i, Index) { return !beside[i]; });
  // A crease that the paint does not jump at is no border.
  const std::vector<Index> known = knownNextTo(isKnown);
  find([&](Index i, Index t) { return known[t] != kNone && !differ(paint[i], paint[known[t]]); });
  for (Index i = 0; i < samples.size(); ++i) own.addSample(isKnown[i] ? &paint[i] : nullptr);
  own.corners.resize(mesh.halfEdges());
  for (Index h = 0; h < mesh.halfEdges(); ++h) own.corners[h] = own.of(paint[mesh.from(h)]);
  paintSectors(field, progress, paint, known, own);
  if (!progress.stopped()) tints = std::move(own);
}

}  // namespace sdf
