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

// The colour of the next known sample between two creases, else what is seen in the largest triangle there.
void SampledMesh::paintSectors(const LocalField& field, Progress& progress, const std::vector<Paint>& paint,
                               Tints& own) const {
  std::vector<Sector> unseen;
  std::vector<glm::vec3> points;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.vertexAlive(v) || isSmooth(v)) continue;
    for (Sector& s : sectorsAround(mesh, v)) {
      Index nearest = Lists::kNone;
      float least = HUGE_VALF;
      for (const Index h : s.corners)
        for (Index w = onTriangle.first(h / 3); w != Lists::kNone; w = onTriangle.after(w)) {
          if (!own.isKnown(w)) continue;
          const float d = glm::distance(samples[w].at, mesh.positions[v]);
          if (d < least) least = d, nearest = w;
        }
      if (nearest != Lists::kNone) {
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
  for (Index i = 0; i < samples.size(); ++i) {
    const bool isKnown = triangleOf[i] != kNone && !beside[i] &&
                         (!mesh.hasMaterials() || paint[i].material == mesh.material(3 * triangleOf[i]));
    own.addSample(isKnown ? &paint[i] : nullptr);
  }
  own.corners.resize(mesh.halfEdges());
  for (Index h = 0; h < mesh.halfEdges(); ++h)
    if (isSmooth(mesh.from(h))) own.corners[h] = own.of(paint[mesh.from(h)]);
  paintSectors(field, progress, paint, own);
  if (!progress.stopped()) tints = std::move(own);
}

}  // namespace sdf
