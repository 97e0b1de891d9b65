#include "sdf/mesh/refine/flip.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "sdf/mesh/refine/ring.h"

namespace sdf {
namespace {

using Index = SampledMesh::Index;

// A flip has to lessen what it lessens by so much: otherwise two may take turns.
constexpr float kLess = 0.98f;

glm::vec3 areaOf(const Corners& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); }

// Twice the area over the longest side's square.
float flatness(const Corners& t) {
  const glm::vec3 u = t[1] - t[0], v = t[2] - t[1], w = t[0] - t[2];
  const float longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  return longest > 0.0f ? glm::length(areaOf(t)) / longest : 0.0f;
}

}  // namespace

bool flipIfBetter(SampledMesh& sampled, CrowdedTriangles& crowded, Index h, float flat, std::uint8_t block) {
  const HalfEdgeMesh& mesh = sampled.mesh;
  const Index g = mesh.twin(h);
  const auto at = [&](Index v) { return mesh.positions[v]; };
  const glm::vec3 a = at(mesh.from(h)), b = at(mesh.to(h)), c = at(mesh.apex(h)), d = at(mesh.apex(g));
  const Corners before[2] = {{a, b, c}, {b, a, d}}, after[2] = {{d, c, a}, {c, d, b}};
  const glm::vec3 normal = glm::normalize(areaOf(before[0]) + areaOf(before[1]));
  for (int side = 0; side < 2; ++side) {
    const glm::vec3 area = areaOf(after[side]),
                    around = sampled.meanNormal({mesh.apex(h), mesh.apex(g), mesh.from(side ? g : h)});
    if (!(flatness(after[side]) > 2.0f * kFlattest) || !isFacing(area, normal)) return false;
    if (!isNone(around) && !isFacing(area, around)) return false;
  }
  const Tints& tints = sampled.tints;
  Tint tint[4]{};  // of a, b, c, d
  if (tints.any())
    for (int k = 0; k < 4; ++k)
      tint[k] = tints.corners[std::array{h, mesh.next(h), mesh.previous(h), mesh.previous(g)}[k]];
  const std::array<const Tint*, 3> tintsBefore[2] = {{&tint[0], &tint[1], &tint[2]},
                                                     {&tint[1], &tint[0], &tint[3]}},
                                   tintsAfter[2] = {{&tint[3], &tint[2], &tint[0]},
                                                    {&tint[2], &tint[3], &tint[1]}};
  // With what a colour's difference counts as.
  const auto off = [&](const OverTriangle& o, Index sample, const std::array<const Tint*, 3>& t) {
    if (!tints.any()) return o.distance;
    return std::max(o.distance,
                    tints.distance(sample, mixed(*t[0], *t[1], *t[2], clampedWeights(o.weights))));
  };
  float was = 0.0f, is = 0.0f;
  std::vector<std::pair<Index, Index>> handed;  // samples, and half-edges of the triangles that get them
  for (int side = 0; side < 2; ++side)
    for (Index w = sampled.onTriangle.first((side ? g : h) / 3); w != Lists::kNone;
         w = sampled.onTriangle.after(w)) {
      was = std::max(was, off(over(sampled.samples[w].at, before[side]), w, tintsBefore[side]));
      handed.emplace_back(w, h);
    }
  const float most = std::max(flat, kLess * was);
  for (auto& [w, to] : handed) {
    const SurfaceSample& sample = sampled.samples[w];
    const OverTriangle first = over(sample.at, after[0]), second = over(sample.at, after[1]);
    const bool toFirst = first.inside > second.inside;
    if (!isNone(sample.normal) && !isFacing(areaOf(after[toFirst ? 0 : 1]), sample.normal)) return false;
    to = toFirst ? h : g;
    is = std::max(is, toFirst ? off(first, w, tintsAfter[0]) : off(second, w, tintsAfter[1]));
    if (!(is < most)) return false;
  }
  const bool isFlat = std::max(is, was) < flat;
  const float shape = std::min(flatness(after[0]), flatness(after[1])),
              shapeBefore = std::min(flatness(before[0]), flatness(before[1]));
  if (isFlat ? !(kLess * shape > shapeBefore) : !(is < kLess * was)) return false;
  if (crowded.wouldCross(h, block)) return false;
  sampled.onTriangle.clear(h / 3), sampled.onTriangle.clear(g / 3);
  sampled.flip(h);
  crowded.flipped(h);
  for (const auto& [sample, to] : handed) sampled.onTriangle.add(to / 3, sample);
  return true;
}

}  // namespace sdf
