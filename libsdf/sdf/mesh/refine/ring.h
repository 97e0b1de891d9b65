// The triangles around a vertex, as they are or as a change would make them, and how far they are from the
// samples of the surface that they would have.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/mesh/refine/sampled_mesh.h"

namespace sdf {

/// Twice a triangle's area over its longest side's square, below which it is a needle whose normal the
/// rounding of floats would turn.
inline constexpr float kFlattest = 1e-3f;

/// Numbers from lo to hi; none if lo is above hi.
struct Range {
  float lo = -HUGE_VALF, hi = HUGE_VALF;
  void cut(float from, float to) { lo = std::max(lo, from), hi = std::min(hi, to); }
  bool empty() const { return !(lo <= hi); }
  /// 0 where an end is open.
  float middle() const { return std::isfinite(lo) && std::isfinite(hi) ? 0.5f * (lo + hi) : 0.0f; }
};

/// Where |height - weight * t| is within the limit.
Range feasibleAlong(float height, float weight, float limit);
/// Where |off - weight * t * way| is, for a unit way or none.
Range feasibleAlong(const glm::vec3& off, float weight, const glm::vec3& way, float limit);

/// The symmetric matrix (x y; y z) with the same eigenvectors and its eigenvalues without their signs.
glm::dvec3 absolute(const glm::dvec3& form);

/// Spokes from a centre to the vertices around it, counter-clockwise. Those that are creases cut the ring
/// into sectors, and samples stay in theirs. The centre may go along a way: along the normal on a smooth
/// piece, to where a crease bends on that, nowhere at corners.
class Ring {
 public:
  using Index = SampledMesh::Index;
  static constexpr Index kNone = SampledMesh::kNone;

  /// The centre itself is to be no farther from the surface than the tolerance.
  Ring(SampledMesh& sampled, float tolerance) : sampled_(sampled), tolerance_(tolerance), aim_(tolerance) {}

  /// The triangles at v.
  void setAround(Index v);
  /// Those at to(h) once from(h) is merged into it.
  void setCollapsed(Index h);
  /// Those at a vertex that is put into an edge.
  void setSplit(Index h);
  /// Within what distance samples are to come: what colours are chosen for.
  void aimAt(float limit) { aim_ = limit; }
  /// May triangles be turned by more than 60 degrees from their sector's normal, as long as samples face
  /// them?
  void mayBend(bool may) { mayBend_ = may; }
  /// Are triangles with samples to face the normals at their vertices, too, as those without do?
  void faceNormals(bool face) { facesNormals_ = face; }
  std::size_t size() const { return spokes_.size(); }
  /// The vertex in the middle; of a split the one that is to be made.
  Index centre() const { return centreVertex_; }
  /// Those that the ring's are made of, and those that are to be made.
  std::vector<Index> triangles() const;
  Index vertex(std::size_t i) const { return spokes_[i].vertex; }
  bool isCrease(std::size_t i) const { return spokes_[i].crease; }
  const glm::vec3& position(std::size_t i) const { return spokes_[i].at; }
  /// How many spokes are creases.
  int creases() const { return creases_; }
  bool isSmooth() const { return creases_ == 0; }

  /// Cuts the ring into sectors, whose normals are those of their triangles with the centre there. Once after
  /// each of the above. False: a sector has no area.
  bool cut(const glm::vec3& centre);
  /// Puts the centre there and gives each triangle its samples. False: a triangle is a needle or more than 60
  /// degrees (90 at tips) from its sector's normal, or 60 from that of a sample, or a sample lies in none.
  /// With a limit also: a sample could not come within it, wherever on its way the centre is.
  bool place(const glm::vec3& centre, float limit = HUGE_VALF);
  /// Where on its way, from where it is, the centre has all samples within the limit, to first order on a
  /// crease. Precondition: place.
  Range feasible(float limit) const;
  /// Where on its way the largest distance is least.
  float balanced() const;
  /// Scene units.
  const glm::vec3& way() const { return way_; }
  /// The largest distance of a sample from its triangle, or from its crease, scene units, and what colours'
  /// differences count as.
  float largest() const;
  /// How far the centre is from the surface, or on a crease from that.
  float centreDistance() const { return glm::length(centreOff_); }
  /// Are all samples within the limit and the centre within the tolerance?
  bool isWithin(float limit) const { return largest() <= limit && centreDistance() <= tolerance_; }
  /// From the centre to the surface, or to the crease that it is on.
  const glm::vec3& centreOff() const { return centreOff_; }
  /// The sum of the distances' 16th powers, in limits; to first order so far along the centre's way.
  float energy(float limit, float along = 0.0f) const;
  /// Hands the samples over as they are placed. Of triangles with many some are dropped.
  void assign(float limit);

