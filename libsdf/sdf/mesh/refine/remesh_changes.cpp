#include "sdf/mesh/refine/remesh_changes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/mesh/refine/remesh_paint.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {

namespace {

float halfExtent(const std::vector<glm::vec3>& positions) {
  glm::vec3 low(HUGE_VALF), high(-HUGE_VALF);
  for (const glm::vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec3 half = 0.5f * (high - low);
  return std::max({half.x, half.y, half.z});
}

}  // namespace

RemeshChanges::RemeshChanges(HalfEdgeMesh& mesh, const LocalField& field, double tolerance, bool painted,
                             Progress& progress)
    : mesh_(mesh),
      field_(field),
      tolerance_(static_cast<float>(tolerance)),
      size_(halfExtent(mesh.positions)),
      painted_(painted),
      progress_(progress) {
  grow();
  readNormals();
}

void RemeshChanges::setTolerance(double tolerance) {
  tolerance_ = static_cast<float>(tolerance);
  lastFlips_ = lastSplits_ = 0;
  std::fill(tried_.begin(), tried_.end(), 0);
  std::fill(settled_.begin(), settled_.end(), 0);
}

void RemeshChanges::evaluate(const Fans& fans, Sampling sampling, std::vector<FanError>& errors) const {
  evaluateFans(fans, tolerance_, sampling, field_, progress_, errors);
  if (painted_ && !progress_.stopped()) addPaintErrors(fans, tolerance_, field_, progress_, errors);
}

std::vector<FanError> RemeshChanges::lookClosely(const Fans& fans,
                                                 const std::vector<std::uint32_t>& some) const {
  Fans chosen;
  chosen.rim = fans.rim;
  for (const std::uint32_t i : some) chosen.all.push_back(fans.all[i]);
  std::vector<FanError> errors;
  evaluateFans(chosen, tolerance_, Sampling::All, field_, progress_, errors);
  return errors;
}

void RemeshChanges::grow() {
  claimed_.resize(mesh_.halfEdges() / 3, 0);
  tried_.resize(mesh_.halfEdges(), 0);
  changed_.resize(mesh_.vertices(), round_);
  settled_.resize(mesh_.vertices(), 0);
  normals_.resize(mesh_.vertices(), glm::vec3(0.0f));
}

void RemeshChanges::readNormals() {
  forEachRun(
      mesh_.vertices(), [&](std::size_t i) { return mesh_.positions[i]; }, field_, progress_,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) normals_[run.first + i] = g.normal(i);
      });
}

// Marks the triangles around v for this round; false where one is marked already.
bool RemeshChanges::claim(std::uint32_t v) {
  const std::uint32_t first = mesh_.outgoing(v);
  std::uint32_t h = first;
  do {
    if (claimed_[h / 3] == round_) return false;
    h = mesh_.turned(h);
  } while (h != first);
  do {
    claimed_[h / 3] = round_;
    h = mesh_.turned(h);
  } while (h != first);
  return true;
}

// The same for all triangles at an edge's ends.
bool RemeshChanges::claimEdge(std::uint32_t h) {
  const std::uint32_t u = mesh_.from(h), v = mesh_.to(h);
  std::uint32_t e = mesh_.turned(h);
  for (; e != h; e = mesh_.turned(e))
    if (claimed_[e / 3] == round_) return false;
  if (!claim(v)) return false;
  for (e = mesh_.turned(h); e != h; e = mesh_.turned(e)) claimed_[e / 3] = round_;
  claimed_[mesh_.outgoing(u) / 3] = round_;
  return true;
}

// Notes that the triangles around v have changed.
void RemeshChanges::touch(std::uint32_t v) {
  changed_[v] = round_;
  std::uint32_t h = mesh_.outgoing(v);
  do {
    changed_[mesh_.to(h)] = round_;
    h = mesh_.turned(h);
  } while (h != mesh_.outgoing(v));
}

void RemeshChanges::moveToOffsets(Fans& fans, const std::vector<FanError>& errors) const {
  for (std::size_t i = 0; i < fans.all.size(); ++i)
    if (fans.all[i].centred) fans.all[i].centre += errors[i].offset;
}

}  // namespace sdf
