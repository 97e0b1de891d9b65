// A mesh each of whose triangles and creases has the points of the surface that it stands for.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/refine/tints.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Lists of numbers, each of which is in one list at most.
class Lists {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Makes room for so many lists and numbers, and keeps those that there are.
  void grow(std::size_t lists, std::size_t items) { head_.resize(lists, kNone), next_.resize(items, kNone); }
  /// Precondition: the number is in no list, or in one that is cleared or rewritten as a whole.
  void add(std::uint32_t list, std::uint32_t item) { next_[item] = head_[list], head_[list] = item; }
  void clear(std::uint32_t list) { head_[list] = kNone; }
  /// kNone: the list is empty.
  std::uint32_t first(std::uint32_t list) const { return head_[list]; }
  /// kNone: there is none.
  std::uint32_t after(std::uint32_t item) const { return next_[item]; }
  std::size_t count() const { return head_.size(); }

 private:
  std::vector<std::uint32_t> head_, next_;
};

/// A point on the surface.
struct SurfaceSample {
  glm::vec3 at;      ///< scene units
  glm::vec3 normal;  ///< unit; 0 where it is of another piece than the triangle, as next to a crease
};

/// A closed mesh that can be changed, and samples of the surface, each of which belongs to the triangle next
/// to it. Samples of creases belong to edges.
struct SampledMesh {
  using Index = HalfEdgeMesh::Index;
  static constexpr Index kNone = HalfEdgeMesh::kNone;

  /// The samples are the mesh's vertices, which lie on the surface, and the surface's points next to the
  /// middles of its triangles and edges, and inside of its triangles to places no farther apart than
  /// `spacing`. Cost: some readings of the field for each.
  SampledMesh(const FeatureMesh& mesh, const LocalField& field, float spacing, Progress& progress);
  /// Gives samples and corners their colours. `tolerance` is the distance's. Before any change.
  void paint(const LocalField& field, float tolerance, Progress& progress);

  bool isSmooth(Index v) const { return mesh.creasesAt(v) == 0; }
  /// The surface's at those of these vertices that are smooth, unit; 0 where there is none.
  glm::vec3 meanNormal(std::initializer_list<Index> vertices) const;
  /// A vertex that does not move and that no crease leads to.
  bool isTip(Index v) const;
  /// Adds a sample of a triangle, whose paint may be known.
  void add(Index triangle, const SurfaceSample& sample, const Paint* paint = nullptr);
  /// The same of an edge on a crease (creaseOf).
  void addToCrease(Index edge, const SurfaceSample& sample);
  /// Puts a vertex at p into an edge. Samples stay with the triangles that there were: Ring::assign hands
  /// them on.
  Index split(Index h, const glm::vec3& p);
  void flip(Index h);
  /// Merges from(h) into to(h), which moves to p. Samples stay where they are, as with `split`.
  void collapse(Index h, const glm::vec3& p);

  /// The sample of a triangle that is farthest from it, or whose colour is (Tints::distance).
  struct Farthest {
    Index sample = kNone;  ///< kNone: it has none
    float distance = 0.0f;
  };
  Farthest farthestOf(Index triangle) const;

  HalfEdgeMesh mesh;
  std::vector<SurfaceSample> samples;
  std::vector<glm::vec3> normals;  ///< of the surface at each vertex, unit; one side's on a crease
  Lists onTriangle;                ///< by half-edge / 3
  Lists onCrease;                  ///< by creaseOf
  std::vector<Index> creaseOf;     ///< of each half-edge on a crease its edge's number, else kNone
  Tints tints;

 private:
  void addCreases(const FeatureMesh& mesh);
  void put(Index triangle, Index sample);
  Index newSample(const SurfaceSample& sample, const Paint* paint);
  std::vector<char> besideBorders(float away) const;
  std::vector<Index> knownNextTo(const std::vector<char>& isKnown) const;
  void paintSectors(const LocalField& field, Progress& progress, const std::vector<Paint>& paint,
                    const std::vector<Index>& known, Tints& own) const;
};

/// Barycentric coordinates of a point of the triangle that is near to where these are, maybe beside it.
glm::vec3 clampedWeights(const glm::vec3& weights);

using Corners = std::array<glm::vec3, 3>;

/// A point beside a triangle.
struct OverTriangle {
  float inside;       ///< the least barycentric coordinate of the plane's nearest point: negative beside the
                      ///< triangle
  float distance;     ///< scene units
  glm::vec3 weights;  ///< barycentric coordinates of the plane's nearest point
};
OverTriangle over(const glm::vec3& p, const Corners& triangle);

}  // namespace sdf
