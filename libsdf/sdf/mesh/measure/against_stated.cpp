#include "sdf/mesh/measure/against_stated.h"

#include <algorithm>
#include <glm/common.hpp>

#include "sdf/mesh/measure/find_surface.h"
#include "sdf/mesh/measure/steepest.h"
#include "sdf/shape/catalog.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

// Times a slope that is stated: what is steeper refutes it. Chosen: far above the rounding of readings in
// double, and below what tears a mesh.
constexpr double kRefuted = 1.001;

// How far a point is beyond the sides of a box; negative inside.
double beyond(const Box& box, const glm::dvec3& p) {
  const glm::dvec3 d = glm::max(box.min - p, p - box.max);
  return std::max({d.x, d.y, d.z});
}

// Of a mesh that has this fault at a place.
MeshFault blamed(const std::string& fault, const glm::dvec3& at, const MeasuredMesh& m,
                 const ModelTapes& model) {
  const double reach = std::max(kFarthestVoxels * m.voxel, m.stats.maxDistance);
  const Steepest steepest = steepestAround(at, reach, *model.whole());
  const std::string is = "the mesh is " + fault + shownPlace(at + m.origin);
  if (steepest.slope > kRefuted * model.slope())
    return {is + ": near " + shownPlace(steepest.at + m.origin) + " the distance changes by " +
                shown(steepest.slope) + " a unit of length, and what is stated of the shape allows " +
                shown(model.slope()) + ". Enlarge the lipschitz of its field, or leave it out",
            at};
  return {is + ", though nothing that is stated of the shape is seen to be false there; take a smaller voxel "
               "size",
          at};
}

}  // namespace

std::string shownPlace(const glm::dvec3& p) {
  return "(" + shown(p.x) + ", " + shown(p.y) + ", " + shown(p.z) + ")";
}

std::optional<glm::vec3> farthestOutside(std::span<const glm::vec3> points, const Box& bounds,
                                         double allowed) {
  std::optional<glm::vec3> outside;
  for (const glm::vec3& p : points)
    if (const double d = beyond(bounds, p); d > allowed) allowed = d, outside = p;
  return outside;
}

std::optional<MeshFault> leavesBounds(const MeasuredMesh& m) {
  // Refinement may move a vertex by a voxel, simplifying by the tolerance, and the surface be as far from it.
  const double near = std::max(m.voxel, m.stats.tolerance);
  double farthest = near;
  const glm::vec3* outside = nullptr;
  for (std::size_t i = 0; i < m.mesh.positions.size(); ++i)
    if (const double d = beyond(m.bounds, m.mesh.positions[i]); d > farthest && m.distances[i] < near)
      farthest = d, outside = &m.mesh.positions[i];
  if (!outside) return {};
  return MeshFault{"the surface leaves the bounds " + shownPlace(m.bounds.min + m.origin) + " to " +
                       shownPlace(m.bounds.max + m.origin) + " that are stated for it, at " +
                       shownPlace(glm::dvec3(*outside) + m.origin) +
                       "; enlarge the bounds of its field, leave them out, or intersect it with a box",
                   *outside};
}

std::optional<MeshFault> faultOf(const MeasuredMesh& m, const ModelTapes& model) {
  if (auto outside = leavesBounds(m)) return outside;
  const double off = m.stats.maxDistance;
  if (!m.stats.watertight)
    return blamed("torn open at ", m.mesh.positions[*openVertex(m.mesh.triangles, m.mesh.positions.size())],
                  m, model);
  if (off > std::max(kFarthestVoxels * m.voxel, m.stats.tolerance))
    return blamed("off by about " + shown(off) + ", " + shown(off / m.voxel) + " voxels, at ",
                  m.stats.farthest, m, model);
  return {};
}

}  // namespace sdf