  /// A way in the tangent plane towards the best place for a smooth centre: where the triangles' error would
  /// be least if the surface had the curvature that the normals around tell of (optimal Delaunay
  /// triangulation, Chen 2004, in the metric |II|, to which comes how much colours bend). 0 where that is
  /// farther than the ring is wide. Precondition: place, at `centre`, smooth.
  glm::vec3 optimalMove(const glm::vec3& normal) const;
  /// The same along a crease: towards the middle of its two neighbours.
  glm::vec3 moveAlongCrease() const;

 private:
  struct Spoke {
    Index vertex;
    glm::vec3 at;
    Index halfEdge;  // from the centre; of the triangle between this spoke and the next
    bool crease;
    Index edge;          // SampledMesh::creaseOf
    bool isNew = false;  // the triangle is to be made
  };
  struct Sector {
    Index first, last;  // triangle i is between spokes i and i + 1
    glm::vec3 normal, x, y;
    float along = 1.0f;   // what the centre's way has of the normal
    bool isBent = false;  // are triangles not all seen along the normal?
  };
  // A sample over the triangle between spokes i and i + 1, or beside spoke i.
  struct Placed {
    Index sample, spoke;
    float weight;       // of the centre's move along its way
    float height;       // from the triangle
    glm::vec3 weights;  // of the centre and the ends of its two spokes
    float tint = 0.0f;  // what its colour's difference counts as
  };
  struct PlacedOnCrease {
    Index sample, spoke;
    float weight;
    glm::vec3 off;  // from the edge
  };

  void add(Index begin, Index end);
  void addRim(const Tint& atSpoke, const Tint& atNext) { rims_.push_back({atSpoke, atNext}); }
  bool placeSector(std::size_t number, float limit);
  bool placeTriangle(Index triangle, Index guess, const Sector& sector);
  bool placeNearest(Index triangle, const Sector& sector);
  bool isFacingVertices(const Sector& sector) const;
  bool placeOnCreases(float limit);
  bool placeOnEdge(Index edge, Index from, Index to);
  void rotateTo(std::size_t first);
  bool chooseTints(float limit);
  glm::dvec3 tintForm() const;
  std::optional<Tint> bestTint(const Sector& s, const Tint& was, float limit) const;
  float seeTints(const Sector& s, const Tint& centre);
  void findWay();
  std::array<glm::vec3, 2> creaseEnds() const;
  void findNearest();
  std::size_t sectorOfGone(int which) const;

  SampledMesh& sampled_;
  float tolerance_, aim_;
  Index centreVertex_;
  std::vector<Spoke> spokes_;
  std::vector<std::array<Tint, 2>>
      rims_;                   // of the triangle after each spoke, at this and the next; if painted
  std::vector<Tint> centres_;  // of the centre, by spoke: as they were, and as they are chosen
  std::vector<Sector> sectors_;
  int creases_ = 0;
  bool mayBend_ = false, facesNormals_ = true;
  bool isTip_ = false;  // a point in which a smooth piece ends
  // Triangles that a collapse takes away, the vertices opposite to what is collapsed, and whether they lie
  // after these spokes, if those are creases. kNone: nothing is taken away.
  Index gone_[2], apex_[2];
  bool afterApex_[2];
  Index goneEdge_, goneEdgeNext_;  // a crease that goes, and the vertex at the other end of the next one
  glm::vec3 centre_, way_;
  glm::vec3 chord_;                 // along a crease through the centre, unit
  std::vector<glm::vec3> rim_;      // of a sector, from the centre, by its axes
  std::vector<float> areas_;        // of its triangles, seen along its normal; inverse, twice
  std::vector<float> cosines_;      // between its triangles' normals and its own
  std::vector<glm::vec3> normals_;  // its triangles'
  std::vector<Placed> placed_;
  std::vector<PlacedOnCrease> placedOnCreases_;
  Range feasible_;                     // so far
  glm::vec3 centreOff_;                // from the centre to the surface, by the sample next to it
  std::vector<std::uint32_t> counts_;  // of the placed samples, by spoke
};

}  // namespace sdf
