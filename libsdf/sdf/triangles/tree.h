// A tree of boxes over triangles: the nearest triangle, pairs that meet, and how often they wind around a
// point.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

namespace sdf {

/// The part of a triangle that a point is on.
enum class Feature : std::uint8_t {
  Face,     ///< inside
  Edge0,    ///< the edge from corner 0 to 1
  Edge1,    ///< the edge from corner 1 to 2
  Edge2,    ///< the edge from corner 2 to 0
  Corner0,  ///< corner 0
  Corner1,  ///< corner 1
  Corner2   ///< corner 2
};

/// The point of some triangles that is nearest to another one.
struct NearestPoint {
  std::uint32_t triangle = 0;
  Feature feature = Feature::Face;
  double squared = std::numeric_limits<double>::infinity();  ///< of the distance, rounded a few times
};

/// The nearest point of one triangle, which may have no area (Ericson, Real-Time Collision Detection, 2004,
/// section 5.1.5).
NearestPoint nearestOf(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// How often a triangle winds around the origin: the share of the sphere that it covers, positive where it is
/// seen from behind (Van Oosterom, Strackee 1983).
double windingOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Immutable, and read from any thread.
class TriangleTree {
 public:
  /// Sorts the triangles, at least one, into boxes, by the surface area heuristic with bins (Wald 2007). The
  /// vectors must outlive the tree. Cost: n log n.
  TriangleTree(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles);

  /// The point of all triangles that is nearest to p. `hint` is a triangle that may be near, such as the one
  /// that was nearest to a point near by. Any point will do whose squared distance is no more than `enough`.
  /// Cost: some log n; where the hint will do, no more than that.
  NearestPoint nearest(const glm::dvec3& p, std::uint32_t hint = 0, double enough = -1.0) const;

  /// How often the triangles wind around p, within some hundredths: whole numbers if they are closed
  /// (Jacobson et al. 2013); far clusters count as dipoles (Barill et al. 2018). Cost: some log n.
  double winding(const glm::dvec3& p) const;

  /// Do two triangles have a point in common beyond the corners and edges that they share? Cost: n log n, for
  /// any number of triangles around a corner, where few of them lie close to one another.
  bool crosses() const;
  /// The same of one triangle and all others. One without an area does.
  bool crosses(std::uint32_t triangle) const;
  /// The same of each, in less time; also where many cross.
  std::vector<char> crossing() const;

 private:
  struct Node {
    glm::vec3 min, max;
    std::uint32_t first = 0, count = 0;  // of order_; or, where count is 0, the first of two nodes
  };
  /// Between two planes, across about the mean normal of a node's triangles, lie all of them. Boxes of
  /// triangles that share an edge, or lie askew, are wide.
  struct Slab {
    glm::dvec3 normal{0.0};
    double low = 0.0, high = 0.0;
  };
  struct Link;
  struct Nodes;
  struct Asked;
  struct Dipole {
    glm::dvec3 centre{0.0}, area{0.0};
    double reach = 0.0;  // of a ball around the centre that holds all
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth);
  Slab slabOf(std::uint32_t first, std::uint32_t count) const;
  double leastSquaredTo(const glm::dvec3& p, std::uint32_t node, double enough) const;
  void setDipoles();
  void findLinks();
  void findHubs();
  Asked asked(std::uint32_t triangle) const;
  bool isToSkip(const Asked& asked, std::uint32_t number) const;
  bool crosses(const Asked& asked, std::uint32_t other) const;
  template <class Found>
  bool anyBelow(Nodes open, std::vector<Asked>& all, const Found& found) const;
  template <class Found>
  bool anyAround(std::uint32_t corner, Asked& asked, const Found& found) const;
  template <class Found>
  bool anyOf(Nodes below, std::vector<Asked>& all, const Found& found) const;
  template <class Visit>
  bool anyLeaf(const Visit& visit) const;

  const std::vector<glm::vec3>& points_;
  const std::vector<glm::uvec3>& triangles_;
  std::vector<Node> nodes_;
  std::vector<Slab> slabs_;           // by node
  std::vector<std::uint32_t> order_;  // of triangles, by leaf
  std::vector<Dipole> dipoles_;       // by node
  // By corner, of those of many triangles; and by node the one that all of its triangles have in common.
  std::unordered_map<std::uint32_t, std::shared_ptr<const Link>> links_;
  std::vector<std::uint32_t> hubs_;
};

}  // namespace sdf
