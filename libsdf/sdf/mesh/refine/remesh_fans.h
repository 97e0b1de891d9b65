// What a change of the mesh would make of it, as fans of triangles around a vertex, and how far these are
// from the surface.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Triangles (centre, rim[i], rim[i + 1]), counter-clockwise; a closed fan's last one returns to rim[0].
struct Fan {
  glm::vec3 centre;
  std::uint32_t first;        ///< of the rim, in Fans::rim
  std::uint32_t count;        ///< rim vertices
  std::uint32_t creases = 0;  ///< spokes that are creases: they cut the fan into sectors
  bool closed = true;
  bool centred = true;  ///< the centre is to be held to the surface, too; no corner
  std::uint32_t triangles() const { return closed ? count : count - 1; }
};

/// Many fans, each a change that could be made.
struct Fans {
  struct Spoke {
    glm::vec3 end;
    std::uint32_t vertex;
    bool crease;
    int material;  ///< of the triangle from here to the next
  };
  std::vector<Fan> all;
  std::vector<Spoke> rim;

  void clear() { all.clear(), rim.clear(); }
  /// The triangles around v as they are.
  void addAround(const HalfEdgeMesh& mesh, std::uint32_t v);
  /// Those around to(h) once from(h) is merged into it.
  void addCollapsed(const HalfEdgeMesh& mesh, std::uint32_t h);
  /// The two triangles at an edge as they are, and as they were with the other diagonal: open fans.
  void addEdge(const HalfEdgeMesh& mesh, std::uint32_t h);
  void addFlipped(const HalfEdgeMesh& mesh, std::uint32_t h);
  /// The four triangles around a point in the middle of the edge.
  void addSplit(const HalfEdgeMesh& mesh, std::uint32_t h);

 private:
  void begin(const glm::vec3& centre);
  void add(const HalfEdgeMesh& mesh, std::uint32_t vertex, bool crease, std::uint32_t triangle);
};

/// Large distances weigh much: the largest decides. Those beyond so many tolerances count as that, for their
/// power is to stay finite.
inline constexpr int kEnergyPower = 16;
inline constexpr float kLargestShare = 100.0f;

/// What was found of one fan.
struct FanError {
  float largest = 0.0f;     ///< distance from the surface, scene units
  std::uint32_t worst = 0;  ///< the triangle that has it
  float spoke = 0.0f;       ///< the same at the spokes' middles
  std::uint32_t worstSpoke = 0;
  float energy = 0.0f;      ///< sum over the samples of (distance / tolerance)^kEnergyPower
  bool smooth = false;      ///< two creases meet at the centre, and the surface does not turn there
  bool sound = true;        ///< no triangle is a needle or turned away from the gradient
  glm::vec3 normal{0.0f};   ///< of the surface at the centre, of the first sector; unit
  glm::vec3 offset{0.0f};   ///< off or onto the surface: makes the largest distance to either side equal
  glm::vec3 onto{0.0f};     ///< from the centre to the surface, or to the crease
  glm::vec3 balance{0.0f};  ///< along the surface, to where the triangles' errors balance
  glm::vec3 descent{0.0f};  ///< along the surface, the way on which the energy falls most; unit, or 0
};

/// Where fans are read: at the corners, centroids and middles of edges, or in large triangles, which may span
/// what the field resolves, also all over them.
enum class Sampling { Few, All };

/// Evaluates all fans in parallel; `errors` receives one entry for each.
void evaluateFans(const Fans& fans, float tolerance, Sampling sampling, const LocalField& field,
                  Progress& progress, std::vector<FanError>& errors);

}  // namespace sdf
